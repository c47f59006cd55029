#!/usr/bin/env python3
"""Compares the numbers that the README and the chapters publish with those committed beside this file.

    tests/reference/reference.py PROGRAM [GROUP...]             compare; says what moved, exit code 1 if anything did
    tests/reference/reference.py PROGRAM [GROUP...] --update    write what moved; the diff of the CSV is the review
    tests/reference/reference.py --list                         the groups, and what each runs

Without a group: all but the nightly ones. Every number comes from a command of PROGRAM as a user runs it
(groups.py). GROUP.csv has one row for each: key, value, tolerance, unit, and the kind of number: its rule (so
many sigmas of the number, plus a part of it, plus a constant) and the reason stand in tolerances.csv. `--update` leaves rows that are within their tolerance as they are, so
that a diff shows what moved and nothing else; to write a group from nothing, delete its CSV first.

Exit codes: 0 all hold, 1 something moved, 2 a command failed, 77 a recording that the group needs is absent.
"""
import argparse
import csv
import math
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
import groups  # noqa: E402

HERE = Path(__file__).resolve().parent
COLUMNS = ["key", "value", "tolerance", "unit", "kind"]


def read_rules():
    with open(HERE / "tolerances.csv", newline="") as file:
        return {row["kind"]: row for row in csv.DictReader(file)}


def tolerance_of(number, rules):
    """In the unit of the value; of words and counts 0."""
    if not isinstance(number.value, float):
        return 0.0
    rule = {part: float(rules[number.kind][part]) for part in ("sigmas", "relative", "absolute")}
    return rule["sigmas"] * number.sigma + rule["relative"] * abs(number.value) + rule["absolute"]


def text_of(value):
    if isinstance(value, float):
        return f"{value:.9g}"
    return "" if value is None else str(value)


def rows_of(numbers, rules):
    rows = {}
    for n in numbers:
        if n.key in rows:
            raise SystemExit(f"reference.py: two numbers have the key {n.key}")
        rows[n.key] = {"key": n.key, "value": text_of(n.value), "tolerance": f"{tolerance_of(n, rules):.3g}",
                       "unit": n.unit, "kind": n.kind}
    return rows


def read_rows(path):
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        return {row["key"]: row for row in csv.DictReader(file)}


def write_rows(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def shift(was, now):
    """How far a value moved, in its tolerances; infinite for words that are others."""
    if was["value"] == now["value"]:
        return 0.0
    tolerance = float(was["tolerance"])
    try:
        moved = abs(float(now["value"]) - float(was["value"]))
    except ValueError:
        return math.inf
    return moved / tolerance if tolerance > 0.0 and math.isfinite(moved) else math.inf


def report(group, committed, found, shifts):
    """The moved ones as a table; returns their keys."""
    moved = [key for key, far in shifts.items() if not far <= 1.0]
    if moved:
        print(f"{group}: {len(moved)} of {len(found)} numbers moved")
        width = max(len(key) for key in moved)
        for key in moved:
            was, now = committed.get(key), found.get(key)
            far = f"{shifts[key]:.3g} tolerances of {was['tolerance']} {was['unit']}" if was and now and \
                math.isfinite(shifts[key]) else ""
            print(f"  {key:{width}}  was {was['value'] if was else 'absent'}, "
                  f"is {now['value'] if now else 'absent'}  {far}".rstrip())
    else:
        farthest = max(shifts, key=shifts.get)
        print(f"{group}: {len(found)} numbers hold; the farthest is {farthest}, "
              f"by {shifts[farthest]:.2g} of its tolerance")
    return moved


def check(group, program, rules, update):
    """True if every number holds."""
    with tempfile.TemporaryDirectory(prefix="driftscope_reference_") as scratch:
        found = rows_of(groups.GROUPS[group].numbers(groups.Runner(program, Path(scratch))), rules)
    path = HERE / f"{group}.csv"
    committed = read_rows(path)
    shifts = {key: shift(committed[key], found[key]) if key in committed and key in found else math.inf
              for key in list(found) + [k for k in committed if k not in found]}
    moved = report(group, committed, found, shifts)
    if update and moved:
        write_rows(path, [row if shifts[key] > 1.0 else committed[key] for key, row in found.items()])
        print(f"  written to {path.name}; look at the diff")
    return not moved


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("group", nargs="*", help=", ".join(groups.GROUPS))
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if arguments.list or not arguments.program:
        for name, group in groups.GROUPS.items():
            print(f"{name:18}{'nightly  ' if group.nightly else '         '}{group.what}")
        return 0 if arguments.list else 2
    for name in arguments.group:
        if name not in groups.GROUPS:
            parser.error(f"no group {name} (expected one of {', '.join(groups.GROUPS)})")
    chosen = arguments.group or [name for name, group in groups.GROUPS.items() if not group.nightly]
    rules = read_rules()
    try:
        return 0 if all([check(name, arguments.program, rules, arguments.update) for name in chosen]) else 1
    except groups.Absent as absent:
        print(f"not compared: {absent}")
        return 77
    except groups.Failed as failed:
        print(failed)
        return 2


if __name__ == "__main__":
    sys.exit(main())
