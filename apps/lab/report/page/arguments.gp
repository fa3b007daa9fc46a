# Residual, averaged in bins, over pressure, position, velocity and command.
# Sets: ROWS, COLUMNS; arrays ROW_LABEL, LIMIT, IS_AFTER, TOP, BOTTOM [ROWS], COLUMN_LABEL, FROM, TO, LEFT, RIGHT [COLUMNS];
# blocks $bins_row_column

set multiplot
unset key
do for [r = 1:ROWS] {
  do for [c = 1:COLUMNS] {
    if (r > 1 || c > 1) { @NEXT }
    if (c == 1) { set label 1 ROW_LABEL[r] @ABOVE }
    set lmargin at screen LEFT[c]
    set rmargin at screen RIGHT[c]
    set tmargin at screen AT(TOP[r])
    set bmargin at screen AT(BOTTOM[r])
    set xrange [FROM[c]:TO[c]]
    set yrange [-LIMIT[r]:LIMIT[r]]
    set xtics NICE((TO[c] - FROM[c]) / 2.0)
    set ytics NICE(LIMIT[r] / 2.0)
    if (c == 1) { set format y "%g" } else { set format y "" }
    if (r == ROWS) { set format x "%g"; set xlabel COLUMN_LABEL[c] } else { set format x "" ; unset xlabel }
    plot sprintf("$bins_%d_%d", r, c) using "at":(-column("band")):"band" with filledcurves fc rgb "#DDD5B0" title "band", \
      "" using "at":"mean" with linespoints lw 1.2 pt 7 ps 0.35 lc rgb (IS_AFTER[r] ? BLUE : VERMILLION) \
        title IS_AFTER[r] ? "after" : "before"
  }
}
unset multiplot
