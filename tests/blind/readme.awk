# From the totals of the blind trials to study/guides/trust.md: results/blind.md, blind_noise.md, blind_nothing.md, blind_recorded.md.
BEGIN {
  FS = " *\\| *"
  print "| closeloop on rigs drawn at random | how often | 95 % interval |"
  print "|---|---|---|"
  say["added under the right names", "blind.md"] = "effects of the catalogue are missing: all are added by name"
  say["right names, stated class, or listed below --min-gain", "blind.md"] = \
    "... or stated, as indistinguishable from what was added or as below 2 % of the error"
  say["added under the right names", "blind_noise.md"] = "as the first row, without a declared noise"
  say["called unlisted, in the right equation", "blind.md"] = "something is missing that no catalogue has: reported as unknown, in the right equation"
  say["something named (false alarm)", "blind_nothing.md"] = "nothing is missing: something is named"
  say["right or honestly undecided", "blind_recorded.md"] = "logs as benches and plants record them: right, or honestly undecided"
  say["right", "blind_recorded.md"] = "... right"
  say["confidently wrong (false alarm, overlooked, wrong)", "blind_recorded.md"] = "... something is named wrongly, or overlooked"
}
FNR == 1 { file = FILENAME; sub(".*/", "", file) }
$2 ~ /: / {
  what = $2
  sub(/^[^:]*: /, "", what)
  # of what has the same end the first is meant: p and x, one or two missing
  if ((what, file) in say && !((what, file) in said)) {
    said[what, file] = 1
    printf "| %s | %s | %s %% |\n", say[what, file], $3, $5
  }
}
