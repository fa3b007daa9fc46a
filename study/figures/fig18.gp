# Fig. 18, hypothesis 4: the bench set is varied. The classes are those of the paper.
TITLE = "A higher bench set brings the time constants together and the shapes apart"
SUBTITLE = "R1-400, spring chosen for the bench set below each group"
NAME = "Bench_set_varied"
HEIGHT = 760
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig18")

stats file using "variable" nooutput
classes = int(STATS_max)
stats file using "T1_s" name "LAG" nooutput
stats file using "T2_s" name "RAMP" nooutput
stats file using "asymmetry" name "SHAPE" nooutput
larger(a, b) = a > b ? a : b
value_of(law, name) = is_law(law) ? column(name) : NaN
BENCH_SETS = "80–240 120–280 160–320 200–360"
bench_set(class) = class <= words(BENCH_SETS) ? word(BENCH_SETS, class) : sprintf("class %d", class)
colour(law) = law < 3 ? BLUE : VERMILLION
pale(law) = law < 3 ? "#99C7E0" : "#EEBE99"
# bars of a group: isothermal T_1, T_2, polytropic T_1, T_2
place(class, bar) = class + 0.19*(bar - 2.5)

set multiplot

# heading and key
set lmargin at screen 0.075
set rmargin at screen 0.975
@BLANK
@KEY width 0
plot [0:1][0:1] \
  NaN with boxes lc rgb colour(1) title "isothermal, filling T_1", NaN with boxes lc rgb pale(1) title "isothermal, venting T_2", \
  NaN with boxes lc rgb colour(3) title "polytropic, filling T_1", NaN with boxes lc rgb pale(3) title "polytropic, venting T_2"
@NEXT
@FRAME

set xrange [0.4:classes + 0.6]
set grid noxtics
set xtics scale 0
do for [flow = 1:2] {
  set lmargin at screen (flow == 1 ? 0.075 : 0.545)
  set rmargin at screen (flow == 1 ? 0.505 : 0.975)
  unset label
  set label 2 flow_name(word(FLOWS, flow)) at graph 1, graph 1 right offset 0,0.8 textcolor rgb GREY

  set tmargin at screen 0.80
  set bmargin at screen 0.44
  set format y (flow == 1 ? "%g" : "")
  set xtics ("" 1)
  unset xlabel
  if (flow == 1) { set label 1 "Time constants [s]" @ABOVE }
  set yrange [0:1.06*larger(LAG_max, RAMP_max)]
  plot for [law = flow:4:2] file using (place(column("variable"), law < 3 ? 1 : 3)):(value_of(law, "T1_s")):(0.17) with boxes lc rgb colour(law), \
       for [law = flow:4:2] file using (place(column("variable"), law < 3 ? 2 : 4)):(value_of(law, "T2_s")):(0.17) with boxes lc rgb pale(law)

  set tmargin at screen 0.37
  set bmargin at screen 0.095
  set format y (flow == 1 ? "%.2f" : "")
  do for [class = 1:classes] { set xtics add (bench_set(class) class) }
  set xlabel "Bench set [kPa, gauge]"
  if (flow == 1) { set label 1 "Asymmetry [1]" @ABOVE }
  set yrange [0:1.06*SHAPE_max]
  plot for [law = flow:4:2] file using (place(column("variable"), law < 3 ? 1.5 : 3.5)):(value_of(law, "asymmetry")):(0.36) with boxes lc rgb colour(law)
}
unset multiplot
