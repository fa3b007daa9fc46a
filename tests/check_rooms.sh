#!/bin/sh
# Arrows go one way: a file includes only what is in its own room or in one below.
# The check is first made to fail on an include that goes up.
set -eu

# From the ground up.
rooms='lib lib/effects apps/fmu/runtime
  apps/lab/base apps/lab/log apps/lab/rig apps/lab/run apps/lab/check apps/lab/fit apps/lab/trace apps/lab/metrics
  apps/lab/separate apps/lab/report apps/lab/batch apps/lab/batch/mpi apps/study apps/fmu apps'
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

fail() { echo "$1"; exit 1; }

[ -n "$(echo 'lib/flow.c:#include "../apps/lab/base/text.h"' | upward)" ] || fail "the check sees nothing"
[ -n "$(echo 'apps/lab/log/log.c:#include "../rig/rig.h"' | upward)" ] || fail "the check sees nothing"
[ -z "$(echo 'apps/lab/rig/rig.c:#include "../log/log.h"' | upward)" ] || fail "the check minds an arrow downwards"

found=$(find lib apps -name '*.[ch]' -exec grep -H '^#include "' {} + | upward)
[ -z "$found" ] || fail "$found"
echo "rooms: no include goes up"
