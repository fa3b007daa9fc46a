#!/bin/sh
# What `make install` puts there, from another project's view: users by pkg-config, by CMake and with a copy of the sources
# build and run; the shared library shows what pneu.h declares and no more, and refuses a user of another version; programs
# find their data; manual and completion agree with --help; uninstall leaves nothing.
# What cannot be tried here is told by a line that begins with "absent:".
set -eu
: "${MAKE:=make}" "${CC:=cc}" "${CXX:=c++}" "${BUILD:=build}"
mkdir -p "$BUILD"
BUILD=$(cd "$BUILD" && pwd)
here=$(pwd)
folder=$BUILD/install
root=$folder/root
prefix=$root/usr
rm -rf "$folder"
mkdir -p "$folder"

have() { command -v "$1" >/dev/null 2>&1; }

wrong() {
  echo "check_install: $1" >&2
  exit 1
}

# The same folder as PREFIX below DESTDIR, and then moved: nothing may depend on where it was made.
install_to() {
  $MAKE --no-print-directory BUILD="$BUILD" "$@" install >"$folder/make.log" 2>&1 || { tail "$folder/make.log" >&2; exit 1; }
}

install_to PREFIX=/usr DESTDIR="$folder/made"
mv "$folder/made" "$root"

# ---- Versions: one number everywhere ----

