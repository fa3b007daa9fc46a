# How the cost grows: over rows, effects, parameters, threads.
TITLE = "Cost grows in proportion to rows, beyond what the steps of a simulation cost"
SUBTITLE = "Median of repeated runs; one thread unless the axis says otherwise, closeloop with all"
NAME = "Growth_of_the_cost"
HEIGHT = 790
load system("dirname '".ARG0."'")."/style.gp"
file = table("scaling")

TASKS = "read fit scan closeloop"
AXES = "rows effects parameters threads"
array MEANING[4] = ["read a log", "fit parameters", "scan effects", "closeloop, all of it"]
array XLABEL[4] = ["Rows of the log [1]", "Effects scanned [1]", "Parameters fitted [1]", "Threads [1]"]
array SERIES[4] = ["read fit scan closeloop", "scan", "fit", "fit scan"] # over each axis
array COLOUR[4] = [BLUE, VERMILLION, GREEN, PURPLE]
array POINT[4] = [7, 6, 8, 4]
number(task) = task eq "read" ? 1 : task eq "fit" ? 2 : task eq "scan" ? 3 : 4
curve(axis, k, name) = strcol("grows") eq word(AXES, axis) && strcol("task") eq word(TASKS, k) ? column(name) : NaN

set multiplot
@BLANK
@KEY
plot [0:1][0:1] for [k = 1:4] NaN with linespoints lc rgb COLOUR[k] lw 2 pt POINT[k] title MEANING[k]
@NEXT
@FRAME
do for [axis = 1:4] {
  left = axis % 2 == 1
  top = axis <= 2
  set lmargin at screen (left ? 0.09 : 0.57)
  set rmargin at screen (left ? 0.49 : 0.97)
  set tmargin at screen (top ? 0.80 : 0.38)
  set bmargin at screen (top ? 0.52 : 0.10)
  set label 1 "Time [s]" @ABOVE
  set xlabel XLABEL[axis]
  if (axis == 1) { set logscale xy; set format "10^{%T}"; set ytics 100; set xrange [500:*] }
  if (axis > 1) { unset logscale; set format "%g"; set ytics autofreq; set yrange [0:*]; set xrange [0:*] }
  if (axis == 4) { set xtics 1 }
  plot for [task in SERIES[axis]] file using (curve(axis, number(task), "value")):(curve(axis, number(task), "median [s]")) with linespoints lc rgb COLOUR[number(task)] lw 2 pt POINT[number(task)] ps 0.8 notitle
}
unset multiplot
