#!/usr/bin/env bash
# The commit of a build is looked up at every build, and its header is touched only when it changed.
#
#   tests/build_commit.sh cmake
set -euo pipefail
cmake=$1 script=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/core/base/build_commit.cmake
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
export GIT_CEILING_DIRECTORIES=$scratch
header=$scratch/build_commit.hpp
look() { "$cmake" "-DSOURCE=$scratch/tree" "-DOUTPUT=$header" -P "$script"; }
says() { grep -qx "#define DRIFT_COMMIT \"$1\"" "$header" || { echo "expected $1:"; cat "$header"; exit 1; }; }
commit() { git -C tree -c user.name=t -c user.email=t@t commit -qam "$1"; }

mkdir -p tree/core && echo 1 >tree/core/a.cpp && echo 1 >tree/README.md
look && says unknown
git -C tree init -q && git -C tree add . && commit one
look && says "$(git -C tree describe --always)"
touch -d '2001-01-01' "$header" && look
[ "$(stat -c %Y "$header")" -lt 1000000000 ] || { echo "touched though nothing changed"; exit 1; }
echo 2 >tree/README.md && look && says "$(git -C tree describe --always)"
echo 2 >tree/core/a.cpp && look && says "$(git -C tree describe --always)-dirty"
commit two && look && says "$(git -C tree describe --always)"
echo "the header follows the commit"
