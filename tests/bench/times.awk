# A row for each thing measured, from bench.csv; of the laws, all at an error of 1e-6 and one at the others.
function text(s)
{
  return s < 1e-6 ? sprintf("%.3g ns", s * 1e9) : s < 1e-3 ? sprintf("%.3g µs", s * 1e6) \
       : s < 1 ? sprintf("%.3g ms", s * 1e3) : sprintf("%.3g s", s)
}
BEGIN { FS = "," }
NR == 1 { next }
/^fill-and-vent/ && !/1e-06/ && $2 != "isothermal choked" { next }
$3 == "libpneu" { row[++n] = "| " $1 ", " $2 " | " text($8) " (" text($7) " to " text($9) ") |"; next }
{
  split($3, name, " ")
  who = $3 == "wc -l" ? $3 : name[1]
  rival[n] = rival[n] (rival[n] ? ", " : "") who " " ($8 == "" ? "fails" : text($8) sprintf($10 < 10 ? " (%.2gx)" : " (%.0fx)", $10))
}
END {
  print "| what | libpneu: median (quartiles) | others: median (over libpneu) |"
  print "|---|---|---|"
  for (i = 1; i <= n; i++)
    print row[i] " " rival[i] " |"
}
