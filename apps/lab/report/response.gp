# Command, and measured and predicted channels over time.
# Sets: N, T_FROM, T_TO, T_LABEL, U_FROM, U_TO, U_LABEL, array LABEL[N], FOUND; blocks $command_0, $measured_i, $before_i, $after_i

array NAMES[3] = ["measured", "declared model, fitted", "completed model"]
set style line 11 lw 6 lc rgb "#C4C4C4"
set style line 12 lw 1.5 lc rgb VERMILLION
set style line 13 lw 1.5 lc rgb BLUE

set multiplot
set lmargin at screen 0.085
set rmargin at screen 0.975
set xrange [T_FROM:T_TO]
@BLANK
@KEY width -4
plot [0:1][0:1] for [k = 1:2 + FOUND] NaN with lines ls 10+k title NAMES[k]
@NEXT
@FRAME
unset key
set xrange [T_FROM:T_TO]

set tmargin at screen AT(150)
set bmargin at screen AT(205)
set format x ""
set label 1 U_LABEL @ABOVE
set yrange [U_FROM:U_TO]
set ytics NICE((U_TO - U_FROM) / 3)
plot $command_0 using "at":"value" with steps lw 1.5 lc rgb GREY

do for [i = 1:N] {
  @NEXT
  set label 1 LABEL[i] @ABOVE
  set tmargin at screen AT(245 + 205 * (i - 1))
  set bmargin at screen AT(245 + 205 * (i - 1) + 160)
  set yrange [*:*]
  set autoscale yfix
  set offsets 0, 0, graph 0.04, graph 0.04
  set ytics autofreq
  if (i == N) { set format x "%g"; set xlabel T_LABEL }
  plot for [k = 1:2 + FOUND] word("$measured_ $before_ $after_", k).i using "at":"value" with lines ls 10+k
}
unset multiplot
