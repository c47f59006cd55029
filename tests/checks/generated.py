#!/usr/bin/env python3
"""Documents that the program writes of itself: core/docs/effects.md, of `driftscope terms`, core/docs/study.md, of
`driftscope schema`, and core/docs/plans.md, of `driftscope check`; and how many effects README.md says that there are.

    tests/checks/generated.py PROGRAM             compares; exit code 1 and the difference if one is stale
    tests/checks/generated.py PROGRAM --update    writes them
"""
import difflib
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "core" / "docs"
EFFECTS = """# Effects

Every term of the library, as `driftscope terms KEY` prints it; written by `tests/checks/generated.py`. Sections of
physics.md are those of [Physics](physics.md). w_l: drift of a gyro, w_md: its torquing, w_cp: rate of the platform against the
case, f: specific force, delta: an offset of the attitude; I, O, S: input, output and spin axis of a gyro; dT: deviation of the
temperature from its mean, of one recording or of all that are given together ([what that makes of several simulated
tests](recording.md#several-recordings)). A study brings others: [own terms](own_terms.md).

Sensors on a case read w_g = (I + S) C w_ic + w_l: C takes the true rate to what is read, rows as in gyro_misalignment, S has the s of
torquer_scale, positive where a gyro reads too much, and of x, y, z as input axis O is the next axis and S the one after that, unless
`[mounting]` says otherwise. As a formula that takes the errors off: [a strapdown
unit](../../analysis/docs/real_recording.md#signs-and-how-to-take-the-errors-off).
"""
STUDY = """# The study file

Every key that the reader of study files knows, written by `tests/checks/generated.py` from `driftscope schema`. A file is TOML;
numbers with a unit are texts ("1.45 deg/h/g"). `driftscope check FILE` prints every value of a file, defaults included, and where
it came from. What one key asks of another, and a unit that does not fit, `check` says. A parameter's own key goes before its
group's (`eta_x` before `eta`), in whatever order they stand, and a position's before that of `[plan]`. Terms and parameters:
[effects](effects.md); `[[term]]`: [own terms](own_terms.md); `[recording]`: [the recording](recording.md).
"""


PLANS = """# Plans

The positions of every preset of `plan.preset`, in order, as `driftscope check` prints them; written by
`tests/checks/generated.py`. A recording numbers its positions like this (column `position`), or `[recording] positions` says
which is which. axes: where the platform's axes point, of N(orth), E, S, W, U(p), D(own); two letters: half way between. case: heading
of the case, from North over West, that keeps the middle gimbal below 60 deg (`case_heading` of a recording). Another order, or other attitudes, are written position by position ([the study file](study.md), `plan.position[]`).
There `turn` turns the platform on from `axes`, about one of its own axes, right-handed and by any angle; of a list every turn is about
an axis as the turn before left it. A tumble about y in steps of 30 deg is twelve positions with `axes = "x=N y=W z=U"` and
`turn = "30 deg about y"`, `"60 deg about y"` and so on; at the second x has sunk by 30 deg and reads -0.5 g.
"""


def plans(program):
    yield PLANS
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    config = str(ROOT / "configs" / "diagnose_equation.toml")
    for preset in schema["properties"]["plan"]["properties"]["preset"]["enum"]:
        command = [program, "check", config, "--set", f'plan.preset="{preset}"']
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        first = next(k for k, line in enumerate(lines) if line.split()[:3] == ["position", "name", "axes"])
        yield f"\n## {preset}\n\n| position | name | axes | case | entry |\n|---|---|---|---|---|\n"
        for line in lines[first + 1:]:
            number, name, axes, case, _, entry, *_ = (part.strip() for part in re.split(r"  +", line.strip()))
            yield f"| {number} | {name} | {axes} | {case} | {entry} |\n"


def terms(program, *key):
    return subprocess.run([program, "terms", *key], check=True, capture_output=True, text=True).stdout


def keys(program):
    return re.findall(r"^([a-z0-9_]+) +\d+  ", terms(program), re.M)


def effects(program):
    yield EFFECTS
    for key in keys(program):
        yield f"\n## {key}\n\n" + re.sub(r"^", "    ", terms(program, key).rstrip("\n"), flags=re.M) + "\n"


def readme(program):
    text, places = re.subn(r"the \d+ that are modelled", f"the {len(keys(program))} that are modelled",
                           (ROOT / "README.md").read_text())
    assert places == 1, "README.md says nowhere, or twice, how many effects are modelled"
    yield text


def rows(section, path=""):
    """(key, what it is) of a section and of the tables and lists in it."""
    for key, value in section.get("properties", {}).items():
        what = value.get("description", "").partition(": ")[2] or value.get("description", "")
        if "enum" in value:
            what = "one of " + ", ".join(json.dumps(name) for name in value["enum"])
        yield path + key, what
        below = value if "properties" in value else value.get("items", {})
        if isinstance(below, dict) and "properties" in below:
            yield from rows(below, f"{path}{key}{'[]' if below is not value else ''}.")


def study(program):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    parameters = set(schema["properties"]["published"]["items"]["properties"]) - {"name", "filter"}
    yield STUDY
    for top, section in schema["properties"].items():
        below = list(rows({"properties": {top: section}}))
        yield f"\n## {top}\n\n| key | what |\n|---|---|\n"
        for key, what in below:
            if top == "published" and key.split(".")[1:2] and key.split(".")[1] in parameters:
                continue
            yield f"| `{key}` | {what} |\n"
        if top == "published":
            yield "| `published[].KEY.values`, `published[].KEY.sigmas` | of a parameter: lists of numbers in its unit |\n"


def main():
    program, update = sys.argv[1], "--update" in sys.argv[2:]
    stale = 0
    documents = ((DOCS / "effects.md", effects), (DOCS / "study.md", study), (DOCS / "plans.md", plans),
                 (ROOT / "README.md", readme))
    for path, make in documents:
        text = "".join(make(program))
        if update:
            path.write_text(text)
            continue
        was = path.read_text()
        if was != text:
            stale += 1
            sys.stdout.writelines(difflib.unified_diff(was.splitlines(True), text.splitlines(True), path.name, "the program's"))
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
