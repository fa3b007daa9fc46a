# Autocorrelation of the residual, before and after, with the 99 % band of white noise.
# Sets: N, LOWEST, HIGHEST, FOUND; arrays LABEL, LAGS, TOP, BOTTOM, LEFT, RIGHT [N]; blocks $correlation_i

set multiplot
set lmargin at screen LEFT[1]
set rmargin at screen RIGHT[N]
@BLANK
@KEY width -4
plot [0:1][0:1] NaN with lines lw 10 lc rgb "#DDD5B0" title "white noise, 99 %", \
  NaN with linespoints lw 1 pt 7 ps 0.4 lc rgb VERMILLION title "declared model, fitted", \
  for [k = 1:FOUND] NaN with lines lw 4 lc rgb BLUE title "completed model"
@NEXT
@FRAME
unset key
set tmargin at screen AT(TOP[1])
set bmargin at screen AT(BOTTOM[1])
set yrange [LOWEST:HIGHEST]
set ytics NICE((HIGHEST - LOWEST) / 5.0)
do for [i = 1:N] {
  if (i > 1) { @NEXT; set format y "" }
  set label 1 LABEL[i] @ABOVE
  set lmargin at screen LEFT[i]
  set rmargin at screen RIGHT[i]
  set xrange [0:LAGS[i] + 1]
  set xlabel "Lag [rows]"
  plot "$correlation_".i using "lag":(-column("band")):"band" with filledcurves fc rgb "#DDD5B0" title "band", \
    for [k = 1:FOUND] "" using "lag":"after" with impulses lw 4 lc rgb BLUE title "after", \
    "" using "lag":"before" with linespoints lw 1 pt 7 ps 0.4 lc rgb VERMILLION title "before"
}
unset multiplot
