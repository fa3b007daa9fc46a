# From the totals of the blind trials to the README: results/blind.md, blind_nothing.md, blind_noise.md.
BEGIN {
  FS = " *\\| *"
  print "| closeloop on rigs drawn at random | of how many | 95 % interval |"
  print "|---|---|---|"
  say["added under the right names", "blind.md"] = "effects of the catalogue missing: each added under its name"
  say["right names, stated class, or listed below --min-gain", "blind.md"] = \
    "or at least stated: not to be told from what was added, or significant but below 2 % of the error"
  say["added under the right names", "blind_noise.md"] = "the first where the rig file does not tell the noise"
  say["called unlisted, in the right equation", "blind.md"] = "something missing that is in no catalogue: called so, in the right equation"
  say["something named (false alarm)", "blind_nothing.md"] = "nothing missing: something named"
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
