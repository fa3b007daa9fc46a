# Fig. 6: velocity of the falling edge over the chamber pressure, and that of a stem on its springs.
TITLE = "On its springs the venting stem gains speed on its way; Eq. (25) has it lose speed"
SUBTITLE = "Venting stroke of the R1-400; venting goes from right to left"
NAME = "Speed_of_the_venting_stroke"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig06")
YELLOW = "#FFF2B3"
stats file using (column("in_band [1]") > 0 ? column("p_over_pa [1]") : NaN) nooutput

set lmargin at screen 0.08
set rmargin at screen 0.97
set tmargin at screen 0.80
unset key
set object 1 rectangle from STATS_min, graph 0 to STATS_max, graph 1 behind fillcolor rgb YELLOW fillstyle solid noborder
set label 1 "Stem speed over (C a/A) √(2 R T/δ) [1]" @ABOVE
set label 2 "bench set of\n12 springs,\n180 to 380 kPa" at (STATS_min + STATS_max)/2, graph 0.16 center textcolor rgb INK
set label 3 "pressure taken as constant, ".flow_name("paper") at 5, 0.913 left offset 0,-1.1 textcolor rgb BLUE
set label 4 "pressure taken as constant, ".flow_name("choked") at 5, 0.484 left offset 0,-1 textcolor rgb BLUE
set label 5 "on the springs, ".flow_name("paper") at STATS_max, 0.628 left offset 0.8,0 textcolor rgb GREEN
set label 6 "on the springs, ".flow_name("choked") at STATS_max, 0.342 left offset 0.8,0 textcolor rgb GREEN
set xlabel "Chamber over ambient pressure p/p_a, p gauge [1]"
set xrange [0:10]
set yrange [0:1]
set format y "%.1f"
is_curve(flow, balance) = strcol("flow") eq flow && strcol("balance") eq balance
plot for [flow in FLOWS] file using "p_over_pa [1]":(is_curve(flow, "constant pressure") ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2), \
     for [flow in FLOWS] file using "p_over_pa [1]":(is_curve(flow, "spring") ? column("v_over_scale [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2) lc rgb GREEN
