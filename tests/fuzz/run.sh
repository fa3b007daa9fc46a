#!/bin/sh
# Fuzz each target in turn, from the seeds and what earlier runs have kept; ends with the totals.
#   run.sh FOLDER SECONDS RUNS TARGET...     RUNS: executions of a target, -1 for no bound
# A reader that takes ten minutes for an input of 1 kB hangs; what is merely slow on a busy machine does not.
# A find is left in FOLDER/found; make it minimal, fix the reader, and put it into tests/fuzz/finds.
set -u
folder=$1
seconds=$2
runs=$3
shift 3
all=0
finds=0
mkdir -p "$folder/found"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export ASAN_OPTIONS=malloc_context_size=4:quarantine_size_mb=8
export LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0

# Leaks are counted once, at the end of a target's run: after every execution it would take all the time.
# Words of the files, as the readers have them.
cat apps/lab/rig/*.c apps/lab/log/*.[ch] apps/study/study.c lib/*.h lib/effects/*.c |
  grep -o '"[A-Za-z0-9_.^/%-][A-Za-z0-9_.^/% -]*"' | sort -u >"$folder/words"

for target in "$@"; do
  corpus="$folder/corpus/$target"
  log="$folder/$target.log"
  mkdir -p "$corpus"
  [ "$target" != log ] || cp tests/loggers/* "$corpus"
  for seed in tests/fuzz/seeds/"$target"-* tests/fuzz/finds/"$target"-*; do
    [ -f "$seed" ] && cp "$seed" "$corpus"
  done
  FUZZ_TARGET=$target "$folder/fuzz" -max_total_time="$seconds" -runs="$runs" -max_len=1024 -timeout=600 \
    -rss_limit_mb=4096 -detect_leaks=0 -entropic=0 -dict="$folder/words" -artifact_prefix="$folder/found/$target-" -print_final_stats=1 \
    "$corpus" >"$log" 2>&1
  status=$?
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
  speed=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log" | tail -n 1)
  kept=$(find "$corpus" -type f | wc -l)
  all=$((all + ${count:-0}))
  printf 'fuzz %-6s %10s executions, %6s a second, corpus of %s, %s\n' "$target" "${count:-0}" "${speed:-0}" "$kept" \
    "$([ $status -eq 0 ] && echo 'nothing found' || echo "FOUND: $log")"
  if [ $status -ne 0 ]; then
    finds=$((finds + 1))
    grep -E '^(==|SUMMARY|broken promise)|runtime error' "$log" | head -n 5
  fi
done
printf 'fuzz: %s executions in all, %s of %s targets with a find\n' "$all" "$finds" "$#"
[ "$finds" -eq 0 ]
