#!/bin/sh
# The core on the targets of firmware, from `make firmware-check`:
#   Cortex-M4F and Cortex-M0+, emulated: the demonstration gives what it gives on this computer, and its alarm is right
#   32-bit x86, there with either order of the stepper, and big-endian s390x, emulated: the core's tests
#   check.sh short|full     short: from `make check-all`; full: all tests on s390x too, and results/size.csv made again
# A target whose tools are not there is skipped, with a line that says so; FIRMWARE=required makes that a failure.
set -u
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}" "${FIRMWARE:=}"
extent=$1
out="$BUILD/firmware"
log="$out/log"
mkdir -p "$out"
failed=0
skipped=0

core=$(ls tests/lib/test_*.c)
quick=$(echo "$core" | grep -Ev 'test_(stem|stepper|audit|effects|effects_sensor)\.c')

# How far the targets may be from the host, both in single precision: their exp and pow round differently, and 12500
# steps add that up. A hundred-thousandth of full scale.
pressure=4 # [Pa]
position=1 # [um]
score=1     # units of the alarm's sum, as printed

target()
{
  name=$1
  shift
  $MAKE --no-print-directory -f tests/firmware/target.mk NATIVE="$CC" S390X="${s390x:-}" TARGET="$name" "$@"
}

say_failed()
{
  failed=$((failed + 1))
  echo "FAILED  firmware: $1"
  tail -n 40 "$log"
}

skip()
{
  skipped=$((skipped + 1))
  echo "skipped firmware: $1"
}

# The demonstration on a Cortex-M: cortex FOLDER TARGET MACHINE WORDS DEFINITIONS
cortex()
{
  program="$out/$1/demo"
  said="$out/$1.txt"
  what=$4
  if ! target "$2" OUT="$out/$1" DEFS="$5" "$program" >"$log" 2>&1; then
    say_failed "$what: does not build"
    return
  fi
  if ! sh tests/firmware/emulate.sh "$3" "$program" >"$said" 2>"$log"; then
    cat "$said" >>"$log"
    say_failed "$what: the demonstration does not end well"
    return
  fi
  if awk -v pressure=$pressure -v position=$position -v score=$score -f tests/firmware/agree.awk "$out/host.txt" "$said" >"$log"
  then
    echo "ok      firmware: $what, demonstration as on this computer; $(tail -n 1 "$log")"
  else
    say_failed "$what: the demonstration is not as on this computer"
  fi
}

# The core's tests on a target: core_tests FOLDER TARGET WORDS DEFINITIONS TESTS RUNNER...
core_tests()
{
  folder=$out/$1
  name=$2
  what=$3
  definitions=$4
  programs=$(echo "$5" | sed "s|^|$folder/|; s|\.c\$||")
  shift 5
  # shellcheck disable=SC2086
  if ! target "$name" OUT="$folder" DEFS="$definitions" $programs >"$log" 2>&1; then
    say_failed "$what: the core's tests do not build"
    return
  fi
  passed=0
  for program in $programs; do
    if ! "$@" "$program" >"$log" 2>&1; then
      say_failed "$what: $(basename "$program")"
      return
    fi
    passed=$((passed + $(sed -n 's/^\[  PASSED  \] \([0-9]*\) .*/\1/p' "$log")))
  done
  echo "ok      firmware: $what, $passed tests of the core"
}

# What the core may cost on a Cortex-M4F, in the columns of size.csv: base model, built to be fast.
within_bars()
{
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $1 == "m4f" && $2 == "fast" && $3 == "base" && $4 ~ /^isothermal/ {
      seen++
      if ($at["core_code_B"] > 24 * 1024 || $at["core_variables_B"] > 0 || $at["instance_B"] > 1024 || $at["instructions_mean"] > 3000) { print; wrong = 1 }
    }
    $at["stack_used_B"] > $at["stack_bound_B"] { print "stack: " $0; wrong = 1 }
    END { exit wrong || seen < 3 }' "$1"
}

sizes()
{
  if ! BUILD="$BUILD" MAKE="$MAKE" sh tests/firmware/size.sh >"$out/size.csv" 2>"$log"; then
    say_failed "size.csv cannot be made"
  elif ! within_bars "$out/size.csv" >"$log"; then
    say_failed "sizes beyond their bars"
  else
    cp "$out/size.csv" results/size.csv
    sh tests/readme_table.sh --refresh sizes study/guides/firmware.md
    echo "ok      firmware: results/size.csv, within its bars"
  fi
}

have()
{
  for tool in "$@"; do
    command -v "$tool" >/dev/null 2>&1 || return 1
  done
}

can_link_32_bit()
{
  echo 'int main(void) { return 0; }' >"$out/try.c"
  $CC -m32 "$out/try.c" -lm -o "$out/try" >/dev/null 2>&1 && "$out/try"
}

trimmed="-DPNEU_TERM_KNOTS=0 -DPNEU_EFFECTS_FILE='\"../tests/firmware/no_effects.def\"'"
if ! { target host OUT="$out/host" "$out/host/demo" && "$out/host/demo" >"$out/host.txt"; } >"$log" 2>&1; then
  say_failed "the demonstration fails on this computer"
elif have arm-none-eabi-gcc qemu-system-arm; then
  cortex m4f m4f mps2-an386 "Cortex-M4F (mps2-an386)" ""
  cortex m4f-trimmed m4f mps2-an386 "Cortex-M4F, base model alone" "$trimmed"
  cortex m0 m0 microbit "Cortex-M0+ code on a Cortex-M0 (microbit)" ""
  [ "$extent" = full ] && sizes
else
  skip "Cortex-M: no gcc-arm-none-eabi or no qemu-system-arm"
fi

if can_link_32_bit; then
  core_tests i386 i386 "32-bit x86" "" "$core" env
  core_tests i386-order4 i386 "32-bit x86, stepper of order 4" "-DPNEU_ORDER=4" "$core" env
else
  skip "32-bit x86: $CC -m32 does not work (gcc-multilib)"
fi

s390x=$(command -v s390x-linux-gnu-gcc || command -v "s390x-linux-gnu-gcc-$($CC -dumpversion | cut -d. -f1)" || true)
if [ -n "$s390x" ] && have qemu-s390x; then
  core_tests s390x s390x "big-endian s390x" "" "$([ "$extent" = full ] && echo "$core" || echo "$quick")" qemu-s390x
else
  skip "big-endian s390x: no gcc-s390x-linux-gnu or no qemu-user"
fi

[ "$failed" -eq 0 ] && { [ "$skipped" -eq 0 ] || [ "$FIRMWARE" != required ]; }
