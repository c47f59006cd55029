"""The table of bench/table.sh: runs the benchmarks, one core each where they allow, and collects their rows.

A row is {key, ours_s, peer_s, ratio, note}: CPU seconds of one unit of work with driftscope and with its peer
(null where there is none), ratio = peer_s / ours_s; of the rows peak_... the peer is the core itself, whose fused
multiply-adds alone would take peer_s. `spread` tells how far our own repetitions were apart.
"""
import argparse
import json
import os
import pathlib
import platform
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
REGRESSION = 0.8  # a ratio below this part of the stored one is told

# Which program prints which rows.
PROGRAMS = {
    "bench_ekf": ["ekf63_sequential", "ekf63_lanes", "ekf63_pass", "ekf63_pass_alone", "ekf63_pass_10s"],
    "bench_study": ["run_one_pass", "run_iterated", "threads2"],
    "bench_sensitivities": ["sensitivities_cvodes", "sensitivities_alone"],
    "bench_servo": ["servo_dwell", "servo_slew"],
    "bench_kernels": ["peak_covariance", "peak_information", "peak_factorise"],
}
COMMANDS = ["diagnose24", "rank_improve"]
PYTHON = "ekf63_numpy"
KEYS = [k for keys in PROGRAMS.values() for k in keys] + [PYTHON] + COMMANDS


def row(key, ours, peer, spread, note):
    ratio = peer / ours if peer and ours else None
    return {"key": key, "ours_s": ours, "peer_s": peer, "ratio": ratio, "spread": spread, "note": note}


def of_program(folder, program):
    one_core = {min(os.sched_getaffinity(0))}
    pinned = None if program == "bench_study" else lambda: os.sched_setaffinity(0, one_core)  # that one has threads
    done = subprocess.run([str(folder / program)], cwd=ROOT, capture_output=True, text=True, preexec_fn=pinned)
    sys.stderr.write(done.stdout + done.stderr)
    if done.returncode:
        sys.exit(f"{program} ended with {done.returncode}: the answers of the two sides differ, or it failed")
    for line in done.stdout.splitlines():
        if line.startswith("row\t"):
            _, key, ours, peer, spread, note = line.split("\t")
            yield row(key, float(ours), float(peer), float(spread), note)


def of_numpy(ours):
    """The step of `ekf63_sequential` as it is written in Python: predict, and update in Joseph's form, three scalars
    twice, over dense arrays of numpy. Its numbers are not ours, its shapes are; so it is about time alone."""
    sys.path.insert(0, str(ROOT / "bench"))
    try:
        import numpy_ekf
    except ImportError as error:
        sys.stderr.write(f"{PYTHON}: left out, {error} (Debian: python3-numpy)\n")
        return []
    seconds = [numpy_ekf.seconds_of_a_step() for _ in range(5)]
    return [row(PYTHON, ours["ours_s"], min(seconds), ours["spread"],
                "covariance step of 63 states, 6 scalars, against dense arrays of numpy, Joseph's form")]


def cpu_of(command, folder):
    """CPU seconds of a command and its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def of_command(folder, key):
    program = str(folder / "driftscope")
    with tempfile.TemporaryDirectory() as work:
        if key == "diagnose24":
            study = str(ROOT / "configs/diagnose_equation.toml")
            cpu_of([program, "simulate", study, "-o", "rec.csv"], work)
            command = [program, "diagnose", study, "rec.csv", "--threads", "1"]
            note = "configs/diagnose_equation.toml, 24 positions at 60 s, one thread"
        else:
            command = [program, "rank", str(ROOT / "configs/table1.toml"), "--improve", "3"]
            note = "rank configs/table1.toml --improve 3"
        times = [cpu_of(command + ["-o", f"out{k}"], work) for k in range(2)]
    return row(key, min(times), None, max(times) / min(times), note)


def machine():
    cpu = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
    return {"cpu": cpu, "cores": os.cpu_count(), "load": os.getloadavg()[0], "system": platform.platform()}


def markdown(rows, where):
    lines = [f"{where['cpu']}, {where['cores']} cores, load {where['load']:.1f}; CPU time on both sides", "",
             "| key | ours [s] | peer [s] | ratio | spread | what |", "|---|---|---|---|---|---|"]
    for r in rows:
        number = lambda v, form: "-" if v is None else format(v, form)
        lines.append(f"| {r['key']} | {number(r['ours_s'], '.3g')} | {number(r['peer_s'], '.3g')} "
                     f"| {number(r['ratio'], '.3g')} | {number(r['spread'], '.2f')} | {r['note']} |")
    return "\n".join(lines) + "\n"


def regressions(rows, stored):
    """Rows whose ratio, or whose time where they have no peer, is more than a fifth worse than it was."""
    old = {r["key"]: r for r in stored}
    for r in rows:
        was = old.get(r["key"])
        if not was or not r["ours_s"] or not was["ours_s"]:
            continue
        part = r["ratio"] / was["ratio"] if r["ratio"] and was["ratio"] else was["ours_s"] / r["ours_s"]
        if part < REGRESSION:
            yield f"{r['key']}: {part:.2f} of what it was"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("keys", nargs="*", metavar="KEY", help=f"of {', '.join(KEYS)}; none: all")
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("--against", type=pathlib.Path, help="an older bench_table.json to compare with")
    options = parser.parse_args()
    unknown = [k for k in options.keys if k not in KEYS]
    if unknown:
        parser.error(f"unknown key {', '.join(unknown)} (expected of {', '.join(KEYS)})")
    wanted = options.keys or KEYS
    stored = json.loads(options.against.read_text()) if options.against else None
    rows = []
    for program, keys in PROGRAMS.items():
        if set(keys) & set(wanted):
            rows += [r for r in of_program(options.bin, program) if r["key"] in wanted]
    if PYTHON in wanted:
        ours = next(r for r in rows + list(of_program(options.bin, "bench_ekf")) if r["key"] == "ekf63_sequential")
        rows += of_numpy(ours)
    rows += [of_command(options.bin, key) for key in COMMANDS if key in wanted]
    where = machine()
    for r in rows:
        r["machine"] = f"{where['cpu']}, {where['cores']} cores, load {where['load']:.1f}"
    pathlib.Path("bench_table.json").write_text(json.dumps(rows, indent=1) + "\n")
    text = markdown(rows, where)
    pathlib.Path("bench_table.md").write_text(text)
    print(text)
    if stored:
        told = list(regressions(rows, stored))
        print("\n".join(["More than a fifth worse than before:"] + told) if told
              else "Nothing is more than a fifth worse than before.")


if __name__ == "__main__":
    main()
