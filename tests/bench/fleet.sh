#!/bin/sh
# A fleet run: N logs of a few hundred rows, twenty of a rig, through closeloop --batch.
# Usage: fleet.sh N [FOLDER-OF-THE-TABLE [THREADS]]; prints logs per second of one core and memory, writes fleet.csv.
set -eu
: "${BUILD:=build}"
n=$1
results=${2:-results}
threads=${3:-$(getconf _NPROCESSORS_ONLN)}
rows=300
folder="$BUILD/fleet-$n"
mkdir -p "$folder" "$results"
[ -e "$folder/list.csv" ] || "$BUILD/tests/bench/fleet" "$folder" "$n" "$rows"
status=0
./closeloop --batch "$folder/list.csv" --out "$folder/answers" --threads "$threads" || status=$?
[ -e "$folder/answers/batch.csv" ] || exit "$status"
awk -F, -v rows="$rows" -v threads="$threads" '
  FNR == 1 { file++; next }
  file == 1 { n++; errors += $2 == "error" }
  file == 2 { cpu += $3; most = $3 > most ? $3 : most; memory = $4 > memory ? $4 : memory }
  END {
    print "logs [1],rows [1],errors [1],at_once [1],cpu [s],longest_cpu [s],logs_per_second_of_a_core [Hz],memory_of_largest [MB]"
    printf "%d,%d,%d,%d,%.1f,%.2f,%.3f,%.1f\n", n, rows, errors, threads, cpu, most, n / cpu, memory
  }' "$folder/answers/batch.csv" "$folder/answers/batch.cost.csv" >"$results/fleet.csv.part"
mv "$results/fleet.csv.part" "$results/fleet.csv"
cat "$results/fleet.csv"
exit "$status"
