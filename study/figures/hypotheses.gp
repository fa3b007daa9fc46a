# Signed asymmetry that is left when the cause of each hypothesis is taken away: both actuators, both springs, four laws.
TITLE = "Without the rate of the spring (H1) no asymmetry is left"
SUBTITLE = "Signed asymmetry left without the cause of each hypothesis, share of the base; a mark for each of the four laws"
NAME = "Six_hypotheses"
HEIGHT = 660
load system("dirname '".ARG0."'")."/style.gp"
file = table("hypotheses_thresholds")

CONFIRMED = 10.0 # [%] left: below it a cause is necessary
array CAUSE[6] = ["Rate of the spring", "Preload of the spring", "Travel limiters", "Place of the bench set", \
                  "Unequal orifices", "Air process"]
array TAKEN[6] = ["spring force made constant", "just enough to come home", "no upper limiter", \
                  "moved to the middle of the supply", "nothing to take away: they are equal", "linear flow, fixed volume, isothermal"]
NAMES = "r1-400 r1-400-bench 37-13 37-13-bench"
array SHOWN[4] = ["R1-400 as printed", "R1-400, spring of its bench set", "37-13 as printed", "37-13, spring of its bench set"]
array COLOUR[4] = [BLUE, SKY, VERMILLION, ORANGE]

is_row(a) = strcol("actuator") eq word(NAMES, a)
number(a) = int(strcol("hypothesis")[2:])
row(a) = number(a) + 0.17*(a - 2.5)
left(a) = is_row(a) ? 100*column("share_left_signed") : NaN

set multiplot
set lmargin at screen 0.06
set rmargin at screen 0.975
@BLANK
@KEY width -2
plot [0:1][0:1] for [a = 1:4] NaN with points pt 7 ps 0.9 lc rgb COLOUR[a] title SHOWN[a]
@NEXT
@FRAME

set lmargin at screen 0.41
set tmargin at screen 0.775
set bmargin at screen 0.115
set border 1
set grid noytics
unset ytics
set xrange [-300:400]
set yrange [6.55:0.45]
set xtics 100
set xlabel "Signed asymmetry left, share of the base [%]"
set object 1 rectangle from first -CONFIRMED, graph 0 to first CONFIRMED, graph 1 behind fillcolor rgb BAND fillstyle solid noborder
set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 1.5 lc rgb GREY
set arrow 2 from 100, graph 0 to 100, graph 1 nohead lw 1 dt (2,4) lc rgb GREY
set label 1 sprintf("below %g %%", CONFIRMED) at 0, graph 1 center offset 0,0.7 textcolor rgb INK
set label 2 "base" at 100, graph 1 center offset 0,0.7 textcolor rgb GREY
set label 3 "other way round" at graph 0, graph 1 left offset 0,0.7 textcolor rgb GREY
do for [h = 1:6] {
  set label 10 + h sprintf("H%d", h) at screen 0.02, first h left textcolor rgb INK
  set label 20 + h CAUSE[h] at screen 0.06, first h left offset 0,0.55 textcolor rgb INK
  set label 30 + h TAKEN[h] at screen 0.06, first h left offset 0,-0.55 textcolor rgb GREY
}
plot for [a = 1:4] file using (left(a)):(row(a)) with points pt 7 ps 0.8 lc rgb COLOUR[a]
unset multiplot
