# Time constants and asymmetry over a varied quantity, figs. 15 to 17 and 19: left the flow law of the paper,
# right the choked nozzle. The caller sets FILE (its name), TITLE, SUBTITLE, XLABEL; NOMINAL if the value of
# Table A1 is within the range; LOG for time constants that span decades.
HEIGHT = 760
load system("dirname '".ARG0."'")."/style.gp"

stats table(FILE) using "T1_s" name "LAG" nooutput
stats table(FILE) using "T2_s" name "RAMP" nooutput
stats table(FILE) using "asymmetry" name "SHAPE" nooutput
larger(a, b) = a > b ? a : b
smaller(a, b) = a < b ? a : b
value_of(law, name) = is_law(law) ? column(name) : NaN

set multiplot

# heading and key
set lmargin at screen 0.075
set rmargin at screen 0.975
@BLANK
@KEY width 0
plot [0:1][0:1] \
  NaN with linespoints ls 1 pt 7 ps 0.8 title "isothermal, filling T_1", NaN with linespoints ls 1 pt 6 ps 0.8 title "isothermal, venting T_2", \
  NaN with linespoints ls 3 pt 7 ps 0.8 title "polytropic, filling T_1", NaN with linespoints ls 3 pt 6 ps 0.8 title "polytropic, venting T_2"
@NEXT
@FRAME

do for [flow = 1:2] {
  set lmargin at screen (flow == 1 ? 0.075 : 0.545)
  set rmargin at screen (flow == 1 ? 0.505 : 0.975)
  unset label
  set label 2 flow_name(word(FLOWS, flow)) at graph 1, graph 1 right offset 0,0.8 textcolor rgb GREY
  if (exists("NOMINAL")) {
    set arrow 1 from first NOMINAL, graph 0 to first NOMINAL, graph 1 nohead back lw 1 dt (2,4) lc rgb GREY
  }

  set tmargin at screen 0.80
  set bmargin at screen 0.44
  set format x ""
  set format y (flow == 1 ? "%g" : "")
  unset xlabel
  if (flow == 1) { set label 1 "Time constants [s]" @ABOVE }
  if (exists("LOG")) {
    set logscale y
    set ytics (0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
    set yrange [0.9*smaller(LAG_min, RAMP_min):1.1*larger(LAG_max, RAMP_max)]
  } else {
    set yrange [0:1.06*larger(LAG_max, RAMP_max)]
  }
  plot for [law = flow:4:2] table(FILE) using "variable":(value_of(law, "T1_s")) with linespoints ls law pt 7 ps 0.8 pointinterval 4, \
       for [law = flow:4:2] table(FILE) using "variable":(value_of(law, "T2_s")) with linespoints ls law pt 6 ps 0.8 pointinterval -4

  set tmargin at screen 0.37
  set bmargin at screen 0.095
  set format x "%g"
  set format y (flow == 1 ? "%.2f" : "")
  set xlabel XLABEL
  if (flow == 1) { set label 1 "Asymmetry [1]" @ABOVE }
  unset logscale y
  set ytics autofreq
  set yrange [0:1.06*SHAPE_max]
  plot for [law = flow:4:2] table(FILE) using "variable":(value_of(law, "asymmetry")) with lines ls law
}
unset multiplot
