#!/bin/sh
# closeloop and its folder: every file there, the same bytes again, whole after Ctrl-C, and words where gnuplot is missing.
set -u
: "${BUILD:=build}"
folder="$BUILD/closeloop"
programs=$(cd "$BUILD/bin" && pwd)
rm -rf "$folder"
mkdir -p "$folder/bin" "$folder/empty"
files="report.json report.html model.cfg model.h effects.def residual.csv signature.svg response.svg residual.svg arguments.svg autocorrelation.svg"
. tests/expect.sh

# A rig that answers as declared, and its log.
printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
  cat study/actuators/r1-400.cfg - >"$folder/rig.cfg"
"$BUILD/bin/simulate" study/actuators/r1-400.cfg --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/log.csv"

# The same log as Excel writes it in German: the same answer, and what was guessed is told.
{
  printf 'Zeit (s);Befehl (1);Druck (kPa);Hub (mm)\r\n'
  tail -n +2 "$folder/log.csv" | tr ',.' ';,' | sed 's/$/\r/'
} >"$folder/german.csv"
expect 0 "log in German" "$programs/closeloop" "$folder/rig.cfg" "$folder/german.csv" --out "$folder/german" --no-figures
cp "$folder/out" "$folder/german.out"
grep -q 'german.csv: read with semicolons between cells, decimal commas' "$folder/german/report.json" ||
  complain "what was guessed of a log is not told"
expect 0 "log in English" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/english" --no-figures
cmp "$folder/out" "$folder/german.out" || complain "a log in German has another answer"
cmp "$folder/english/residual.csv" "$folder/german/residual.csv" || complain "a log in German has other residuals"

# A rig file drafted from the log alone is read, and answers.
expect 0 "draft" "$programs/closeloop" --init "$folder/log.csv" --sheet "area=400 cm^2" "stroke=20 mm" -o "$folder/draft.cfg"
expect 0 "run of a draft" "$programs/closeloop" "$folder/draft.cfg" "$folder/log.csv" --out "$folder/drafted" --no-figures
grep -q '"verdict"' "$folder/drafted/report.json" || complain "a drafted rig file has no answer"
expect 2 "draft with a wrong word" "$programs/closeloop" --init "$folder/log.csv" --sheet aera=1
printf 'Time (s),A,B\n0,1,2\n1,2,3\n' >"$folder/unknown.csv"
expect 1 "draft of unknown columns" "$programs/closeloop" --init "$folder/unknown.csv"
grep -q "closeloop --sheet name=VALVE > rig.cfg makes one" "$folder/err" || complain "a rig file is to be written that is not there"
expect 2 "words without a draft" "$programs/closeloop" --sheet area=1 "$folder/rig.cfg" "$folder/log.csv"
expect 2 "a draft of a list" "$programs/closeloop" --init "$folder/log.csv" --batch "$folder/list.csv"

expect 0 "first run" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/whole"
expect 0 "second run, no locale" env LC_ALL=C "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/again"
grep warning "$folder/err" && complain "without a locale there are warnings"
for file in $files; do
  [ -s "$folder/whole/$file" ] || complain "$file is not written"
  [ "$file" = report.json ] || cmp "$folder/whole/$file" "$folder/again/$file" || complain "$file differs from run to run"
done
tr '\n' ' ' <"$folder/whole/report.html" | sed 's/<[^>]*>/ /g' | tr -s ' ' | grep -qF "$(cat "$folder/out")" || complain "report.html does not say: $(cat "$folder/out")"
grep -q "no larger than noise, but not white on 2 of 2" "$folder/whole/report.html" ||
  complain "report.html does not say why a log without noise leaves nothing to explain"
