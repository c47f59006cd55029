#!/usr/bin/env bash
# Builds the tree in other ways and runs what each is for:
#   gcc       the fast tests of a build by the compiler that the launcher does not take
#   headers   every header compiles alone
#   asan      the fast tests under the address and undefined behaviour sanitizers, and which lines of what
#             stores and reads users' data they reach
#   tsan      the tests of mc, which share work among threads, under the thread sanitizer
#   fuzz      a million damaged study files, recordings, manifests and worker files under the sanitizers of
#             asan, others every night; MUTANTS: how many, KEEP: where those that fail are kept
#   tidy      clang-tidy, with the checks of .clang-tidy, on every source; OF: on those of some folders
#
#   tests/checks/other_builds.sh [gcc] [headers] [asan] [tsan] [fuzz] [tidy]       all, unless some are named
#
# Each costs a build; together two hours on two cores. ./driftscope test nightly runs them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

[ $# -gt 0 ] || set -- gcc headers asan tsan fuzz tidy
# What the OpenMP library keeps for its threads until the process ends is no leak of ours.
suppressed=$(mktemp)
trap 'rm -f "$suppressed"' EXIT
echo leak:libomp >"$suppressed"
export LSAN_OPTIONS=suppressions=$suppressed
for way; do
  preset=${way/fuzz/asan}
  cmake --preset "$preset" >/dev/null
  case $way in
    fuzz) cmake --build --preset asan --target driftscope_mc_tests ;;
    tidy) cmake --build build/tidy --target drift_commit drift_zoom ;;
    *) cmake --build --preset "$way" ;;
  esac
  case $way in
    gcc) ctest --preset gcc -j "$(nproc)" ;;
    asan)
      rm -rf build/asan/reached
      LLVM_PROFILE_FILE=$PWD/build/asan/reached/%4m.profraw ctest --preset asan -j "$(nproc)"
      tests/checks/reached.sh build/asan
      ;;
    fuzz)
      keep=${KEEP:-$PWD/build/asan/fuzz}
      series=$(date +%Y%m%d)
      echo "fuzz: series $series, failures are kept in $keep"
      DRIFT_FUZZ=${MUTANTS:-1000000} DRIFT_FUZZ_SERIES=$series DRIFT_FUZZ_KEEP=$keep \
        build/asan/bin/driftscope_mc_tests --gtest_filter='Fuzz*'
      ;;
    tidy) run-clang-tidy -quiet -p build/tidy "/(${OF:-core|mc|analysis})/" ;;
    tsan)
      # Archer tells the sanitizer how OpenMP keeps threads apart; the libraries are not instrumented.
      OMP_TOOL_LIBRARIES=$(clang --print-resource-dir)/../../libarcher.so OMP_NUM_THREADS=4 \
        TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=1" \
        build/tsan/bin/driftscope_mc_tests --gtest_filter='Engine*:KeptRuns*:TimeForGroups*:Store*:Manifest*:Salvage*:MonteCarlo*:PointStatistics*:StudyTask*:Trace*'
      ;;
  esac
done
