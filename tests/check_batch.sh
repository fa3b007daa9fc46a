#!/bin/sh
# closeloop --batch: the same bytes for any number of threads and ranks, after kill -9 (tests/kill.sh, too) and Ctrl-C; a
# line is done again if its files changed and only then; a bad log is a line. MPI only where mpirun is installed.
set -u
: "${BUILD:=build}" "${MAKE:=make}"
rm -rf "$BUILD/batch"
mkdir -p "$BUILD/batch/list/rigs"
folder=$(cd "$BUILD/batch" && pwd)
. tests/expect.sh

list=list # the name of the one to run

# batch NAME OPTIONS...: run the list into a folder
batch() {
  into="$folder/$1"
  shift
  ./closeloop --batch "$folder/list/$list.csv" --out "$into" --quiet "$@"
}

# behind NAME OPTIONS...: the same in the background, as the process $victim
behind() {
  into="$folder/$1"
  shift
  ./closeloop --batch "$folder/list/$list.csv" --out "$into" --quiet "$@" >"$folder/out" 2>"$folder/err" &
  victim=$!
}

# same NAME [AS]: whether its tables and page are those of the undisturbed run
same() {
  for table in batch.csv index.html trends.csv; do
    [ -e "$folder/${2:-one}/$table" ] || [ -e "$folder/$1/$table" ] || continue
    cmp "$folder/${2:-one}/$table" "$folder/$1/$table" || complain "$1: $table is another one than with one thread"
  done
}

# cell NAME LINE COLUMN: of batch.csv
cell() {
  awk -F, -v name="$2" -v column="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == column) c = i }
    $1 == name { print $c }' "$folder/$1/batch.csv"
}

# Rigs that answer as declared, with springs of their own, and one that leaks; every tenth row of a step up and down.
for k in 1 2 3 4 5; do
  sed "s/400 kN/4${k}0 kN/" study/actuators/r1-400.cfg >"$folder/rig.cfg"
  printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
    cat study/actuators/r1-400.cfg - >"$folder/list/rigs/r$k.cfg"
  [ "$k" -eq 4 ] && printf 'effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n' >>"$folder/rig.cfg"
  ./simulate "$folder/rig.cfg" --step | awk 'NR == 1 || NR % 10 == 0' >"$folder/list/r$k.csv"
done
cp "$folder/list/r5.csv" "$folder/list/held.csv"
cat >"$folder/list/list.csv" <<'LIST'
# the fleet
name;rig;log;holdout
one;rigs/r1.cfg;r1.csv;r1.csv
two;rigs/r2.cfg;"r2.csv;r2.csv";
torn;rigs/r3.cfg;torn.csv;
;rigs/r3.cfg;r3.csv;
leaks;rigs/r4.cfg;r4.csv;
none;rigs/none.cfg;r1.csv;
five;rigs/r5.cfg;r5.csv;held.csv;
LIST
printf 't [s],u [1],p [kPa],x [mm]\n0,0,0,0\n1,1,zero,0\n' >"$folder/list/torn.csv"

expect 1 "one thread" batch one --threads 1
grep -q "7 lines: 1 effect, 4 none, 2 error" "$folder/out" || complain "summary: $(cat "$folder/out")"
grep -q "2 of 7 lines" "$folder/err" || complain "message: $(cat "$folder/err")"
grep -q "^torn,error,.*torn.csv:3" "$folder/one/batch.csv" || complain "torn.csv is not named with its line"
grep -q "^none,error,.*none.cfg: there is no such file" "$folder/one/batch.csv" || complain "none.cfg is not named"
[ "$(sed 's/,.*//' "$folder/one/batch.csv" | tr '\n' ' ')" = "name one two torn r3 leaks none five " ] ||
  complain "not in the order of the list"
[ "$(cell one leaks found)" = chamber_leak ] || complain "the leak was taken for: $(cell one leaks found)"
[ -n "$(cell one five pressure_holdout_after)" ] || complain "no error on the log held out"
[ -z "$(cell one r3 pressure_holdout_after)" ] || complain "an error where nothing was held out"
names_of() { sed -n 's/^<tr><th scope="row">\(<a href="\([^"]*\)">\)*\([^<]*\)<.*/\3:\2/p' "$1/index.html" | tr '\n' ' '; }
[ "$(names_of "$folder/one")" = "torn: none: leaks:leaks/report.json five:five/report.json one:one/report.json two:two/report.json r3:r3/report.json " ] ||
  complain "index.html is not sorted by severity, or its links are others: $(names_of "$folder/one")"
