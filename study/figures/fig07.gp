# Fig. 7: chamber pressure at which both edges are equally fast, over the reciprocal of the supply pressure.
TITLE = "Where both strokes are equally fast: above the curve, venting is faster"
SUBTITLE = "Limit of inequality (35), and the same limit with a nozzle that chokes"
NAME = "Pressure_of_equal_speeds"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig07")

set tmargin at screen 0.80
set key at screen 0.97, screen 0.865 horizontal
set label 1 "Chamber over supply pressure, p/p_s [1], both gauge" @ABOVE
set xlabel "Ambient over supply pressure, p_a/p_s [1], p_s gauge"
set xrange [0:2]
set yrange [0:1]
set format y "%.1f"
plot for [flow in FLOWS] file using "pa_over_ps [1]":(strcol("flow") eq flow ? column("p_over_ps [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2) title flow_name(flow)
