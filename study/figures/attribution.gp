# Shapley shares of the causes of asymmetry, for the R1-400 and, where its table is there, for the 37-13.
TITLE = "The growing volume is the main cause of asymmetry in the R1-400"
SUBTITLE = "Share of each cause: mean of its effects over all orders of adding the causes (Shapley)"
NAME = "Causes_of_asymmetry"
PANELS = "attribution attribution_37-13"
NAMES = "R1-400 37-13"
HEIGHT = 780
load system("dirname '".ARG0."'")."/style.gp"

is_gas(gas) = strcol("gas") eq gas
colour(gas) = gas eq "isothermal" ? BLUE : VERMILLION
SHIFT = 0.19
shift(gas) = gas eq "isothermal" ? -SHIFT : SHIFT

# of each panel: how many causes, and the asymmetry that they share, in words
array COUNT[words(PANELS)]
array WHOLE[words(PANELS)]
do for [panel = 1:words(PANELS)] {
  file = table(word(PANELS, panel))
  WHOLE[panel] = ""
  if (is_there(file)) {
    LAST = panel
    do for [gas in GASES] {
      stats file using (is_gas(gas) ? column("shapley") : NaN) nooutput
      COUNT[panel] = STATS_records
      WHOLE[panel] = WHOLE[panel].sprintf("%s%.3f %s", WHOLE[panel] eq "" ? "" : ", ", STATS_sum, gas)
    }
  }
}

set multiplot

# heading and key
set lmargin at screen 0.40
set rmargin at screen 0.96
@BLANK
set key at screen 0.40, screen 1 - 75.0/HEIGHT left top horizontal
plot [0:1][0:1] for [gas in GASES] NaN with boxes lc rgb colour(gas) title gas
@NEXT
@FRAME

set grid noytics
set border 1
unset ytics
XMIN = -25
set xrange [XMIN:125]
set xtics 25
set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb GREY
do for [panel = 1:words(PANELS)] {
  file = table(word(PANELS, panel))
  if (is_there(file)) {
    causes = COUNT[panel]
    set tmargin at screen (panel == 1 ? 0.82 : 0.43)
    set bmargin at screen (panel == 1 ? 0.50 : 0.11)
    set yrange [causes - 0.4:-0.6]
    set format x (panel == LAST ? "%g" : "")
    set xlabel (panel == LAST ? "Share of the asymmetry [%]" : "")
    set label 1 word(NAMES, panel) at screen 0.02, graph 1 left offset 0,0.8 font ",15" textcolor rgb INK
    set label 2 "asymmetry ".WHOLE[panel] at graph 1, graph 1 right offset 0,0.8 textcolor rgb GREY
    row(gas) = int(column(0)) % causes + shift(gas)
    share(gas) = is_gas(gas) ? 100*column("share") : NaN
    plot for [gas in GASES] file using (share(gas)):(row(gas)):(0):(share(gas)):(row(gas) - 0.9*SHIFT):(row(gas) + 0.9*SHIFT) with boxxyerror lc rgb colour(gas), \
         for [gas in GASES] file using (share(gas) + (share(gas) < 0 ? -5.5 : 5.5)):(row(gas)):(sprintf("%.0f", share(gas))) with labels center tc rgb INK, \
         file using (is_gas(word(GASES, 1)) ? XMIN : NaN):(int(column(0)) % causes):(strcol("cause")) with labels right offset -1,0 tc rgb INK
  }
}
unset multiplot
