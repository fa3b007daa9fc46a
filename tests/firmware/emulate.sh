#!/bin/sh
# Run a program on an emulated board; what it says goes to stdout. An instruction takes 64 ns of the board's time.
#   emulate.sh MACHINE PROGRAM
exec timeout 900 qemu-system-arm -M "$1" -display none -serial none -monitor none -icount shift=6 \
  -chardev stdio,id=says -semihosting-config enable=on,target=native,chardev=says -kernel "$2" </dev/null
