# Fig. 5: velocity of the leading edge over the reciprocal of the chamber pressure.
TITLE = "While the chamber fills, the stem slows down with the pressure ratio"
SUBTITLE = "Stem speed at constant chamber pressure, Eq. (12); the chamber fills from right to left"
NAME = "Speed_of_the_filling_stroke"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig05")

set tmargin at screen 0.80
set key at screen 0.97, screen 0.865 horizontal
set label 1 "Stem speed over C a/A (2 R T/δ)^{1/2} [1]" @ABOVE
set xlabel "Supply over chamber pressure, absolute, P_1/P_2 [1]"
set xrange [1:5]
set yrange [0:5]
plot file using "P1_over_P2 [1]":(strcol("flow") eq "paper" ? column("inverse_law [1]") : NaN) with lines lw 2 dt (2,4) lc rgb GREY title "inverse law, Eq. (13)", \
     for [flow in FLOWS] file using "P1_over_P2 [1]":(strcol("flow") eq flow ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2) title flow_name(flow)
