#!/usr/bin/env bash
# Every C++ source stands as clang-format 14 would have it (.clang-format at the root).
set -euo pipefail
cd "$1"
command -v clang-format >/dev/null || { echo "clang-format is not installed"; exit 77; }
find core mc analysis tests bench -name '*.?pp' -print0 | xargs -0 -P 2 -n 40 clang-format --dry-run -Werror
