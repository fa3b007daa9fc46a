# Fig. 8: chamber pressure at which both edges are equally fast, over the supply pressure.
TITLE = "Both strokes are equally fast near 0.6 of the supply; if air chokes, near 0.75"
SUBTITLE = "Above its curve venting is faster, below it filling"
NAME = "Pressure_of_equal_speeds_over_supply"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig08")
stats file using (column("typical [1]") ? column("ps_over_pa [1]") : NaN) nooutput

set tmargin at screen 0.80
set key at screen 0.97, screen 0.865 horizontal
set object 1 rectangle from STATS_min, graph 0 to STATS_max, graph 1 behind fillcolor rgb BAND fillstyle solid noborder
set label 2 "typical supply, 140 to 800 kPa" at (STATS_min + STATS_max)/2, graph 0.05 center textcolor rgb INK
set label 1 "Chamber over supply pressure, p/p_s [1], both gauge" @ABOVE
set xlabel "Supply over ambient pressure, p_s/p_a [1], p_s gauge"
set xrange [0:10]
set xtics 1
set yrange [0:1]
set format y "%.1f"
set rmargin at screen 0.90
do for [flow in FLOWS] {
  stats file using (strcol("flow") eq flow ? column("asymptote [1]") : NaN) name "LIMIT_".flow nooutput
}
set label 3 sprintf("%.3f", LIMIT_paper_min) at 10, LIMIT_paper_min left offset 0.8,0 textcolor rgb GREY
set label 4 sprintf("%.3f", LIMIT_choked_min) at 10, LIMIT_choked_min left offset 0.8,0 textcolor rgb GREY
plot for [flow in FLOWS] file using "ps_over_pa [1]":(strcol("flow") eq flow ? column("p_over_ps [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2) title flow_name(flow), \
     for [flow in FLOWS] file using (0):(strcol("flow") eq flow ? column("asymptote [1]") : NaN):(10):(0) every 1000 with vectors nohead lw 1.5 dt (2,4) lc rgb GREY notitle, \
     NaN with lines lw 1.5 dt (2,4) lc rgb GREY title "limit at high supply"