grep -lF "$folder/" "$folder"/whole/* && complain "an answer that is kept or sent names the folder of the log"
if command -v xmllint >/dev/null 2>&1; then
  xmllint --noout "$folder/whole"/*.svg "$folder/whole/report.html" || complain "malformed"
fi

# the model it writes is one that it reads
expect 0 "model.cfg" "$programs/closeloop" "$folder/whole/model.cfg" "$folder/log.csv" --out "$folder/model" --no-figures
[ -e "$folder/model/response.svg" ] && complain "--no-figures drew a figure"

# model.h with a catalogue: the whole one or its own give the model, any other does not compile
expect 0 "a leak" "$programs/closeloop" study/guides/leak/rig.cfg study/guides/leak/fit.csv --budget 600 --out "$folder/leak" --no-figures
awk -F, 'NR > 1 { print int($1 * 1000 + 0.5), $2, $3 * 1000 }' study/guides/leak/fit.csv >"$folder/rows"
# watch CATALOGUE: what the guide's program says with it
watch() {
  "${CC:-cc}" -std=c99 -w -DPNEU_EFFECTS_FILE="\"$1\"" -I. -I"$folder" -I"$folder/leak" -Ilib study/guides/watch/watch.c \
    lib/*.c lib/effects/*.c -lm -o "$folder/watch" 2>"$folder/err" && "$folder/watch" <"$folder/rows"
}
watch effects.def >"$folder/whole.txt" || complain "model.h with the whole catalogue: $(cat "$folder/err")"
watch leak/effects.def >"$folder/own.txt" || complain "model.h with its own catalogue: $(cat "$folder/err")"
cmp "$folder/whole.txt" "$folder/own.txt" || complain "model.h has another leak with its own catalogue"
grep -q 'at most [45] times the noise' "$folder/own.txt" || complain "model.h does not have the leak"
watch tests/firmware/no_effects.def >/dev/null && complain "model.h compiles without the effect that it needs"
printf '#include "model.h"\nstatic const pneu_params p = MODEL_PARAMS;\nstatic const pneu_laws law = MODEL_LAWS;\nstatic pneu_model model;\nint main(void) { return pneu_model_init(&model, &p, &law, 0); }\n' >"$folder/model.c"
# by_place LANGUAGE: C90 and C++ know no names
by_place() {
  at="-x $1 $folder/model.c -x none -Wall -Wextra -pedantic -Werror -I. -I$folder -I$folder/leak -Ilib"
  # shellcheck disable=SC2086
  expect 0 "model.h in $1" "${CC:-cc}" $2 $at "${LIBPNEU:-$BUILD/libpneu.a}" -lm -o "$folder/model.o"
  expect 0 "the model in $1" "$folder/model.o"
  # shellcheck disable=SC2086
  "${CC:-cc}" $2 $at -fsyntax-only -DPNEU_EFFECTS_FILE='"leak/effects.def"' 2>"$folder/err" &&
    complain "model.h in $1 takes another catalogue for the whole one"
}
by_place c -std=c90
if "${CC:-cc}" -x c++ -fsyntax-only /dev/null 2>/dev/null; then by_place c++ -std=c++11; fi

# a name is no way out of results/: neither dots nor slashes in it lead anywhere
for name in .. ../out "hall 2/press 1"; do
  mkdir -p "$folder/named"
  sed "s,name = [^;]*,name = \"$name\"," "$folder/rig.cfg" >"$folder/named.cfg"
  expect 0 "named $name" sh -c "cd '$folder/named' && '$programs/closeloop' ../named.cfg ../log.csv --no-figures --quiet"
done
[ "$(cd "$folder/named" && find . -name report.json | sort | tr '\n' ' ')" = \
  "./results/-.-out/report.json ./results/-./report.json ./results/hall 2-press 1/report.json " ] ||
  complain "names of rigs lead elsewhere: $(cd "$folder/named" && find . -name report.json)"

# held-out logs have an error each, a coarser log another
awk 'NR == 1 || NR % 3 == 0' "$folder/log.csv" >"$folder/third.csv"
expect 1 "nothere.csv" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --holdout "$folder/nothere.csv" \
  --holdout "$folder/third.csv"
expect 0 "held out" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --holdout "$folder/log.csv,$folder/third.csv" \
  --out "$folder/held" --no-figures
grep -q "log.csv is held out, but fitted too" "$folder/held/report.json" || complain "a log that is fitted and held out is not told"
grep -q "third.csv is held out" "$folder/held/report.json" && complain "a log that is only held out is told"
awk -F'[:,]' '/"(before|after|log|error|path|holdout)":/ { gsub(/[\t "]/, ""); where = $1 == "log" ? $2 : $1 == "path" ? "/path" : where "/" $1 }
  /"rmse":/ && where { print where, $2; where = "" }' "$folder/held/report.json" >"$folder/errors"
# same LINE LINE: whether the errors of two lines agree within a twentieth
same() {
  awk -v a="$1" -v b="$2" 'NR == a { x = $2 }  NR == b { y = $2 }  END { exit !(x > 0.95 * y && x < 1.05 * y) }' \
    "$folder/errors"
}
sed 's/ .*//' "$folder/errors" | tr '\n' ' ' >"$folder/order"
[ "$(cat "$folder/order")" = "/error/before /after /holdout/before /after log.csv/before /after third.csv/before /after /path/error /holdout " ] ||
  complain "errors in report.json are of: $(cat "$folder/order")"
same 6 8 && complain "third.csv has the error of log.csv"
same 4 10 || complain "the model on the way there is the final one and has another error"

