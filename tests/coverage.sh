#!/bin/sh
# Lines and branches that the tests reach, by gcov; a table a file, in results/coverage.csv as well.
#   coverage.sh FOLDER TEST...    with objects and tests built with --coverage in FOLDER
# Lines that no test reaches are listed. Fails where fewer than 95 % of the lines of lib/ are reached.
set -u
folder=$1
shift
find "$folder" -name '*.gcda' -exec rm -f {} +
for test in "$@"; do
  "$folder/tests/$test" >"$folder/test.log" 2>&1 || { tail "$folder/test.log"; exit 1; }
done

readers=$(ls apps/lab/base/csv.c apps/lab/log/*.c apps/lab/rig/*.c)

# "lib/flow.c",lines,reached,branches,both ways: of the files named
measure() {
  for file in "$@"; do
    gcov -b -n -o "$folder/${file%.c}.o" "$file" 2>/dev/null | awk -v file="$file" '
      /^File/ { own = $0 ~ "\x27(.*/)?" file "\x27" }
      own && /^Lines/ { sub(".*:", ""); sub("%", ""); lines = $3; share = $1 }
      own && /^Taken/ { sub(".*:", ""); sub("%", ""); branches = $3; taken = $1 }
      END { printf "%s,%d,%d,%d,%d\n", file, lines, share * lines / 100 + 0.5, branches, taken * branches / 100 + 0.5 }'
  done
}

total() {
  awk -F, -v name="$1" '{ for (i = 2; i <= 5; i++) sum[i] += $i }
    END { printf "%s,%d,%d,%d,%d\n", name, sum[2], sum[3], sum[4], sum[5] }'
}

# shellcheck disable=SC2046,SC2086
{
  echo "file,lines,lines_reached,branches,branches_taken"
  measure $(ls lib/*.c lib/effects/*.c) >"$folder/lib.csv"
  measure $readers >"$folder/readers.csv"
  cat "$folder/lib.csv" "$folder/readers.csv"
  total "lib/ in all" <"$folder/lib.csv"
  total "readers in all" <"$folder/readers.csv"
} >results/coverage.csv
awk -F, '{ printf "%-32s", $1
  if (NR == 1) print "lines      %  branches      %"
  else printf "%5d %6.1f %9d %6.1f\n", $2, $2 ? 100 * $3 / $2 : 100, $4, $4 ? 100 * $5 / $4 : 100 }' results/coverage.csv

echo "not reached:"
# shellcheck disable=SC2046,SC2086
for file in $(ls lib/*.c lib/effects/*.c) $readers; do
  gcov -t -o "$folder/${file%.c}.o" "$file" 2>/dev/null |
    awk -F: -v file="$file" '/Source:/ { own = $0 ~ file "$" } own && /#####/ { print file ":" $2+0 ":" substr($0, index($0, $3)) }'
done
awk -F, '/^lib\/ in all/ { exit !($3 >= 0.95 * $2) }' results/coverage.csv
