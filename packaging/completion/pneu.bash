# Completion of libpneu's programs for bash: options as --help lists them, files by what an option or operand takes.
# The name of an argument in --help says what it is: DIR a folder, FILE any file, *.csv and *.cfg files of that kind.
# SPDX-License-Identifier: MIT

# Options with their arguments, one a line: "--out DIR".
_pneu_options() {
  "$1" --help 2>/dev/null | sed -n 's/^  \(--[a-z-]*\)\( [A-Z][^ ]*\)\{0,1\} .*/\1\2/p'
}

# Files with an ending, and folders on the way to them: _pneu_files WORD ENDING...
_pneu_files() {
  local word=$1 ending
  shift
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$word"
    for ending in "$@"; do compgen -f -X "!*.$ending" -- "$word"; done
  )
}

_pneu() {
  local program=$1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} argument
  COMPREPLY=()
  argument=$(_pneu_options "$program" | sed -n "s/^$before //p")
  case $argument in
  DIR) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
  FILE) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
  *.csv*) _pneu_files "$word" csv ;;
  *.cfg*) _pneu_files "$word" cfg ;;
  ?*) ;; # a number
  *)
    case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W "$(_pneu_options "$program" | cut -d ' ' -f 1)" -- "$word") ;;
    *) _pneu_files "$word" cfg csv ;;
    esac
    ;;
  esac
}

complete -F _pneu sweep simulate closeloop
