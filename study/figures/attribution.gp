# Shapley shares of the causes of the signed asymmetry, for both actuators with both springs.
TITLE = "The growing volume makes the asymmetry; the place of the bench set works against it"
SUBTITLE = "Share of each cause in the signed asymmetry: mean of its effects over all orders of adding the causes (Shapley)"
NAME = "Causes_of_asymmetry"
HEIGHT = 820
load system("dirname '".ARG0."'")."/style.gp"

PANELS = "attribution attribution_r1-400-bench attribution_37-13 attribution_37-13-bench"
array SHOWN[4] = ["R1-400 as printed", "R1-400, spring of its bench set", "37-13 as printed", "37-13, spring of its bench set"]
array CAUSE[5] = ["density upstream", "growing volume", "choking", "temperature", "place of bench set"]
CAUSES = 5

is_gas(gas) = strcol("gas") eq gas
colour(gas) = gas eq "isothermal" ? BLUE : VERMILLION
SHIFT = 0.19
shift(gas) = gas eq "isothermal" ? -SHIFT : SHIFT
number(row) = int(row) % (CAUSES + 1)
share(gas) = is_gas(gas) && number(column(0)) < CAUSES ? 100*column("share") : NaN
row(gas) = number(column(0)) + shift(gas)

# the signed asymmetry that the causes share, in words
array WHOLE[4]
do for [panel = 1:4] {
  file = table(word(PANELS, panel))
  WHOLE[panel] = ""
  if (is_there(file)) {
    do for [gas in GASES] {
      stats file using (is_gas(gas) ? column("shapley") : NaN) nooutput
      WHOLE[panel] = WHOLE[panel].sprintf("%s%.3f", WHOLE[panel] eq "" ? "" : " and ", STATS_sum)
    }
  }
}

set multiplot

# heading and key
set lmargin at screen 0.20
set rmargin at screen 0.96
@BLANK
set key at screen 0.20, screen 1 - 75.0/HEIGHT left top horizontal
plot [0:1][0:1] for [gas in GASES] NaN with boxes lc rgb colour(gas) title (gas eq "polytropic" ? "adiabatic" : gas)
@NEXT
@FRAME

set grid noytics
set border 1
unset ytics
set xrange [-225:325]
set xtics 100
set yrange [CAUSES - 0.4:-0.6]
set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb GREY
do for [cause = 1:CAUSES] {
  set label 10 + cause CAUSE[cause] at graph 0, first (cause - 1) right offset -0.5,0 textcolor rgb INK
}
do for [panel = 1:4] {
  file = table(word(PANELS, panel))
  if (is_there(file)) {
    top = 0.855 - 0.20*(panel - 1)
    set tmargin at screen top
    set bmargin at screen top - 0.155
    set format x (panel == 4 ? "%g" : "")
    set xlabel (panel == 4 ? "Share of the signed asymmetry [%]" : "")
    set label 1 SHOWN[panel] at screen 0.02, graph 1 left offset 0,0.7 font ",15" textcolor rgb INK
    set label 2 "signed asymmetry ".WHOLE[panel] at graph 1, graph 1 right offset 0,0.7 textcolor rgb GREY
    plot for [gas in GASES] file using (share(gas)):(row(gas)):(0):(share(gas)):(row(gas) - 0.9*SHIFT):(row(gas) + 0.9*SHIFT) with boxxyerror lc rgb colour(gas), \
         for [gas in GASES] file using (share(gas) + (share(gas) < 0 ? -13 : 13)):(row(gas)):(sprintf("%.0f", share(gas))) with labels font ",11" center tc rgb INK
  }
}
unset multiplot
