# A free term over its argument, or over one cycle.
# Sets: IS_TABLE, ARGUMENT_LABEL, VALUE_LABEL, LOW, HIGH; arrays TOP, BOTTOM, LEFT, RIGHT [1]; block $term: at, value
unset key
set lmargin at screen LEFT[1]
set rmargin at screen RIGHT[1]
set tmargin at screen AT(TOP[1])
set bmargin at screen AT(BOTTOM[1])
set xlabel ARGUMENT_LABEL
set ylabel VALUE_LABEL
set xzeroaxis
set autoscale xfix
set yrange [LOW:HIGH]
plot $term using "at":"value" with lines lw 1.5 lc rgb BLUE title "term", \
  for [k = 1:IS_TABLE] "" using "at":"value" with points pt 7 ps 0.5 lc rgb BLUE title "term"
