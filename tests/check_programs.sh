#!/bin/sh
# The programs on bad input and in a bad world: exit status, message, nothing lost, nothing half-written.
set -u
: "${BUILD:=build}"
folder="$BUILD/programs"
rm -rf "$folder"
mkdir -p "$folder"
model=study/actuators/r1-400.cfg
wrong=0

# expect STATUS TEXT COMMAND...: exit status, and a message on stderr that contains TEXT
expect() {
  status=$1
  text=$2
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  if [ "$got" -ne "$status" ] || { [ -n "$text" ] && ! grep -qi -- "$text" "$folder/err"; }; then
    echo "expected status $status and \"$text\", got $got from: $*"
    cat "$folder/err"
    wrong=$((wrong + 1))
  fi
}

# model TEXT: the R1-400 with an edited line, as $folder/bad.cfg
edit() {
  sed "$1" "$model" >"$folder/bad.cfg"
}

printf 't [s],u [1],p [kPa],x [mm]\n0,0,0,0\n1,1,0,0\n2,1,100,1\n' >"$folder/good.csv"

# command line
expect 2 "unknown\|unrecognized\|option" "$BUILD/bin/sweep" --nonsense
expect 2 "" "$BUILD/bin/sweep"
expect 2 "" "$BUILD/bin/simulate"
expect 0 "" "$BUILD/bin/sweep" --help
expect 0 "" "$BUILD/bin/simulate" --version

# the world
expect 4 "unit database" env UDUNITS2_XML_PATH=nothere "$BUILD/bin/simulate" "$model" --step

# configuration
expect 1 "nothere.cfg" "$BUILD/bin/sweep" nothere.cfg
expect 1 "nothere.cfg" "$BUILD/bin/simulate" nothere.cfg --step
: >"$folder/empty.cfg"
expect 1 "empty.cfg" "$BUILD/bin/sweep" "$folder/empty.cfg"
edit 's/spring_rate/sprung_rate/'
expect 1 "spring_rate" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
edit 's/400 kN\/m/400 kN/'
expect 1 "bad.cfg:[0-9]*.*spring_rate" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
edit 's/0.002 dm^3/-0.002 dm^3/'
expect 1 "dead_volume" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
edit 's/"400 kPa"/"-10 kPa"/'
expect 1 "pressure" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
edit 's/"400 kPa"/"nan kPa"/'
expect 1 "pressure" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
sed 's/stroke = "20 mm"/stroke = "0 mm"/' "$model" >"study/actuators/bad-$$.cfg"
sed "s/r1-400.cfg/bad-$$.cfg/" study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "stroke" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/actuators/bad-$$.cfg"
edit 's/isothermal/isothermic/'
expect 1 "isothermal" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
sed 's/subject   = "r1-400"/subject = "r2"/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "r2" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/points = 28/points = 0/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "points" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/confirmed_below/confirmed_bellow/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "confirmed_below" "$BUILD/bin/sweep" "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/bad-$$.cfg"

printf 'effects = { heat_transfer = { film_conductance = "5 W/K"; }; };\n' | cat "$model" - >"$folder/bad.cfg"
expect 1 "film_conductance" "$BUILD/bin/simulate" "$folder/bad.cfg" --step
for inputs in '"u", "x"' '"x", "p"'; do
  printf 'inputs = [%s];\n' "$inputs" | cat "$model" - >"$folder/driven.cfg"
  printf 't [s],u [1],p [kPa],x [mm]\n0,0,150,-0.06\n0.1,0,150,-0.04\n0.2,0,150,0.02\n' >"$folder/driven.csv"
  expect 0 "" "$BUILD/bin/simulate" "$folder/driven.cfg" "$folder/driven.csv"
done

# logs
expect 1 "missing.csv" "$BUILD/bin/simulate" "$model" "$folder/missing.csv"
: >"$folder/empty.csv"
expect 1 "empty" "$BUILD/bin/simulate" "$model" "$folder/empty.csv"
printf 't [s],u [1],p [kg]\n0,0,0\n1,1,2\n' >"$folder/unit.csv"
expect 1 "unit.csv:1" "$BUILD/bin/simulate" "$model" "$folder/unit.csv"
printf 't [s],u [1],p [kPa]\n0,0,0\nnan,1,2\n' >"$folder/nan.csv"
expect 1 "nan.csv:3" "$BUILD/bin/simulate" "$model" "$folder/nan.csv"
printf 't [s],u [1],p [kPa]\n0,0,0\n1,1\n' >"$folder/ragged.csv"
expect 1 "ragged.csv:3" "$BUILD/bin/simulate" "$model" "$folder/ragged.csv"
head -c 4096 /dev/urandom >"$folder/noise.csv"
expect 1 "noise.csv" "$BUILD/bin/simulate" "$model" "$folder/noise.csv"

# the outside world; root may write anywhere, so a file stands where a folder is needed
: >"$folder/file"
expect 4 "file" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/file/results"
expect 4 "file" "$BUILD/bin/simulate" "$model" --step --out "$folder/file/step.csv"
[ -e /dev/full ] && expect 4 "space" "$BUILD/bin/simulate" "$model" --step --out /dev/full
[ -e /dev/full ] && expect 4 "space" sh -c "$BUILD/bin/simulate $model --step >/dev/full"

# what an undisturbed run writes (tests/kill.sh kills it)
"$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/whole" || wrong=$((wrong + 1))

# a disk that fills up at the first file of one product after the other: the message says so and no part is left; with room
# again the next run writes what is missing
cp -R "$folder/whole" "$folder/full"
while read -r product key file others; do
  [ -e /dev/full ] || break
  rm "$folder/full/$file"
  ln -s /dev/full "$folder/full/$file.part"
  expect 4 "space" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/full"
  [ -e "$folder/full/$file" ] && { echo "full disk: $file is there"; wrong=$((wrong + 1)); }
  [ -L "$folder/full/$file.part" ] && { echo "full disk: $file.part stays"; wrong=$((wrong + 1)); }
  expect 0 "" "$BUILD/bin/sweep" hypotheses.cfg --quiet --no-figures --results "$folder/full"
  cmp -s "$folder/whole/$file" "$folder/full/$file" || { echo "after $product: $file differs"; wrong=$((wrong + 1)); }
done <"$folder/whole/.done"

exit "$((wrong != 0))"
