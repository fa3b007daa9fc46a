#!/bin/sh
# sweep, closeloop and closeloop --batch, ended by kill -9 at moments drawn at random. Two inputs, a and b, take turns in one folder. After every
# kill each file is whole: it is that of an undisturbed run of a or of b, byte for byte. The run after it, of a or of b,
# leaves the folder of an undisturbed one: no file more, none less, the same bytes. Left out are times, the only thing that
# differs from run to run: the group `timing` of report.json and what a batch says each log cost.
#   KILLS=N  how many that hit (10)    SEED=S  of what is drawn (1)
set -u
: "${BUILD:=build}" "${KILLS:=10}" "${SEED:=1}"
folder="$BUILD/kill"
rm -rf "$folder"
mkdir -p "$folder/study/figures"
wrong=0

complain() {
  echo "kill $kill: $*"
  wrong=$((wrong + 1))
}

# ---- Inputs: small ones, so that a run takes half a second ----

# A study of one actuator and one law; three of its figures are the true ones, the others an axis.
inputs_of_sweep() {
  cp -R study/actuators "$folder/study"
  for script in study/figures/*.gp; do
    case $script in
    */fig04.gp | */fig11.gp | */fig15.gp | */varied.gp | */style.gp) cp "$script" "$folder/study/figures" ;;
    *) echo 'set terminal svg; plot x' >"$folder/study/figures/${script##*/}" ;;
    esac
  done
  for points in 3 4; do
    sed -e "s/points = [0-9]*/points = $points/" -e 's/, "actuators[^"]*"//' \
      -e 's/^gas .*/gas = ( "isothermal" );/' -e 's/^flow .*/flow = ( "paper" );/' study/hypotheses.cfg \
      >"$folder/study/$points.cfg"
  done
  mv "$folder/study/3.cfg" "$folder/study/a.cfg"
  mv "$folder/study/4.cfg" "$folder/study/b.cfg"
}

# A log that the rig file explains, and one of a chamber that leaks.
inputs_of_closeloop() {
  model=study/actuators/r1-400.cfg
  printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' | cat $model - >"$folder/rig.cfg"
  printf 'effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n' | cat $model - >"$folder/leaky.cfg"
  ./simulate $model --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/a.csv"
  ./simulate "$folder/leaky.cfg" --step | awk 'NR == 1 || NR % 5 == 0' >"$folder/b.csv"
}

# Two lists of the two logs, in which they change places.
inputs_of_batch() {
  printf 'name,rig,log\none,rig.cfg,a.csv\ntwo,rig.cfg,b.csv\n' >"$folder/list-a.csv"
  printf 'name,rig,log\none,rig.cfg,b.csv\ntwo,rig.cfg,a.csv\n' >"$folder/list-b.csv"
}

# words PROGRAM INPUT FOLDER: what to run; one more program is one more line here, and its name below
words() {
  case $1 in
  sweep) echo ./sweep "$folder/study/$2.cfg" --quiet --results "$3" ;;
  closeloop) echo ./closeloop "$folder/rig.cfg" "$folder/$2.csv" --quiet --out "$3" ;;
  batch) echo ./closeloop --batch "$folder/list-$2.csv" --quiet --out "$3" ;;
  esac
}
: "${PROGRAMS:=sweep closeloop batch}"

# ---- What is there afterwards ----

# A file without what may differ: times, and the order of lines in the record of what is done.
settled() {
  case $1 in
  *.json) sed '/^[[:space:]]*"timing":/,/^[[:space:]]*}/d' "$1" ;;
  */./*/.done) awk 'NR == 1 { $4 = $5 = $6 = "" } { print }' "$1" ;; # a line of a batch, and what it cost
  */.done) sort "$1" ;;
  *.cost.csv) cut -d, -f1 "$1" | sort ;;
  *) cat "$1" ;;
  esac
}
same() {
  [ -e "$1" ] && [ -e "$2" ] || return 1
  settled "$1" >"$folder/one"
  settled "$2" >"$folder/other"
  cmp -s "$folder/one" "$folder/other"
}

names() { (cd "$1" && find . -type f | sort); }

