# Air leaves a vessel through an orifice: measured pressure and gas temperature, laws fitted to the pressure.
TITLE = "An emptying vessel needs choking and heat from the wall"
SUBTITLE = "16.2 L of air from 7.9 bar, 298 K; orifice area and heat transfer fitted to the pressures alone"
NAME = "Measured_vessel"
HEIGHT = 720
load system("dirname '".ARG0."'")."/style.gp"
file = table("measured_vessel_curves")

LAWS = "paper isothermal adiabatic convection convection-both"
COUNT = words(LAWS)
array COLOUR[COUNT] = [BLUE, BLUE, VERMILLION, GREEN, PURPLE]
array POINT[COUNT] = [6, 7, 5, 9, 11]
array TEXT[COUNT] = ["isothermal, paper's flow", "isothermal, nozzle", "adiabatic, nozzle", \
  "natural convection, nozzle", "the same, fitted to T as well"]
set for [i = 1:COUNT] style line 10+i lc rgb COLOUR[i] lw 2 dt solid
set style line 11 lc rgb BLUE lw 2 dt (7,4)
set style line 15 lc rgb PURPLE lw 2 dt (7,4)
of(i, name) = strcol("law") eq word(LAWS, i) ? column(name) : NaN

set multiplot

# heading and key
set lmargin at screen 0.075
set rmargin at screen 0.975
@BLANK
@KEY width -4
plot [0:1][0:1] NaN with points pt 7 ps 0.9 lc rgb INK title "measured", \
  for [i = 1:COUNT] NaN with lines ls 10+i title TEXT[i]
@NEXT
@FRAME
set xrange [0:56]
set xtics 10

do for [side = 1:2] {
  set lmargin at screen (side == 1 ? 0.075 : 0.575)
  set rmargin at screen (side == 1 ? 0.475 : 0.975)
  channel = side == 1 ? "p" : "T"
  unit = side == 1 ? " [kPa]" : " [K]"
  NAMED = side == 1 ? "Pressure, absolute" : "Gas temperature"

  set tmargin at screen 0.76
  set bmargin at screen 0.42
  set format x ""
  unset xlabel
  unset label
  set label 1 NAMED.unit @ABOVE
  if (side == 1) { set yrange [0:800]; set ytics 200 } else { set yrange [160:310]; set ytics 25 }
  plot for [i = 1:COUNT] file using "t [s]":(of(i, channel.unit)) with lines ls 10+i, \
       file using "t [s]":(of(1, channel."_data".unit)) with points pt 7 ps 0.6 lc rgb INK

  set tmargin at screen 0.345
  set bmargin at screen 0.09
  set format x "%g"
  set xlabel "Time [s]"
  unset label
  set label 1 "Measured less model".unit @ABOVE
  if (side == 1) { set yrange [-28:28]; set ytics 10 } else { set yrange [-50:120]; set ytics 50 }
  set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead back lw 1 lc rgb GREY
  plot for [i = 1:COUNT] file using "t [s]":(of(i, channel."_residual".unit)) \
    with linespoints ls 10+i lw 1 pt POINT[i] ps 0.55
  unset arrow 1
}
unset multiplot