version=$(sed -n 's/^Version: //p' "$prefix/lib/pkgconfig/pneu.pc")
printf '#include <stdio.h>\n#include <pneu.h>\nint main(void) { return puts(PNEU_VERSION) < 0; }\n' >"$folder/version.c"
$CC -I"$prefix/include/pneu" "$folder/version.c" -o "$folder/version"
[ "$("$folder/version")" = "$version" ] || wrong "pneu.pc and pneu.h differ in their version"
[ -f "$prefix/lib/libpneu.so.$version" ] || wrong "no libpneu.so.$version"
for program in "$prefix"/bin/*; do
  name=$(basename "$program")
  [ "$("$program" --version)" = "$name (libpneu) $version" ] || wrong "$name --version is not $version"
done

# ---- Symbols ----

# Declared functions as the compiler sees them: the second way beside packaging/functions.awk.
printf '#include <pneu.h>\n' | $CC -E -P -I"$prefix/include/pneu" - | tr '\n' ' ' | tr ';{}' '\n\n\n' |
  grep -v '^ *typedef' | sed -n 's/^[^(=]*[ *]\(pneu_[a-z0-9_]*\) *(.*)[^)]*$/\1/p' | sort -u >"$folder/declared"
exported() { nm -D --defined-only "$1" | awk '$2 != "A" {sub("@.*", "", $3); print $3}' | sort -u; }
exported "$prefix/lib/libpneu.so" >"$folder/exported"
[ "$(wc -l <"$folder/declared")" -gt 30 ] || wrong "hardly any function is declared"
diff "$folder/declared" "$folder/exported" >&2 || wrong "the shared library does not export what pneu.h declares (<, >)"
readelf -d "$prefix/lib/libpneu.so" | grep -q "SONAME.*\[libpneu.so.${version%%.*}\]" || wrong "soname"
readelf -d "$prefix/lib/libpneu.so" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -vE '^(libm|libc|ld-linux.*)\.' &&
  wrong "the shared library needs more than libm"

# ---- A user by pkg-config ----

export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
cp -R tests/consumers/pkg-config "$folder/pkg-config"
run_shared() { LD_LIBRARY_PATH="$1" "$2"; }
if have pkg-config; then
  CC=$CC CFLAGS="-O2 -Werror" $MAKE --no-print-directory -C "$folder/pkg-config" >"$folder/make.log" 2>&1 ||
    { cat "$folder/make.log" >&2; wrong "pkg-config: does not build"; }
  run_shared "$prefix/lib" "$folder/pkg-config/strokes" >"$folder/strokes.txt" || wrong "pkg-config: does not run"
  grep -q "libpneu $version: success" "$folder/strokes.txt" || wrong "pkg-config: it does not say what it should"
  readelf -d "$folder/pkg-config/strokes" | grep -q 'NEEDED.*libpneu\.so\.' || wrong "pkg-config: not the shared library"
  # a library of another MINOR lacks the version that the user asks for
  mkdir "$folder/other"
  echo 'PNEU_9.9 { global: pneu_*; local: *; };' >"$folder/other.map"
  $CC -shared -Wl,-soname,"libpneu.so.${version%%.*}" -Wl,--version-script,"$folder/other.map" \
    "$BUILD"/shared/lib/*.o "$BUILD"/shared/lib/effects/*.o -lm -o "$folder/other/libpneu.so.${version%%.*}"
  run_shared "$folder/other" "$folder/pkg-config/strokes" >/dev/null 2>"$folder/refused.txt" &&
    wrong "a user of one MINOR runs with the library of another"
  grep -q "version .PNEU_" "$folder/refused.txt" || wrong "refused for another reason: $(cat "$folder/refused.txt")"
  # and without pkg-config's path, from the folder above
  printf '#include <pneu/pneu.h>\nint main(void) { return PNEU_EFFECT_COUNT == 0; }\n' >"$folder/above.c"
  $CC -I"$prefix/include" "$folder/above.c" -o "$folder/above" && "$folder/above" || wrong "#include <pneu/pneu.h>"
else
  echo "absent: pkg-config"
fi

# ---- A user in C++ by CMake ----

if have cmake; then
  cmake -S tests/consumers/cmake -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Werror" >"$folder/cmake.log" 2>&1 &&
    cmake --build "$folder/cmake" >>"$folder/cmake.log" 2>&1 || { tail -n 30 "$folder/cmake.log" >&2; wrong "CMake: does not build"; }
  "$folder/cmake/dead_volume" >"$folder/shared.txt" || wrong "CMake: does not run"
  "$folder/cmake/dead_volume_static" >"$folder/static.txt" || wrong "CMake: static, does not run"
  cmp "$folder/shared.txt" "$folder/static.txt" || wrong "shared and static library do not give the same"
  readelf -d "$folder/cmake/dead_volume_static" | grep -q libpneu && wrong "CMake: static, but needs the shared library"
  # takes VERSION: may find_package(pneu VERSION) succeed?
  takes() {
    rm -rf "$folder/asks"
    mkdir "$folder/asks"
    printf 'cmake_minimum_required(VERSION 3.13)\nproject(asks CXX)\nfind_package(pneu %s REQUIRED)\n' "$1" >"$folder/asks/CMakeLists.txt"
    cmake -S "$folder/asks" -B "$folder/asks/build" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null 2>&1
  }
  minor=${version%.*}
  takes "" && takes "${version%%.*}" && takes "$minor" && takes "$version EXACT" || wrong "CMake: version $version is refused"
  takes "$minor.99" && wrong "CMake: $version passes for a later one"
  takes "${version%%.*}.0" && wrong "CMake: $version passes for another MINOR"
else
  echo "absent: cmake"
fi

# ---- A user in C90 with a copy of lib/ ----

mkdir "$folder/copied"
cp -R lib tests/consumers/copied/hold.c "$folder/copied"
(
  cd "$folder/copied"
  for file in lib/*.c lib/effects/*.c; do
    $CC -std=c99 -pedantic-errors -O1 -c "$file"
  done
  $CC -std=c90 -pedantic-errors -Wall -Wextra -Werror -Ilib -c hold.c
  $CC ./*.o -lm -o hold
  ./hold >hold.txt
) || wrong "C90 with a copy of lib/"

# ---- Programs away from the sources ----

away=$folder/away
mkdir "$away"
(
  cd "$away"
  PATH=$prefix/bin:$PATH
  study=$prefix/share/pneu/study
  simulate "$study/actuators/r1-400.cfg" --step --out step.csv
  [ "$(wc -l <step.csv)" -eq 3052 ]
  export-fmu "$study/actuators/r1-400.cfg" -o r1-400.fmu
  [ -s r1-400.fmu ]
  printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
    cat "$study/actuators/r1-400.cfg" - >rig.cfg
  awk 'NR == 1 || NR % 20 == 0' step.csv >log.csv
  closeloop rig.cfg log.csv --quiet --out answer >said.txt
  [ -s answer/report.html ] && [ -s answer/model.h ]
  simulate answer/model.cfg log.csv >again.csv
  sweep "$study/hypotheses.cfg" --quiet --no-figures --results study >sweep.txt 2>&1
  [ -s study/REPORT.md ] && [ -s study/hypotheses.csv ]
) || wrong "a program does not work outside the source tree"

# model.h and the installed header are enough to build the completed model
printf '#include <pneu.h>\n#include "model.h"\nstatic const pneu_params p = MODEL_PARAMS;\nstatic const pneu_laws law = MODEL_LAWS;\nstatic pneu_model model;\nint main(void) { return pneu_model_init(&model, &p, &law, 0); }\n' >"$folder/model.c"
$CC -std=c99 -Wall -Wextra -Werror -I"$away/answer" -I"$prefix/include/pneu" "$folder/model.c" "$prefix/lib/libpneu.a" -lm \
  -o "$folder/model" && "$folder/model" || wrong "model.h with the installed header"

# ---- Manual ----

for page in "$prefix"/share/man/man*/*; do
  if have man; then
    LC_ALL=C.UTF-8 man -l --warnings "$page" 2>"$folder/man.log" >/dev/null || wrong "man: $page"
    [ -s "$folder/man.log" ] && { cat "$folder/man.log" >&2; wrong "man: warnings in $page"; }
  fi
  if have mandoc; then
    # pages that are not installed are no fault, but those of libpneu must be among what is
    mandoc -T lint "$page" 2>&1 | grep -v 'mandoc\.db lacks\|referenced manual not found' >"$folder/man.log" &&
      { cat "$folder/man.log" >&2; wrong "mandoc: $page"; }
    mandoc -T lint "$page" 2>&1 | sed -n 's/.*not found: Xr \([a-z-]*\) \([0-9]\).*/\1.\2/p' >"$folder/references"
    while read -r reference; do
      case $reference in
      gnuplot.1 | mpirun.1 | pkg-config.1) ;;
      *) [ -f "$prefix/share/man/man${reference##*.}/$reference" ] || wrong "$page refers to $reference" ;;
      esac
    done <"$folder/references"
  fi
