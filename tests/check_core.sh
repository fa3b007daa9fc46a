#!/bin/sh
# Prove of the core library what firmware needs to know: no heap, no I/O, no variables of its own, no names
# but pneu_*; a header that is C90, C99 and C++; a user in C90 that links and runs.
#   check_core.sh ARCHIVE SOURCE_FOLDER      tools: CC, CXX, AR, NM, SIZE from the environment
#   SINGLE=1: the archive was built with PNEU_SINGLE;  RUN: prefix to run a program (an emulator)
# Every check is first made to fail on an object that offends.
set -eu

archive=$1
source=$2
: "${CC:=cc}" "${CXX:=c++}" "${AR:=ar}" "${NM:=nm}" "${SIZE:=size}" "${RUN:=}"
single=${SINGLE:+-DPNEU_SINGLE}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# What the core may call: the mathematics library, what compilers put in for struct copies and for sine beside cosine, and
# what compares names (find.c).
allowed='(cbrt|cos|exp|expm1|fabs|fmax|fmin|log|log1p|pow|sin|sincos|sqrt)f?|mem(cpy|move|set|cmp)|str(chr|cmp|len|ncmp)|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail|__aeabi_.*'

# Names that the archive needs from elsewhere and may not.
foreign()
{
  $NM -g "$1" | awk 'NF == 3 {print $3}' | sort -u > "$scratch/defined"
  $NM -g "$1" | awk 'NF == 2 && $1 == "U" {print $2}' | sort -u > "$scratch/needed"
  grep -vxF -f "$scratch/defined" "$scratch/needed" | grep -vxE "$allowed" || true
}

# Names that the archive defines without the prefix.
unprefixed()
{
  $NM -g "$1" | awk 'NF == 3 {print $3}' | grep -v '^pneu_' || true
}

# Bytes of variables: the library keeps no state.
variables()
{
  $SIZE -A "$1" | awk '$1 ~ /^\.(data|bss|tdata|tbss)(\.[a-z_]+)*$/ && $1 !~ /^\.data\.rel\.ro/ {sum += $2} END {print sum + 0}'
}

complain()
{
  echo "check_core: $1" >&2
  failed=1
}

report()
{
  failed=0
  names=$(foreign "$1")
  [ -z "$names" ] || complain "needs $names"
  names=$(unprefixed "$1")
  [ -z "$names" ] || complain "defines without prefix $names"
  bytes=$(variables "$1")
  [ "$bytes" = 0 ] || complain "has $bytes bytes of variables"
  return $failed
}

# An archive with one fault in it.
fault()
{
  printf '%s\n' "$1" > "$scratch/fault.c"
  $CC -O1 -c "$scratch/fault.c" -o "$scratch/fault.o"
  rm -f "$scratch/fault.a"
  $AR rcs "$scratch/fault.a" "$scratch/fault.o"
  if report "$scratch/fault.a" 2> /dev/null; then
    echo "check_core: does not see the fault in: $1" >&2
    exit 1
  fi
}

fault '#include <stdlib.h>
void *pneu_fault(void) { return malloc(8); }'
fault '#include <stdio.h>
void pneu_fault(double x) { printf("%g", x); }'
fault 'int fault(void) { return 1; }'
fault 'int pneu_fault; int pneu_count(void) { return ++pneu_fault; }'
fault 'static int hidden = 3; int pneu_count(void) { return ++hidden; }'

# A header that is not C90 must be seen too.
printf '%s\n' '// a line comment' 'int pneu_x;' > "$scratch/fault.h"
if $CC -std=c90 -pedantic-errors -fsyntax-only -x c "$scratch/fault.h" 2> /dev/null; then
  echo "check_core: $CC takes a C99 comment for C90" >&2
  exit 1
fi

report "$archive"
for precision in '' -DPNEU_SINGLE; do
  $CC -std=c90 -pedantic-errors -Wall -Wextra -Werror $precision -fsyntax-only -x c "$source/pneu.h"
  $CC -std=c99 -pedantic-errors -Wall -Wextra -Werror $precision -fsyntax-only -x c "$source/pneu.h"
  $CXX -std=c++98 -pedantic-errors -Wall -Wextra -Werror $precision -fsyntax-only -x c++ "$source/pneu.h"
done

# The user in C90; and one in the other precision, whose link must fail.
user=$(dirname "$0")/consumer.c
$CC -std=c90 -pedantic-errors -Wall -Wextra -Werror $single "$user" "$archive" -lm -o "$scratch/consumer"
$RUN "$scratch/consumer" > "$scratch/consumer.out" || { cat "$scratch/consumer.out" >&2; exit 1; }
other=$([ -n "$single" ] || echo -DPNEU_SINGLE)
if $CC -std=c90 $other "$user" "$archive" -lm -o "$scratch/mixed" 2> /dev/null; then
  echo "check_core: a user of the other precision links" >&2
  exit 1
fi

# -ffast-math would compile the checks for finite input away: every source refuses it, and says so; its user need not.
for flag in -ffast-math -ffinite-math-only; do
  for file in "$source"/*.c "$source"/effects/*.c; do
    if $CC -std=c99 $flag -fsyntax-only "$file" 2> "$scratch/refused" || ! grep -q 'not finite' "$scratch/refused"; then
      echo "check_core: $file takes $flag" >&2
      exit 1
    fi
  done
  $CC -std=c90 $flag $single -fsyntax-only "$user"
done

# Builds without free terms, and without effects: the evaluation does not refer to them, the user still runs, to the same
# end. The full build does refer.
refers()
{
  $NM "$1" | grep -q "U $2\$"
}

# trimmed NAME SYMBOL DEFINITION
trimmed()
{
  mkdir "$scratch/$1"
  for file in "$source"/*.c "$source"/effects/*.c; do
    $CC -std=c99 -Os -Wall -Wextra -Werror $single "$3" -c "$file" -o "$scratch/$1/$(basename "$file" .c).o"
  done
  $AR rcs "$scratch/$1.a" "$scratch/$1"/*.o
  report "$scratch/$1.a"
  if refers "$scratch/$1.a" "$2" || ! refers "$archive" "$2"; then
    echo "check_core: $2 is called in spite of $3, or is not called without it" >&2
    exit 1
  fi
  $CC -std=c90 $single "$3" "$user" "$scratch/$1.a" -lm -o "$scratch/$1.program"
  $RUN "$scratch/$1.program" > "$scratch/$1.out"
  cmp "$scratch/consumer.out" "$scratch/$1.out"
}

trimmed no_terms pneu_add_terms -DPNEU_TERM_KNOTS=0
printf '\n' > "$scratch/none.def"
trimmed no_effects pneu_effect_record_chamber_leak "-DPNEU_EFFECTS_FILE=\"$scratch/none.def\""
echo "check_core: $(basename "$archive") is clean"
