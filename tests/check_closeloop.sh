#!/bin/sh
# closeloop and its folder: every file there, the same bytes again, whole after Ctrl-C, and words where gnuplot is missing.
set -u
: "${BUILD:=build}"
folder="$BUILD/closeloop"
rm -rf "$folder"
mkdir -p "$folder/bin" "$folder/empty"
files="report.json report.html model.cfg model.h residual.csv response.svg residual.svg arguments.svg autocorrelation.svg \
parameters.svg"
wrong=0

complain() {
  echo "$*"
  wrong=$((wrong + 1))
}

# expect STATUS WHAT COMMAND...
expect() {
  status=$1
  what=$2
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  [ "$got" -eq "$status" ] || complain "$what: expected status $status, got $got: $(cat "$folder/err")"
}

# A rig that answers as declared, and its log.
printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
  cat study/actuators/r1-400.cfg - >"$folder/rig.cfg"
./simulate study/actuators/r1-400.cfg --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/log.csv"

expect 0 "first run" ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/whole"
expect 0 "second run, no locale" env LC_ALL=C ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/again"
grep warning "$folder/err" && complain "without a locale there are warnings"
for file in $files; do
  [ -s "$folder/whole/$file" ] || complain "$file is not written"
  [ "$file" = report.json ] || cmp "$folder/whole/$file" "$folder/again/$file" || complain "$file differs from run to run"
done
grep -q "$(cat "$folder/out")" "$folder/whole/report.html" || complain "report.html does not say: $(cat "$folder/out")"
grep -lF "$folder/" "$folder"/whole/* && complain "an answer that is kept or sent names the folder of the log"
if command -v xmllint >/dev/null 2>&1; then
  xmllint --noout "$folder/whole"/*.svg "$folder/whole/report.html" || complain "malformed"
fi

# the model it writes is one that it reads
expect 0 "model.cfg" ./closeloop "$folder/whole/model.cfg" "$folder/log.csv" --out "$folder/model" --no-figures
[ -e "$folder/model/response.svg" ] && complain "--no-figures drew a figure"

# held-out logs have an error each: that of the log fitted is the error after, as near as its fit is, and that of a
# coarser log another
awk 'NR == 1 || NR % 3 == 0' "$folder/log.csv" >"$folder/third.csv"
expect 0 "held out" ./closeloop "$folder/rig.cfg" "$folder/log.csv" --holdout "$folder/log.csv,$folder/third.csv" \
  --out "$folder/held" --no-figures
awk -F'[:,]' '/"(before|after|log|error|path)":/ { gsub(/[\t "]/, ""); where = $1 == "log" ? $2 : where "/" $1 }
  /"rmse":/ && where { print where, $2; where = "" }' "$folder/held/report.json" >"$folder/errors"
# same LINE LINE: whether the errors of two lines agree within a twentieth
same() {
  awk -v a="$1" -v b="$2" 'NR == a { x = $2 }  NR == b { y = $2 }  END { exit !(x > 0.95 * y && x < 1.05 * y) }' \
    "$folder/errors"
}
sed 's/ .*//' "$folder/errors" | tr '\n' ' ' >"$folder/order"
[ "$(cat "$folder/order")" = "/error/before /after /before /after log.csv/before /after third.csv/before /after /path/error " ] ||
  complain "errors in report.json are of: $(cat "$folder/order")"
same 2 6 || complain "held out, log.csv has another error than fitted"
same 2 8 && complain "third.csv has the error of log.csv"
same 2 9 || complain "the model on the way there is the final one and has another error"

# without gnuplot the rest is there, and the message names the way out
expect 4 "no gnuplot" env PATH="$folder/empty" ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/without"
grep -q -- "--no-figures" "$folder/err" || complain "no way out without gnuplot: $(cat "$folder/err")"
[ -s "$folder/without/report.json" ] || complain "no report.json without gnuplot"

# whole FOLDER: what is in it is what an undisturbed run writes
whole() {
  for path in "$1"/*; do
    [ -e "$path" ] || continue
    name=$(basename "$path")
    case $name in
    report.json) grep -q '^}$' "$path" || complain "half-written: $path" ;;
    *) cmp "$path" "$folder/whole/$name" || complain "half-written: $path" ;;
    esac
  done
}

# a disk that fills up at one file after the other: the message names it, what was there stays, no part is left
for file in $files; do
  [ -e /dev/full ] || break
  rm -rf "$folder/full"
  cp -R "$folder/whole" "$folder/full"
  ln -s /dev/full "$folder/full/$file.part"
  expect 4 "full disk at $file" ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/full"
  grep -q "$file: cannot be written: .*space" "$folder/err" || complain "full disk at $file: $(cat "$folder/err")"
  whole "$folder/full"
  [ -L "$folder/full/$file.part" ] && complain "full disk: $file.part stays"
done

# an answer that cannot be said is not done
[ -e /dev/full ] && expect 4 "full disk on standard output" \
  sh -c "./closeloop '$folder/rig.cfg' '$folder/log.csv' --no-figures --out '$folder/unsaid' >/dev/full"
printf 'rig,log\n%s,%s\n' rig.cfg log.csv >"$folder/list.csv"
[ -e /dev/full ] && expect 4 "full disk on standard output of a batch" \
  sh -c "./closeloop --batch '$folder/list.csv' --out '$folder/unsaid' >/dev/full"

# the folder of temporary files fills up while gnuplot draws, which gnuplot itself does not say
printf '#!/bin/sh\ntrap "" XFSZ\nulimit -f 8\nPATH=$REAL_PATH exec gnuplot "$@"\n' >"$folder/bin/gnuplot"
chmod +x "$folder/bin/gnuplot"
expect 4 "no room for figures" env REAL_PATH="$PATH" PATH="$folder/bin:$PATH" \
  ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/cramped"
grep -q "gnuplot" "$folder/err" || complain "no room for figures: $(cat "$folder/err")"
ls "$folder/cramped"/*.svg >/dev/null 2>&1 && complain "a figure was written that gnuplot did not finish"

# figures of an earlier run that this one does not draw go
cp -R "$folder/whole" "$folder/stale"
cp "$folder/whole/residual.svg" "$folder/stale/candidates.svg"
: >"$folder/stale/unlisted.svg.part"
expect 0 "stale figures" ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/stale"
[ "$(ls "$folder/stale")" = "$(ls "$folder/whole")" ] || complain "figures of an earlier run stay"

# Ctrl-C while it fits: nothing is written
expect 130 "interrupted fit" timeout --preserve-status -s INT 0.03 \
  ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/early"
[ -e "$folder/early" ] && complain "an interrupted fit has written something"

# Ctrl-C while gnuplot draws, to the program and then to all: it is put off until the files are in their place
cat >"$folder/bin/gnuplot" <<'SCRIPT'
#!/bin/sh
kill -INT $PPID $$
PATH=$REAL_PATH exec gnuplot "$@"
SCRIPT
chmod +x "$folder/bin/gnuplot"
expect 130 "interrupted drawing" env --default-signal=INT REAL_PATH="$PATH" PATH="$folder/bin:$PATH" \
  ./closeloop "$folder/rig.cfg" "$folder/log.csv" --out "$folder/late"
whole "$folder/late"
for file in $files; do
  [ -s "$folder/late/$file" ] || complain "interrupted drawing: $file is missing"
done

exit "$((wrong != 0))"
