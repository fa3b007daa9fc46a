# Fig. 6: velocity of the falling edge over the chamber pressure, and that of a stem on its springs.
TITLE = "Venting is steady only at a pressure held constant: springs slow it by a third"
SUBTITLE = "Stem speed of the R1-400 while its chamber vents"
NAME = "Speed_of_the_venting_stroke"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig06")
stats file using (column("in_band [1]") ? column("p_over_pa [1]") : NaN) nooutput

set tmargin at screen 0.76
set key at screen 0.97, screen 0.875 horizontal maxcols 2
set object 1 rectangle from STATS_min, graph 0 to STATS_max, graph 1 behind fillcolor rgb BAND fillstyle solid noborder
set label 2 "180 to 380 kPa" at (STATS_min + STATS_max)/2, graph 0.05 center textcolor rgb INK
set label 1 "Stem speed over C a/A (2 R T/δ)^{1/2} [1]" @ABOVE
set xlabel "Chamber over ambient pressure, p/p_a [1], p gauge"
set xrange [0:10]
set yrange [0:1]
is_curve(flow, balance) = strcol("flow") eq flow && strcol("balance") eq balance
plot for [flow in FLOWS] file using "p_over_pa [1]":(is_curve(flow, "constant pressure") ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2) title "pressure constant, ".flow_name(flow), \
     for [flow in FLOWS] file using "p_over_pa [1]":(is_curve(flow, "spring") ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 3 : 4) lc rgb GREEN title "against 12 springs, ".flow_name(flow)
