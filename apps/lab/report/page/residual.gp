# Residual over time in noise units, before and after.
# Sets: N (panels), T_FROM, T_TO, T_LABEL, LEFT, RIGHT; arrays LABEL, LIMIT, IS_AFTER, TOP, BOTTOM [N]; blocks $residual_i
NOISE = 2.576

set multiplot
set lmargin at screen LEFT
set rmargin at screen RIGHT
set xrange [T_FROM:T_TO]
unset key
set format x ""
do for [i = 1:N] {
  if (i > 1) { @NEXT }
  set label 1 LABEL[i] @ABOVE
  set tmargin at screen AT(TOP[i])
  set bmargin at screen AT(BOTTOM[i])
  set yrange [-LIMIT[i]:LIMIT[i]]
  set ytics NICE(LIMIT[i] / 2.0)
  set object 1 rectangle from graph 0, first -NOISE to graph 1, first NOISE behind fc rgb BAND fs solid noborder
  if (i == N) { set format x "%g"; set xlabel T_LABEL }
  plot "$residual_".i using "at":"value" with lines lw 1 lc rgb (IS_AFTER[i] ? BLUE : VERMILLION) \
    title IS_AFTER[i] ? "after" : "before"
}
unset multiplot
