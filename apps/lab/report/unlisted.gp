# A free term over its argument, or over one cycle.
# Sets: IS_TABLE, ARGUMENT_LABEL, VALUE_LABEL; block $term: at, value
unset key
set lmargin at screen 0.1
set rmargin at screen 0.975
set tmargin at screen AT(105)
set bmargin at screen AT(HEIGHT - 70)
set xlabel ARGUMENT_LABEL
set ylabel VALUE_LABEL
set xzeroaxis
set autoscale xfix
set offsets 0, 0, graph 0.05, graph 0.05
plot $term using "at":"value" with lines lw 1.5 lc rgb BLUE, \
  for [k = 1:IS_TABLE] "" using "at":"value" with points pt 7 ps 0.5 lc rgb BLUE
