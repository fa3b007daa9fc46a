#!/bin/sh
# Install what is missing, on Debian and Ubuntu; elsewhere name it.
# Exits 0 where everything is there, or there is no apt-get.
#   install-packages.sh            what `make study` needs
#   install-packages.sh tests      also what only make check uses
#   install-packages.sh everything also what parts of make check-all use
#   install-packages.sh PACKAGE... these
set -eu

# packages PART...: of packages.txt
packages() {
  for part in "$@"; do
    awk -v part="$part" '$1 == part && $2 != "-" { print $2 }' "$(dirname "$0")/packages.txt"
  done
}

case "${1:-}" in
"") wanted=$(packages compiler programs figures) ;;
tests) wanted=$(packages compiler programs figures tests) ;;
everything) wanted=$(packages compiler programs figures tests mpi parts) ;;
*) wanted=$* ;;
esac

missing() {
  for package in $wanted; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || printf '%s ' "$package"
  done
}

if ! command -v apt-get >/dev/null 2>&1; then
  # shellcheck disable=SC2086
  echo "no apt-get: install what is missing of these by hand:" $wanted >&2
  exit 0
fi
[ -n "$(missing)" ] || exit 0
exec 9>"${TMPDIR:-/tmp}/libpneu-install-$(id -u).lock"
flock 9 # two at once have no lists of packages, or one of them fails
list=$(missing)
[ -n "$list" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "neither root nor sudo: ask an administrator for  apt-get install $list" >&2
    exit 1
  fi
  as_root=sudo
fi
echo "installing: $list"
export DEBIAN_FRONTEND=noninteractive
# shellcheck disable=SC2086
$as_root apt-get update -q >/dev/null || echo "apt-get update failed; trying with the old list" >&2
# shellcheck disable=SC2086
$as_root apt-get install -q -y --no-install-recommends $list >/dev/null
