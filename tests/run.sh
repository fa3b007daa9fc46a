#!/bin/sh
# Every test, from `make check`: units in double and single precision and with sanitizers, the core's symbols and
# headers, the README's commands, and the study against results/. Ends with one line of totals.
set -u
: "${MAKE:=make}" "${CC:=cc}" "${CXX:=c++}" "${BUILD:=build}" "${MEASURED:=../shared/data}"
export MAKE CC CXX BUILD MEASURED
passed=0
failed=0
skipped=0
log="$BUILD/check.log"
mkdir -p "$BUILD"

say() { printf '%s\n' "$*"; }

# One check that is a command: pass NAME COMMAND...
pass() {
  what=$1
  shift
  if "$@" >"$log" 2>&1; then
    passed=$((passed + 1))
    say "ok      $what"
  else
    failed=$((failed + 1))
    say "FAILED  $what"
    tail -n 40 "$log"
  fi
}

count() { sed -n "s/^\[ *$1 *\] \([0-9]*\) test(s).*/\1/p" "$log" | tail -n 1; }

# One cmocka program: suite LABEL PROGRAM
suite() {
  "$2" >"$log" 2>&1
  status=$?
  good=$(count PASSED)
  bad=$(count FAILED)
  gone=$(count SKIPPED)
  good=${good:-0}
  bad=${bad:-0}
  passed=$((passed + good))
  failed=$((failed + bad))
  skipped=$((skipped + ${gone:-0}))
  if [ "$status" -ne 0 ] && [ "$bad" -eq 0 ]; then
    failed=$((failed + 1)) # died without a count
    bad=1
  fi
  if [ "$bad" -ne 0 ]; then
    say "FAILED  $1 $(basename "$2"): $bad of $((good + bad))"
    grep -v '^\[ *\(RUN\|OK\) *\]' "$log" | tail -n 60
  else
    say "ok      $1 $(basename "$2"): $good"
    [ ! -d "$MEASURED" ] || grep '^absent:' "$log" || true
  fi
}

# Build the tests in a folder of their own and run them: suites LABEL FOLDER PATTERN MAKE-ARGUMENTS...
suites() {
  label=$1
  folder=$2
  pattern=$3
  shift 3
  programs=""
  for source in tests/test_*.c; do
    name=$(basename "$source" .c)
    case " $pattern " in *" $name "* | " all ") programs="$programs $folder/tests/$name" ;; esac
  done
  # shellcheck disable=SC2086
  if ! $MAKE --no-print-directory BUILD="$folder" "$@" $programs >"$log" 2>&1; then
    failed=$((failed + 1))
    say "FAILED  $label: the tests do not build"
    tail -n 40 "$log"
    return
  fi
  for program in $programs; do
    suite "$label" "$program"
  done
}

# The core on other processors; each line of the script counts.
firmware() {
  CC="$CC" sh tests/firmware/install.sh >"$log" 2>&1
  firmware_log="$BUILD/firmware.log"
  if ! sh tests/firmware/check.sh short >"$firmware_log" 2>&1 && ! grep -q '^FAILED' "$firmware_log"; then
    echo "FAILED  firmware: its script ended early" >>"$firmware_log"
  fi
  cat "$firmware_log"
  passed=$((passed + $(grep -c '^ok ' "$firmware_log")))
  failed=$((failed + $(grep -c '^FAILED' "$firmware_log")))
  skipped=$((skipped + $(grep -c '^skipped' "$firmware_log")))
}

# closeloop against 40 rigs without its answer; fails where the counts speak against a bar of tests/blind/bars.c.
blind_trials() {
  rm -rf "$BUILD/blind-sample"
  "$BUILD/tests/blind/blind" --trials 40 --seed 2 --check --quiet --work "$BUILD/blind-sample" --out "$BUILD/blind-sample"
}

# The study, without figures, against the committed tables.
study_agrees() {
  again="$BUILD/study-again"
  rm -rf "$again"
  ./sweep hypotheses.cfg --quiet --no-figures --results "$again" || return 1
  wrong=0
  for table in "$again"/*.csv; do
    name=$(basename "$table")
    "$BUILD/tests/compare" 1e-6 1e-7 "results/$name" "$table" || wrong=1
  done
  return $wrong
}

core="test_params test_terms test_clock test_flow test_chamber test_stem test_stepper test_jacobian test_audit \
test_effects test_effects_gas test_effects_stem test_effects_sensor"

[ -d "$MEASURED" ] ||
  say "absent: measured data, $MEASURED: the tests on it are skipped; study/measured/fetch.sh loads what can be had"
suites double "$BUILD" all
suites single "$BUILD/single" "$core" SINGLE=1
suites sanitized "$BUILD/sanitized" all SANITIZE=address,undefined OPT=-O1
pass "rooms: includes go one way" sh tests/check_rooms.sh
pass "core: symbols, headers, no heap" sh tests/check_core.sh "$BUILD/libpneu.a" lib
firmware
pass "core in single precision" env SINGLE=1 sh tests/check_core.sh "$BUILD/single/libpneu.a" lib
[ -f tests/check_readme.sh ] && pass "README: its example and commands" sh tests/check_readme.sh
pass "guides: every command, and what it prints" sh tests/check_guides.sh study/guides README.md
pass "gallery: every figure of results/" sh -c 'sh study/gallery.sh | cmp - results/GALLERY.md'
[ -f tests/check_programs.sh ] && pass "programs: bad input, full disk, interrupted runs" sh tests/check_programs.sh
pass "installed: users, symbols, manual, completion, uninstall" sh tests/check_install.sh && { grep '^absent:' "$log" || true; }
pass "memory that runs out, call by call" $MAKE --no-print-directory BUILD="$BUILD" alloc
command -v clang >/dev/null && pass "clang: every warning on lib/" $MAKE --no-print-directory strict
command -v valgrind >/dev/null && pass "valgrind: a part of the tests" $MAKE --no-print-directory BUILD="$BUILD" \
  GRIND="test_params test_flow test_jacobian test_terms test_number test_finds" valgrind
pass "closeloop: its folder, full disk, interrupted runs" sh tests/check_closeloop.sh
pass "closeloop --batch: threads, ranks, stops" sh tests/check_batch.sh && { grep '^absent:' "$log" || true; }
pass "FMUs: as without, by FMPy" sh tests/check_fmu.sh && { grep '^absent:' "$log" || true; }
pass "pages of closeloop in a browser" sh tests/check_browser.sh && { grep '^absent:' "$log" || true; }
pass "killed at any moment: 12 times" env KILLS=12 sh tests/kill.sh
pass "mutants: 10 ways to break the library" $MAKE --no-print-directory mutate MUTANTS=10
$MAKE --no-print-directory "$BUILD/tests/blind/blind" >/dev/null && pass "blind: 40 trials of closeloop" blind_trials
pass "the same bytes with 1, 2 and 3 threads" sh tests/check_threads.sh
$MAKE --no-print-directory "$BUILD/tests/compare" >/dev/null && pass "study: same numbers as results/" study_agrees

say "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
