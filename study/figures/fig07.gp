# Fig. 7: chamber pressure at which both edges are equally fast, over the reciprocal of the supply pressure.
TITLE = "A choking nozzle moves the pressure of equal speeds up, most at a high supply"
SUBTITLE = "Chamber pressure at which filling and venting move the stem equally fast, Eq. (35)"
NAME = "Pressure_of_equal_speeds"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig07")

set lmargin at screen 0.08
set rmargin at screen 0.97
set tmargin at screen 0.80
unset key
set label 1 "Chamber over supply pressure p/p_s, both gauge [1]" @ABOVE
set label 2 flow_name("paper") at 0.5, 0.581 left offset 0,-1 textcolor rgb BLUE
set label 3 flow_name("choked") at 0.5, 0.711 left offset 0,1 textcolor rgb BLUE
set label 4 "venting is faster" at 1.5, 0.85 center textcolor rgb GREY
set label 5 "filling is faster" at 1.5, 0.25 center textcolor rgb GREY
set xlabel "Ambient over supply pressure p_a/p_s, supply in gauge pressure [1]"
set xrange [0:2]
set yrange [0:1]
set format y "%.1f"
plot for [flow in FLOWS] file using "pa_over_ps [1]":(strcol("flow") eq flow ? column("p_over_ps [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2)
