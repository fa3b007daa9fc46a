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
expect 2 "unknown\|unrecognized\|option" ./sweep --nonsense
expect 2 "" ./sweep
expect 2 "" ./simulate
expect 0 "" ./sweep --help
expect 0 "" ./simulate --version

# the world
expect 4 "unit database" env UDUNITS2_XML_PATH=nothere ./simulate "$model" --step

# configuration
expect 1 "nothere.cfg" ./sweep nothere.cfg
expect 1 "nothere.cfg" ./simulate nothere.cfg --step
: >"$folder/empty.cfg"
expect 1 "empty.cfg" ./sweep "$folder/empty.cfg"
edit 's/spring_rate/sprung_rate/'
expect 1 "spring_rate" ./simulate "$folder/bad.cfg" --step
edit 's/400 kN\/m/400 kN/'
expect 1 "bad.cfg:[0-9]*.*spring_rate" ./simulate "$folder/bad.cfg" --step
edit 's/0.002 dm^3/-0.002 dm^3/'
expect 1 "dead_volume" ./simulate "$folder/bad.cfg" --step
edit 's/"400 kPa"/"-10 kPa"/'
expect 1 "pressure" ./simulate "$folder/bad.cfg" --step
edit 's/"400 kPa"/"nan kPa"/'
expect 1 "pressure" ./simulate "$folder/bad.cfg" --step
sed 's/stroke = "20 mm"/stroke = "0 mm"/' "$model" >"study/actuators/bad-$$.cfg"
sed "s/r1-400.cfg/bad-$$.cfg/" study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "stroke" ./sweep "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/actuators/bad-$$.cfg"
edit 's/isothermal/isothermic/'
expect 1 "isothermal" ./simulate "$folder/bad.cfg" --step
sed 's/subject   = "r1-400"/subject = "r2"/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "r2" ./sweep "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/points = 28/points = 0/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "points" ./sweep "study/bad-$$.cfg" --no-figures --results "$folder/none"
sed 's/confirmed_below/confirmed_bellow/' study/hypotheses.cfg >"study/bad-$$.cfg"
expect 1 "confirmed_below" ./sweep "study/bad-$$.cfg" --no-figures --results "$folder/none"
rm -f "study/bad-$$.cfg"

printf 'effects = { heat_transfer = { film_conductance = "5 W/K"; }; };\n' | cat "$model" - >"$folder/bad.cfg"
expect 1 "film_conductance" ./simulate "$folder/bad.cfg" --step
for inputs in '"u", "x"' '"x", "p"'; do
  printf 'inputs = [%s];\n' "$inputs" | cat "$model" - >"$folder/driven.cfg"
  printf 't [s],u [1],p [kPa],x [mm]\n0,0,150,-0.06\n0.1,0,150,-0.04\n0.2,0,150,0.02\n' >"$folder/driven.csv"
  expect 0 "" ./simulate "$folder/driven.cfg" "$folder/driven.csv"
done

# logs
expect 1 "missing.csv" ./simulate "$model" "$folder/missing.csv"
: >"$folder/empty.csv"
expect 1 "empty" ./simulate "$model" "$folder/empty.csv"
printf 't [s],u [1],p [kg]\n0,0,0\n1,1,2\n' >"$folder/unit.csv"
expect 1 "unit.csv:1" ./simulate "$model" "$folder/unit.csv"
printf 't [s],u [1],p [kPa]\n0,0,0\nnan,1,2\n' >"$folder/nan.csv"
expect 1 "nan.csv:3" ./simulate "$model" "$folder/nan.csv"
printf 't [s],u [1],p [kPa]\n0,0,0\n1,1\n' >"$folder/ragged.csv"
expect 1 "ragged.csv:3" ./simulate "$model" "$folder/ragged.csv"
head -c 4096 /dev/urandom >"$folder/noise.csv"
expect 1 "noise.csv" ./simulate "$model" "$folder/noise.csv"

# the outside world; root may write anywhere, so a file stands where a folder is needed
: >"$folder/file"
expect 4 "file" ./sweep hypotheses.cfg --quiet --no-figures --results "$folder/file/results"
expect 4 "file" ./simulate "$model" --step --out "$folder/file/step.csv"
[ -e /dev/full ] && expect 4 "space" ./simulate "$model" --step --out /dev/full
[ -e /dev/full ] && expect 4 "space" sh -c "./simulate $model --step >/dev/full"

# a run that is killed leaves whole files only, and the next one completes it to the same bytes
./sweep hypotheses.cfg --quiet --no-figures --results "$folder/whole" || wrong=$((wrong + 1))
round=0
while [ $round -lt 8 ]; do
  ./sweep hypotheses.cfg --quiet --no-figures --force --results "$folder/killed" &
  victim=$!
  sleep "0.$((round * 37 % 60 + 10))"
  kill -9 $victim 2>/dev/null
  wait $victim 2>/dev/null
  for file in "$folder/killed"/*.csv; do
    [ -e "$file" ] || continue
    cmp -s "$file" "$folder/whole/$(basename "$file")" || { echo "half-written: $file"; wrong=$((wrong + 1)); }
  done
  round=$((round + 1))
done
./sweep hypotheses.cfg --quiet --no-figures --results "$folder/killed" || wrong=$((wrong + 1))
for file in "$folder/whole"/*; do
  cmp -s "$file" "$folder/killed/$(basename "$file")" || { echo "differs: $file"; wrong=$((wrong + 1)); }
done
ls "$folder/killed"/*.part >/dev/null 2>&1 && { echo "a .part file stays"; wrong=$((wrong + 1)); }

# a disk that fills up at the first file of one product after the other: the message says so and no part is left; with room
# again the next run writes what is missing
cp -R "$folder/whole" "$folder/full"
while read -r product key file others; do
  [ -e /dev/full ] || break
  rm "$folder/full/$file"
  ln -s /dev/full "$folder/full/$file.part"
  expect 4 "space" ./sweep hypotheses.cfg --quiet --no-figures --results "$folder/full"
  [ -e "$folder/full/$file" ] && { echo "full disk: $file is there"; wrong=$((wrong + 1)); }
  [ -L "$folder/full/$file.part" ] && { echo "full disk: $file.part stays"; wrong=$((wrong + 1)); }
  expect 0 "" ./sweep hypotheses.cfg --quiet --no-figures --results "$folder/full"
  cmp -s "$folder/whole/$file" "$folder/full/$file" || { echo "after $product: $file differs"; wrong=$((wrong + 1)); }
done <"$folder/whole/.done"

exit "$((wrong != 0))"
