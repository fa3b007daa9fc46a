#!/bin/sh
# Load the public measurements that the study compares with, and check each by its SHA-256.
#
#   study/measured/fetch.sh [FOLDER [SET...]]      default: folder ../shared/data, where make looks; every set
#
# Sets, their authors and their terms:
#   vessel-air-charge-discharge     HydDown by A. Andreasen, MIT. Air and nitrogen leave a vessel; points that he read
#                                   off published figures. The .csv files are written here from his .yml files.
#   airtank-pump-vent,
#   soft-bellows-pressure-position  MSc project of E. IJpelaar (TU Eindhoven), no licence stated: for evaluation.
#   printed-cylinder-friction-leak  E. Zillen (TU Delft), CC0 1.0.
#   tube-fill-vent-pneuact          F. Sojoodi Farimani and S. Misra, ICRA 2018: for scientific and academic purposes.
#   pump-fed-chamber-control        github.com/DiegoSanMo6011/softbot_pneumatic_driver, MIT.
#
# Not here: damadics-servomotor-static-step. Its points were read off the vector figure 5 of M. Bartys,
# "Specification of actuators intended to use for benchmark definition" (2002), which names no licence; the document
# lies in github.com/dlaredo/ValveActuator-DAMADICS-, Reference/damadics-actuator-v1_02.pdf, commit
# a0353a02f8bed2fba6fc5147211e95ac45422363. To repeat it, read the corners of the plotted lines by the grid of each
# chart into static_hysteresis_fig5.csv (branch,p_kPa,x_percent; branch lower is rising pressure).
# Nor those whose logs were sheets or had more columns; none states a licence, and each is to be written by hand:
#   tank-blowdown-nozzles           github.com/AttainableEngineering/AeroLab, commit 365f6594, Lab6Data.xlsx: the sheets of
#                                   0.094 and 0.125 inch as CSV.
#   soft-bellows-arm-steps          github.com/zhiqiao0256/Soft-Arm-SMART-Controller-, commit 1f37dcaf,
#                                   2020/07-30/data_collect_1, 2, 3 and 9.txt: t_s, pd1..3_psi, pm1..3_psi, tip less base
#                                   dx, dy, dz and dist in m, the angle between their quaternions in degrees.
#   soft-catheter-pressure-position github.com/christopher-gonzalez-millan/Medtronic-Soft-Robotics-, commit 9fd9719c,
#                                   Data_Storage: the sheets as CSV with t_s, x_des, x_act, p_des_psia, p_act_psia.
set -eu

here=$(dirname "$0")
folder=${1:-../shared/data}
[ $# -gt 0 ] && shift
from=${FETCH_FROM:-https://raw.githubusercontent.com}
tab=$(printf '\t')

say() { printf '%s\n' "$*" >&2; }

sha256() {
  if command -v sha256sum >/dev/null 2>&1; then sha256sum <"$1"; else shasum -a 256 <"$1"; fi | cut -d ' ' -f 1
}

# whole PATH SHA256: is the file there, and is it the right one
whole() { [ -f "$1" ] && [ "$(sha256 "$1")" = "$2" ]; }

# wanted PATH SET...: no set named, or the path's
wanted() {
  path=$1
  shift
  [ $# -eq 0 ] && return 0
  for set in "$@"; do
    case $path in "$set"/*) return 0 ;; esac
  done
  return 1
}

# load SHA256 REPOSITORY COMMIT REMOTE LOCAL
load() {
  target=$folder/$5
  if whole "$target" "$1"; then return 0; fi
  mkdir -p "$(dirname "$target")"
  remote=$(printf '%s' "$4" | sed 's/%/%25/g; s/ /%20/g; s/&/%26/g; s/(/%28/g; s/)/%29/g')
  if ! curl --fail --silent --show-error --location --globoff --retry 3 -o "$target.part" "$from/$2/$3/$remote"; then
    rm -f "$target.part"
    say "$5: could not be loaded from $2"
    return 1
  fi
  if ! whole "$target.part" "$1"; then
    rm -f "$target.part"
    say "$5: is not the file that was used: wrong SHA-256"
    return 1
  fi
  mv "$target.part" "$target"
}

# points YML: the block `validation:` as quantity,t_s,value; pressure first, then each temperature
points() {
  awk '
    function list(text) { sub(/^[^[]*\[/, "", text); sub(/\].*$/, "", text); gsub(/ /, "", text); return text }
    function show(name, times, values,   n, i, t, v) {
      n = split(times, t, ","); split(values, v, ",")
      for (i = 1; i <= n; i++) out[name] = out[name] name "," t[i] "," v[i] "\n"
    }
    { sub(/\r$/, "") }
    /^validation:/ { inside = 1; next }
    /^[^ ]/ { inside = 0 }
    !inside { next }
    /^  [a-z]+:/ { name = $1; next }
    /^    [a-z_]+:[ ]*$/ { name = $1; sub(/:/, "", name); order[++count] = "T_" name "_K"; next }
    /time:/ { times = list($0); next }
    /temp:/ { show("T_" name "_K", times, list($0)); next }
    /pres:/ { show("p_bar_abs", times, list($0)) }
    END {
      print "quantity,t_s,value"
      printf "%s", out["p_bar_abs"]
      for (i = 1; i <= count; i++) printf "%s", out[order[i]]
    }' "$1"
}

# derive NAME SHA256: write the .csv beside the .yml
derive() {
  base=$folder/vessel-air-charge-discharge/$1
  [ -f "$base.yml" ] || return 0
  points "$base.yml" >"$base.csv.part"
  if ! whole "$base.csv.part" "$2"; then
    rm -f "$base.csv.part"
    say "$1.csv: the points of $1.yml came out differently: wrong SHA-256"
    return 1
  fi
  mv "$base.csv.part" "$base.csv"
}

if ! command -v curl >/dev/null 2>&1; then
  say "curl is missing, which loads them: apt-get install curl ca-certificates"
  exit 1
fi
failed=0
while IFS=$tab read -r sum repository commit remote local; do
  case $sum in '#'* | '') continue ;; esac
  wanted "$local" "$@" || continue
  load "$sum" "$repository" "$commit" "$remote" "$local" || failed=$((failed + 1))
done <"$here/files.txt"
derive Air_790kPa_21mm 9a2d5fb0ae3293cd1909e8b0dda3784c31fefc6e98b93be569236c785b74cc3a || failed=$((failed + 1))
derive N2_Exp_I1 a5f221e490c4517676ae7a4be5bfc09f13ffeae222128d2be9bbbde71ef060ee || failed=$((failed + 1))
say "damadics-servomotor-static-step: read off figures, not to be loaded; see the head of this script"
if [ "$failed" -gt 0 ]; then
  say "$failed files are missing"
  exit 1
fi
say "all files are in $folder"
