# A diaphragm servomotor: static loop of pressure and position with the balance of forces, and two step responses.
TITLE = "Servomotor: friction that grows, a spring that hardens"
SUBTITLE = "DAMADICS benchmark, static loop; pressure drives the model, so that the balance of forces stands alone"
NAME = "Measured_servomotor"
HEIGHT = 860
load system("dirname '".ARG0."'")."/style.gp"
loop = table("measured_damadics_loop")
edges = table("measured_damadics_edges")

LAWS = "coulomb friction-position friction-position+hardening"
array COLOUR[3] = [BLUE, ORANGE, GREEN]
array POINT[3] = [7, 5, 9]
array TEXT[3] = ["Coulomb, linear spring", "friction grows with travel", "and the spring hardens"]
set for [i = 1:3] style line 10+i lc rgb COLOUR[i] lw 2 dt solid
of(i, kind, name) = strcol("law") eq word(LAWS, i) && strcol("kind") eq kind ? column(name) : NaN
branch(i, sign, name) = column("direction [1]") == sign ? of(i, "point", name) : NaN
on(which, name) = strcol("edge") eq which ? column(name) : NaN

set multiplot

# heading and key of the loop
set lmargin at screen 0.075
set rmargin at screen 0.975
@BLANK
@KEY width -4
plot [0:1][0:1] \
  NaN with points pt 7 ps 0.9 lc rgb INK title "pressure rising", \
  NaN with points pt 6 ps 0.9 lc rgb INK title "pressure falling", \
  for [i = 1:3] NaN with lines ls 10+i title TEXT[i]
@NEXT
@FRAME

# the loop
set lmargin at screen 0.075
set rmargin at screen 0.475
set tmargin at screen 0.79
set bmargin at screen 0.485
set label 1 "Travel [% of 38.1 mm]" @ABOVE
set label 2 "Chamber pressure, gauge [kPa]" at graph 1, graph 0 right offset 0,-2.2 textcolor rgb INK
set xrange [0:118]
set yrange [-3:113]
set xtics 20
set ytics 25
plot for [i in "1 3"] loop using (of(int(i), "ramp", "p [kPa]")):(of(int(i), "ramp", "x [%]")) \
    with lines ls 10+int(i), \
  loop using (branch(1, 1, "p [kPa]")):(branch(1, 1, "x [%]")) with points pt 7 ps 0.6 lc rgb INK, \
  loop using (branch(1, -1, "p [kPa]")):(branch(1, -1, "x [%]")) with points pt 6 ps 0.6 lc rgb INK

# what is left of the pressure
@NEXT
set lmargin at screen 0.575
set rmargin at screen 0.975
set label 1 "Measured less model [kPa]" @ABOVE
set label 2 "Travel [%]" at graph 1, graph 0 right offset 0,-2.2 textcolor rgb INK
set xrange [0:108]
set yrange [-1.7:1.7]
set ytics 0.5
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead back lw 1 lc rgb GREY
plot for [i = 1:3] loop using (branch(i, 1, "x [%]")):(branch(i, 1, "residual [kPa]")) \
    with linespoints ls 10+i lw 1 pt POINT[i] ps 0.6, \
  for [i = 1:3] loop using (branch(i, -1, "x [%]")):(branch(i, -1, "residual [kPa]")) \
    with linespoints ls 10+i lw 1 dt (4,3) pt POINT[i]-1 ps 0.6

# heading and key of the steps
@NEXT
unset arrow 1
unset xlabel
set lmargin at screen 0.075
set rmargin at screen 0.975
set tmargin at screen 0.40
set bmargin at screen 0.36
@BLANK
set label 3 "Two steps of the same kind of servomotor, both nearer to a first-order lag than to an integrator" \
  at screen 0.02, screen 0.405 left textcolor rgb INK
set key at screen 0.06, screen 0.385 left top horizontal maxcols 4 width 1
plot [0:1][0:1] NaN with points pt 7 ps 0.9 lc rgb INK title "pressure up", \
  NaN with points pt 6 ps 0.9 lc rgb INK title "pressure down", \
  NaN with lines lw 2 lc rgb BLUE title "lag", NaN with lines lw 2 dt (7,4) lc rgb VERMILLION title "integrator"
@NEXT
@FRAME

set tmargin at screen 0.305
set bmargin at screen 0.075
set lmargin at screen 0.075
set rmargin at screen 0.475
set xrange [0:7.2]
set yrange [-0.5:10.5]
set xtics 1
set ytics 2
set label 1 "Travel [tenths of full travel]" @ABOVE
set label 2 "Time [s]" at graph 1, graph 0 right offset 0,-2.2 textcolor rgb INK
plot for [e in "up down"] edges using "t [s]":(on(e, "x_ramp [1]")) with lines lw 2 dt (7,4) lc rgb VERMILLION, \
  for [e in "up down"] edges using "t [s]":(on(e, "x_lag [1]")) with lines lw 2 lc rgb BLUE, \
  edges using "t [s]":(on("up", "x [1]")) with points pt 7 ps 0.35 lc rgb INK, \
  edges using "t [s]":(on("down", "x [1]")) with points pt 6 ps 0.6 lc rgb INK

@NEXT
set lmargin at screen 0.575
set rmargin at screen 0.975
set label 1 "Measured less fit [tenths]" @ABOVE
set label 2 "Time [s]" at graph 1, graph 0 right offset 0,-2.2 textcolor rgb INK
set yrange [-1.2:1.9]
set ytics 0.5
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead back lw 1 lc rgb GREY
INTEGRATOR = 'with linespoints lw 1 dt (7,4) lc rgb VERMILLION'
plot edges using "t [s]":(on("up", "ramp_residual [1]")) @INTEGRATOR pt 7 ps 0.35, \
  edges using "t [s]":(on("down", "ramp_residual [1]")) @INTEGRATOR pt 6 ps 0.6, \
  edges using "t [s]":(on("up", "lag_residual [1]")) with linespoints lw 1 lc rgb BLUE pt 7 ps 0.35, \
  edges using "t [s]":(on("down", "lag_residual [1]")) with linespoints lw 1 lc rgb BLUE pt 6 ps 0.6
unset multiplot
