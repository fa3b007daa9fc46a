# Time constants and asymmetry over a varied quantity, figs. 15 to 17 and 19: left the flow law of the paper,
# right the choked nozzle; T_1 dark blue and T_2 red, as in the paper. The caller sets FILE (its name), TITLE, SUBTITLE,
# XLABEL; NOMINAL if the value of Table A1 is within the range.
HEIGHT = 790
load system("dirname '".ARG0."'")."/style.gp"

stats table(FILE) using "variable" name "VARIED" nooutput
stats table(FILE) using "T1_s" name "LAG" nooutput
stats table(FILE) using "T2_s" name "RAMP" nooutput
stats table(FILE) using "asymmetry" name "SHAPE" nooutput
larger(a, b) = a > b ? a : b
value_of(gas, flow, name) = strcol("gas") eq gas && strcol("flow") eq flow ? column(name) : NaN

# what is drawn: colour; dash is the gas law
array COLOUR[3] = ["#00308F", "#D0021B", INK]
array MEANING[3] = ["T_1, filling (lag)", "T_2, venting (integrator)", "asymmetry"]
do for [k = 1:3] {
  set style line 10*k + 1 lc rgb COLOUR[k] lw 2 dt solid
  set style line 10*k + 2 lc rgb COLOUR[k] lw 2 dt (7,4)
}

set multiplot

# heading and key
set lmargin at screen 0.075
set rmargin at screen 0.965
@BLANK
@KEY
plot [0:1][0:1] for [gas = 1:2] for [k = 1:3] NaN with lines ls 10*k + gas title MEANING[k].", ".word(GASES, gas)
@NEXT
@FRAME

set xrange [0:VARIED_max]
do for [flow in FLOWS] {
  first = flow eq word(FLOWS, 1)
  set lmargin at screen (first ? 0.075 : 0.555)
  set rmargin at screen (first ? 0.485 : 0.965)
  unset label
  set label 2 flow_name(flow) at graph 1, graph 1 right offset 0,0.8 textcolor rgb GREY
  if (exists("NOMINAL")) {
    set arrow 1 from first NOMINAL, graph 0 to first NOMINAL, graph 1 nohead back lw 1 dt (2,4) lc rgb GREY
  }

  set tmargin at screen 0.775
  set bmargin at screen 0.43
  set format x ""
  set format y (first ? "%g" : "")
  unset xlabel
  if (first) { set label 1 "Time constants [s]" @ABOVE }
  set yrange [0:1.06*larger(LAG_max, RAMP_max)]
  plot for [k = 1:2] for [gas = 1:2] table(FILE) using "variable":(value_of(word(GASES, gas), flow, sprintf("T%d_s", k))) with lines ls 10*k + gas

  set tmargin at screen 0.365
  set bmargin at screen 0.095
  set format x "%g"
  set format y (first ? "%.2f" : "")
  set xlabel XLABEL
  if (first) { set label 1 "Asymmetry [1]" @ABOVE }
  set yrange [0:1.06*SHAPE_max]
  plot for [gas = 1:2] table(FILE) using "variable":(value_of(word(GASES, gas), flow, "asymmetry")) with lines ls 30 + gas
}
unset multiplot
