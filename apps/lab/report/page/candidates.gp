# Statistic of each effect on the residual of the declared model, with the threshold.
# Sets: N, T_MIN, T_MAX, THRESHOLD; block $candidates: row, statistic, kind (2 found, 1 passes, 0 does not), name
unset key
set lmargin at screen 0.24
set rmargin at screen 0.955
set tmargin at screen AT(105)
set bmargin at screen AT(HEIGHT - 70)
set logscale x
set xrange [T_MIN:T_MAX]
set yrange [N + 0.6:0.4]
set format x "10^{%L}"
set xlabel "Score statistic T"
set ytics scale 0
set grid noytics
colour(kind) = kind == 2 ? 0x0072B2 : kind == 1 ? 0xE69F00 : 0xB0B0B0
set arrow 1 from THRESHOLD, graph 0 to THRESHOLD, graph 1 nohead front lw 1.5 dt (6,3) lc rgb INK
set label 1 "threshold" at THRESHOLD, graph 1 center offset 0,0.7 textcolor rgb INK
plot $candidates using (T_MIN):"row":(T_MIN):"statistic":(column("row") - 0.36):(column("row") + 0.36):(colour(column("kind"))):ytic(stringcolumn("name")) \
  with boxxyerror fc rgb variable fs solid noborder
