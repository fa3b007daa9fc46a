# Work and precision: error against time of every integrator, in the four laws.
TITLE = "At the same error the stepper needs a fraction of the others' time"
SUBTITLE = "Largest error of x over stroke against time of one fill-and-vent; CasADi was given the times of events"
NAME = "Work_and_precision_of_the_integrators"
HEIGHT = 860
load system("dirname '".ARG0."'")."/style.gp"
file = table("work_precision")

WANTED = 1e-6 # error over stroke at which the design compares times
NAMES = system("tail -n +2 '".file."' | sed 's/[ ,].*//' | awk '!seen[$0]++'") # first words of who took part
array COLOUR[4] = [BLUE, VERMILLION, GREEN, PURPLE]
array POINT[4] = [7, 6, 8, 4]
curve(law, who, name) = is_law(law) && word(strcol("integrator"), 1) eq who ? column(name) : NaN

stats file using (column("error") > 0 ? column("time_us") : NaN):"error" name "ALL" nooutput

set multiplot
@BLANK
set key at screen 0.06, screen 1 - 75.0/HEIGHT left top horizontal maxcols 4 width 2
plot [0:1][0:1] for [k = 1:words(NAMES)] NaN with linespoints lc rgb COLOUR[k] lw 2 pt POINT[k] title word(NAMES, k)
@NEXT
@FRAME
set xrange [0.7*ALL_min_x:1.4*ALL_max_x]
set yrange [0.5*ALL_min_y:1]
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set ytics 100
set arrow 1 from graph 0, first WANTED to graph 1, first WANTED nohead back lw 1 dt (2,4) lc rgb GREY
do for [law = 1:4] {
  left = law % 2 == 1
  top = law <= 2
  set lmargin at screen (left ? 0.09 : 0.57)
  set rmargin at screen (left ? 0.49 : 0.97)
  set tmargin at screen (top ? 0.81 : 0.38)
  set bmargin at screen (top ? 0.55 : 0.12)
  set label 1 "Error of x over stroke [1]" @ABOVE
  set label 2 law_name(law) at graph 0, graph 1 left offset 0,2.1 font ",15" textcolor rgb INK
  set xlabel "Time of one fill-and-vent [µs]"
  plot for [k = 1:words(NAMES)] file using (curve(law, word(NAMES, k), "time_us")):(column("error")) with linespoints lc rgb COLOUR[k] lw 2 pt POINT[k] ps 0.7 notitle
}
unset multiplot
