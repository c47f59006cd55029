#!/usr/bin/env bash
# Installs a build, compiles the examples against what was installed, from another folder, and runs them: by
# CMake, and by pkg-config. A study that one of them ran is one for the program.
#
#   tests/installed.sh CMAKE BUILD_FOLDER [pkg-config]
set -euo pipefail
cmake=$1 build=$2
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
study=$scratch/prefix/share/driftscope/configs/cheap.toml
"$scratch/prefix/bin/driftscope" check "$study" >/dev/null
"$here/checks/hardened.sh" "$scratch/prefix/bin/driftscope" "$(sed -n "s/^CMAKE_BUILD_TYPE:[A-Z]*=//p" "$build/CMakeCache.txt")"
python3 -c 'import json, sys; parts = json.load(open(sys.argv[1]))["components"]; missing = {"SUNDIALS", "Eigen", "HDF5", "Random123", "toml++", "Boost"} - {p["name"] for p in parts}; assert not missing, missing' \
  "$scratch"/prefix/share/doc/driftscope/sbom.cdx.json
[ -s "$scratch/prefix/share/doc/driftscope/SECURITY.md" ] && [ -s "$scratch/prefix/share/doc/driftscope/CITATION.cff" ]
grep -q '^\.TH DRIFTSCOPE 1' "$scratch/prefix/share/man/man1/driftscope.1"
PYTHONPATH=$scratch/prefix/share/driftscope/python python3 -c 'import driftscope; driftscope.open' # needs nothing but Python
cp -r "$here/example" "$scratch/source"

if [ "${3:-}" = pkg-config ]; then
  export PKG_CONFIG_PATH=$scratch/prefix/lib/x86_64-linux-gnu/pkgconfig:$scratch/prefix/lib/pkgconfig
  for name in example study; do
    # shellcheck disable=SC2046
    c++ -O1 "$scratch/source/$name.cpp" -o "$scratch/$name" $(pkg-config --cflags --libs driftscope)
  done
else
  "$cmake" -S "$scratch/source" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
  "$cmake" --build "$scratch/build" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
  cp "$scratch/build/example" "$scratch/build/study" "$scratch"
fi
"$scratch/example" "$study" | tee "$scratch/said"
grep -q 'the plan says [1-9]' "$scratch/said"
for executed in 100 0; do
  "$scratch/study" "$study" "$scratch/folder" | tee "$scratch/said"
  grep -q "^complete true, executed now $executed, results [0-9a-f]" "$scratch/said"
  [ "$(sed -n 's/^memory, //p' "$scratch/said")" = "$(sed -n 's/^folder, //p' "$scratch/said")" ]
done
"$scratch/prefix/bin/driftscope" verify "$scratch/folder"
"$scratch/prefix/bin/driftscope" run "$study" --runs 100 -o "$scratch/folder" --progress none
