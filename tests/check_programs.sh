#!/bin/sh
# The programs on bad input and in a bad world: exit status, message, nothing lost, nothing half-written.
set -u
: "${BUILD:=build}"
folder="$BUILD/programs"
rm -rf "$folder"
mkdir -p "$folder"
model=study/actuators/r1-400.cfg
. tests/expect.sh


# command line
expect_words 2 "unknown\|unrecognized\|option" "$BUILD/bin/sweep" --nonsense
expect_words 2 "" "$BUILD/bin/sweep"
expect_words 0 "" "$BUILD/bin/sweep" --help

# the world
expect_words 4 "unit database" env UDUNITS2_XML_PATH=nothere "$BUILD/bin/simulate" "$model" --step

# configuration
expect_words 1 "nothere.cfg" "$BUILD/bin/sweep" nothere.cfg
: >"$folder/empty.cfg"
expect_words 1 "empty.cfg" "$BUILD/bin/sweep" "$folder/empty.cfg"
sed 's/400 kN\/m/400 kN/' "$model" >"$folder/bad.cfg"
expect_words 1 "bad.cfg:[0-9]*.*spring_rate" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
sed 's/stroke = "20 mm"/stroke = "0 mm"/' "$model" >"study/actuators/bad-$$.cfg"
sed "s/r1-400.cfg/bad-$$.cfg/" study/hypotheses.cfg >"study/bad-$$.cfg"
expect_words 1 "stroke" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/actuators/bad-$$.cfg"
sed 's/subject   = "r1-400"/subject = "r2"/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect_words 1 "r2" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/points = 28/points = 0/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect_words 1 "points" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/confirmed_below/confirmed_bellow/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect_words 1 "confirmed_below" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/bad-$$.cfg"

printf 'effects = { heat_transfer = { film_conductance = "5 W/K"; }; };\n' | cat "$model" - >"$folder/bad.cfg"
expect_words 1 "film_conductance" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
for inputs in '"u", "x"' '"x", "p"'; do
  printf 'inputs = [%s];\n' "$inputs" | cat "$model" - >"$folder/driven.cfg"
  printf 't [s],u [1],p [kPa],x [mm]\n0,0,150,-0.06\n0.1,0,150,-0.04\n0.2,0,150,0.02\n' >"$folder/driven.csv"
  expect_words 0 "" "$BUILD/bin/simulate" "$folder/driven.cfg" "$folder/driven.csv"
done

# logs
# of a valve that air closes the travel comes back as the log has it: open at rest
printf 't [s],u [1],x [mm]\n0,0,20\n1,0,20\n' >"$folder/open.csv"
printf 'actuator = { stroke = "20 mm"; fail = "open"; };\n' >"$folder/open.cfg"
expect_words 0 "" "$BUILD/bin/simulate" "$folder/open.cfg" "$folder/open.csv" --out "$folder/open_x.csv"
grep -q '^1,0,20$' "$folder/open_x.csv" || complain "simulate turns the travel of a valve that air closes: $(cat "$folder/open_x.csv")"
head -c 4096 /dev/urandom >"$folder/noise.csv"
expect_words 1 "noise.csv" "$BUILD/bin/simulate" "$model" "$folder/noise.csv"

# the outside world; root may write anywhere, so a file stands where a folder is needed
: >"$folder/file"
expect_words 4 "file" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/file/results"
[ -e /dev/full ] && expect_words 4 "space" sh -c "$BUILD/bin/simulate $model --step >/dev/full"

# what an undisturbed run writes (tests/kill.sh kills it)
"$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/whole" || wrong=$((wrong + 1))

# a disk that fills up at the first file of one product after the other: the message says so and no part is left; with room
# again the next run writes what is missing
cp -R "$folder/whole" "$folder/full"
while read -r product key file others; do
  [ -e /dev/full ] || break
  rm "$folder/full/$file"
  ln -s /dev/full "$folder/full/$file.part"
  expect_words 4 "space" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/full"
  [ -e "$folder/full/$file" ] && complain "full disk: $file is there"
  [ -L "$folder/full/$file.part" ] && complain "full disk: $file.part stays"
  expect_words 0 "" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/full"
  cmp -s "$folder/whole/$file" "$folder/full/$file" || complain "after $product: $file differs"
done <"$folder/whole/.done"

exit "$((wrong != 0))"
