#!/bin/sh
# Say which programs and headers of a part of packages.txt, or of the compiler, are missing and how to get them; fails where
# any is. Without a compiler no header is seen.
#   missing.sh PART FOUND COMPILER [FLAGS...]
# FOUND is written where none is, and FOUND.d beside it, so that make looks again when a header has gone.
set -eu
part=$1
found=$2
shift 2
table=$(dirname "$0")/packages.txt

# is_there NAME COMPILER [FLAGS...]
is_there() {
  name=$1
  shift
  case $name in
  *.h) echo "#include <$name>" | "$@" -E -x c - ;;
  cc) command -v "$1" ;;
  c++) command -v "${CXX:-c++}" ;;
  *) command -v "$name" ;;
  esac >/dev/null 2>&1
}

all=$(awk -v part="$part" '$1 == part || $1 == "compiler" { print $5 }' "$table")
missing=""
for name in $all; do
  is_there "$name" "$@" || missing="$missing $name"
done
if [ -z "$missing" ]; then
  for name in $all; do
    case $name in *.h) echo "#include <$name>" ;; esac
  done | "$@" -M -MP -MF "$found.d" -MT "$found" -x c -
  : >"$found"
  exit 0
fi

# packages COLUMN: what has them
packages() {
  awk -v column="$1" -v missing="$missing " '$1 !~ /^#/ && index(missing, " " $5 " ") && $column != "-" { print $column }' "$table" |
    tr '\n' ' '
}

echo "missing:$missing" >&2
{
  command -v apt-get >/dev/null && echo "  apt-get install $(packages 2)"
  command -v dnf >/dev/null && echo "  dnf install $(packages 3)"
  command -v brew >/dev/null && echo "  brew install $(packages 4)"
  true
} | grep . >&2 || awk '{ print "  " $0 }' >&2 <<WORDS
Debian, Ubuntu: apt-get install $(packages 2)
Fedora: dnf install $(packages 3)
macOS: brew install $(packages 4)
WORDS
exit 1
