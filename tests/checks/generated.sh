#!/usr/bin/env bash
# Documents that the program writes of itself: core/docs/effects.md, of `driftscope terms`.
#
#   tests/checks/generated.sh PROGRAM             compares; exit code 1 and the difference if one is stale
#   tests/checks/generated.sh PROGRAM --update    writes it
set -euo pipefail
program=$1
effects=$(dirname "${BASH_SOURCE[0]}")/../../core/docs/effects.md

write_effects() {
  echo "# Effects"
  echo
  echo "Every term of the library, as \`driftscope terms KEY\` prints it; written by \`tests/checks/generated.sh\`. Sections of"
  echo "physics.md are those of [Physics](physics.md). w_l: drift of a gyro, w_md: its torquing, w_cp: rate of the platform against the"
  echo "case, f: specific force, delta: an offset of the attitude; I, O, S: input, output and spin axis of a gyro."
  "$program" terms | sed -n 's/^\([a-z0-9_]\+\)  *[0-9]\+  .*/\1/p' | while read -r key; do
    printf '\n## %s\n\n' "$key"
    "$program" terms "$key" | sed 's/^/    /'
  done
}

if [ "${2:-}" = --update ]; then
  write_effects >"$effects"
else
  diff -u "$effects" <(write_effects)
fi
