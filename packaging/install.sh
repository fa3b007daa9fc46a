#!/bin/sh
# Copy what `make install` has staged to its place, and take it away again.
#   install.sh install STAGE DESTDIR LIST      STAGE/usr/lib/x goes to DESTDIR/usr/lib/x; LIST, a path without DESTDIR,
#                                              names what was put there: files, and the folders made for them
#   install.sh uninstall DESTDIR LIST          removes what LIST names, folders only where nothing else is in them
#   install.sh found LIBDIR BINDIR             lets the loader know of LIBDIR, where that is its to know; says what to set where
#                                              shell, pkg-config and loader would not find what is there
# Installing over another version leaves nothing of that one behind.
set -eu
umask 022

# Relative paths below a folder, parents first; a link is a file.
paths_of() {
  (cd "$1" && find . -mindepth 1 | sed 's|^\./||' | LC_ALL=C sort)
}

# is_folder PATH
is_folder() {
  [ -d "$1" ] && [ ! -L "$1" ]
}

# remove DESTDIR < paths, parents first
remove() {
  LC_ALL=C sort -r | while IFS= read -r path; do
    if is_folder "$1/$path"; then
      rmdir "$1/$path" 2>/dev/null || true
    else
      rm -f "$1/$path"
    fi
  done
}

put() {
  stage=$1
  destination=$2
  list=$destination/$3
  now=$(mktemp)
  before=$(mktemp)
  trap 'rm -f "$now" "$before"' EXIT
  [ ! -f "$list" ] || cat "$list" >"$before"
  mkdir -p "$destination"
  paths_of "$stage" | while IFS= read -r path; do
    if ! is_folder "$stage/$path"; then
      rm -f "$destination/$path"
      cp -P "$stage/$path" "$destination/$path"
    elif [ ! -d "$destination/$path" ]; then
      mkdir "$destination/$path"
    elif ! grep -qxF "$path" "$before"; then
      continue # it was there before us
    fi
    printf '%s\n' "$path"
  done >"$now"
  printf '%s\n' "${3#/}" >>"$now"
  grep -vxF -f "$now" "$before" | remove "$destination" || true
  LC_ALL=C sort -u "$now" >"$list"
  chmod 644 "$list"
}

# before NAME FOLDER: how a shell puts the folder before what the variable has
before() { printf ' %s=%s${%s:+:$%s}' "$1" "$2" "$1" "$1"; }

found() {
  PATH=$PATH:/usr/sbin:/sbin
  loader=$(ldconfig -v -N -X 2>/dev/null | grep -xF "$1:" || true)
  [ -z "$loader" ] || [ "$(id -u)" -ne 0 ] || ldconfig
  settings=$(
    case :$PATH: in *:$2:*) ;; *) before PATH "$2" ;; esac
    [ "$(pkg-config --variable=pcfiledir pneu 2>/dev/null)" = "$1/pkgconfig" ] || before PKG_CONFIG_PATH "$1/pkgconfig"
    [ -n "$loader" ] || before LD_LIBRARY_PATH "$1"
  )
  [ -z "$settings" ] || echo "to use it from there: export$settings"
}

case $1 in
install)
  put "$2" "${3:-/}" "$4"
  ;;
uninstall)
  destination=${2:-/}
  if [ ! -f "$destination/$3" ]; then
    echo "uninstall: no $destination/$3, so that nothing of libpneu is known to be there; PREFIX or DESTDIR may be another" >&2
    exit 1
  fi
  listed=$(mktemp)
  trap 'rm -f "$listed"' EXIT
  cat "$destination/$3" >"$listed"
  remove "$destination" <"$listed"
  ;;
found)
  found "$2" "$3"
  ;;
*)
  echo "install.sh: install, uninstall or found" >&2
  exit 2
  ;;
esac
