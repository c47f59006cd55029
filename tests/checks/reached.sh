#!/usr/bin/env bash
# Which lines of what stores and reads users' data the tests of a build reached, folder by folder, and the
# lines that throw and were not reached.
#
#   tests/checks/reached.sh BUILD_FOLDER        after tests with LLVM_PROFILE_FILE=BUILD_FOLDER/reached/%4m.profraw
set -euo pipefail
build=$1
tools=$(ls -d /usr/lib/llvm-*/bin | sort -V | tail -n 1)
"$tools/llvm-profdata" merge -sparse "$build"/reached/*.profraw -o "$build/reached/all.profdata"
objects=()
for program in "$build"/bin/driftscope*; do objects+=(-object "$program"); done
"$tools/llvm-cov" export -format=lcov -instr-profile="$build/reached/all.profdata" "${objects[@]}" \
  >"$build/reached/lines.lcov" 2>/dev/null
python3 - "$build/reached/lines.lcov" "$build/reached/not_thrown.txt" <<'PYTHON'
import collections, os, re, sys

hits = collections.defaultdict(lambda: collections.defaultdict(int))  # file -> line -> times
for text in open(sys.argv[1]):
    if text.startswith("SF:"):
        file = os.path.relpath(text[3:].strip())
        ours = file.startswith(("core/base/", "core/recording/", "core/config/", "mc/"))
    elif ours and text.startswith("DA:"):
        line, times = text[3:].split(",")[:2]
        hits[file][int(line)] += int(times)

folders = collections.defaultdict(lambda: [0, 0, 0, 0])
missed = []
for file, lines in hits.items():
    source = open(file).read().split("\n")
    of = folders[os.path.dirname(file)]
    for line, times in lines.items():
        of[0] += times > 0
        of[1] += 1
        if re.search(r"\bthrow\b|\brefuse|\bfail\(", source[line - 1]):
            of[2] += times > 0
            of[3] += 1
            if not times:
                missed.append(f"{file}:{line}: {source[line - 1].strip()}")
print(f"{'folder':32} {'lines reached':>22} {'lines that refuse':>22}")
for folder, (reached, lines, thrown, throws) in sorted(folders.items()) + [("all", [sum(x) for x in zip(*folders.values())])]:
    share = lambda a, b: f"{a} of {b}, {100 * a / b:3.0f} %" if b else "-"
    print(f"{folder:32} {share(reached, lines):>22} {share(thrown, throws):>22}")
open(sys.argv[2], "w").write("\n".join(sorted(missed)) + "\n")
print(f"{len(missed)} lines that refuse and were not reached: {sys.argv[2]}")
PYTHON
