#!/usr/bin/env bash
# Builds the tree in other ways, all with Debian's clang, and runs what each is for:
#   headers   every header compiles alone
#   asan      the fast tests under the address and undefined behaviour sanitizers
#   tsan      the tests of mc, which share work among threads, under the thread sanitizer
#
#   tests/checks/other_builds.sh [headers] [asan] [tsan]       all, unless some are named
#
# Each costs a build; together an hour on two cores. ./driftscope test nightly runs them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

[ $# -gt 0 ] || set -- headers asan tsan
for way; do
  cmake --preset "$way" >/dev/null
  cmake --build --preset "$way"
  case $way in
    asan)
      # What the OpenMP library keeps for its threads until the process ends is no leak of ours.
      suppressed=$(mktemp)
      trap 'rm -f "$suppressed"' EXIT
      echo leak:libomp >"$suppressed"
      LSAN_OPTIONS=suppressions=$suppressed ctest --preset asan -j "$(nproc)"
      ;;
    tsan)
      # Archer tells the sanitizer how OpenMP keeps threads apart; the libraries are not instrumented.
      OMP_TOOL_LIBRARIES=$(clang --print-resource-dir)/../../libarcher.so OMP_NUM_THREADS=4 \
        TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=1" \
        build/tsan/bin/driftscope_mc_tests --gtest_filter='Engine*:Store*:Manifest*:MonteCarlo*:PointStatistics*:StudyTask*:Trace*'
      ;;
  esac
done
