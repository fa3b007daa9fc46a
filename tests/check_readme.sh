#!/bin/sh
# The README's C example compiles and runs; its rig file gets the answer on the page; its commands exist; tables that are made
# are as they are made.
set -eu
: "${CC:=cc}" "${BUILD:=build}"
folder="$BUILD/readme"
mkdir -p "$folder"
awk '/^```c$/{on=1;next} /^```$/{on=0} on' README.md >"$folder/example.c"
[ -s "$folder/example.c" ]
$CC -std=c90 -pedantic-errors -Wall -Wextra -Werror -Ilib "$folder/example.c" "$BUILD/libpneu.a" -lm -o "$folder/example"
"$folder/example"
awk '/^\/\/ rig.cfg/{on=1} /^```$/{on=0} on' README.md >"$folder/rig.cfg"
answer=$(./closeloop "$folder/rig.cfg" study/guides/leak/fit.csv --out "$folder/answer" --no-figures --quiet)
grep -qxF "$answer" README.md || { echo "README.md has a rig file of which closeloop says: $answer"; exit 1; }
./simulate study/actuators/r1-400.cfg --step >"$folder/step.csv"
[ "$(wc -l <"$folder/step.csv")" -eq 3052 ]
./simulate study/actuators/r1-400.cfg "$folder/step.csv" >"$folder/again.csv"
[ "$(wc -l <"$folder/again.csv")" -eq 3052 ]
for target in $(sed -n 's/^make \([a-z-]*\).*/\1/p' README.md); do
  # shellcheck disable=SC2046
  grep -q "^$target:" Makefile $(sed -n 's/^include //p' Makefile)
done
# every file that the top documents point to or name is there
for page in README.md DESIGN.md TRIED.md CONTRIBUTING.md CHANGELOG.md; do
  for path in $(sed -n 's/.*](\([^)#]*\)).*/\1/p' $page) \
    $(grep -o '`\(lib\|apps\|study\|tests\|packaging\|results\)/[a-z0-9_/.-]*`' $page | tr -d '`' | grep -v '/\.'); do
    case $path in http*) ;; *) [ -e "$path" ] || { echo "$page points to $path, which is not there"; exit 1; } ;; esac
  done
done
sh tests/readme_table.sh --check trials study/guides/trust.md
sh tests/readme_table.sh --check sizes study/guides/firmware.md
sh tests/readme_table.sh --check times study/guides/speed.md
sh tests/readme_table.sh --check rules DESIGN.md
sh tests/readme_table.sh --check constants DESIGN.md
