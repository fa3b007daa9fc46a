#!/bin/sh
# Programs that run out of memory, at one call after the other: no crash, no leak (built with sanitizers), status 4 and a
# message about memory, no file half-written.
#   check_alloc.sh FOLDER QUICK    closeloop, simulate and export-fmu, linked with tests/alloc/fail.c; FOLDER's with sanitizers
# The first calls are tried one by one, later ones further and further apart; every second time memory stays away. A
# search for what has no name takes too long with sanitizers: QUICK's is tried at a few calls.
# Not tried: memory that libraries take for themselves (libconfig, UDUNITS, cJSON, libzip, libxml2, NLopt, SUNDIALS, gnuplot, and the
# streams of the C library).
set -u
folder=$1
quick=$2
work="$folder/work"
rm -rf "$work"
mkdir -p "$work"
export OMP_NUM_THREADS=1 LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0
. tests/expect.sh
runs=0

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
    k=$((k + 1 + k / 8))
  done
  echo "$(basename "$1"): $((runs - before)) of $count calls for memory failed in turn"
}

sample "$folder/closeloop" "$work/rig.cfg" "$work/log.csv" --out "$work/out" --threads 1 --quiet
sample "$folder/simulate" "$work/rig.cfg" "$work/log.csv"
sample "$folder/export-fmu" "$work/leaky.cfg" --out "$work/out"

# a bump of friction that nothing in the catalogue explains
printf 'unlisted = ( { equation = "friction"; argument = "x"; from = "0 mm"; to = "20 mm"; values = [ 0, 0, 300, 0, 0 ];
  unit = "N"; } );\n' | cat study/actuators/r1-400.cfg - >"$work/bump.cfg"
sed -i 's/2 kPa/0.3 kPa/; s/0.2 mm/0.02 mm/' "$work/rig.cfg"
"$folder/simulate" "$work/bump.cfg" --step | awk 'NR == 1 || NR % 12 == 0' >"$work/log.csv"
for k in 9000 20000 29001; do
  try "$k" "$quick/closeloop" "$work/rig.cfg" "$work/log.csv" --out "$work/out" --threads 1 --quiet
done
echo "closeloop, something without a name: calls 9000, 20000 and 29001 failed in turn"
[ "$wrong" -eq 0 ]
