#!/bin/sh
# Run a program on an emulated board; what it says goes to stdout. An instruction takes 64 ns of the board's time.
# One that goes on for ever is ended by its seconds of CPU.
#   emulate.sh MACHINE PROGRAM
ulimit -t 900
exec qemu-system-arm -M "$1" -display none -serial none -monitor none -icount shift=6 \
  -chardev stdio,id=says -semihosting-config enable=on,target=native,chardev=says -kernel "$2" </dev/null
