#!/bin/sh
# The guides say what happens: every command of their console blocks is run, in the order of the page, and prints what the
# page shows. A line `...` on the page stands for any lines. What a page points to is there. Called from the top folder with the
# folder of the guides, or with pages, or both.
set -u
: "${BUILD:=build}" "${CC:=cc}"
top=$(pwd)
build=$(cd "$BUILD" && pwd)
wrong=0

# steps GUIDE FOLDER: FOLDER/1.sh, 1.want, 2.sh, ... from the page
steps() {
  awk -v folder="$2" '
    /^```/ { console = $0 == "```console"; next }
    !console { next }
    /^\$ / { n++; print substr($0, 3) > (folder "/" n ".sh"); printf "" > (folder "/" n ".want"); more = /\\$/; next }
    more { sub(/^> /, ""); print > (folder "/" n ".sh"); more = /\\$/; next }
    { print > (folder "/" n ".want") }' "$1"
}

# says WANT GOT: whether they agree line by line, `...` apart
says() {
  awk 'NR == FNR { want[++n] = $0; next } { got[++m] = $0 }
    function fits(i, j) {
      if (i > n) return j > m
      if (want[i] == "...") { for (; j <= m + 1; j++) if (fits(i + 1, j)) return 1; return 0 }
      return j <= m && want[i] == got[j] && fits(i + 1, j + 1)
    }
    END { exit !fits(1, 1) }' "$1" "$2"
}

# points_to GUIDE: what it points to beside it
points_to() {
  sed 's/](\([^)]*\))/\n@\1\n/g' "$1" | sed -n 's/^@\([^#:]*\)$/\1/p'
}

if [ -d "$1" ]; then
  for path in $(points_to "$1/README.md"); do
    [ -e "$1/$path" ] || { echo "$1/README.md points to $path"; wrong=$((wrong + 1)); }
  done
  pages=$(ls "$1"/*.md | grep -v README)
  shift
  # shellcheck disable=SC2086
  set -- $pages "$@"
fi
for guide in "$@"; do
  for path in $(points_to "$guide"); do
    [ -e "$(dirname "$guide")/$path" ] || { echo "$guide points to $path"; wrong=$((wrong + 1)); }
  done
  folder="$build/guides/$(basename "$guide" .md)"
  rm -rf "$folder"
  mkdir -p "$folder/place" "$folder/steps"
  cp -R lib study apps "$folder/place"
  for name in tests results packaging python Makefile sweep simulate closeloop; do
    ln -s "$top/$name" "$folder/place/$name"
  done
  ln -s "$build" "$folder/place/build"
  steps "$guide" "$folder/steps"
  n=0
  while [ -e "$folder/steps/$((n + 1)).sh" ]; do
    n=$((n + 1))
    step="$folder/steps/$n"
    (cd "$folder/place" && CC="$CC" sh -e "$step.sh") >"$step.got" 2>&1
    status=$?
    if [ $status -ne 0 ] || ! says "$step.want" "$step.got"; then
      wrong=$((wrong + 1))
      echo "$guide: $(head -n 1 "$step.sh"): status $status; the page says:"
      cat "$step.want"
      echo "it printed:"
      cat "$step.got"
    fi
  done
  [ $n -gt 0 ] || ! grep -q '^```console' "$guide" || { echo "$guide: no command"; wrong=$((wrong + 1)); }
  echo "$guide: $n commands"
done
[ $wrong -eq 0 ]
