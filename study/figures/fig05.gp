# Fig. 5: velocity of the leading edge over the reciprocal of the chamber pressure.
TITLE = "While the chamber fills, the stem slows down with the ratio of pressures"
SUBTITLE = "Filling stroke at a pressure taken as constant, Eq. (12); filling goes from right to left"
NAME = "Speed_of_the_filling_stroke"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig05")

set lmargin at screen 0.08
set rmargin at screen 0.97
set tmargin at screen 0.80
unset key
set label 1 "Stem speed over (C a/A) √(2 R T/δ) [1]" @ABOVE
set label 2 "inverse law, Eq. (13)" at 3.0, 3.0 right offset -1,0.4 textcolor rgb GREY
set label 3 flow_name("paper") at 4.0, 3.464 left offset 0,-1.2 textcolor rgb BLUE
set label 4 flow_name("choked") at 4.0, 1.937 left offset 0,-1.2 textcolor rgb BLUE
set xlabel "Supply over chamber pressure P_1/P_2, absolute [1]"
set xrange [1:5]
set yrange [0:5]
is_flow(flow) = strcol("flow") eq flow
plot file using "P1_over_P2 [1]":(is_flow("paper") ? column("inverse_law [1]") : NaN) with lines lw 2 dt (2,4) lc rgb GREY, \
     for [flow in FLOWS] file using "P1_over_P2 [1]":(is_flow(flow) ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2)
