#!/bin/sh
# The libraries that the lab needs, built for another machine from Debian's source packages, static.
#   libraries.sh TARGET PREFIX    TARGET: wasm (Emscripten), windows (MinGW, 64 bits)
# PREFIX gets include/, lib/ and licences, one text. What is there already is not built again. UDUNITS is not among them: units/ has what
# takes its place.
set -eu
target=$1
mkdir -p "$2"
prefix=$(cd "$2" && pwd)

# Source package and its version.
packages="sundials 6.4.1+dfsg1-3
nlopt 2.7.1-5
libconfig 1.5-0.4
cjson 1.7.15-1+deb12u4"

# How a target is configured, and its compiler's flags.
flags="-O3 -ffp-contract=off"
case $target in
wasm)
  NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
  export NODE_PATH
  configure="emconfigure ./configure --host=wasm32-unknown-linux-gnu"
  cmake="emcmake cmake"
  # CMake looks for sizes in the linked file, where Emscripten has none.
  sizes="-DHAVE_HAS_int64_t=1 -DHAS_int64_t=8 -DHAVE_SIZEOF_UINT32_T=1 -DSIZEOF_UINT32_T=4 -DHAVE_SIZEOF_UNSIGNED_INT=1 \
-DSIZEOF_UNSIGNED_INT=4 -DHAVE_SIZEOF_UNSIGNED_LONG=1 -DSIZEOF_UNSIGNED_LONG=4"
  ;;
windows)
  host=x86_64-w64-mingw32
  configure="./configure --host=$host CC=$host-gcc-posix"
  # No C++ is compiled, but CMake asks for its compiler.
  cmake="cmake -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_C_COMPILER=$host-gcc-posix -DCMAKE_CXX_COMPILER=$host-gcc-posix -DCMAKE_CXX_COMPILER_WORKS=1 -DCMAKE_RC_COMPILER=$host-windres"
  sizes=
  # The numbers of C99: the system's own printf has three digits in an exponent.
  flags="$flags -D__USE_MINGW_ANSI_STDIO=1"
  # Of export-fmu, which runs in no browser.
  packages="$packages
libzip 1.7.3-1
libxml2 2.9.14+dfsg-1.3~deb12u6"
  ;;
*)
  echo "libraries.sh: expected the target wasm or windows, found $target" >&2
  exit 2
  ;;
esac

log=$prefix/log
wrong() {
  tail -n 30 "$log" >&2
  echo "libraries.sh: $1" >&2
  exit 1
}

# Sources come from where the system has its packages, by lists of their own, so that the system's stay as they are.
sources() {
  mkdir -p "$prefix/apt/lists/partial" "$prefix/src"
  # shellcheck disable=SC2016
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | sort -u >"$prefix/apt/sources.list"
  own_apt update
}

# Under the lock of study/install-packages.sh: where a system cleans up after an update, it takes packages from under an
# installation.
own_apt() {
  flock "${TMPDIR:-/tmp}/libpneu-install-$(id -u).lock" apt-get -q -o Dir::Etc::sourcelist="$prefix/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::lists="$prefix/apt/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=root "$@" >>"$log" 2>&1
}

# fetch NAME VERSION: its folder of sources. A version that the distribution has replaced is gone: then that of now.
fetch() {
  [ -d "$prefix/apt/lists" ] || sources || wrong "no lists of source packages"
  rm -rf "$prefix/src/$1" "$prefix/src/$1"_*
  (cd "$prefix/src" && { own_apt source --download-only "$1=$2" || own_apt source --download-only "$1"; }) || wrong "no source of $1 $2"
  (cd "$prefix/src" && dpkg-source -x "$1"_*.dsc "$1" >>"$log" 2>&1) || wrong "the source of $1 does not unpack"
}

# by_cmake NAME SETTINGS...
by_cmake() {
  source=$prefix/src/$1
  shift
  # shellcheck disable=SC2086
  $cmake $sizes -S "$source" -B "$source/made" -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS="$flags" -DCMAKE_INSTALL_PREFIX="$prefix" \
    -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF "$@" >>"$log" 2>&1 &&
    $MAKE -C "$source/made" install >>"$log" 2>&1
}

build_sundials() {
  set --
  for part in ARKODE CVODES IDA IDAS KINSOL; do set -- "$@" -DBUILD_$part=OFF; done
  by_cmake sundials "$@" -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_ENABLE_CXX=OFF -DEXAMPLES_INSTALL=OFF
}

# Without the algorithms of Luksan, whose licence is the LGPL.
build_nlopt() {
  by_cmake nlopt -DNLOPT_LUKSAN=OFF -DNLOPT_CXX=OFF -DNLOPT_FORTRAN=OFF -DNLOPT_PYTHON=OFF -DNLOPT_OCTAVE=OFF -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF \
    -DNLOPT_SWIG=OFF -DNLOPT_TESTS=OFF
}

# The library alone; what else lies in the package is no use here.
build_libconfig() {
  (cd "$prefix/src/libconfig" &&
    $configure --prefix="$prefix" --disable-shared --disable-cxx --disable-examples CFLAGS="$flags" &&
    $MAKE -C lib install) >>"$log" 2>&1
}

build_cjson() {
  by_cmake cjson -DENABLE_CJSON_TEST=OFF -DENABLE_CUSTOM_COMPILER_FLAGS=OFF
}

# With zlib alone, which the system has for MinGW.
build_libzip() {
  set --
  for part in COMMONCRYPTO GNUTLS MBEDTLS OPENSSL WINDOWS_CRYPTO BZIP2 LZMA ZSTD; do set -- "$@" -DENABLE_$part=OFF; done
  for part in TOOLS REGRESS EXAMPLES DOC; do set -- "$@" -DBUILD_$part=OFF; done
  by_cmake libzip "$@" -DZLIB_LIBRARY="/usr/$host/lib/libz.a" -DZLIB_INCLUDE_DIR="/usr/$host/include"
}

build_libxml2() {
  set --
  for part in ICONV LZMA PYTHON ZLIB TESTS PROGRAMS; do set -- "$@" -DLIBXML2_WITH_$part=OFF; done
  by_cmake libxml2 "$@"
}

: "${MAKE:=make}"
: >"$log"
echo "$packages" | while read -r name version; do
  [ "$(cat "$prefix/done-$name" 2>/dev/null)" = "$version" ] && continue
  echo "  $name $version for $target"
  fetch "$name" "$version"
  "build_$name" || wrong "$name does not build"
  echo "$version" >"$prefix/done-$name"
done

# What must go with a program that has them inside.
for name in $(echo "$packages" | cut -d ' ' -f 1); do
  for text in LICENSE NOTICE COPYING COPYING.LIB COPYRIGHT Copyright src/algs/*/COPYRIGHT src/algs/*/COPYING; do
    for file in "$prefix/src/$name"/$text; do
      [ ! -f "$file" ] || { printf '==== %s\n\n' "$name/${file#"$prefix/src/$name/"}" && cat "$file" && echo; }
    done
  done
done >"$prefix/licences"
