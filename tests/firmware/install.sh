#!/bin/sh
# Install compilers and emulators of the firmware targets, each group for itself: what cannot be had is told by check.sh.
set -u
major=$(${CC:-cc} -dumpversion | cut -d. -f1)
for group in \
  "gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm" \
  "gcc-$major-multilib" \
  "gcc-$major-s390x-linux-gnu libc6-dev-s390x-cross qemu-user"; do
  # shellcheck disable=SC2086
  sh study/install-packages.sh $group || echo "firmware: not all installed: $group" >&2
done
