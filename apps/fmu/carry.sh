#!/bin/sh
# Files as C: their bytes, and a table of them by name, for carried.c.
#   carry.sh NAME=FILE...
n=0
for pair in "$@"; do
  printf 'static const unsigned char file_%d[] = {\n' $n
  od -An -v -tx1 "${pair#*=}" | sed 's/ \(..\)/0x\1,/g'
  printf '};\n'
  n=$((n + 1))
done
n=0
echo 'const fmu_file fmu_files[] = {'
for pair in "$@"; do
  printf '{"%s", file_%d, sizeof file_%d},\n' "${pair%%=*}" $n $n
  n=$((n + 1))
done
echo '{0, 0, 0}};'
