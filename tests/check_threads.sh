#!/bin/sh
# The same input gives the same bytes whatever the number of threads: sweep, closeloop, blind trials.
set -u
: "${BUILD:=build}"
folder="$BUILD/threads"
rm -rf "$folder"
mkdir -p "$folder"
wrong=0

printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
  cat study/actuators/r1-400.cfg - >"$folder/rig.cfg"
printf 'effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n' |
  cat study/actuators/r1-400.cfg - >"$folder/leaky.cfg"
./simulate "$folder/leaky.cfg" --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/log.csv"

# run THREADS: every program, into a folder of that name
run() {
  OMP_NUM_THREADS=$1
  OMP_DYNAMIC=false
  export OMP_NUM_THREADS OMP_DYNAMIC
  ./sweep hypotheses.cfg --quiet --no-figures --results "$folder/$1/sweep" &&
    ./closeloop "$folder/rig.cfg" "$folder/log.csv" --quiet --out "$folder/$1/closeloop" &&
    "$BUILD/tests/blind/blind" --trials 2 --seed 1 --quiet --work "$folder/$1/work" --out "$folder/$1/blind" &&
    sed '/^[[:space:]]*"timing":/,/^[[:space:]]*}/d' "$folder/$1/closeloop/report.json" >"$folder/$1/report.json" &&
    rm -r "$folder/$1/closeloop/report.json" "$folder/$1/work"
}

for threads in 1 2 3; do
  run $threads >"$folder/out" 2>&1 || { echo "with $threads threads: $(cat "$folder/out")"; wrong=1; }
done
for threads in 2 3; do
  diff -rq "$folder/1" "$folder/$threads" || wrong=1
done
[ -s "$folder/1/blind/blind.csv" ] && [ -s "$folder/1/report.json" ] && [ -s "$folder/1/sweep/hypotheses.csv" ] || wrong=1
exit $wrong
