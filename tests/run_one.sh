#!/bin/sh
# One check of tests/run.sh: run_one.sh LIST NUMBER runs that line, "WORDS | COMMAND", says how it went, and leaves
# "PASSED FAILED SKIPPED" in LIST-NUMBER.count. What counts itself, by cmocka or by lines "ok", "FAILED", "skipped", is taken at its
# word; another command is one check.
set -u
line=$(sed -n "$2p" "$1")
what=${line%% | *}
log="$1-$2.log"
begin=$(date +%s)
sh -c "${line#* | }" >"$log" 2>&1 </dev/null
status=$?
took="$(($(date +%s) - begin)) s"

# counted WORD LINE: numbers of tests that cmocka says, and lines that begin so
counted() {
  awk -v word="^\\\\[ *$1 *\\\\] [0-9]+ test" -v line="^$2 " '
    $0 ~ word { sub(/^[^]]*\] /, ""); n += $1 }  $0 ~ line { n++ }  END { print n + 0 }' "$log"
}
passed=$(counted PASSED ok)
failed=$(counted FAILED FAILED)
skipped=$(counted SKIPPED skipped)
[ "$((passed + failed + skipped))" -ne 0 ] || [ "$status" -ne 0 ] || passed=1
[ "$status" -eq 0 ] || [ "$failed" -ne 0 ] || failed=1 # it died without a count
echo "$passed $failed $skipped" >"$1-$2.count"

# in one piece, because others run beside it
{
  if [ "$failed" -ne 0 ]; then
    echo "FAILED  $what: $failed of $((passed + failed)), $took"
    grep -v '^\[ *\(RUN\|OK\) *\]' "$log" | tail -n 60
  else
    echo "ok      $what: $passed, $took"
  fi
  grep '^skipped' "$log"
  [ ! -d "$MEASURED" ] && echo "$what" | grep -Eq '^(double|sanitized) ' || grep '^absent:' "$log"
} >"$1-$2.said"
cat "$1-$2.said"
