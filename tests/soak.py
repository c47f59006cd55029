#!/usr/bin/python3
"""Lets a study run for a while and looks whether it takes more and more: memory, open files, threads.

    tests/soak.py PROGRAM CONFIG [SECONDS] [THREADS]

After a fifth of the time (600 s) as warm-up, resident memory must have grown by no more than 1 MB at the
end (which engine.md allows an hour), and the number of open files and threads must be what it was. A
study that was ended by its wall time is then resumed for a moment: what is stored is read as it is.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

MOST_GROWTH = 1024  # [kB] after the warm-up
MOST_RUNS = 50000  # a second and thread: more than any machine gets through


def fail(what):
    sys.exit(f"FAILED: {what}")


def look(process):
    """Resident memory [kB], open files, threads; None where the process has ended."""
    proc = pathlib.Path(f"/proc/{process}")
    try:
        status = (proc / "status").read_text()
        files = [os.readlink(f) for f in (proc / "fd").iterdir()]
    except OSError:
        return None
    if "VmRSS" not in status:
        return None
    # A journal is open while a transaction is written, the folder while it is synced.
    steady = [f for f in files if f.endswith((".sqlite", ".lock"))]
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]), len(steady), int(re.search(r"Threads:\s+(\d+)", status)[1])


def main(program, config, seconds=600.0, threads=2):
    with tempfile.TemporaryDirectory() as scratch:
        command = [program, "run", config, "--progress", "none", "-o", scratch + "/out",
                   "--threads", str(threads), "--runs", str(int(seconds * threads * MOST_RUNS))]
        process = subprocess.Popen([*command, "--max-wall", f"{seconds:.0f} s"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        began, seen = time.monotonic(), []
        while process.poll() is None:
            time.sleep(min(1.0, seconds / 100))
            if (now := look(process.pid)) and time.monotonic() - began < seconds:
                seen.append((time.monotonic() - began, *now))
        said = process.stderr.read()
        if process.returncode != 75:
            fail(f"exit {process.returncode}, expected 75 (out of time): {said}")
        steady = [row for row in seen if row[0] > seconds / 5]
        first, last = steady[0], steady[-1]
        runs = re.search(r"(\d+) executed", said)[1]
        print(f"{runs} runs in {seconds:.0f} s: memory {first[1]} kB after {first[0]:.0f} s, {last[1]} kB at the end, "
              f"{max(row[1] for row in steady)} kB at most; {last[2]} files, {last[3]} threads")
        if max(row[1] for row in steady) - first[1] > MOST_GROWTH:
            fail("memory grows")
        if len({row[2:] for row in steady}) > 1:
            fail(f"open files or threads: {sorted({row[2:] for row in steady})}")
        again = subprocess.run([*command, "--max-wall", "1 s"], capture_output=True, text=True)
        if again.returncode != 75 or f"{runs} runs stored before" not in again.stderr:
            fail(f"resumed: exit {again.returncode}: {again.stderr}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], *map(float, sys.argv[3:4]), *map(int, sys.argv[4:]))
