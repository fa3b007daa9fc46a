#!/bin/sh
# The core on the targets of firmware, from `make firmware-check`:
#   Cortex-M4F and Cortex-M0+, emulated: the demonstration gives what it gives on this computer, and its alarm is right
#   32-bit x86, and big-endian s390x, emulated: the core's tests
#   check.sh short|full     short: from `make check`; the quicker half of the tests on s390x
# A target whose tools are not there is skipped, with a line that says so; FIRMWARE=required makes that a failure.
set -u
: "${MAKE:=make}" "${CC:=cc}" "${BUILD:=build}" "${FIRMWARE:=}"
extent=$1
out="$BUILD/firmware"
log="$out/log"
mkdir -p "$out"
failed=0
skipped=0

quick="test_params test_terms test_clock test_flow test_chamber test_jacobian test_effects_gas test_effects_stem"
core="$quick test_stem test_stepper test_audit test_effects test_effects_sensor"

# How far the targets may be from the host, both in single precision: their exp and pow round differently, and 12500
# steps add that up. A hundred-thousandth of full scale.
pressure=4 # [Pa]
position=1 # [um]
score=1     # units of the alarm's sum, as printed

target()
{
  name=$1
  shift
  $MAKE --no-print-directory -f tests/firmware/target.mk NATIVE="$CC" S390X="${s390x:-}" TARGET="$name" OUT="$out/$name" "$@"
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

cortex()
{
  case $1 in
  m4f) machine=mps2-an386 what="Cortex-M4F (mps2-an386)" ;;
  m0) machine=microbit what="Cortex-M0+ code on a Cortex-M0 (microbit)" ;;
  esac
  if ! target "$1" "$out/$1/demo" >"$log" 2>&1; then
    say_failed "$what: does not build"
    return
  fi
  if ! sh tests/firmware/emulate.sh "$machine" "$out/$1/demo" >"$out/$1.txt" 2>"$log"; then
    cat "$out/$1.txt" >>"$log"
    say_failed "$what: the demonstration does not end well"
    return
  fi
  if awk -v pressure=$pressure -v position=$position -v score=$score -f tests/firmware/agree.awk "$out/host.txt" "$out/$1.txt" >"$log"
  then
    echo "ok      firmware: $what, demonstration as on this computer; $(tail -n 1 "$log")"
  else
    say_failed "$what: the demonstration is not as on this computer"
  fi
}

# The core's tests on a target: core_tests TARGET WORDS TESTS RUNNER...
core_tests()
{
  name=$1
  what=$2
  programs=""
  for test in $3; do
    programs="$programs $out/$name/$test"
  done
  shift 3
  # shellcheck disable=SC2086
  if ! target "$name" $programs >"$log" 2>&1; then
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

if ! { target host "$out/host/demo" && "$out/host/demo" >"$out/host.txt"; } >"$log" 2>&1; then
  say_failed "the demonstration fails on this computer"
elif have arm-none-eabi-gcc qemu-system-arm; then
  cortex m4f
  cortex m0
else
  skip "Cortex-M: no gcc-arm-none-eabi or no qemu-system-arm"
fi

if can_link_32_bit; then
  core_tests i386 "32-bit x86" "$core" env
else
  skip "32-bit x86: $CC -m32 does not work (gcc-multilib)"
fi

s390x=$(command -v s390x-linux-gnu-gcc || command -v "s390x-linux-gnu-gcc-$($CC -dumpversion | cut -d. -f1)" || true)
if [ -n "$s390x" ] && have qemu-s390x; then
  core_tests s390x "big-endian s390x" "$([ "$extent" = full ] && echo "$core" || echo "$quick")" qemu-s390x
else
  skip "big-endian s390x: no gcc-s390x-linux-gnu or no qemu-user"
fi

[ "$failed" -eq 0 ] && { [ "$skipped" -eq 0 ] || [ "$FIRMWARE" != required ]; }
