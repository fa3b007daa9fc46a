# A page with what it carries: a line "@carry NAME" becomes the file of that name in the first of `folders` that has it,
# "@version" the version.
# SPDX-License-Identifier: MIT
BEGIN { n = split(folders, folder, " ") }
/^@carry / {
  for (i = 1; i <= n; i++) {
    path = folder[i] "/" $2
    for (lines = 0; (getline line < path) > 0; lines++) print line
    close(path)
    if (lines) next
  }
  print "carry.awk: no file " $2 > "/dev/stderr"
  exit 1
}
{ sub(/@version/, version); print }