[ -s "$folder/one/r3/report.json" ] || complain "no report.json"
[ -e "$folder/one/r3/report.html" ] && complain "report.html without --reports"
[ "$(wc -l <"$folder/one/batch.cost.csv")" -eq 8 ] || complain "batch.cost.csv has not a line each"

# two runs in one folder are one too many
behind alone --threads 1
while [ ! -e "$folder/alone/one/.done" ] && kill -0 "$victim" 2>/dev/null; do sleep 0.01; done
kill -STOP "$victim" # so that it is still there, however late the second comes
expect 4 "second run" batch alone
grep -q "another run" "$folder/err" || complain "second run: $(cat "$folder/err")"
kill -9 "$victim"
wait "$victim" 2>/dev/null

# a line is what a single run says
expect 0 "single run" sh -c "cd '$folder/list' && '$PWD/closeloop' rigs/r4.cfg r4.csv --out ../single --threads 1"
grep -v '_s"' "$folder/single/report.json" >"$folder/single.json"
grep -v '_s"' "$folder/one/leaks/report.json" | cmp - "$folder/single.json" || complain "report.json is not that of a single run"
grep -q "^leaks,.*$(sed 's/.*: //' "$folder/single.json" | grep -o 'falls from [0-9.]* to [0-9.]*')" "$folder/one/batch.csv" ||
  complain "the message is not the sentence of a single run"

expect 1 "two threads" batch two --threads 2
same two
expect 1 "from another folder" sh -c "cd '$folder/list' && '$PWD/closeloop' --batch list.csv --out ../there --quiet"
same there

# a record that was cut short is no record; what is whole is not done again
cp -rp "$folder/two" "$folder/cut"
head -c 60 "$folder/two/one/.done" >"$folder/cut/one/.done"
rm "$folder/cut/two/report.json"
touch "$folder/before"
sleep 0.05
expect 1 "cut" batch cut --threads 2
same cut
[ "$(find "$folder/cut" -name .done -newer "$folder/before" | wc -l)" -eq 2 ] || complain "cut: not just two lines were done again"

# Ctrl-C: ends by the signal, what was done is kept, no table
behind stopped --threads 1
while [ ! -e "$folder/stopped/one/.done" ] && kill -0 "$victim" 2>/dev/null; do sleep 0.01; done
kill -TERM "$victim"
wait "$victim" 2>/dev/null
got=$?
[ "$got" -eq 143 ] || complain "SIGTERM: expected status 143, got $got"
[ -e "$folder/stopped/batch.csv" ] && complain "a table of a run that was stopped"
[ -e "$folder/stopped/index.html" ] && complain "a page of a run that was stopped"
find "$folder/stopped" -name '*.part' | grep . && complain "half a file after SIGTERM"
expect 1 "after SIGTERM" batch stopped --threads 1
same stopped

# a changed rig, log, held-out log, option: these lines again; back again: the same table
changed() {
  touch "$folder/before"
  sleep 0.05
  expect 1 "changed: $1" batch two --threads 2 $3
  found=$(find "$folder/two" -name .done -newer "$folder/before" | wc -l)
  [ "$found" -eq "$2" ] || complain "changed $1: $found lines were done again, expected $2"
}
changed nothing 0 ""
sed -i.old 's/0.02 mm/0.03 mm/' "$folder/list/rigs/r5.cfg"
changed rig 1 ""
cmp -s "$folder/one/batch.csv" "$folder/two/batch.csv" && complain "another rig and the same table"
mv "$folder/list/rigs/r5.cfg.old" "$folder/list/rigs/r5.cfg"
changed "rig back" 1 ""
same two
printf '30.6,-1,0,0\n' >>"$folder/list/r3.csv"
changed log 1 ""
sed -i.old '$d' "$folder/list/r3.csv"
printf '30.6,-1,0,0\n' >>"$folder/list/held.csv"
changed "held-out log" 2 "" # and the log above
sed -i.old '$d' "$folder/list/held.csv"
changed option 7 "--alpha 0.02"
changed "option back" 7 ""
same two

