# Fig. 8: chamber pressure at which both edges are equally fast, over the supply pressure.
TITLE = "Both strokes are equally fast near 0.6 of the supply; if the nozzle chokes, near 0.75"
SUBTITLE = "Chamber pressure at which filling and venting move the stem equally fast, Eq. (35)"
NAME = "Pressure_of_equal_speeds_over_supply"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig08")
LIGHT_RED = "#FBE0DC"
stats file using (column("typical [1]") > 0 ? column("ps_over_pa [1]") : NaN) nooutput
stats file using (strcol("flow") eq "paper" ? column("asymptote [1]") : NaN) name "PAPER" nooutput
stats file using (strcol("flow") eq "choked" ? column("asymptote [1]") : NaN) name "CHOKED" nooutput

set lmargin at screen 0.08
set rmargin at screen 0.885
set tmargin at screen 0.80
unset key
set object 1 rectangle from STATS_min, graph 0 to STATS_max, graph 1 behind fillcolor rgb LIGHT_RED fillstyle solid noborder
set arrow 1 from graph 0, first PAPER_max to graph 1, first PAPER_max nohead dt (2,4) lw 1.5 lc rgb GREY
set arrow 2 from graph 0, first CHOKED_max to graph 1, first CHOKED_max nohead dt (2,4) lw 1.5 lc rgb GREY
set label 1 "Chamber over supply pressure p/p_s, both gauge [1]" @ABOVE
set label 2 "typical supply, 140 to 800 kPa" at (STATS_min + STATS_max)/2, graph 0.05 center textcolor rgb INK
set label 3 sprintf("limit %.3f", PAPER_max) at graph 1, first PAPER_max left offset 0.6,0 textcolor rgb GREY
set label 4 sprintf("limit %.3f", CHOKED_max) at graph 1, first CHOKED_max left offset 0.6,0 textcolor rgb GREY
set label 5 flow_name("paper") at 4.0, 0.596 left offset 0,-1 textcolor rgb BLUE
set label 6 flow_name("choked") at 4.0, 0.759 left offset 0,-1 textcolor rgb BLUE
set label 7 "venting is faster" at 4.7, 0.90 center textcolor rgb GREY
set label 8 "filling is faster" at 4.7, 0.30 center textcolor rgb GREY
set xlabel "Supply over ambient pressure p_s/p_a, supply in gauge pressure [1]"
set xrange [0:10]
set xtics 1
set yrange [0:1]
set format y "%.1f"
plot for [flow in FLOWS] file using "ps_over_pa [1]":(strcol("flow") eq flow ? column("p_over_ps [1]") : NaN) with lines ls (flow eq "paper" ? 1 : 2)
