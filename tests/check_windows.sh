#!/bin/sh
# What runs on Windows, from `make windows-check`, under Wine: tests of the core in both precisions, a user in C90 that prints the
# same as here, and the programs of `make windows`, whose verdicts are those of the native ones. RIGS names folders with rig.cfg,
# fit.csv and holdout.csv; default: the guide's and three of MEASURED, where that is.
set -eu
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}" "${MEASURED:=../shared/data}"
mkdir -p "$BUILD/windows"
out=$(cd "$BUILD/windows" && pwd)
WINEPREFIX=$out/wine
WINEDEBUG=-all
export WINEPREFIX WINEDEBUG

wrong() {
  tail -n 30 "$out/log" >&2
  echo "check_windows: $1" >&2
  exit 1
}

# core_tests FOLDER DEFINITIONS
core_tests() {
  programs=$(printf '%s\n' tests/lib/test_*.c | sed "s|^|$out/$1/|; s|\.c\$|.exe|")
  # shellcheck disable=SC2086
  $MAKE --no-print-directory -f tests/firmware/target.mk TARGET=windows OUT="$out/$1" DEFS="$2" $programs >"$out/log" 2>&1 ||
    wrong "the tests do not build"
  passed=0
  for program in $programs; do
    if ! wine "$program" >"$out/log" 2>&1; then # once more where Wine's own server broke off, not the test
      grep -q "^wine client error" "$out/log" && wine "$program" >"$out/log" 2>&1 || wrong "$(basename "$program")"
    fi
    passed=$((passed + $(tr -d '\r' <"$out/log" | sed -n 's/^\[  PASSED  \] \([0-9]*\) .*/\1/p')))
  done
  echo "ok      windows: $passed tests of the core $2"
}

core_tests double ""
core_tests single -DPNEU_SINGLE

user=tests/consumers/copied/hold.c
x86_64-w64-mingw32-gcc -std=c90 -pedantic-errors -Wall -Wextra -Werror -Ilib $user "$out/double/libpneu.a" -static -o "$out/hold.exe"
wine "$out/hold.exe" 2>"$out/log" | tr -d '\r' >"$out/hold.txt"
# shellcheck disable=SC2046
$CC -std=c99 -O2 -ffp-contract=off -Ilib $user $(find lib -name '*.c') -lm -o "$out/hold"
"$out/hold" | cmp - "$out/hold.txt" >"$out/log" || wrong "hold.c prints something else than here"
echo "ok      windows: a user in C90 prints the same as here"

# ---- An FMU ----
$MAKE --no-print-directory export-fmu >"$out/log" 2>&1 || wrong "export-fmu does not build"
./export-fmu study/actuators/r1-400.cfg --fmi 2 --out "$out/r1-400.fmu"
if command -v python3 >/dev/null 2>&1; then
  rm -rf "$out/fmu"
  python3 -m zipfile -e "$out/r1-400.fmu" "$out/fmu"
  token=$(sed -n 's/.* guid="\([^"]*\)".*/\1/p' "$out/fmu/modelDescription.xml")
  $CC -std=c99 -D_POSIX_C_SOURCE=200809L tests/fmu/steps.c -ldl -o "$out/steps"
  x86_64-w64-mingw32-gcc -std=c99 -Wall -Wextra -Werror -Wno-cast-function-type -D__USE_MINGW_ANSI_STDIO=1 tests/fmu/steps.c -static \
    -o "$out/steps.exe"
  "$out/steps" "$out/fmu/binaries/linux64/r1_400.so" "$token" >"$out/here.csv"
  wine "$out/steps.exe" "$out/fmu/binaries/win64/r1_400.dll" "$token" 2>"$out/log" | tr -d '\r' >"$out/there.csv"
  cmp "$out/here.csv" "$out/there.csv" >>"$out/log" || wrong "an FMU steps to other values than here"
  echo "ok      windows: the library for Windows in an FMU steps to the same values as that for Linux, to 12 digits"
fi

# ---- The programs, from the zip as it is unpacked ----
if ! command -v python3 >/dev/null 2>&1; then
  echo "absent: python3, so that the programs were not compared"
  exit 0
fi
rm -rf "$out/unpacked" "$out/native" "$out/wine-out"
python3 -m zipfile -e "$BUILD"/windows/libpneu-*-windows.zip "$out/unpacked"
there=$(echo "$out"/unpacked/libpneu-*)
if [ -z "${RIGS:-}" ]; then
  RIGS=study/guides/leak
  for name in null-a travel-a spring-a; do
    [ ! -d "$MEASURED/rig/$name" ] || RIGS="$RIGS $MEASURED/rig/$name"
  done
fi
for rig in $RIGS; do
  name=$(basename "$rig")
  ./closeloop "$rig/rig.cfg" "$rig/fit.csv" --holdout "$rig/holdout.csv" --out "$out/native/$name" --no-figures --quiet >"$out/log" 2>&1 ||
    wrong "closeloop on $name"
  wine "$there/closeloop.exe" "$rig/rig.cfg" "$rig/fit.csv" --holdout "$rig/holdout.csv" --out "$out/wine-out\\$name" --no-figures \
    --quiet >"$out/log" 2>&1 || wrong "closeloop.exe on $name"
  said=$(python3 tests/same_report.py "$out/native/$name/report.json" "$out/wine-out/$name/report.json" 2>&1) || wrong "$name: $said"
  ! grep -q "$(printf '\r')" "$out/wine-out/$name"/*.* || wrong "$name: carriage returns in what closeloop.exe wrote"
  echo "ok      windows: closeloop.exe on $name: $said"
done

wine "$there/closeloop.exe" --init study/guides/leak/fit.csv >"$out/draft" 2>"$out/log" || wrong "closeloop.exe --init"
./closeloop --init study/guides/leak/fit.csv | cmp - "$out/draft" >"$out/log" || wrong "--init drafts something else than here"
wine "$there/simulate.exe" study/guides/leak/rig.cfg study/guides/leak/fit.csv >"$out/there.csv" 2>"$out/log" || wrong "simulate.exe"
./simulate study/guides/leak/rig.cfg study/guides/leak/fit.csv >"$out/here.csv"
paste -d , "$out/here.csv" "$out/there.csv" | awk -F , 'NR == 1 { n = NF / 2; next }
  { for (i = 1; i <= n; i++) { d = $i - $(i + n); size = $i < 0 ? -$i : $i; if (d * d > 1e-18 * size * size + 1e-18) bad++ } }
  END { exit bad || NR < 100 }' >"$out/log" 2>&1 || wrong "simulate.exe predicts something else than here"
echo "ok      windows: --init drafts and simulate.exe predicts the same as here"
wine "$there/export-fmu.exe" study/actuators/r1-400.cfg --fmi 2 --out "$out/there.fmu" >"$out/log" 2>&1 || wrong "export-fmu.exe"
python3 tests/same_files.py "$out/r1-400.fmu" "$out/there.fmu" >"$out/log" 2>&1 || wrong "export-fmu.exe writes another FMU than here"
echo "ok      windows: export-fmu.exe writes the same files into an FMU as here"
if wine "$there/closeloop.exe" --batch list.csv >"$out/log" 2>&1 || ! grep -q "none on Windows" "$out/log"; then
  wrong "--batch does not say that there is none"
fi