# a log for which the CPU time does not suffice is a line of a batch that failed; a single run gives the best answer so far
./simulate study/actuators/r1-400.cfg --step >"$folder/list/long.csv"
sed 's/480 N/470 N/' study/actuators/r1-400.cfg >"$folder/list/rigs/long.cfg"
printf 'name,rig,log\nlong,rigs/long.cfg,long.csv\none,rigs/r1.cfg,r1.csv\n' >"$folder/list/budget.csv"
expect 4 "budget" ./closeloop --batch "$folder/list/budget.csv" --out "$folder/budget" --quiet --budget 1
grep -q "^long,error,.*not done within 1 s of CPU" "$folder/budget/batch.csv" || complain "budget: $(cat "$folder/budget/batch.csv")"
grep -q "^one,none," "$folder/budget/batch.csv" || complain "budget: the line beside it is not done"
expect 0 "budget of a single run" ./closeloop "$folder/list/rigs/long.cfg" "$folder/list/long.csv" --out "$folder/spent" --budget 1
grep -q "ended by --budget" "$folder/out" || complain "budget of a single run: $(cat "$folder/out")"
grep -q '"complete":.*false' "$folder/spent/report.json" || complain "budget of a single run: the answer counts as complete"
grep -q "ended by --budget" "$folder/spent/report.html" || complain "budget of a single run: the page does not say it"
expect 0 "no need of the budget" ./closeloop "$folder/list/rigs/r1.cfg" "$folder/list/r1.csv" --out "$folder/unspent"
grep -q '"complete":.*true' "$folder/unspent/report.json" || complain "a search that came to its end counts as cut short"

# a bad list is refused before anything is done
printf 'name,rig,log\na,rigs/r1.cfg,r1.csv\na,rigs/r2.cfg,r2.csv\n' >"$folder/list/double.csv"
expect 1 "double name" ./closeloop --batch "$folder/list/double.csv" --out "$folder/double"
grep -q "double.csv:3: line 2 has the same name" "$folder/err" || complain "double name: $(cat "$folder/err")"
[ -e "$folder/double" ] && complain "a bad list has left a folder"
expect 2 "operand" ./closeloop --batch "$folder/list/list.csv" more.csv
expect 2 "holdout" ./closeloop --batch "$folder/list/list.csv" --holdout more.csv
expect 2 "reports" ./closeloop rig.cfg log.csv --reports

