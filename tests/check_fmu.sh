#!/bin/sh
# FMUs by export-fmu: bad input, and what an importer (FMPy, from PyPI) makes of them. Without FMPy that part is absent.
set -u
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}" "${MEASURED:=../shared/data}"
export MEASURED
folder="$BUILD/fmu"
rm -rf "$folder"
mkdir -p "$folder"
model=study/actuators/r1-400.cfg
wrong=0

# expect STATUS TEXT COMMAND...: exit status, and a message on stderr that contains TEXT
expect() {
  status=$1
  text=$2
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  if [ "$got" -ne "$status" ] || { [ -n "$text" ] && ! grep -q -- "$text" "$folder/err"; }; then
    echo "expected status $status and \"$text\", got $got from: $*"
    cat "$folder/err"
    wrong=$((wrong + 1))
  fi
}

$MAKE --no-print-directory BUILD="$BUILD" export-fmu "$BUILD/tests/fmu/native" >/dev/null || exit 1

expect 0 "" ./export-fmu --help
expect 2 "" ./export-fmu
expect 2 "fmi" ./export-fmu "$model" --fmi 1
expect 1 "nothere.cfg" ./export-fmu nothere.cfg
sed 's/spring_rate/sprung_rate/' "$model" >"$folder/bad.cfg"
expect 1 "spring_rate" ./export-fmu "$folder/bad.cfg" --out "$folder/bad.fmu"
: >"$folder/file"
expect 4 "file" ./export-fmu "$model" --out "$folder/file/a.fmu"
[ -e /dev/full ] && expect 4 "space" ./export-fmu "$model" --out /dev/full
[ -e "$folder/bad.fmu" ] && { echo "something was written in spite of an error"; wrong=$((wrong + 1)); }

# what leaves the shared library: the standard's functions, of its version alone
for version in 2 3; do
  nm -D --defined-only "$BUILD/fmu$version.so" | awk '{print $3}' | grep -v "^fmi$version" &&
    { echo "fmu$version.so: these leave it"; wrong=$((wrong + 1)); }
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
