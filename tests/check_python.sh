#!/bin/sh
# The Python package, from `make python-check`: the wheel in a virtual environment of its own, its tests and its notebook.
set -eu
: "${BUILD:=build}"
folder=$BUILD/python
rm -rf "$folder"
mkdir -p "$folder"

wrong() {
  tail -n 30 "$folder/log" >&2
  echo "check_python: $1" >&2
  exit 1
}

wheel=$(find "$BUILD/wheel" -maxdepth 1 -name 'pneu-*-manylinux*.whl')
[ -n "$wheel" ] || wrong "there is no wheel: make wheel"
python3 -m venv "$folder/venv" >"$folder/log" 2>&1 || wrong "no virtual environment"
"$folder/venv/bin/pip" install "$wheel[test]" >"$folder/log" 2>&1 || wrong "the wheel does not install"

# What it has inside it takes from there.
inside=$("$folder/venv/bin/python" -c 'import pneu, os; print(os.path.dirname(pneu.__file__))')
ldd "$inside/libpneulab.so" >"$folder/log"
for library in sundials nlopt config udunits cjson gomp; do
  grep "lib$library" "$folder/log" | grep -q pneu.libs || wrong "lib$library is not the wheel's own"
  find "$inside/licences" -name "*$library*" | grep -q . || wrong "the licence of lib$library is not in the wheel"
done

PROGRAMS=$BUILD/bin "$folder/venv/bin/python" -m pytest -p no:cacheprovider -v python/tests >"$folder/log" 2>&1 ||
  wrong "tests of the package"
sed -n 's/^.*::\(.*\) PASSED.*/ok      python: \1/p' "$folder/log"
