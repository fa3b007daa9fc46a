# Compare two outputs of the demonstration: the same words, the same times, numbers apart by no more than a tolerance.
#   awk -v pressure=PA -v position=UM -v score=N -f agree.awk WANT GOT
function apart(a, b) { return a > b ? a - b : b - a }
function wrong(text) { printf "line %d: %s\n  want %s\n  got  %s\n", FNR, text, want[FNR], $0; failed = 1 }
NR == FNR { want[NR] = $0; lines = NR; next }
{
  n = split(want[FNR], w, " ")
  seen = FNR
  if (n != NF || w[1] != $1) { wrong("another line"); next }
  if (w[1] ~ /:$/) { if ($0 != want[FNR]) wrong("another verdict"); next }
  if (w[2] != $2) wrong("another time")
  if (apart(w[3], $3) > pressure) wrong("pressure")
  if (apart(w[4], $4) > position) wrong("position")
  if (apart(w[5], $5) > score) wrong("score")
  if (apart(w[3], $3) > most_p) most_p = apart(w[3], $3)
  if (apart(w[4], $4) > most_x) most_x = apart(w[4], $4)
}
END {
  if (seen != lines || lines == 0) { print "another number of lines: " lines ", " seen; failed = 1 }
  printf "largest differences: %g Pa, %g um\n", most_p, most_x
  exit failed
}
