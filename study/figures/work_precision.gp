# Work and precision: error against time of the stepper and of CVODE, in the four laws.
TITLE = "At the same error the stepper needs a fraction of CVODE's time"
SUBTITLE = "One fill-and-vent of the R1-400, a point for each tolerance"
NAME = "Work_and_precision_of_the_integrators"
HEIGHT = 640
load system("dirname '".ARG0."'")."/style.gp"
file = table("work_precision")

WANTED = 1e-6 # error over stroke at which the design compares times
is_cvode(name) = name eq "CVODE" || name eq "cvode"
curve(law, cvode, name) = is_law(law) && is_cvode(strcol("integrator")) == cvode ? column(name) : NaN
point(cvode) = cvode ? 6 : 7

stats file using (column("error") > 0 ? column("time_us") : NaN) name "ALL" nooutput
set xrange [0.7*ALL_min:1.4*ALL_max]
HIGHEST = 0
do for [cvode = 0:1] {
  stats file using (is_cvode(strcol("integrator")) == cvode ? column("time_us") : NaN):"error" name "OWN" nooutput
  HIGHEST = HIGHEST > OWN_max_y ? HIGHEST : OWN_max_y
  name = cvode ? "CVODE" : "stepper"
  set label 2 + cvode name at OWN_min_x, OWN_max_y center offset 0,1 font ",15" textcolor rgb INK
}

set lmargin at screen 0.10
set rmargin at screen 0.97
set tmargin at screen 0.775
set bmargin at screen 0.115
@KEY
set label 1 "Largest error of x over stroke [1]" @ABOVE
set xlabel "Time for one fill-and-vent [µs]"
set logscale xy
set format y "10^{%T}"
set xtics (5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000)
set yrange [*:5*HIGHEST]
set arrow 1 from graph 0, first WANTED to graph 1, first WANTED nohead back lw 1 dt (2,4) lc rgb GREY
plot for [law = 1:4] NaN with lines ls law title law_name(law), \
     for [law = 1:4] for [cvode = 0:1] file using (curve(law, cvode, "time_us")):(column("error")) with linespoints ls law pt point(cvode) ps 0.8 notitle
