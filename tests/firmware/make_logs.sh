#!/bin/sh
# The rig logs of the demonstration as a C table: the first seconds of two logs, one row in so many, and every row in
# which the command changes. What a commissioning fit would give is taken from the logs' known answers.
#   make_logs.sh FOLDER > rig_logs.c      FOLDER holds null-a and leak-a: rig.cfg, fit.csv, truth.json
set -eu
folder=$1
every=12  # rows of 5 ms
until=12.5 # s

# A number of truth.json: number FILE KEY
number()
{
  sed -n "s/.*\"$2\": *\([-+.0-9e]*\).*/\1/p" "$1"
}

rows()
{
  awk -F, -v every="$every" -v until="$until" '
    function whole(value) { return sprintf("%.0f", value) }
    NR == 1 || $1 > until { next }
    (NR - 2) % every == 0 || $2 != u { printf "    {%s, %s, %s, %s},\n", whole($1 * 1000), $2, whole($3 * 50), whole($4 * 1000) }
    { u = $2 }' "$1"
}

log()
{
  truth="$folder/$2/truth.json"
  printf 'static const rig_row %s_row[] = {\n' "$1"
  rows "$folder/$2/fit.csv"
  printf '};\n\nconst rig_log rig_log_%s = {"%s", %s, %s_row, (int)(sizeof %s_row / sizeof *%s_row),\n' "$1" "$1" "$3" "$1" "$1" "$1"
  for key in k x0 F lam Ca_in; do
    printf '    (pneu_real)%s%s' "$(number "$truth" "$key")" "$([ $key = Ca_in ] || echo ,)"
  done
  printf '};\n'
}

printf '/* Written by make_logs.sh from the rig logs null-a and leak-a.\n * SPDX-License-Identifier: MIT */\n'
printf '/* clang-format off */\n#include "rig_logs.h"\n\n'
log healthy null-a PNEU_FLOW_PAPER
printf '\n'
log leak leak-a PNEU_FLOW_CHOKED
