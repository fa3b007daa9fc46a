#!/bin/sh
# FMUs by export-fmu: bad input, and what an importer (FMPy, from PyPI) makes of them. Without FMPy that part is absent.
set -u
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}" "${MEASURED:=../shared/data}"
export MEASURED
folder="$BUILD/fmu"
rm -rf "$folder"
mkdir -p "$folder"
model=study/actuators/r1-400.cfg
. tests/expect.sh

$MAKE --no-print-directory BUILD="$BUILD" export-fmu "$BUILD/tests/fmu/native" >/dev/null || exit 1

expect_words 0 "" ./export-fmu --help
expect_words 2 "" ./export-fmu
expect_words 2 "fmi" ./export-fmu "$model" --fmi 1
expect_words 1 "nothere.cfg" ./export-fmu nothere.cfg
sed 's/spring_rate/sprung_rate/' "$model" >"$folder/bad.cfg"
expect_words 1 "spring_rate" ./export-fmu "$folder/bad.cfg" --out "$folder/bad.fmu"
: >"$folder/file"
expect_words 4 "file" ./export-fmu "$model" --out "$folder/file/a.fmu"
[ -e /dev/full ] && expect_words 4 "space" ./export-fmu "$model" --out /dev/full
[ -e "$folder/bad.fmu" ] && complain "something was written in spite of an error"

# what leaves the shared library: the standard's functions, of its version alone
for version in 2 3; do
  nm -D --defined-only "$BUILD/fmu$version.so" | awk '{print $3}' | grep -v "^fmi$version" &&
    complain "fmu$version.so: these leave it"
done

python3 tests/fmu/check.py "$BUILD/fmpy" "$folder/importer" "$BUILD/tests/fmu/native" "$CC" 2>"$folder/err"
case $? in
0) ;;
3) grep '^absent:' "$folder/err" ;;
*)
  grep -v '^Warning' "$folder/err" | tail -n 20
  wrong=$((wrong + 1))
  ;;
esac
exit "$((wrong != 0))"
