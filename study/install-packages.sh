#!/bin/sh
# Install what is missing, on Debian and Ubuntu; name it for other systems.
# Exits 0 where everything is there.
#   install-packages.sh            what `make all` needs
#   install-packages.sh tests      also what only make check uses
#   install-packages.sh PACKAGE... these
set -eu

apt_packages="gcc g++ make pkg-config libsundials-dev libnlopt-dev libconfig-dev libudunits2-dev libcjson-dev
libcminpack-dev libzip-dev libxml2-dev libcmocka-dev gnuplot-nox"
case "${1:-}" in
"") ;;
tests) apt_packages="$apt_packages libopenmpi-dev openmpi-bin python3-venv" ;;
*) apt_packages=$* ;;
esac

missing() {
  for package in $apt_packages; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || printf '%s ' "$package"
  done
}

name_others() {
  cat <<WORDS
This system has no apt-get. Install by its own package manager: $apt_packages
Libraries for make all elsewhere:
  dnf:  dnf install gcc gcc-c++ make pkgconf sundials-devel NLopt-devel libconfig-devel udunits2-devel cjson-devel cminpack-devel libzip-devel libxml2-devel libcmocka-devel gnuplot openmpi-devel
  brew: brew install sundials nlopt libconfig udunits cjson cminpack libzip libxml2 cmocka gnuplot libomp open-mpi
WORDS
}

if ! command -v apt-get >/dev/null 2>&1; then
  name_others
  exit 0
fi

list=$(missing)
[ -z "$list" ] && exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "missing: $list" >&2
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
