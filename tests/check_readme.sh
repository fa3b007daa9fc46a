#!/bin/sh
# The README's C example compiles and runs; its commands exist; its table of times is that of results/bench.csv.
set -eu
: "${CC:=cc}" "${BUILD:=build}"
folder="$BUILD/readme"
mkdir -p "$folder"
awk '/^```c$/{on=1;next} /^```$/{on=0} on' README.md >"$folder/example.c"
[ -s "$folder/example.c" ]
$CC -std=c90 -pedantic-errors -Wall -Wextra -Werror -Ilib "$folder/example.c" "$BUILD/libpneu.a" -lm -o "$folder/example"
"$folder/example"
./simulate study/actuators/r1-400.cfg --step >"$folder/step.csv"
[ "$(wc -l <"$folder/step.csv")" -eq 3052 ]
./simulate study/actuators/r1-400.cfg "$folder/step.csv" >"$folder/again.csv"
[ "$(wc -l <"$folder/again.csv")" -eq 3052 ]
for target in $(sed -n 's/^make \([a-z-]*\).*/\1/p' README.md); do
  # shellcheck disable=SC2046
  grep -q "^$target:" Makefile $(sed -n 's/^include //p' Makefile)
done
# every file that the top documents point to or name is there
for page in README.md DESIGN.md CONTRIBUTING.md CHANGELOG.md; do
  for path in $(sed -n 's/.*](\([^)#]*\)).*/\1/p' $page) \
    $(grep -o '`\(lib\|apps\|study\|tests\|packaging\|results\)/[a-z0-9_/.-]*`' $page | tr -d '`' | grep -v '/\.'); do
    case $path in http*) ;; *) [ -e "$path" ] || { echo "$page points to $path, which is not there"; exit 1; } ;; esac
  done
done
for kind in times sizes trials; do
  sh tests/readme_table.sh --check $kind README.md
done
