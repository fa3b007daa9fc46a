# Command, and measured and predicted channels over time.
# Sets: N, T_FROM, T_TO, T_LABEL, LEFT, RIGHT, FOUND; arrays LABEL, TOP, BOTTOM, LOW, HIGH [N+1], of the command first;
# blocks $command_0, $measured_i, $before_i, $after_i

array NAMES[3] = ["measured", "declared model, fitted", "completed model"]
set style line 11 lw 6 lc rgb "#C4C4C4"
set style line 12 lw 1.5 dt (7,3) lc rgb VERMILLION
set style line 13 lw 1.5 lc rgb BLUE

set multiplot
set lmargin at screen LEFT
set rmargin at screen RIGHT
set xrange [T_FROM:T_TO]
@BLANK
@KEY width -4
plot [0:1][0:1] for [k = 1:2 + FOUND] NaN with lines ls 10+k title NAMES[k]
@NEXT
@FRAME
unset key
set xrange [T_FROM:T_TO]

set tmargin at screen AT(TOP[1])
set bmargin at screen AT(BOTTOM[1])
set format x ""
set label 1 LABEL[1] @ABOVE
set yrange [LOW[1]:HIGH[1]]
set ytics NICE((HIGH[1] - LOW[1]) / 3.0)
plot $command_0 using "at":"value" with steps lw 1.5 lc rgb GREY title "command"

do for [i = 1:N] {
  @NEXT
  set label 1 LABEL[i + 1] @ABOVE
  set tmargin at screen AT(TOP[i + 1])
  set bmargin at screen AT(BOTTOM[i + 1])
  set yrange [LOW[i + 1]:HIGH[i + 1]]
  set ytics autofreq
  if (i == N) { set format x "%g"; set xlabel T_LABEL }
  plot for [k = 1:2 + FOUND] word("$measured_ $before_ $after_", k).i using "at":"value" with lines ls 10+k \
    title word("measured before after", k)
}
unset multiplot
