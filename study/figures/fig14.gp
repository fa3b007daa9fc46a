# Fig. 14: step response of the 37-13 without its upper limiter, in the four laws.
TITLE = "Without its upper limiter the modelled 37-13 goes far beyond its travel"
SUBTITLE = "Step response, fill at 0.5 s and vent at 15.5 s, parameters of Table A1; the record ends at 30.5 s"
NAME = "Step_response_of_the_37_13_without_upper_limiter"
HEIGHT = 760
TRAVEL = 38.1 # [mm] Table A1
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig14")
stats file using "x [mm]" nooutput

set multiplot
set lmargin at screen 0.08
set rmargin at screen 0.97
set xrange [0:32]
set xtics 4 format ""

set tmargin at screen 0.81
set bmargin at screen 0.46
@KEY
set label 1 "Travel x [mm]" @ABOVE
set label 2 sprintf("travel of the actuator: %g mm", TRAVEL) at 6.4, TRAVEL left offset 0,-0.9 textcolor rgb GREY
set label 3 sprintf("highest: %.0f mm", STATS_max) at 17, STATS_max left textcolor rgb INK
set arrow 1 from graph 0, first TRAVEL to graph 1, first TRAVEL nohead lw 1.5 dt (2,4) lc rgb GREY
set yrange [-2:72]
set ytics 10
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("x [mm]") : NaN) with lines ls law title law_name(law)

@NEXT
unset arrow 1
set tmargin at screen 0.40
set bmargin at screen 0.095
set label 1 "Chamber pressure p [kPa, gauge]" @ABOVE
set xlabel "Time t [s]"
set xtics format "%g"
set yrange [-5:145]
set ytics 20
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("p [kPa]") : NaN) with lines ls law
unset multiplot
