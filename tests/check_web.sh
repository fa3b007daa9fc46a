#!/bin/sh
# closeloop as a page, from `make web-check`: units are those of UDUNITS-2; the page in a headless Chromium, without network, by
# keyboard, with draft and cancel; answers as those of the native programs. RIGS names the folders, default: the guide's.
set -eu
: "${BUILD:=build}" "${CC:=cc}" "${RIGS:=}"
folder=$BUILD/web/check
units=packaging/cross/units
rm -rf "$folder"
mkdir -p "$folder/leak"

wrong() {
  echo "check_web: $1" >&2
  exit 1
}

# ---- Units: every one of the table, alone and in what one writes with it. Words in "per" and "ref" and marks of angles are read by
# UDUNITS-2 in ways of its own. ----
awk -F '"' '/^  \{"/ && NF == 5 && $2 !~ /^per|^ref|^['\''"%′″°]/ {
    print $2 "\t" $4; print "k" $2 "\t" $4; print "milli" $2 "\t" $4; print $2 "2\t(" $4 ")2"; print $2 "^-1\t(" $4 ")-1"
    print "N/" $2 "\tN/(" $4 ")"; print "1e-3 m " $2 " s-1\tm.(" $4 ")/s"; print $2 "\tPa" }' "$BUILD/web/units_table.c" >"$folder/units"
cat >>"$folder/units" <<'LIST'
%	1
1	%
m3/h	m3/s
l/min	m3/s
kgf/cm2	Pa
lbf/in2	Pa
mm²	m2
N·s/m	N.s/m
N/(m/s)	kg/s
K @ 273.15	K
°C	K
J/(kg K)	m2.s-2.K-1
foo	m
m/	m
(m	m
	1
m^a	m
LIST
lab="apps/lab/base/units.c apps/lab/base/message.c apps/lab/base/escape.c"
flags="-std=c99 -O1 -D_POSIX_C_SOURCE=200809L"
# shellcheck disable=SC2086
$CC $flags tests/units/say.c $lab -ludunits2 -lm -o "$folder/say-udunits"
# shellcheck disable=SC2086
$CC $flags -I"$units" tests/units/say.c $lab "$units/units.c" "$BUILD/web/units_table.c" -lm -o "$folder/say-own"
"$folder/say-udunits" <"$folder/units" >"$folder/udunits.txt" 2>/dev/null
"$folder/say-own" <"$folder/units" >"$folder/own.txt"
paste "$folder/udunits.txt" "$folder/own.txt" | awk -F '\t' '
  function far(a, b, size) { return a - b > 1e-14 * size || b - a > 1e-14 * size }
  function size(a) { return a < 0 ? -a : a }
  { n++; split($3, u, " "); split($6, v, " ") }
  ($3 == "no") != ($6 == "no") || far(u[1], v[1], size(u[1])) || far(u[2], v[2], size(u[1]) + size(u[2])) { bad++; print "  " $1 " to " $2 ": " $3 ", not " $6 }
  END { if (bad || n < 4000) { print n + 0 " units, " bad + 0 " wrong"; exit 1 } print "ok      web: " n " units as UDUNITS-2 has them" }' ||
  wrong "units differ from those of UDUNITS-2"

# ---- The page ----
size=$(wc -c <"$BUILD/web/closeloop.html")
[ "$size" -lt 3000000 ] || wrong "closeloop.html has $size bytes, 3000000 are enough"
echo "ok      web: closeloop.html has $((size / 1000)) kB"
if ! command -v chromium >/dev/null 2>&1 || ! command -v python3 >/dev/null 2>&1; then
  echo "absent: chromium or python3, so that the page was not tried in a browser"
  exit 0
fi
cp study/guides/leak/rig.cfg study/guides/leak/fit.csv study/guides/leak/holdout.csv "$folder/leak/"
# shellcheck disable=SC2086
python3 tests/browser/check_web.py page "$BUILD/web/closeloop.html" ./closeloop ./simulate "$folder/leak" $RIGS >"$folder/log" 2>&1 ||
  { cat "$folder/log"; wrong "the page"; }
sed 's/^/ok      web: /' "$folder/log"
