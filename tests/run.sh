#!/bin/sh
# The tests. Ends with one line of totals.
#   run.sh         `make check`: units, the core in single precision, programs, the study against results/, a few blind trials
#   run.sh all     `make check-all`: these and everything else, each at a length that lets all of it end within half an hour
#   run.sh searches   the tests that search logs over and over, with sanitizers, which make them five times as long
# JOBS run at once (as many as there are cores). Each check is a line "WORDS | COMMAND" of a list, run by tests/run_one.sh.
set -u
case "${1:-}" in
"" | all | searches) ;;
*) echo "run.sh: nothing, all or searches, not $1" >&2 && exit 2 ;;
esac
: "${MAKE:=make}" "${CC:=cc}" "${CXX:=c++}" "${BUILD:=build}" "${MEASURED:=../shared/data}"
: "${JOBS:=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)}"
single="$BUILD/single"
sanitized="$BUILD/sanitized"
folder="$BUILD/checks"
export MAKE CC CXX BUILD MEASURED
rm -rf "$folder"
mkdir -p "$folder"

# A sanitizer's complaint is no exit status that a program gives.
export ASAN_OPTIONS=abort_on_error=1 UBSAN_OPTIONS=abort_on_error=1

# built FOLDER WORDS MAKE-ARGUMENTS...: make them there; says what does not build
built() {
  into=$1
  what=$2
  shift 2
  $MAKE --no-print-directory -j "$JOBS" BUILD="$into" "$@" >"$folder/build.log" 2>&1 && return
  echo "FAILED  $what: does not build"
  tail -n 40 "$folder/build.log"
  echo 0 1 0 >"$folder/$what.count"
  return 1
}

# suites LABEL FOLDER BELOW: the test programs below a folder of tests/, built in FOLDER, as lines of a list
suites() {
  find "$3" -name 'test_*.c' | sort |
    awk -v label="$1" -v folder="$2" '{ sub(/\.c$/, ""); path = $0; sub(/^tests\//, ""); print label " " $0 " | " folder "/" path }'
}

# run LIST HOW-MANY: the lines on stdin, so many at once
run() {
  cat >"$folder/$1"
  awk '{ print NR }' "$folder/$1" | xargs -n 1 -P "$2" sh tests/run_one.sh "$folder/$1"
}

# blind TRIALS SEED: closeloop against rigs without its answer; fails where the counts speak against a bar of tests/blind/bars.c
blind() {
  echo "blind: $1 trials of closeloop | rm -rf $BUILD/blind-$2 && $BUILD/tests/blind/blind --trials $1 --seed $2 --check --quiet \
--work $BUILD/blind-$2 --out $BUILD/blind-$2"
}

short() {
  blind 6 1
  cat <<LIST
programs: bad input, full disk | sh tests/check_programs.sh
closeloop: its folder, full disk, interrupted runs | sh tests/check_closeloop.sh
study: same numbers as results/ | sh tests/check_study.sh
core: symbols, headers, no heap | sh tests/check_core.sh $BUILD/libpneu.a lib
core in single precision: the same | SINGLE=1 sh tests/check_core.sh $single/libpneu.a lib
rooms: arrows go one way, names have their prefix | sh tests/check_rooms.sh
README: its example and commands | sh tests/check_readme.sh
gallery: every figure of results/ | sh study/gallery.sh | cmp - results/GALLERY.md
LIST
  suites double "$BUILD" tests
  suites single "$single" tests/lib
}

# Without the tests' own folder: `sanitized PROGRAM-SCRIPT`
with_sanitizers() {
  echo "LIBPNEU=$BUILD/libpneu.a BUILD=$sanitized LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0 sh tests/$1"
}

# What computes, and what needs programs that are there.
long() {
  cat <<LIST
pages of closeloop in a browser | sh tests/check_browser.sh
killed at any moment: 12 times | KILLS=12 sh tests/kill.sh
closeloop: held-out errors are those of simulate | sh tests/check_holdout.sh
closeloop --baseline: faults made in a plant | sh tests/check_lublin.sh
programs, sanitized: the same | $(with_sanitizers check_programs.sh)
closeloop, sanitized: the same | $(with_sanitizers check_closeloop.sh)
guides: every command, and what it prints | sh tests/check_guides.sh study/guides README.md
the same bytes with 1, 2 and 3 threads | sh tests/check_threads.sh
LIST
  blind 32 2
  suites sanitized "$sanitized" tests | grep -Ev "$searches"
}

# Of these tests one run with sanitizers takes as long as all others together; check_closeloop.sh goes the same ways.
searches='(apps/test_closeloop|lab/change/test_change|lab/report/test_recorded|lab/trace/test_closed_loop) '

# What builds something of its own, one after the other.
alone() {
  cat <<LIST
firmware | sh tests/firmware/install.sh; sh tests/firmware/check.sh short
installed: users, symbols, manual, completion, uninstall | sh tests/check_install.sh
closeloop --batch: threads, ranks, stops | sh tests/check_batch.sh
FMUs: as without, by FMPy | sh tests/check_fmu.sh
python: the wheel, its tests, its notebook | $MAKE python-check
memory that runs out, call by call | $MAKE alloc
hostile: 300 rigs, logs and lists of a stranger | $MAKE ATTACKS=300 hostile
clang: every warning on lib/ | $MAKE strict
fuzz: ten seconds a reader | $MAKE FUZZ_SECONDS=10 fuzz
valgrind: a part of the tests | $MAKE valgrind \
GRIND="lib/test_params lib/test_flow lib/test_jacobian lib/test_term lab/base/test_number fuzz/test_finds"
stepper: 20000 random steps in either precision | $MAKE STEPS=20000 step-search
mutants: 10 ways to break the library | $MAKE MUTANTS=10 mutate
lines that tests reach | $MAKE coverage
LIST
}

# The same with other compilers or in another system, so that it may run beside these.
elsewhere() {
  cat <<LIST
closeloop as a page: units, layout, the same answers | $MAKE web-check
windows | $MAKE windows-check
packages, in a fresh Debian | $MAKE deb-check
LIST
}

[ -d "$MEASURED" ] ||
  echo "absent: measured data, $MEASURED: the tests on it are skipped; study/measured/fetch.sh loads what can be had"
if [ "${1:-}" != searches ]; then
  core=$(find tests/lib -name 'test_*.c' | sed "s|^|$single/|; s|\\.c\$||")
  built "$BUILD" tests tests "$BUILD/tests/blind/blind" "$BUILD/tests/compare" "$BUILD/tests/decisions"
  # shellcheck disable=SC2086
  built "$single" "tests in single precision" SINGLE=1 $core
  short | run short "$JOBS"
fi
if [ -n "${1:-}" ]; then
  built "$sanitized" "sanitized tests" SANITIZE=address,undefined OPT=-O1 tests \
    "$sanitized/bin/sweep" "$sanitized/bin/simulate" "$sanitized/bin/closeloop"
fi
case "${1:-}" in
searches) suites sanitized "$sanitized" tests | grep -E "$searches" | run searches "$JOBS" ;;
all)
  long | run long "$JOBS"
  elsewhere | run elsewhere 1 &
  alone | run alone 1
  wait
  ;;
esac

cat "$folder"/*.count | awk '{ passed += $1; failed += $2; skipped += $3 }
  END { print passed " passed, " failed " failed, " skipped " skipped"; exit failed != 0 }'
