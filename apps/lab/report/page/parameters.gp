# Fitted parameters of the base model relative to what was declared, with 95 % intervals.
# Sets: N, FOUND; block $parameters: row, before, after, low, high [%], name
COLOUR = FOUND ? BLUE : VERMILLION

set multiplot
set lmargin at screen 0.24
set rmargin at screen 0.955
@BLANK
@KEY width -4
plot [0:1][0:1] NaN with points pt 7 ps 0.8 lc rgb COLOUR title FOUND ? "completed model, 95 % interval" : "declared model, 95 % interval", \
  for [k = 1:FOUND] NaN with points pt 6 ps 0.9 lw 1.5 lc rgb VERMILLION title "declared model, fitted"
@NEXT
@FRAME
unset key
set tmargin at screen AT(125)
set bmargin at screen AT(HEIGHT - 70)
set xrange [*:*]
set yrange [N + 0.6:0.4]
set offsets graph 0.05, graph 0.05, 0, 0
set xlabel "Fitted less declared [% of declared]"
set ytics scale 0
set xzeroaxis
set arrow 1 from 0, graph 0 to 0, graph 1 nohead back lw 1 lc rgb GREY
plot $parameters using "after":"row":"low":"high":ytic(stringcolumn("name")) with xerrorbars pt 7 ps 0.8 lw 1.5 lc rgb COLOUR title FOUND ? "after" : "before", \
  for [k = 1:FOUND] "" using "before":"row" with points pt 6 ps 0.9 lw 1.5 lc rgb VERMILLION title "before"
unset multiplot
