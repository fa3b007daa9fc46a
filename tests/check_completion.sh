#!/bin/sh
# Completion in bash and zsh, run as a shell runs it: each option of each program, and files by their kind.
#   check_completion.sh SHARE SCRATCH      SHARE/bash-completion/..., SHARE/zsh/...; programs are on the PATH
set -eu
here=$(cd "$(dirname "$0")" && pwd)
share=$1
scratch=$2
mkdir -p "$scratch/folder"
cd "$scratch"
: >rig.cfg
: >log.csv
: >login.txt
: >fog.txt

wrong() {
  echo "check_completion: $1" >&2
  exit 1
}

# in_bash WORD...: what bash offers for the last word
in_bash() {
  bash --norc --noprofile -c '
    source "$0"
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    function_name=$(complete -p "$1" | sed "s/.*-F \([^ ]*\).*/\1/")
    "$function_name" "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
    printf "%s\n" "${COMPREPLY[@]}" | sort' "$share/bash-completion/completions/$1" "$@"
}

# expect "OFFERED ..." WORD...
expect() {
  wanted=$1
  shift
  got=$(in_bash "$@" | tr '\n' ' ' | sed 's/ $//')
  [ "$got" = "$wanted" ] || wrong "bash: for \"$*\" expected \"$wanted\", got \"$got\""
}

if ! command -v bash >/dev/null; then
  echo "absent: bash"
  exit 0
fi
for file in "$share"/bash-completion/completions/*; do
  program=$(basename "$file")
  expect "$("$program" --help | sed -n 's/^  \(--[a-z-]*\).*/\1/p' | sort | tr '\n' ' ' | sed 's/ $//')" "$program" --
  expect "--quiet" "$program" --q
  expect "folder log.csv rig.cfg" "$program" ""
  expect "" "$program" --threads ""
done
expect "folder" sweep --results ""
expect "log.csv" simulate l
expect "fog.txt folder log.csv login.txt rig.cfg" simulate --out ""
expect "folder" closeloop --out ""
expect "folder log.csv" closeloop --batch ""
expect "folder log.csv" closeloop rig.cfg log.csv --holdout ""
expect "" closeloop --alpha ""

if ! command -v zsh >/dev/null; then
  echo "absent: zsh"
  exit 0
fi
# zsh_makes LINE OF TEXT: what the tab key makes of a text
zsh_makes() {
  got=$(zsh -f "$here/completion.zsh" "$share" "$2")
  [ "$got" = "$1" ] || wrong "zsh: of \"$2\" expected \"$1\", got \"$got\""
}
zsh_makes "sweep --no-figures" "sweep --no-f"
zsh_makes "closeloop --holdout" "closeloop --ho"
zsh_makes "simulate rig.cfg" "simulate r"
zsh_makes "sweep --results folder/" "sweep --results f"
zsh_makes "simulate log.csv" "simulate l" # login.txt is neither model nor log
