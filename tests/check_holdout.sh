#!/bin/sh
# Errors on logs held out are those of what `simulate` predicts there: nothing is fitted on them but where they start. With
# an empty fit list that holds of the declared model, too, and of the log that is fitted. Measured logs, where they are:
# MEASURED.
set -u
: "${BUILD:=build}" "${MEASURED:=../shared/data}"
folder="$BUILD/holdout"
rm -rf "$folder"
mkdir -p "$folder"
. tests/expect.sh

# errors REPORT: "before.pressure 12.3", "holdout.before.pressure 4.5", ... in SI
errors() {
  awk -F'[:,]' '/"error":/ { on = 1 }  !on { next }  /"(logs|path)":/ { exit }
    { gsub(/[\t "]/, "", $1) }
    $1 == "holdout" { of = "holdout." }  $1 == "before" || $1 == "after" { stage = $1 }
    $1 == "pressure" || $1 == "position" { channel = $1 }  $1 == "rmse" { print of stage "." channel, $2 }' "$1"
}

# rmse LOG PREDICTED COLUMN: of the column of that name; kPa and mm become Pa and m
rmse() {
  awk -F, -v name="$3" -v OFMT=%.9g '
    /^#/ { next }
    FNR == 1 { for (i = 1; i <= NF; i++) if ($i ~ "^" name " ") { at[FILENAME] = i; unit = $i }; next }
    FILENAME == ARGV[1] { measured[++n] = $at[FILENAME]; next }
    { d = $at[FILENAME] - measured[++m]; if (measured[m] != "" && measured[m] != "nan") { sum += d * d; count++ } }
    END { if (n != m || !count) print "rows", n, m; else print sqrt(sum / count) * (unit ~ /kPa/ ? 1e3 : unit ~ /mm/ ? 1e-3 : 1) }' \
    "$1" "$2"
}

# predicts CASE STAGE MODEL LOG: `simulate MODEL LOG` leaves the errors that the report of CASE has under STAGE
predicts() {
  ./simulate "$3" "$4" --out "$folder/$1.$2.csv" || complain "$1: simulate failed"
  for channel in p:pressure x:position; do
    said=$(errors "$folder/$1/report.json" | sed -n "s/^$2.${channel#*:} //p")
    [ -n "$said" ] || continue
    got=$(rmse "$4" "$folder/$1.$2.csv" "${channel%:*}")
    compared=$((compared + 1))
    awk -v a="$said" -v b="$got" 'BEGIN { exit !(a > 0 && b > a * (1 - 1e-6) && b < a * (1 + 1e-6)) }' ||
      complain "$1: $2.${channel#*:}: closeloop $said, simulate $got"
  done
}

# held CASE RIG LOG HOLDOUT: closeloop on them, and whether its completed model predicts its errors
held() {
  ./closeloop "$2" "$3" --holdout "$4" --out "$folder/$1" --no-figures --quiet >"$folder/$1.txt" 2>&1 ||
    complain "$1: closeloop failed: $(cat "$folder/$1.txt")"
  compared=0
  predicts "$1" holdout.after "$folder/$1/model.cfg" "$4"
  [ "$compared" -gt 0 ] || complain "$1: no error on the log held out"
}

# as_declared CASE RIG LOG HOLDOUT: the same with nothing to fit, and the declared model
as_declared() {
  sed '/^fit /d' "$2" >"$folder/$1.cfg"
  held "$1" "$folder/$1.cfg" "$3" "$4"
  predicts "$1" holdout.before "$folder/$1.cfg" "$4"
  predicts "$1" before "$folder/$1.cfg" "$3"
}

leak=study/guides/leak
held guide $leak/rig.cfg $leak/fit.csv $leak/holdout.csv
as_declared guide-declared $leak/rig.cfg $leak/fit.csv $leak/holdout.csv

# every STEP ROWS SHOWN JUMP: the rig under a command that jumps up and changes between all rows, to and fro by JUMP beside,
# of which a log shows one in so many, with noise; with JUMP 0 it never jumps
every() {
  awk -v step="$1" -v rows="$2" -v jump="$4" 'BEGIN { print "t [s],u [1]"
    for (i = 0; i < rows; i++)
      printf "%.6f,%.3f\n", i * step, i * step < 0.4 ? 0 : 0.8 * (jump ? cos(i * step) : sin(i * step - 0.4)) + 0.1 * sin(10 * (i * step - (jump ? 0 : 0.4))) + jump * (int(i / 2) % 2 * 2 - 1) }' >"$folder/u.csv"
  ./simulate study/actuators/r1-400.cfg "$folder/u.csv" |
    awk -F, -v every="$3" 'function noise(size) { seed = seed * 16807 % 2147483647; return size * (seed / 2147483647 - 0.5) }
      BEGIN { seed = 1 }
      NR == 1 { print; next }
      i++ % every == 0 { printf "%s,%s,%.4f,%.5f\n", $1, $2, $3 + noise(0.6), $4 + noise(0.1) }'
}
every 0.01 1200 2 0.05 >"$folder/often.csv"
every 0.01 2000 2 0.05 >"$folder/often_held.csv"
printf 'fit = ("orifice_area");\nnoise = { pressure = "5 kPa"; position = "0.5 mm"; };\n' |
  cat study/actuators/r1-400.cfg - >"$folder/often.cfg"
held often "$folder/often.cfg" "$folder/often.csv" "$folder/often_held.csv"
grep -q "by what share of a row" "$folder/often/report.html" || complain "often: an instant for each of many changes"
as_declared often-declared "$folder/often.cfg" "$folder/often.csv" "$folder/often_held.csv"

# the same command without jumps runs along lines
every 0.01 1200 2 0 >"$folder/ramps.csv"
every 0.01 2000 2 0 >"$folder/ramps_held.csv"
held ramps "$folder/often.cfg" "$folder/ramps.csv" "$folder/ramps_held.csv"
as_declared ramps-declared "$folder/often.cfg" "$folder/ramps.csv" "$folder/ramps_held.csv"

# rows of one log, each second one held out: the model predicts these from a log that has no others
printf 'log = { every = 2; holdout = { first = 1; }; };\n' | cat "$folder/often.cfg" - >"$folder/rows.cfg"
./closeloop "$folder/rows.cfg" "$folder/often.csv" --holdout "$folder/often.csv" --out "$folder/rows" --no-figures --quiet \
  >"$folder/rows.txt" 2>&1 || complain "rows: closeloop failed: $(cat "$folder/rows.txt")"
awk 'NR % 2' "$folder/often.csv" >"$folder/rows_held.csv"
sed '/^log = {/,/^};/d' "$folder/rows/model.cfg" >"$folder/rows_held.cfg"
compared=0
predicts rows holdout.after "$folder/rows_held.cfg" "$folder/rows_held.csv"
[ "$compared" -eq 2 ] || complain "rows: no error on the rows held out"

# pressure as the input
printf 'inputs = ("p");\n' | cat "$folder/often.cfg" - | sed 's/orifice_area/spring_rate/' >"$folder/stem.cfg"
held stem "$folder/stem.cfg" "$folder/often.csv" "$folder/often_held.csv"
as_declared stem-declared "$folder/stem.cfg" "$folder/often.csv" "$folder/often_held.csv"

# a log held out of more rows than a fit takes
every 0.004 24000 1 0 >"$folder/long.csv"
held long "$folder/often.cfg" "$folder/often.csv" "$folder/long.csv"

# measured: logs of the virtual rig, and of a plant whose command, a set position, changes often
if [ -d "$MEASURED/rig" ]; then
  for name in null-a leak-a bias-a; do
    held "$name" "$MEASURED/rig/$name/rig.cfg" "$MEASURED/rig/$name/fit.csv" "$MEASURED/rig/$name/holdout.csv"
  done
fi
plant="$MEASURED/damadics-lublin-events/plant.csv"
if [ -f "$plant" ]; then
  # rows FIRST LAST: set point as the pressure that holds the stem there, and its position
  rows() {
    awk -F, -v first="$1" -v last="$2" 'BEGIN { print "t [s],u [kPa],x [mm]" }
      NR - 2 >= first && NR - 2 < last { printf "%d,%.4g,%.5g\n", NR - 2 - first, 20 + 0.8 * $5, 0.381 * $6 }' "$plant"
  }
  rows 0 200 >"$folder/plant.csv"
  rows 299 499 >"$folder/plant_held.csv"
  cat >"$folder/plant.cfg" <<'RIG'
actuator = {
  name = "plant";  action = "reverse";
  area = "1290 cm^2";  dead_volume = "5.5 dm^3";  stroke = "38.1 mm";
  spring_rate = "270.866 kN/m";  spring_preload = "9.525 mm";
  moving_mass = "2 kg";  dry_friction = "516 N";  viscous_friction = "1500 N.s/m";
};
transducer = { fill_area = "10 mm^2";  vent_area = "10 mm^2";  proportional_band = "4 kPa"; };
supply = { pressure = "140 kPa";  temperature = "293 K"; };
laws   = { gas = "isothermal";  flow = "choked";  friction = "coulomb"; };
fit    = ( "spring_preload", "dry_friction" );
RIG
  held plant "$folder/plant.cfg" "$folder/plant.csv" "$folder/plant_held.csv"
  as_declared plant-declared "$folder/plant.cfg" "$folder/plant.csv" "$folder/plant_held.csv"
fi

exit "$((wrong != 0))"
