#!/bin/sh
# Programs that run out of memory, at one call after the other: no crash, no leak (built with sanitizers), status 4 and a
# message about memory, no file half-written.
#   check_alloc.sh FOLDER    with closeloop, simulate and sweep linked with tests/alloc/fail.c
# The first calls are tried one by one, later ones further and further apart; every second time memory stays away.
# Not tried: memory that libraries take for themselves (libconfig, UDUNITS, cJSON, NLopt, SUNDIALS, gnuplot, and the
# streams of the C library).
set -u
folder=$1
work="$folder/work"
rm -rf "$work"
mkdir -p "$work"
export OMP_NUM_THREADS=1 LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0
wrong=0
runs=0

complain() {
  echo "$*"
  wrong=$((wrong + 1))
}

# A rig without its leak, and a short log of one that leaks.
printf 'effects = { chamber_leak = { leak_area = "0.4 mm^2"; }; };\n' | cat study/actuators/r1-400.cfg - >"$work/leaky.cfg"
printf 'fit = ("spring_rate");\nnoise = { pressure = "2 kPa"; position = "0.2 mm"; };\n' |
  cat study/actuators/r1-400.cfg - >"$work/rig.cfg"
"$folder/simulate" "$work/leaky.cfg" --step | awk 'NR == 1 || NR % 40 == 0' >"$work/log.csv"

# try K PROGRAM...: the program with the K-th call failing
try() {
  k=$1
  shift
  rm -rf "$work/out"
  if [ $((k % 2)) -eq 0 ]; then on=FAIL_ON=1; else on=FAIL_ONCE=1; fi
  env FAIL_AT="$k" "$on" "$@" >"$work/stdout" 2>"$work/stderr"
  status=$?
  runs=$((runs + 1))
  if [ "$status" -ne 4 ] || ! grep -q 'memory' "$work/stderr"; then
    complain "call $k: $(basename "$1") ends with status $status: $(tail -n 30 "$work/stderr")"
  fi
  [ -z "$(find "$work" -name '*.part')" ] || complain "call $k: $(find "$work" -name '*.part') is left"
}

# sample PROGRAM...: until no call fails
sample() {
  rm -rf "$work/out"
  FAIL_COUNT="$work/count" "$@" >"$work/stdout" 2>"$work/stderr" || complain "$1 fails undisturbed: $(cat "$work/stderr")"
  count=$(cat "$work/count")
  before=$runs
  k=1
  while [ "$k" -le "$count" ]; do
    try "$k" "$@"
    k=$((k + 1 + k / 12))
  done
  echo "$(basename "$1"): $((runs - before)) of $count calls for memory failed in turn"
}

sample "$folder/closeloop" "$work/rig.cfg" "$work/log.csv" --out "$work/out" --threads 1 --quiet --no-figures
sample "$folder/simulate" "$work/rig.cfg" "$work/log.csv"
[ "$wrong" -eq 0 ]
