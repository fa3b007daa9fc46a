#!/bin/sh
# The README's table of times, from results/bench.csv.
#   table.sh BENCH.csv                      print it
#   table.sh --refresh BENCH.csv README.md  put it between the README's marks
#   table.sh --check BENCH.csv README.md    fail where the README says something else
set -eu

# A row for each thing measured; of the laws, all at an error of 1e-6 and one at the others.
table()
{
  awk -F, '
    function text(s) { return s < 1e-6 ? sprintf("%.3g ns", s * 1e9) : s < 1e-3 ? sprintf("%.3g µs", s * 1e6) \
                              : s < 1 ? sprintf("%.3g ms", s * 1e3) : sprintf("%.3g s", s) }
    NR == 1 { next }
    /^fill-and-vent/ && !/1e-06/ && $2 != "isothermal choked" { next }
    $3 == "libpneu" { row[++n] = "| " $1 ", " $2 " | " text($8) " (" text($7) " to " text($9) ") |"; next }
    { split($3, name, " "); who = $3 == "wc -l" ? $3 : name[1]
      rival[n] = rival[n] (rival[n] ? ", " : "") who " " ($8 == "" ? "fails" : text($8) sprintf($10 < 10 ? " (%.2gx)" : " (%.0fx)", $10)) }
    END { print "| what | libpneu: median (quartiles) | others: median (over libpneu) |"; print "|---|---|---|"
          for (i = 1; i <= n; i++) print row[i] " " rival[i] " |" }' "$1"
}

# The README with the table between its marks.
fresh()
{
  awk -v begin='<!-- times: made by tests/bench/table.sh -->' -v end='<!-- end of times -->' '
    FNR == NR { table = table $0 "\n"; next }
    $0 == begin { print; printf "%s", table; inside = 1; found = 1; next }
    $0 == end { inside = 0 }
    !inside { print }
    END { exit !found || inside }' "$1" "$2"
}

mode=print
case $1 in --*) mode=$1 && shift ;; esac
if [ "$mode" = print ]; then
  table "$1"
  exit
fi
part="$2.part"
trap 'rm -f "$part" "$part.table"' EXIT
table "$1" >"$part.table"
fresh "$part.table" "$2" >"$part"
case $mode in
--refresh) cmp -s "$part" "$2" || cp "$part" "$2" ;;
--check) cmp "$part" "$2" ;;
*) exit 2 ;;
esac
