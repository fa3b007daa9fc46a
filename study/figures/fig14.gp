# Fig. 14: step response of the 37-13 without its upper limiter, in the four laws.
TITLE = "Without its upper limiter the 37-13 creeps to the top and leaves it at once"
SUBTITLE = "Step response, fill at 0.5 s and vent at 15.5 s, parameters of Table A1"
NAME = "Step_response_of_the_37_13_without_upper_limiter"
HEIGHT = 760
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig14")

set multiplot
set lmargin at screen 0.08
set rmargin at screen 0.97
set xrange [0:30.5]
set xtics 5 format ""

set tmargin at screen 0.81
set bmargin at screen 0.46
@KEY
set label 1 "Travel x [mm]" @ABOVE
set yrange [-2:*]
set ytics 10
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("x [mm]") : NaN) with lines ls law title law_name(law)

@NEXT
set tmargin at screen 0.40
set bmargin at screen 0.095
set label 1 "Chamber pressure p [kPa, gauge]" @ABOVE
set xlabel "Time t [s]"
set xtics format "%g"
set yrange [-5:150]
set ytics 20
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("p [kPa]") : NaN) with lines ls law
unset multiplot
