# Asymmetry that is left when the cause of each hypothesis is taken away, in the four laws.
TITLE = "Only the springs (H1) and the air (H6) take the asymmetry with them"
SUBTITLE = "Asymmetry of the R1-400 without the cause of each hypothesis; the base is given beside each law"
NAME = "Six_hypotheses_in_four_laws"
HEIGHT = 660
load system("dirname '".ARG0."'")."/style.gp"
file = table("hypotheses")

CONFIRMED = 10.0 # [%] left: below it a hypothesis is confirmed
XMIN = 0.1
XMAX = 300
array CAUSE[6] = ["Springs oppose one stroke only", "Springs are compressed at rest", "Limiters cut the travel short", \
                  "Bench set off the middle of the supply", "Filling and venting take unequal times", "Air fills and leaves by different laws"]
array TAKEN[6] = ["spring force made constant", "just enough preload to come home", "no upper limiter", \
                  "bench set moved to the middle", "vent sized for equal times", "linear flow, fixed volume and temperature"]

is_hypothesis(h) = strcol("hypothesis") eq sprintf("H%d", h)
row(law) = int(strcol("hypothesis")[2:]) + 0.15*(law - 2.5)
left(law) = is_law(law) ? 100*column("asymmetry_without_cause")/column("asymmetry_base") : NaN
on_scale(x) = x >= XMIN ? x : NaN
off_scale(x) = x < XMIN ? 100 : NaN
largest(a, b) = a > b ? a : b
point(law) = law % 2 ? 7 : 6

# what the table says of each hypothesis, and of how much asymmetry
array VERDICT[6]
array LINES[6]
array BASE[4]
do for [h = 1:6] {
  verdict = ""
  agree = 1
  change = 0
  most = 0
  stats file using (is_hypothesis(h) ? (verdict = verdict eq "" ? strcol("verdict") : verdict, \
    agree = agree && verdict eq strcol("verdict"), \
    most = largest(most, column("asymmetry_without_cause")/column("asymmetry_base")), \
    change = change + abs(column("asymmetry_without_cause") - column("asymmetry_base"))) : NaN) nooutput
  if (!agree) { verdict = "differs from law to law" }
  if (change < 1e-12) { verdict = "nothing to take away: it is in the middle" }
  if (100*most < XMIN) { verdict = verdict.sprintf(", less than %g %% left", XMIN) }
  VERDICT[h] = ""
  LINES[h] = 1
  length = 0
  do for [word in verdict] {
    length = length + strlen(word) + 1
    VERDICT[h] = VERDICT[h].(length > 24 ? "\n" : VERDICT[h] eq "" ? "" : " ").word
    if (length > 24) { length = strlen(word) + 1; LINES[h] = LINES[h] + 1 }
  }
}
do for [law = 1:4] {
  stats file using (is_hypothesis(1) && is_law(law) ? column("asymmetry_base") : NaN) nooutput
  BASE[law] = STATS_max
}

set multiplot

# heading and key
set lmargin at screen 0.06
set rmargin at screen 0.975
@BLANK
@KEY width -10
plot [0:1][0:1] for [law = 1:4] NaN with linespoints ls law pt point(law) ps 0.9 title law_name(law).sprintf(": %.3f", BASE[law])
@NEXT
@FRAME

set lmargin at screen 0.435
set rmargin at screen 0.765
set tmargin at screen 0.775
set bmargin at screen 0.115
set border 1
set grid noytics
unset ytics
set logscale x
set xrange [XMIN:XMAX]
set yrange [6.55:0.45]
set xtics (0.1, 1, 10, 100)
set xlabel "Asymmetry left, share of the base [%]"
set object 1 rectangle from graph 0, graph 0 to first CONFIRMED, graph 1 behind fillcolor rgb BAND fillstyle solid noborder
set arrow 1 from CONFIRMED, graph 0 to CONFIRMED, graph 1 nohead lw 1.5 lc rgb GREY
set arrow 2 from 100, graph 0 to 100, graph 1 nohead lw 1 dt (2,4) lc rgb GREY
set label 1 sprintf("confirmed: below %g %%", CONFIRMED) at CONFIRMED, graph 1 right offset -0.5,0.7 textcolor rgb INK
set label 2 "base" at 100, graph 1 center offset 0,0.7 textcolor rgb GREY
do for [h = 1:6] {
  set label 10 + h sprintf("H%d", h) at screen 0.02, first h left textcolor rgb INK
  set label 20 + h CAUSE[h] at screen 0.06, first h left offset 0,0.55 textcolor rgb INK
  set label 30 + h TAKEN[h] at screen 0.06, first h left offset 0,-0.55 textcolor rgb GREY
  set label 40 + h VERDICT[h] at screen 0.78, first h left offset 0,0.5*(LINES[h] - 1) textcolor rgb INK
}
plot for [law = 1:4] file using (on_scale(left(law))):(row(law)):(100 - left(law)):(0) with vectors nohead ls law, \
     for [law = 1:4] file using (off_scale(left(law))):(row(law)):(XMIN - 100):(0) with vectors head filled size screen 0.014,18 fixed ls law, \
     for [law = 1:4] file using (on_scale(left(law))):(row(law)) with points pt 7 ps 0.9 lc rgb "white", \
     for [law = 1:4] file using (on_scale(left(law))):(row(law)) with points ls law pt point(law) ps 0.9
unset multiplot
