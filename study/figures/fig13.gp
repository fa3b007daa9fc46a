# Fig. 13: step response of the R1-400 in the four laws.
TITLE = "Choking slows both strokes of the R1-400; no law makes them alike"
SUBTITLE = "Step response, fill at 0.5 s and vent at 15.5 s, parameters of Table A1"
NAME = "Step_response_of_the_R1_400_in_four_laws"
HEIGHT = 760
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig13")

set multiplot
set lmargin at screen 0.08
set rmargin at screen 0.97
set xrange [0:24]
set xtics 2 format ""

set tmargin at screen 0.81
set bmargin at screen 0.46
@KEY
set label 1 "Travel x [mm]" @ABOVE
set yrange [-0.5:21]
set ytics 5
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("x [mm]") : NaN) with lines ls law title law_name(law)

@NEXT
set tmargin at screen 0.40
set bmargin at screen 0.095
set label 1 "Chamber pressure p [kPa, gauge]" @ABOVE
set xlabel "Time t [s]"
set xtics format "%g"
set yrange [-10:420]
set ytics 100
plot for [law = 1:4] file every 2 using "t [s]":(is_law(law) ? column("p [kPa]") : NaN) with lines ls law
unset multiplot
