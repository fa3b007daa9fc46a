#!/bin/sh
# Arrows go one way: a file includes only what is in its own room or in one below. What the lab's objects in BUILD show of
# themselves begins with lab_. Each check is first made to fail.
set -eu
: "${CC:=cc}" "${BUILD:=build}"

# From the ground up.
rooms='lib lib/effects apps/fmu/runtime
  apps/lab/base apps/lab/log apps/lab/rig apps/lab/run apps/lab/check apps/lab/fit apps/lab/trace apps/lab/change apps/lab/metrics
  apps/lab/discriminate apps/lab/report apps/lab/api apps/lab/batch apps/lab/batch/mpi apps/web apps/study apps/fmu apps'
# Rooms that see nothing but themselves and one other.
alone='lib:lib lib/effects:lib apps/fmu/runtime:lib'

# Lines "file:#include "path"" on stdin; prints those that go up.
upward()
{
  awk -v rooms="$rooms" -v alone="$alone" '
    function folder(path) { sub("/[^/]*$", "", path); return path }
    function reach(path) {
      path = "/" path
      while (match(path, "/[^/]+/\\.\\./"))
        path = substr(path, 1, RSTART) substr(path, RSTART + RLENGTH)
      return substr(path, 2)
    }
    BEGIN {
      n = split(rooms, list); for (i = 1; i <= n; i++) place[list[i]] = i
      n = split(alone, list); for (i = 1; i <= n; i++) { split(list[i], pair, ":"); only[pair[1]] = pair[2] }
    }
    {
      file = $0; sub(":.*", "", file)
      path = $0; sub("^[^\"]*\"", "", path); sub("\".*", "", path)
      from = folder(file); to = folder(reach(from "/" path))
      if (path ~ /\.inc$/) next # made from a file, not one
      if (!(from in place)) print "no room of that name: " file
      else if (!(to in place) || place[to] > place[from] || (from in only && to != from && to != only[from]))
        print file " includes " path
    }'
}

# unprefixed OBJECT...: names that they define for others without the prefix; a compiler's own have a dot
unprefixed() { nm -g "$@" | awk 'NF == 3 && $3 !~ /^(lab_|\.)/ { print $3 }'; }

# objects: what the sources of the lab have become
objects()
{
  for source in apps/lab/*/*.c; do
    object=$BUILD/${source%.c}.o
    [ ! -e "$object" ] || echo "$object"
  done
}

fail() { echo "$1"; exit 1; }

[ -n "$(echo 'lib/flow.c:#include "../apps/lab/base/text.h"' | upward)" ] || fail "the check sees nothing"
[ -n "$(echo 'apps/lab/log/log.c:#include "../rig/rig.h"' | upward)" ] || fail "the check sees nothing"
[ -z "$(echo 'apps/lab/rig/rig.c:#include "../log/log.h"' | upward)" ] || fail "the check minds an arrow downwards"

found=$(find lib apps -name '*.[ch]' -exec grep -H '^#include "' {} + | upward)
[ -z "$found" ] || fail "$found"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo 'int astray(void); int astray(void) { return 0; }' | $CC -x c -c - -o "$scratch/astray.o"
[ "$(unprefixed "$scratch/astray.o")" = astray ] || fail "the check of names sees nothing"
[ -n "$(objects)" ] || fail "no objects of the lab in $BUILD: make all"
# shellcheck disable=SC2046
found=$(unprefixed $(objects))
[ -z "$found" ] || fail "names of the lab without lab_: $found"
echo "rooms: no include goes up; names of the lab begin with lab_"