done
have man || echo "absent: man"
have mandoc || echo "absent: mandoc"

# options PROGRAM, page_options PAGE: the same, of --help and of the manual
options() { "$1" --help | sed -n 's/^  --\([a-z-]*\).*/\1/p' | sort -u; }
page_options() { sed -n 's/^\.It Fl -\([a-z-]*\).*/\1/p' "$1" | sort -u; }
for program in "$prefix"/bin/*; do
  page=$prefix/share/man/man1/$(basename "$program").1
  [ -f "$page" ] || wrong "no page for $(basename "$program")"
  options "$program" >"$folder/options"
  page_options "$page" | diff "$folder/options" - >&2 || wrong "$page and --help differ in their options (<, >)"
done
while read -r name; do
  grep -q "^\.F[no] $name\b" "$prefix/share/man/man3/libpneu.3" || wrong "libpneu(3) does not have $name"
done <"$folder/declared"

# ---- Pages on the interface: Doxygen is told to fail on a warning ----

if have doxygen; then
  $MAKE --no-print-directory BUILD="$folder" docs >"$folder/docs.log" 2>&1 || { cat "$folder/docs.log" >&2; wrong "make docs"; }
  for name in pneu_model_init pneu_run pneu_jacobian; do
    grep -q "paramname.*$name\|$name.*(" "$folder"/docs/html/group__*.html || wrong "no page has $name"
  done
  grep -q '<td class="paramname">law</td>' "$folder"/docs/html/group__*.html || wrong "arguments are not documented"
else
  echo "absent: doxygen"
fi

# ---- Completion ----

PATH=$prefix/bin:$PATH sh tests/check_completion.sh "$prefix/share" "$folder/completion" || wrong "completion"

# ---- Uninstall ----

# What others have there stays; so do folders that were there before.
install_to PREFIX=/usr DESTDIR="$folder/shared"
find "$folder/shared" | sed "s|$folder/shared||" | sort >"$folder/first"
echo mine >"$folder/shared/usr/lib/mine"
: >"$folder/shared/usr/include/pneu/older.h" # as an older version may have left it
printf 'usr/include/pneu/older.h\n' >>"$folder/shared/usr/share/pneu/installed.txt"
install_to PREFIX=/usr DESTDIR="$folder/shared"
rm "$folder/shared/usr/lib/mine"
find "$folder/shared" | sed "s|$folder/shared||" | sort | diff "$folder/first" - >&2 || wrong "installed twice is not installed once"
echo mine >"$folder/shared/usr/lib/mine"
$MAKE --no-print-directory BUILD="$BUILD" PREFIX=/usr DESTDIR="$folder/shared" uninstall
[ "$(cd "$folder/shared" && find . -type f -o -type l)" = ./usr/lib/mine ] || wrong "uninstall: not all and only its own"
rm -r "$folder/shared"
mkdir -p "$folder/shared/usr/lib"
install_to PREFIX=/usr DESTDIR="$folder/shared"
$MAKE --no-print-directory BUILD="$BUILD" PREFIX=/usr DESTDIR="$folder/shared" uninstall
[ "$(cd "$folder/shared" && find . | sort | tr '\n' ' ')" = ". ./usr ./usr/lib " ] || wrong "uninstall leaves folders, or takes those of others"
$MAKE --no-print-directory BUILD="$BUILD" PREFIX=/usr DESTDIR="$folder/shared" uninstall 2>/dev/null && wrong "uninstall of nothing"

# An absolute prefix, without DESTDIR, and libraries in a folder of the kind of machine
install_to PREFIX="$folder/opt" LIBDIR="$folder/opt/lib/kind"
if have pkg-config; then
  (
    eval "$(sed -n 's/^to use it from there: //p' "$folder/make.log")" &&
      $CC "$folder/pkg-config/strokes.c" $(pkg-config --cflags --libs pneu) -o "$folder/kind" &&
      "$folder/kind" >/dev/null && [ "$(command -v sweep)" = "$folder/opt/bin/sweep" ]
  ) || wrong "LIBDIR=lib/kind: what make install says to set is not enough"
fi
(cd "$away" && "$folder/opt/bin/sweep" hypotheses.cfg --quiet --no-figures --results found >/dev/null 2>&1 &&
  cmp found/hypotheses.csv study/hypotheses.csv) || wrong "sweep does not find the installed study"
$MAKE --no-print-directory BUILD="$BUILD" PREFIX="$folder/opt" LIBDIR="$folder/opt/lib/kind" uninstall
[ ! -e "$folder/opt/lib" ] || wrong "uninstall with LIBDIR"
cd "$here"
echo "check_install: libpneu $version is installed, used and gone"
