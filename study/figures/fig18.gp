# Fig. 18, hypothesis 4: the bench set is varied. Classes and colours are those of the paper.
TITLE = "A higher bench set brings the time constants together and the shapes apart"
SUBTITLE = "R1-400, spring chosen for the bench set of each class"
NAME = "Bench_set_varied"
HEIGHT = 800
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig18")

stats file using "variable" nooutput
classes = int(STATS_max)
stats file using "T1_s" name "LAG" nooutput
stats file using "T2_s" name "RAMP" nooutput
stats file using "asymmetry" name "SHAPE" nooutput
larger(a, b) = a > b ? a : b
value_of(gas, flow, name) = strcol("gas") eq gas && strcol("flow") eq flow ? column(name) : NaN
BENCH_SETS = "80–240 120–280 160–320 200–360"
class_name(class) = sprintf("%d", class).(class <= words(BENCH_SETS) ? "\n".word(BENCH_SETS, class) : "")

# what is drawn: colour; a hatched bar is the polytropic chamber
array COLOUR[3] = ["#7FB8E6", "#00308F", GREY]
array MEANING[3] = ["T_1, filling (lag)", "T_2, venting (integrator)", "asymmetry"]
WIDE = 0.18
place(class, bar) = class + WIDE*1.1*(bar - 2.5)

set multiplot

# heading and key
set lmargin at screen 0.075
set rmargin at screen 0.965
@BLANK
@KEY
plot [0:1][0:1] for [gas = 1:2] for [k = 1:3] NaN with boxes lc rgb COLOUR[k] fill pattern (gas == 1 ? 3 : 4) border lc rgb COLOUR[k] title MEANING[k].", ".word(GASES, gas)
@NEXT
@FRAME

set xrange [0.4:classes + 0.6]
set grid noxtics
set xtics scale 0
do for [flow in FLOWS] {
  first = flow eq word(FLOWS, 1)
  set lmargin at screen (first ? 0.075 : 0.555)
  set rmargin at screen (first ? 0.485 : 0.965)
  unset label
  set label 2 flow_name(flow) at graph 1, graph 1 right offset 0,0.8 textcolor rgb GREY

  set tmargin at screen 0.775
  set bmargin at screen 0.45
  set format y (first ? "%g" : "")
  set xtics ("" 1)
  unset xlabel
  if (first) { set label 1 "Time constants [s]" @ABOVE }
  set yrange [0:1.06*larger(LAG_max, RAMP_max)]
  plot for [k = 1:2] for [gas = 1:2] file using (place(column("variable"), 2*(gas - 1) + k)):(value_of(word(GASES, gas), flow, sprintf("T%d_s", k))):(WIDE) \
    with boxes lc rgb COLOUR[k] fill pattern (gas == 1 ? 3 : 4) border lc rgb COLOUR[k]

  set tmargin at screen 0.38
  set bmargin at screen 0.12
  set format y (first ? "%.2f" : "")
  do for [class = 1:classes] { set xtics add (class_name(class) class) }
  set xlabel "Class of bench set [kPa, gauge]" offset 0,-1
  if (first) { set label 1 "Asymmetry [1]" @ABOVE }
  set yrange [0:1.06*SHAPE_max]
  plot for [gas = 1:2] file using (place(column("variable"), 2*gas - 0.5)):(value_of(word(GASES, gas), flow, "asymmetry")):(2*WIDE) \
    with boxes lc rgb COLOUR[3] fill pattern (gas == 1 ? 3 : 4) border lc rgb COLOUR[3]
}
unset multiplot
