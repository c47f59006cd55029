#!/usr/bin/python3
"""Sends signals to a study at random moments and looks at how it ends, and that nothing stored is lost.

    tests/stop_signals.py PROGRAM CONFIG [SIGNALS] [SEED]

A study is begun again and again in the same folder, by 1 to 4 threads or as one of two workers, until
SIGNALS (20) of them have met one at work; a complete folder is compared with an undisturbed one and the
next is begun. One signal in eight is followed by a second one at once. Each time:

- the exit code is 130 for an interrupt and else 143; what comes before the program listens ends it by
  the signal itself;
- one line on standard error, the last, says what is stored, and no fewer runs are than before;
- nothing is in the folder but results: no temporary file, no half of one.
"""
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGUSR2]
RESULTS = re.compile(r"manifest\.json|study\.toml|\.driftscope|worker-\d+\.(sqlite|sqlite-journal|lock)"
                     r"|report\.html|summary\.json")


def fail(what):
    sys.exit(f"FAILED: {what}")


def command(program, config, folder, *options):
    return [program, "run", config, "--progress", "none", "-o", folder, *options]


def digest(program, folder):
    said = subprocess.run([program, "verify", folder, "--sample", "0%"], capture_output=True, text=True)
    found = re.search(r"^results (\w+)", said.stdout, re.M)
    return found.group(1) if found else fail(f"verify: {said.stdout}{said.stderr}")


def stored(program, folder):
    """Runs that are stored, of how many."""
    if not (folder / "manifest.json").exists():
        return 0, None
    said = subprocess.run([program, "status", folder], capture_output=True, text=True).stdout
    found = re.search(r": (\d+) of (\d+)", said)
    return (int(found[1]), int(found[2])) if found else fail(f"status: {said}")


def own_code(number):
    return 130 if number == signal.SIGINT else 143


def allowed(first, second):
    """Exit codes; of two signals at once either may come first."""
    both = {first, second} - {None}
    return {own_code(n) for n in both} | {-n for n in both}


class Trial:
    """One call of the program that a signal meets, or that ends before."""

    def __init__(self, draw, program, config, folder, longest):
        part = draw.choice([[], ["--worker", f"{draw.randrange(2)}/2"]])
        self.first = draw.choice(SIGNALS)
        self.second = draw.choice(SIGNALS) if draw.random() < 0.125 else None
        process = subprocess.Popen(command(program, config, folder, *part, "--threads", str(draw.randint(1, 4))),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(draw.uniform(0.0, longest))
        self.met = process.poll() is None
        began = time.monotonic()
        if self.met:
            process.send_signal(self.first)
            if self.second:
                process.send_signal(self.second)
        _, self.said = process.communicate()
        self.seconds = time.monotonic() - began
        self.code = process.returncode

    def check(self):
        what = f"signals {self.first} and {self.second}: exit {self.code}\n{self.said}"
        ended = {0, 5, 75}  # all there, with failed runs, or this worker's part only
        if self.met and self.code not in allowed(self.first, self.second) | ended or \
                not self.met and self.code not in ended:
            fail(what)
        if self.met and self.code == own_code(self.first) and not self.second:
            # A worker that is done tells its summary, which counts stored runs too, before it is stopped.
            lines = self.said.splitlines()
            told = [line for line in lines if line.startswith("stopped: ")]
            if len(told) != 1 or lines[-1] != told[0] or "stored" not in told[0]:
                fail(f"not one line, the last, that says what is stored: {what}")


def main(program, config, wanted=20, seed=1):
    draw = random.Random(seed)
    waits, before_listening = [], 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        began = time.monotonic()
        subprocess.run(command(program, config, scratch / "reference", "--threads", "1"), capture_output=True)
        took = time.monotonic() - began
        reference = digest(program, scratch / "reference")
        round_, studies = 0, 0
        while len(waits) < wanted:
            folder = scratch / f"study{round_}"
            round_ += 1
            before, total = stored(program, folder)
            while total is None or before < total:
                trial = Trial(draw, program, config, folder, took / 4)
                trial.check()
                if trial.met and trial.code > 0:
                    waits.append(trial.seconds)
                before_listening += trial.met and trial.code < 0
                now, total = stored(program, folder)
                if now < before:
                    fail(f"{before} runs were stored, {now} are after signal {trial.first}")
                before = now
                names = [p.name for p in folder.glob("*")] if trial.code >= 0 else []
                strange = [name for name in names if not RESULTS.fullmatch(name)]
                if strange:
                    fail(f"signal {trial.first} leaves {strange}")
            studies += 1
            if digest(program, folder) != reference:
                fail("other results than undisturbed")
    waits.sort()
    print(f"{len(waits)} signals at work, {before_listening} before the program listens, {studies} studies of "
          f"equal results; from the signal to the end {waits[len(waits) // 2]:.3f} s (median), {waits[-1]:.3f} s at most")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
