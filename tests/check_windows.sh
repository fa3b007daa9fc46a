#!/bin/sh
# The core as a program of Windows, from `make windows-check`: its tests in both precisions under Wine, and a user in C90 that
# prints the same as here.
set -eu
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}"
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
    wine "$program" >"$out/log" 2>&1 || wrong "$(basename "$program")"
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
