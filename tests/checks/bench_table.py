"""The table of bench/table.sh: rows are collected, unknown keys refused, regressions told. With programs that only
pretend to measure: what they really measure is bench/'s business."""
import json
import pathlib
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).resolve().parents[2] / "bench/table.py"


def pretend(folder, name, rows, code=0):
    program = folder / name
    lines = "".join(f"printf 'row\\t{k}\\t{ours}\\t{peer}\\t1.02\\ta note\\n'\n" for k, ours, peer in rows)
    program.write_text(f"#!/bin/sh\necho a table for people\n{lines}exit {code}\n")
    program.chmod(0o755)


def run(folder, *arguments):
    return subprocess.run([sys.executable, str(TABLE), "--bin", str(folder), *arguments], cwd=folder,
                          capture_output=True, text=True)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pretend(folder, "bench_ekf", [("ekf63_sequential", 2e-6, 60e-6), ("ekf63_pass", 5e-6, 60e-6),
                                      ("ekf63_pass_10s", 4e-6, 60e-6)])
        done = run(folder, "ekf63_sequential", "ekf63_pass")
        assert done.returncode == 0, done.stderr
        rows = json.loads((folder / "bench_table.json").read_text())
        assert [r["key"] for r in rows] == ["ekf63_sequential", "ekf63_pass"], rows
        assert abs(rows[0]["ratio"] - 30.0) < 1e-9 and rows[0]["ours_s"] == 2e-6 and rows[0]["note"] == "a note"
        assert "| ekf63_pass |" in (folder / "bench_table.md").read_text()

        # 30 times before, 20 now: told; 12 before and now: not.
        (folder / "bench_table.json").rename(folder / "old.json")
        pretend(folder, "bench_ekf", [("ekf63_sequential", 3e-6, 60e-6), ("ekf63_pass", 5e-6, 60e-6)])
        done = run(folder, "--against", "old.json", "ekf63_sequential", "ekf63_pass")
        assert "ekf63_sequential: 0.67 of what it was" in done.stdout, done.stdout
        assert "ekf63_pass: " not in done.stdout.split("More than a fifth")[1], done.stdout

        done = run(folder, "ekf36_pass")
        assert done.returncode == 2 and "unknown key ekf36_pass" in done.stderr, done.stderr

        pretend(folder, "bench_ekf", [], code=8)
        done = run(folder, "ekf63_pass")
        assert done.returncode == 1 and "ended with 8" in done.stderr, done.stderr


if __name__ == "__main__":
    main()