# without gnuplot all but the drawings is there, the page to the same byte, and one line says so; demanded, they are an error
expect 0 "no gnuplot" env PATH="$folder/empty" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/without"
[ "$(grep -c gnuplot "$folder/err")" = 1 ] || complain "not one line on gnuplot: $(cat "$folder/err")"
cmp "$folder/without/report.html" "$folder/whole/report.html" || complain "without gnuplot the page is another"
ls "$folder/without"/*.svg >/dev/null 2>&1 && complain "figures without gnuplot"
expect 0 "no gnuplot, quiet" env PATH="$folder/empty" \
  "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/without" --quiet
[ -s "$folder/err" ] && complain "--quiet is not: $(cat "$folder/err")"
expect 4 "no gnuplot, --figures" env PATH="$folder/empty" \
  "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/without" --figures
grep -q "gnuplot.*--figures" "$folder/err" || complain "no way out without gnuplot: $(cat "$folder/err")"
[ -s "$folder/without/report.json" ] || complain "no report.json without gnuplot"
expect 2 "--figures --no-figures" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --figures --no-figures
printf 'rig,log\nrig.cfg,log.csv\n' >"$folder/one.csv"
for again in first second; do
  expect 0 "batch without gnuplot, $again" env PATH="$folder/empty" "$programs/closeloop" --batch "$folder/one.csv" --reports \
    --out "$folder/one" --quiet
  [ "$again" = first ] && cp "$folder"/one/*/report.json "$folder/one.json"
done
cmp "$folder"/one/*/report.json "$folder/one.json" || complain "without gnuplot, a line of a batch is never done"

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
  expect 4 "full disk at $file" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/full"
  grep -q "$file: cannot be written: .*space" "$folder/err" || complain "full disk at $file: $(cat "$folder/err")"
  whole "$folder/full"
  [ -L "$folder/full/$file.part" ] && complain "full disk: $file.part stays"
done

# an answer that cannot be said is not done
[ -e /dev/full ] && expect 4 "full disk on standard output" \
  sh -c "$BUILD/bin/closeloop '$folder/rig.cfg' '$folder/log.csv' --no-figures --out '$folder/unsaid' >/dev/full"
printf 'rig,log\n%s,%s\n' rig.cfg log.csv >"$folder/list.csv"
[ -e /dev/full ] && expect 4 "full disk on standard output of a batch" \
  sh -c "$BUILD/bin/closeloop --batch '$folder/list.csv' --out '$folder/unsaid' >/dev/full"

# the folder of temporary files fills up while gnuplot draws, which gnuplot itself does not say
printf '#!/bin/sh\ntrap "" XFSZ\nulimit -f 8\nPATH=$REAL_PATH exec gnuplot "$@"\n' >"$folder/bin/gnuplot"
chmod +x "$folder/bin/gnuplot"
expect 4 "no room for figures" env REAL_PATH="$PATH" PATH="$folder/bin:$PATH" \
  "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/cramped"
grep -q "gnuplot" "$folder/err" || complain "no room for figures: $(cat "$folder/err")"
ls "$folder/cramped"/*.svg >/dev/null 2>&1 && complain "a figure was written that gnuplot did not finish"

# figures of an earlier run that this one does not draw go
cp -R "$folder/whole" "$folder/stale"
cp "$folder/whole/residual.svg" "$folder/stale/unlisted.svg"
: >"$folder/stale/unlisted.svg.part"
expect 0 "stale figures" "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/stale"
[ "$(ls "$folder/stale")" = "$(ls "$folder/whole")" ] || complain "figures of an earlier run stay"

# Ctrl-C while it fits, so many logs that it is far from its end: nothing is written
logs=""
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do logs="$logs $folder/log.csv"; done
# shellcheck disable=SC2086
expect 130 "interrupted fit" timeout --preserve-status -s INT 0.03 \
  "$programs/closeloop" "$folder/rig.cfg" $logs --out "$folder/early"
[ -e "$folder/early" ] && complain "an interrupted fit has written something"

# Ctrl-C while gnuplot draws, to the program and then to all: it is put off until the files are in their place
cat >"$folder/bin/gnuplot" <<'SCRIPT'
#!/bin/sh
[ -e "$ONCE" ] || { : >"$ONCE" && kill -INT $PPID $$; }
PATH=$REAL_PATH exec gnuplot "$@"
SCRIPT
chmod +x "$folder/bin/gnuplot"
expect 130 "interrupted drawing" env --default-signal=INT REAL_PATH="$PATH" ONCE="$folder/once" PATH="$folder/bin:$PATH" \
  "$programs/closeloop" "$folder/rig.cfg" "$folder/log.csv" --out "$folder/late"
whole "$folder/late"
for file in $files; do
  [ -s "$folder/late/$file" ] || complain "interrupted drawing: $file is missing"
done

exit "$((wrong != 0))"
