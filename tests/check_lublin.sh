#!/bin/sh
# Faults made on purpose on the valves of a plant, told by what has changed since a healthy window of the same valve:
# where the supply of the positioner failed, that and when it came back; where the fault was outside the actuator,
# or the window healthy, nothing. The data is not in this repository: MEASURED.
set -u
: "${MEASURED:=../shared/data}" "${BUILD:=build}"
plant="$MEASURED/damadics-lublin-events/plant.csv"
if [ ! -f "$plant" ]; then
  echo "absent: $plant: nothing was checked"
  exit 0
fi
folder="$BUILD/lublin"
rm -rf "$folder"
mkdir -p "$folder"
wrong=0

# window VALVE FIRST END: rows of the plant, the first one being 0
window() {
  awk -F, -v valve="$1" -v first="$2" -v end="$3" '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; print "t [s],sp [%],x [%]" }
    NR > 1 && NR - 2 >= first && NR - 2 < end { print NR - 2 - first "," $at[valve "_CV"] "," $at[valve "_X"] }' "$plant"
}

# told REPORT: condition, what changed, and when that ended
told() {
  awk -F'"' '/"found":/ { exit }  /"condition":/ { printf "%s", $4 }
    /"what":/ { printf " %s", $4 }  /"end":/ { on = 1 }
    on && /"t":/ { sub(/.*:[ \t]*/, ""); sub(/,.*/, ""); printf " %s", $0; on = 0 }  END { print "" }' "$1"
}

# event NUMBER VALVE FIRST END [SECONDS [BUDGET]]: rows of its window; when the supply is back, the first second being 0
event() {
  window "$2" 0 300 >"$folder/then.csv"
  window "$2" "$3" "$4" >"$folder/now.csv"
  ./closeloop study/measured/damadics-lublin.cfg "$folder/now.csv" --baseline "$folder/then.csv" --no-figures --quiet \
    --out "$folder/$1" --budget "${6:-60}" >"$folder/$1.txt" 2>&1
  said=$(told "$folder/$1/report.json")
  if ! echo "$said" | awk -v back="${5:-}" '
      back == "" { exit !($0 == "unchanged") }
      { exit !($1 == "changed" && $2 == "supply_pressure" && $3 >= back - 5 && $3 <= back + 5 && NF == 3) }'; then
    echo "event $1: expected ${5:+changed supply_pressure }${5:-unchanged}, found ${said:-$(cat "$folder/$1.txt")}"
    wrong=$((wrong + 1))
  fi
}

event 1 3 300 599
event 2 1 599 899
event 3 1 1049 1379 286 # the set point falls back to where the stem has come
event 4 1 1379 1500
event 5 1 1500 1601
event 6 3 1601 1652 41 # the stem leaves the lower stop
event 7 3 1652 2243 77 30 # too short to try other changes: the supply that was followed is told all the same
# windows of another valve's faults, in which this one is healthy; its set point swings and no model explains it
event 8 3 599 899
event 9 3 1049 1379
exit "$((wrong != 0))"