# each_whole PROGRAM: every file is that of one of the undisturbed runs; what is under way is beside its place, in a .part
each_whole() {
  for name in $(names "$folder/$1"); do
    case $name in *.part | */.done) continue ;; esac
    same "$folder/$1/$name" "$folder/$1-a/$name" || same "$folder/$1/$name" "$folder/$1-b/$name" ||
      complain "$1: half-written: $name"
  done
}

# as_undisturbed PROGRAM INPUT
as_undisturbed() {
  [ "$(names "$folder/$1")" = "$(names "$folder/$1-$2")" ] ||
    complain "$1: after the next run there are: $(names "$folder/$1" | tr '\n' ' ')"
  for name in $(names "$folder/$1-$2"); do
    same "$folder/$1/$name" "$folder/$1-$2/$name" || complain "$1: the next run differs in $name"
  done
}

children() { ps -A -o ppid=,pid= | awk -v parent="$1" '$1 == parent { print $2 }'; }

# What the killed one had started, gnuplot, ends by itself; one that is there after ten minutes hangs.
no_orphans() {
  for orphan in $orphans; do
    tries=0
    while kill -0 "$orphan" 2>/dev/null && [ $tries -lt 6000 ]; do
      sleep 0.1
      tries=$((tries + 1))
    done
    kill -9 "$orphan" 2>/dev/null && complain "a child stayed"
  done
}

# ---- Kills ----

# draw N: a number from 0 to N - 1, the next of the series
draw() {
  SEED=$(awk -v x="$SEED" 'BEGIN { printf "%.0f", (x * 16807 + 11) % 2147483647 }')
  drawn=$((SEED / 8 % $1))
}

clock() { date +%s.%N | sed 's/N$/0/'; }

# undisturbed PROGRAM INPUT: its folder, and the time it takes [ms]
undisturbed() {
  from=$(clock)
  $(words "$1" "$2" "$folder/$1-$2") >"$folder/out" 2>&1 || { cat "$folder/out"; exit 2; }
  to=$(clock)
  awk -v a="$from" -v b="$to" 'BEGIN { printf "%d\n", (b - a) * 1000 + 20 }' >"$folder/$1-$2.ms"
}

# sooner FILE: a shorter time
sooner() { awk '{ ms = ($1 > 100) ? 0.8 * $1 : $1; printf "%d\n", ms }' "$1" >"$1.part" && mv "$1.part" "$1"; }

pick() {
  draw 2
  input=a
  [ "$drawn" -eq 1 ] && input=b
}

# One kill, in a folder that is new, or holds what an earlier run, whole or killed, has left.
one_kill() {
  program=$1
  draw 4
  [ "$drawn" -eq 0 ] && rm -rf "${folder:?}/$program"
  mkdir -p "$folder/$program"
  pick
  draw "$(cat "$folder/$program-$input.ms")"
  $(words "$program" "$input" "$folder/$program") >"$folder/out" 2>&1 &
  victim=$!
  sleep "$(awk -v ms="$drawn" 'BEGIN { printf "%.3f", ms / 1000 }')"
  kill -STOP $victim 2>/dev/null # so that it starts no other while it is asked
  orphans=$(children $victim)
  kill -9 $victim 2>/dev/null
  wait $victim 2>/dev/null
  if [ $? -eq 137 ]; then
    killed=$((killed + 1))
  else
    sooner "$folder/$program-$input.ms" # the machine has become quicker than it was when this was timed
  fi
  each_whole "$program"
  draw 3
  [ "$drawn" -eq 0 ] && return # the next kill meets what this one left
  pick
  $(words "$program" "$input" "$folder/$program") >"$folder/out" 2>&1 || complain "$program: $(cat "$folder/out")"
  as_undisturbed "$program" "$input"
  no_orphans
}

inputs_of_sweep
inputs_of_closeloop
inputs_of_batch
for program in $PROGRAMS; do
  undisturbed "$program" a
  undisturbed "$program" b
done
kill=0
killed=0
while [ $killed -lt "$KILLS" ] && [ $kill -lt $((5 * KILLS)) ]; do # one that comes too late does not count
  for program in $PROGRAMS; do
    kill=$((kill + 1))
    one_kill "$program"
  done
done
echo "$killed of $kill runs killed before their end, $wrong faults"
[ "$wrong" -eq 0 ] && [ "$killed" -ge "$KILLS" ]
