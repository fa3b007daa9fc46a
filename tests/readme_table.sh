#!/bin/sh
# Tables of pages that are made: each stands between "<!-- KIND: made by ... -->" and "<!-- end of KIND -->". An awk
# program turns the CSV of results into rows; build/tests/decisions prints what the search decides by.
#   readme_table.sh --refresh KIND PAGE   put it there; KIND: times, sizes, trials, rules, constants
#   readme_table.sh --check KIND PAGE     fail where the page says something else
set -eu
mode=$1 kind=$2 readme=$3
case $kind in
times) rows="awk -f tests/bench/times.awk results/bench.csv" ;;
sizes) rows="awk -f tests/firmware/sizes.awk results/size.csv" ;;
trials) rows="awk -f tests/blind/readme.awk results/blind.md results/blind_noise.md results/blind_nothing.md results/blind_recorded.md" ;;
rules | constants) rows="${BUILD:-build}/tests/decisions $kind" ;;
*) exit 2 ;;
esac

# The README with the table between its marks.
fresh()
{
  awk -v begin="<!-- $kind: made by tests/readme_table.sh -->" -v end="<!-- end of $kind -->" '
    FNR == NR { table = table $0 "\n"; next }
    $0 == begin { print; printf "%s", table; inside = 1; found = 1; next }
    $0 == end { inside = 0 }
    !inside { print }
    END { exit !found || inside }' "$1" "$2"
}

part="$readme.part"
trap 'rm -f "$part" "$part.table"' EXIT
$rows >"$part.table"
fresh "$part.table" "$readme" >"$part"
case $mode in
--refresh) cmp -s "$part" "$readme" || cp "$part" "$readme" ;;
--check)
  cmp -s "$part" "$readme" && exit
  echo "$readme: its table of $kind is old; run: sh tests/readme_table.sh --refresh $kind $readme" >&2
  exit 1
  ;;
*) exit 2 ;;
esac
