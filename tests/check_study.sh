#!/bin/sh
# The study, without figures, against the committed tables.
set -u
: "${BUILD:=build}"
again="$BUILD/study-again"
rm -rf "$again"
./sweep hypotheses.cfg --quiet --no-figures --results "$again" || exit 1
wrong=0
for table in "$again"/*.csv; do
  "$BUILD/tests/compare" 1e-6 1e-7 "results/$(basename "$table")" "$table" || wrong=1
done
exit $wrong
