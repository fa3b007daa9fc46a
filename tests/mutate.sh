#!/bin/sh
# Break the laws, the effects, the Jacobian and the tables of the stepper one sign, factor or comparison at a time
# (tests/mutate.awk) and see whether a test notices. Called by `make mutate`, which builds the tests and sets the variables below.
#   MUTANTS=N SEED=S  N of them, drawn with that seed, and not all    OUT=FILE  the table of them, as CSV
#   FILES="lib/..."   of these files alone                            SLOW=     without the slow tests
# Exit status 1 if a mutant survives that tests/mutate_equivalents.txt does not explain.
set -u
: "${CC:=cc}" "${MAKE:=make}" "${BUILD:=build}" "${LINK:?}" "${MUTANTS:=}" "${SEED:=1}" "${OUT:=}"
scratch="$BUILD/mutate"
laws="flow chamber stem balance transducer observe term modes rosenbrock model rhs jacobian linear params active"
sources=${FILES:-$(printf 'lib/%s.c ' $laws) lib/rodas5p.h lib/ros4.h $(echo lib/effects/*.c)}
quick="flow chamber effects_gas effects_stem effects_sensor jacobian params term term_cycles stem stepper effects audit"
slow=${SLOW-second_effects second effects_second}
caught=0
survived=0
explained=0
rm -rf "$scratch"
mkdir -p "$scratch/lib/effects"
ulimit -c 0

# first FILE: the tests in the order in which they are likely to notice
first() {
  case $1 in
  lib/balance.c) echo "balance $quick $slow" ;;
  lib/stem.c | lib/modes.c | lib/transducer.c) echo "stem $quick $slow" ;;
  lib/term.c) echo "term term_cycles $quick $slow" ;;
  lib/rosenbrock.c | lib/rodas5p.h) echo "stepper $quick $slow" ;;
  lib/observe.c) echo "stem effects_sensor $quick $slow" ;;
  lib/model.c | lib/rhs.c) echo "params chamber stem $quick $slow" ;;
  lib/jacobian.c | lib/linear.c) echo "jacobian stepper $quick $slow" ;;
  lib/params.c | lib/active.c) echo "params effects $quick $slow" ;;
  lib/ros4.h) echo "stepper $quick" ;; # the slow ones are about the readers of files too, which are built for order 5
  *) echo "$quick $slow" ;;
  esac
}

# at_home FILE: where the tests lie that a file takes effect in, and how it is compiled: the tables of order 4 in tests of
# that order, built here when they are first asked for
at_home() {
  home=$BUILD
  order=""
  [ "$1" = lib/ros4.h ] || return 0
  home=$BUILD/order4
  order=-DPNEU_ORDER=4
  [ -n "${built:-}" ] && return 0
  # shellcheck disable=SC2046,SC2086
  $MAKE --no-print-directory BUILD="$home" LAB= CFLAGS=$order $(printf "$home/tests/lib/test_%s " $quick) \
    >"$scratch/order4.log" 2>&1 || { tail "$scratch/order4.log"; exit 2; }
  built=1
  expect_none
}

# source_of FILE: what to compile so that a broken file takes effect; a table is a part of the stepper
source_of() {
  case $1 in
  *.h) cp lib/rosenbrock.c "$scratch/lib" && echo "$scratch/lib/rosenbrock.c" ;;
  *) rm -f "$scratch"/lib/*.h && echo "$scratch/$1" ;;
  esac
}

# build SOURCE: an object of a file of the library, with the headers of lib/; a change that turns a whole number into a real
# one is no mutant
build() {
  # shellcheck disable=SC2086
  $CC -std=c99 -O1 -ffp-contract=off -Werror=float-conversion $order -Ilib/effects -Ilib -c "$1" -o "$scratch/mutant.o" \
    2>"$scratch/cc.log"
}

# object_of TEST: where its object lies below a folder of a build
object_of() { find tests -name "test_$1.c" | sed 's/c$/o/'; }

# fails TEST: whether a test program notices the object; one that computes for ten times as long as it should notices too
fails() {
  case " $slow " in *" $1 "*) seconds=60 ;; *) seconds=8 ;; esac
  # shellcheck disable=SC2086
  $CC -o "$scratch/test" "$home/$(object_of "$1")" "$scratch/mutant.o" "$home/libhelp.a" "$BUILD/liblab.a" \
    "$home/libpneu.a" $LINK || exit 2
  { # a program whose words nobody reads any more ends at the next of them
    (ulimit -t $seconds && exec "$scratch/test") 2>&1
    echo "left with $?"
  } | grep -Eq '^\[  FAILED  \]|^left with [^0]'
}

# expect_none: end if a test notices what is not there
expect_none() {
  build lib/flow.c || { cat "$scratch/cc.log"; exit 2; }
  for test in $quick; do
    fails "$test" && { echo "test_$test fails without any mutant"; exit 2; }
  done
}

# notice FILE: `by` is the test that notices what is built from it; empty where none does
notice() {
  by=""
  tried=""
  for test in $(first "$1"); do
    case " $tried " in *" $test "*) continue ;; esac
    tried="$tried $test"
    if fails "$test"; then
      by="test_$test"
      return
    fi
  done
}

# apply FILE LINE COLUMN LENGTH TEXT: the file with one change
apply() {
  TEXT=$5 awk -v at="$2" -v column="$3" -v length_="$4" 'FNR == at {
    $0 = substr($0, 1, column - 1) ENVIRON["TEXT"] substr($0, column + length_) } { print }' "$1"
}

# is_explained FILE LINE: whether the table has a reason for what the line has become
is_explained() {
  sed -n "$2s/^ *//p" "$scratch/$1" >"$scratch/line"
  awk -F '\t' -v file="$1" 'NR == FNR { line = $0; next } $1 == file && $2 == line { found = 1 } END { exit !found }' \
    "$scratch/line" tests/mutate_equivalents.txt && cat "$scratch/line" >>"$scratch/explained"
}

# quote TEXT: as a field of CSV
quote() { printf '"%s"' "$(printf '%s' "$1" | sed 's/"/""/g')"; }

# try_one FILE LINE COLUMN LENGTH TEXT; returns 1 if that is no program
try_one() {
  apply "$@" >"$scratch/$1"
  was=$(sed -n "$2p" "$1" | cut -c "$3-$(($3 + $4 - 1))")
  if is_explained "$1" "$2"; then
    explained=$((explained + 1))
    by="none: equivalent"
  else
    at_home "$1"
    build "$(source_of "$1")" || return 1
    notice "$1"
    if [ -n "$by" ]; then
      caught=$((caught + 1))
    else
      survived=$((survived + 1))
      echo "survived: $1:$2: $(sed -n "$2s/^ *//p" "$scratch/$1")"
    fi
  fi
  [ -n "$OUT" ] && echo "$1,$2,$3,$(quote "$was"),$(quote "$5"),$by" >>"$OUT.part"
  return 0
}

# A seeded order of the lines of a file, the same with every awk.
shuffled() {
  awk -v seed="$SEED" 'BEGIN { x = seed * 7919 + 17 } { x = (x * 16807 + 11) % 2147483647; print x "\t" $0 }' "$1" |
    sort -n | cut -f 2-
}

at_home lib/flow.c
expect_none

# shellcheck disable=SC2086
awk -f tests/mutate.awk $sources >"$scratch/all"
if [ -n "$MUTANTS" ]; then shuffled "$scratch/all"; else cat "$scratch/all"; fi >"$scratch/list"
[ -n "$OUT" ] && echo "file,line,column,was,becomes,caught_by" >"$OUT.part"
tab=$(printf '\t')
while IFS="$tab" read -r file line column length text; do
  [ -n "$MUTANTS" ] && [ $((caught + survived)) -ge "$MUTANTS" ] && break
  try_one "$file" "$line" "$column" "$length" "$text"
done <"$scratch/list"
[ -n "$OUT" ] && mv "$OUT.part" "$OUT"
if [ -z "$MUTANTS${FILES:-}" ]; then
  cut -f 2 tests/mutate_equivalents.txt | grep -Fvxf "$scratch/explained" && echo "explained, but no mutant any more" && survived=1
fi
echo "$caught mutants caught, $survived survived, $explained known to be equivalent"
[ "$survived" -eq 0 ] && [ "$caught" -gt 0 ]
