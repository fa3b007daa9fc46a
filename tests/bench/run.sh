#!/bin/sh
# `make bench`: with rivals where Python can have them, else without; then figures and the table of the README.
#   run.sh RESULTS [quick]      BUILD: folder of the build
set -eu
: "${BUILD:=build}"
results=$1
scratch="$BUILD/bench"
mkdir -p "$scratch" "$results"
if ! python3 tests/bench/rivals.py "$BUILD/pic/libbench.so" "$BUILD/rivals" "$results" "$scratch" . ${2:+"$2"}; then
  echo "bench: without SciPy and CasADi (python3 with venv, and a network at the first time, bring them in)"
  "$BUILD/pic/bench" "$results" "$scratch" . ${2:+"$2"}
fi
for figure in work_precision scaling; do
  LC_ALL=C.UTF-8 gnuplot -e "IN='$results'; OUT='$results/$figure.svg'" "study/figures/$figure.gp"
done
[ "$results" != results ] || sh tests/readme_table.sh --refresh times study/guides/speed.md
