#!/usr/bin/env bash
# All C++ is as clang-format 14 leaves it. Another version formats otherwise.
#
#   tests/checks/format.sh        says which lines are not
#   tests/checks/format.sh -i     formats them
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

for tool in clang-format-14 clang-format none; do
  [[ $($tool --version 2>/dev/null) == *"version 14."* ]] && break
done
if [ "$tool" = none ]; then
  printf 'format.sh: Skipped\nclang-format 14 is not installed\n'
  exit 77
fi
[ "${1:-}" = -i ] && how=(-i) || how=(--dry-run -Werror)
find core mc analysis tests bench -name '*.[ch]pp' -print0 | xargs -0 -n 50 -P "$(nproc)" "$tool" "${how[@]}"