# every file
printf 'name,rig,log\nleaks,rigs/r4.cfg,r4.csv\n' >"$folder/list/reports.csv"
expect 0 "reports" ./closeloop --batch "$folder/list/reports.csv" --out "$folder/reports" --reports --quiet
for file in "$folder/single"/*; do
  name=$(basename "$file")
  [ "$name" = report.json ] || cmp "$file" "$folder/reports/leaks/$name" || complain "--reports: another $name than a single run's"
done

# a spring that stiffens by 10 N/mm in 30 days, and one that stays, in dated lines of any order; another date changes no line
for k in a b; do
  printf 'tolerance = { spring_rate = "10 %%"; others = 0; };\n' | cat "$folder/list/rigs/r1.cfg" - >"$folder/list/rigs/$k.cfg"
done
cat >"$folder/list/dated.csv" <<'LIST'
name,rig,log,date
a3,rigs/a.cfg,r3.csv,2026-03-02
a1,rigs/a.cfg,r1.csv,2026-01-01
a2,rigs/a.cfg,r2.csv,2026-01-31T00:00:00Z
b1,rigs/b.cfg,r1.csv,2026-01-01
b2,rigs/b.cfg,r1.csv,2026-05-01
lost,rigs/b.cfg,torn.csv,2026-06-01
undated,rigs/b.cfg,r5.csv,
american,rigs/b.cfg,r1.csv,3/14/2026
LIST
list=dated
expect 1 "dated" batch dated --threads 1
[ "$(cut -d, -f 1-6 "$folder/dated/trends.csv" | tr '\n' ' ')" = "rig,parameter,unit,n,first_date,last_date \
rigs/a.cfg,spring_rate,N/m,3,2026-01-01,2026-03-02 rigs/b.cfg,spring_rate,N/m,2,2026-01-01,2026-05-01 " ] ||
  complain "trends: $(cat "$folder/dated/trends.csv")"
grep -q "<p>spring_rate leaves its tolerance of 10 % in 30 days (2[0-9] to 3[0-9])</p>" "$folder/dated/index.html" ||
  complain "the page does not say when the tolerance is left"
[ "$(grep -c 'class="spark' "$folder/dated/index.html")" -eq 2 ] || complain "not a line of sparklines for each rig"
grep -q '^american,error,.*line 9 of the list, column date: expected a date like 2026-05-04' "$folder/dated/batch.csv" ||
  complain "a date of another form is not named with its line"
[ -e "$folder/one/trends.csv" ] && complain "trends of a list without dates"
behind dated-killed --threads 1
while [ ! -e "$folder/dated-killed/a1/.done" ] && kill -0 "$victim" 2>/dev/null; do sleep 0.01; done
kill -9 "$victim" 2>/dev/null
wait "$victim" 2>/dev/null
[ -e "$folder/dated-killed/trends.csv" ] && complain "trends of a run that was stopped"
expect 1 "dated, resumed" batch dated-killed --threads 2
same dated-killed dated
touch "$folder/before"
sleep 0.05
sed -i.old 's/2026-03-02/2026-03-12/' "$folder/list/dated.csv"
expect 1 "another date" batch dated-killed
grep -q "2026-03-12" "$folder/dated-killed/trends.csv" || complain "another date, and the same trends"
[ "$(find "$folder/dated-killed" -name .done -newer "$folder/before" | wc -l)" -eq 0 ] || complain "another date: lines were done again"
sed -i.american 's,3/14/2026,2026-03-14,' "$folder/list/dated.csv"
expect 1 "date mended" batch dated-killed
[ "$(cell dated-killed american verdict)" = none ] || complain "a line whose date was mended is not done again"
mv "$folder/list/dated.csv.old" "$folder/list/dated.csv"
list=list

[ "$(names_of "$folder/reports")" = "leaks:leaks/report.html " ] || complain "--reports: index.html links $(names_of "$folder/reports")"
if command -v xmllint >/dev/null 2>&1; then
  xmllint --noout "$folder/one/index.html" "$folder/dated/index.html" "$folder/reports/index.html" "$folder/reports/leaks/report.html" || complain "malformed"
fi

# ---- MPI ----

if ! command -v mpirun >/dev/null 2>&1 || ! command -v mpicc >/dev/null 2>&1; then
  echo "absent: mpirun, so that closeloop --batch was not tried over MPI"
  exit "$((wrong != 0))"
fi
cp closeloop "$folder/closeloop-plain"
expect 0 "build for MPI" $MAKE --no-print-directory BUILD="$BUILD" MPI=1 closeloop
mv closeloop "$folder/closeloop-mpi"
mv "$folder/closeloop-plain" closeloop
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# ranks K NAME OPTIONS...
ranks() {
  k=$1
  into="$folder/$2"
  shift 2
  mpirun --oversubscribe -n "$k" "$folder/closeloop-mpi" --batch "$folder/list/$list.csv" --out "$into" --quiet "$@"
}

for k in 2 3; do
  expect 1 "$k ranks" ranks "$k" "ranks-$k"
  same "ranks-$k"
done
expect 1 "2 ranks, 2 threads" ranks 2 ranks-2-2 --threads 2
same ranks-2-2

list=dated
expect 1 "dated, 2 ranks" ranks 2 dated-ranks
same dated-ranks dated
list=list

# a rank dies: the run ends, and the next one goes on
into="$folder/lost"
mpirun --oversubscribe -n 3 "$folder/closeloop-mpi" --batch "$folder/list/$list.csv" --out "$into" --quiet >"$folder/out" 2>&1 &
mpi=$!
while [ ! -e "$folder/lost/one/.done" ] && kill -0 "$mpi" 2>/dev/null; do sleep 0.01; done
victim=$(ps -e -o pid= -o ppid= -o args= | awk -v f="$folder/closeloop-mpi" '$3 == f { parent[$1] = $2 }
  END { for (p in parent) if (!(parent[p] in parent)) print p }' | sort -n | tail -n 1)
[ -n "$victim" ] || complain "no rank to kill"
kill -9 $victim
wait "$mpi" 2>/dev/null
[ -e "$folder/lost/batch.csv" ] && complain "a table of a run that lost a rank"
expect 1 "after the loss of a rank" ranks 3 lost
same lost

exit "$((wrong != 0))"
