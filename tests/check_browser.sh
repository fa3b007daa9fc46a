#!/bin/sh
# The pages of closeloop in a headless Chromium: nothing asked of the network, no complaint on the console, nothing wider
# than a telephone, contrast in light and dark, curves on every panel that are switched, zoomed and read by mouse and by
# keyboard with the values of residual.csv, two printed pages, numbers without script, valid HTML; index.html quick with
# 10,000 lines.
set -u
: "${BUILD:=build}" "${LINES:=10000}"
folder="$BUILD/browser"

has() {
  for program in "$@"; do command -v "$program" >/dev/null 2>&1 && return; done
  return 1
}
has_browser() { has chromium chromium-browser google-chrome chrome; }
has_browser && has tidy && has pdfinfo && has python3 || sh study/install-packages.sh chromium tidy poppler-utils python3 >/dev/null 2>&1
if ! has_browser || ! has tidy || ! has pdfinfo || ! has python3; then
  echo "absent: chromium, tidy, pdfinfo or python3, so that no page was looked at in a browser"
  exit 0
fi

rm -rf "$folder"
mkdir -p "$folder/list"

# Rigs of which one answers as declared, one leaks, and one has a spot of friction that the catalogue does not know.
cp study/actuators/r1-400.cfg "$folder/list/sound.cfg"
printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' | cat study/actuators/r1-400.cfg - >"$folder/list/rig.cfg"
printf 'effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n' | cat study/actuators/r1-400.cfg - >"$folder/list/leaky.cfg"
printf 'unlisted = ( { equation = "friction"; argument = "x"; from = "0 mm"; to = "20 mm"; values = [ 0, 0, 300, 0, 0 ];
  unit = "N"; } );\n' | cat study/actuators/r1-400.cfg - >"$folder/list/spot.cfg"
for rig in sound leaky spot; do
  ./simulate "$folder/list/$rig.cfg" --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/list/$rig.csv"
done
printf 't [s],u [1],p [kPa],x [mm]\n0,0,0,0\n1,1,zero,0\n' >"$folder/list/torn.csv"
cat >"$folder/list/fleet.csv" <<'LIST'
name,rig,log,holdout
sound,rig.cfg,sound.csv,sound.csv
leaks,rig.cfg,leaky.csv;leaky.csv,leaky.csv
spot,rig.cfg,spot.csv,
torn,rig.cfg,torn.csv,
50 % & <more>,rig.cfg,leaky.csv,
LIST
./closeloop --batch "$folder/list/fleet.csv" --out "$folder/fleet" --reports --quiet >"$folder/out" 2>&1
[ -s "$folder/fleet/index.html" ] || { cat "$folder/out"; exit 1; }

# The same page with many lines: each of its own again and again, with names and errors of their own.
awk -v lines="$LINES" '
  /^<tr><th scope="row">/ { row[n++] = $0; next }
  n && !done {
    for (i = 0; i < lines; i++) {
      text = row[int(i * n / lines)]
      sub(/<\/a><\/th>|<\/th>/, "-" i "&", text)
      if (match(text, /<td>[0-9.]+<\/td>/)) text = substr(text, 1, RSTART + 3) (i * 7919 % 9973) / 100 substr(text, RSTART + RLENGTH - 5)
      print text
    }
    done = 1
  }
  { print }' "$folder/fleet/index.html" >"$folder/many.html"

python3 tests/browser/check.py report "$folder/fleet/sound" "$folder/fleet/leaks" "$folder/fleet/spot" &&
  python3 tests/browser/check.py index "$folder/fleet/index.html" "$folder/many.html"
