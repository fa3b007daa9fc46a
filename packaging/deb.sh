#!/bin/sh
# Debian packages from a copy of this tree, into FOLDER; what lintian says of them ends it.
#   deb.sh FOLDER VERSION      VERSION: MAJOR.MINOR.PATCH, as lib/pneu.h has it
# Version, date and licence are filled in from lib/pneu.h, the last commit and LICENSE; MAINTAINER="Name <address>" says who
# answers for the packages.
set -eu
folder=$1
version=$2
major=${version%%.*}
minor=${version#*.}
minor=${minor%.*}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
tree=$folder/libpneu-$version

rm -rf "$folder"
mkdir -p "$tree"
# What git knows of, and what it would add; without git, everything but what make has built.
files() {
  if git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard
  else
    find . -path ./build -prune -o -type f -print
  fi
}
files | while IFS= read -r file; do
  [ ! -e "$file" ] || printf '%s\n' "$file"
done | tar -cf - -T - | tar -xf - -C "$tree"
: "${SOURCE_DATE_EPOCH:=$(git log -1 --format=%ct 2>/dev/null || date -r lib/pneu.h +%s)}"
export SOURCE_DATE_EPOCH

cp -R packaging/debian "$tree/debian"
cd "$tree/debian"
sed -e "s/@VERSION@/$version/" -e "s/@DATE@/$(date -u -R -d "@$SOURCE_DATE_EPOCH")/" changelog.in >changelog
sed -i "s/@NEXT@/$major.$((minor + 1))/" rules
sed "s/@COPYRIGHT@/$(sed -n 's/^Copyright (c) //p' ../LICENSE)/" copyright.in >copyright
sed -n '/^Permission/,$p' ../LICENSE | sed -e 's/^$/./' -e 's/^/ /' >>copyright
[ -z "${MAINTAINER:-}" ] || sed -i "s/libpneu authors <libpneu@example.org>/$MAINTAINER/" control changelog
rm changelog.in copyright.in
cd ..
# the build begins afresh, without what this make was told
env -u MAKEFLAGS -u MFLAGS -u MAKEOVERRIDES -u BUILD -u CFLAGS -u LDFLAGS dpkg-buildpackage -b -us -uc >"$folder/build.log" 2>&1 || {
  tail -n 40 "$folder/build.log" >&2
  exit 1
}
cd ..
rm -rf "libpneu-$version"
lintian --allow-root --fail-on error,warning --tag-display-limit 0 ./*.changes
ls -l ./*.deb | awk '{printf "%8.1f KB  %s\n", $5 / 1024, $NF}'
