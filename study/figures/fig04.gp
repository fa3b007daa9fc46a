# Fig. 4: a large step of the R1-400, filled and vented again.
TITLE = "The stem goes out ever more slowly; it comes back almost steadily, gaining speed"
SUBTITLE = "Large step of the R1-400, isothermal chamber, flow as in the paper"
NAME = "Large_step_of_the_R1_400"
HEIGHT = 740
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig04")

set multiplot
set lmargin at screen 0.08
set rmargin at screen 0.97
set xrange [0:22]
set xtics 2 format ""
unset key

set tmargin at screen 0.865
set bmargin at screen 0.785
set label 1 "Command" @ABOVE
set yrange [-1.3:1.3]
set ytics ("vent" -1, "hold" 0, "fill" 1)
plot file using "t [s]":"u [1]" with steps lw 2 lc rgb GREY

@NEXT
set tmargin at screen 0.735
set bmargin at screen 0.445
set label 1 "Travel x [mm]" @ABOVE
set yrange [-0.5:21]
set ytics 5
plot file using "t [s]":"x [mm]" with lines ls 1

set tmargin at screen 0.39
set bmargin at screen 0.095
set label 1 "Chamber pressure p [kPa, gauge]" @ABOVE
set xlabel "Time t [s]"
set xtics format "%g"
set yrange [-10:420]
set ytics 100
plot file using "t [s]":"p [kPa]" with lines ls 1
unset multiplot
