#!/bin/sh
# Tables of the README that are made from results: each stands between "<!-- KIND: made by ... -->" and
# "<!-- end of KIND -->", and an awk program turns its CSV into rows.
#   readme_table.sh --refresh KIND README.md   put it there; KIND: times, sizes, trials
#   readme_table.sh --check KIND README.md     fail where the README says something else
set -eu
mode=$1 kind=$2 readme=$3
case $kind in
times) rows=tests/bench/times.awk csv=results/bench.csv ;;
sizes) rows=tests/firmware/sizes.awk csv=results/size.csv ;;
trials) rows=tests/blind/readme.awk csv="results/blind.md results/blind_noise.md results/blind_nothing.md" ;;
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
# shellcheck disable=SC2086
awk -f "$rows" $csv >"$part.table"
fresh "$part.table" "$readme" >"$part"
case $mode in
--refresh) cmp -s "$part" "$readme" || cp "$part" "$readme" ;;
--check) cmp "$part" "$readme" ;;
*) exit 2 ;;
esac
