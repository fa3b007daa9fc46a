# Fig. 5: velocity of the leading edge over the reciprocal of the chamber pressure.
TITLE = "On filling, the stem slows down as the inverse of the chamber pressure, or faster"
SUBTITLE = "Filling stroke from a supply of 400 kPa gauge, pressure taken as constant, Eq. (12); filling goes from right to left"
NAME = "Speed_of_the_filling_stroke"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig05")

set lmargin at screen 0.08
set rmargin at screen 0.97
set tmargin at screen 0.75
unset key
set label 1 "Stem speed over (C a/A) √(2 R T/δ) [1]" at graph 0, graph 1 left offset 0,2.6 textcolor rgb INK
set label 2 "inverse law, Eq. (13)" at 6.0, 3.008 right offset -1,0.4 textcolor rgb GREY
set label 3 flow_name("paper") at 8.0, 3.475 left offset 0,-1.2 textcolor rgb BLUE
set label 4 flow_name("choked") at 8.0, 1.942 left offset 0,-1.2 textcolor rgb BLUE
set label 5 "Chamber pressure, absolute [kPa]" at graph 1, graph 1 right offset 0,2.6 textcolor rgb INK
set xlabel "Reciprocal of the chamber pressure 1/P_2, absolute [1/MPa]"
set xrange [0:10]
set xtics 1
set yrange [0:5]
set x2range [0:10]
set x2tics out scale 0.6 textcolor rgb INK
set x2tics ("500" 1e3/500)
do for [P_2 in "400 300 250 200 150 125 100"] { set x2tics add (P_2 1e3/P_2) }
is_flow(flow) = strcol("flow") eq flow
plot file using "reciprocal_P2 [1/MPa]":(is_flow("paper") ? column("inverse_law [1]") : NaN) with lines lw 2 dt (2,4) lc rgb GREY, \
     for [flow in FLOWS] file using "reciprocal_P2 [1/MPa]":(is_flow(flow) ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2)
