#!/bin/sh
# What a stranger may send: check_hostile.sh N generates N rigs, logs and lists with names and contents that try to be code, runs the
# sanitized programs on them (tests/hostile/attack.py), reads all that they write by strict parsers, and opens every page in
# a headless Chromium, in which no name may have run.
set -u
: "${BUILD:=build}"
folder="$BUILD/hostile"
if ! command -v python3 >/dev/null 2>&1; then
  echo "absent: python3, so that no hostile file was tried"
  exit 0
fi
LSAN_OPTIONS=suppressions=$PWD/tests/fuzz/leaks.supp:print_suppressions=0
UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS UBSAN_OPTIONS
python3 tests/hostile/attack.py "$BUILD/sanitized/tests/alloc" "$folder" "$1" || exit 1
for browser in chromium chromium-browser google-chrome chrome; do
  command -v "$browser" >/dev/null 2>&1 && exec python3 tests/browser/check.py hostile "$folder/pages"
done
echo "absent: chromium, so that no page with hostile names was looked at in a browser"
