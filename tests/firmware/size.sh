#!/bin/sh
# What the core costs on a Cortex-M: code, memory, stack and instructions, for each processor, build and catalogue.
#   size.sh > size.csv      study/guides/firmware.md says what is in the columns and how each is measured
set -eu
: "${MAKE:=make}" "${BUILD:=build}"
base=$BUILD/firmware/size

# Configurations of the core: name, then what is defined.
definitions()
{
  case $1 in
  base) echo "-DPNEU_EFFECTS_FILE='\"../tests/firmware/no_effects.def\"' -DPNEU_TERM_KNOTS=0" ;;
  few) echo "-DPNEU_EFFECTS_FILE='\"../tests/firmware/few_effects.def\"' -DPNEU_TERM_KNOTS=0" ;;
  all-no-terms) echo "-DPNEU_TERM_KNOTS=0" ;;
  all) ;;
  esac
}

one()
{
  processor=$1 machine=$2 build=$3 configuration=$4
  out=$base/$processor-$build-$configuration
  case $build in
  small) optimise=-Os lto= ;;
  fast) optimise=-O3 lto=-flto ;;
  esac
  $MAKE --no-print-directory -s -f tests/firmware/target.mk TARGET="$processor" OUT="$out" LTO="$lto" \
    OPT="$optimise -ffp-contract=fast" DEFS="$(definitions "$configuration")" "$out/count" >&2
  sh tests/firmware/emulate.sh "$machine" "$out/count" >"$out/count.txt"
  arm-none-eabi-objdump -d "$out/count" >"$out/count.dis"
  # shellcheck disable=SC2046
  bound=$(awk -v root=pneu_step -f tests/firmware/stack.awk $(find "$out" -name '*.su') "$out/count.dis")
  awk -v sizes="$(awk -f tests/firmware/map.awk "$out/count.map")" -v what="$processor,$build,$configuration" -v bound="$bound" -F, '
    NR == 1 { split($0, bytes, " "); split(sizes, size, " "); next }
    { printf "%s,%s,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d\n", what, $1, size[1], size[3], size[2], size[4],
      bytes[3], bytes[5], bytes[7], bytes[3] + bytes[5] + bytes[7], bound, $4, $2, $3 }' "$out/count.txt"
}

echo "processor,build,configuration,law,core_code_B,library_code_B,core_variables_B,library_variables_B,model_B,state_B,workspace_B,instance_B,stack_bound_B,stack_used_B,instructions_mean,instructions_worst"
for target in "m4f mps2-an386" "m0 microbit"; do
  for build in small fast; do
    for configuration in base few all-no-terms all; do
      # shellcheck disable=SC2086
      one $target $build $configuration
    done
  done
done
