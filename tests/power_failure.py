#!/usr/bin/python3
"""Lets the power fail at every moment of a study that is being stored, and looks at what can be left.

    tests/power_failure.py SYNTHETIC DISK_LOG [STATES] [SEED]

DISK_LOG is the library of tests/support/disk_log.cpp: it writes down every call of a study that
changes a file. A state is what a disk may hold if the power fails after any one of them:

- What a file held at its last fsync it holds. Of what was written since, each sector of 512 bytes
  may have arrived or not, in any order.
- A new size arrives before, with or without what lies in it: zeros, where it did.
- Names (made, renamed, removed) arrive in the order in which they were given, up to any of them; all
  of a folder with its fsync, that of a file with its own.

From every state the same command must end as if nothing had happened, with the same digest, nothing
damaged, and with every run that had been stored, the folder's fsync after its transaction included.
"""
import collections
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

SECTOR = 512
STUDY = """schema = 1
title  = "synthetic columns=12 points=2 fail_every=50"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
[truth]
coupling = "eq5"
[[filter]]
name     = "eq5"
coupling = "eq5"
[monte_carlo]
runs = 640
allowed_failures = 99
"""


class File:
    """What a disk holds of a file for certain, and what was asked of it since."""

    def __init__(self, size=0):
        self.safe = bytearray(size)
        self.since = []  # ("write", at, bytes) or ("size", n)

    def whole(self):
        return self.after(self.since)

    def after(self, changes, sectors=None):
        data = bytearray(self.safe)
        for change in changes:
            if change[0] == "size":
                data = data[: change[1]] + bytes(max(0, change[1] - len(data)))
                continue
            at, new = change[1], change[2]
            data += bytes(max(0, at + len(new) - len(data)))
            begin = at
            while begin < at + len(new):
                end = min(at + len(new), (begin // SECTOR + 1) * SECTOR)
                if sectors is None or sectors():
                    data[begin:end] = new[begin - at : end - at]
                begin = end
        return data

    def torn(self, draw):
        """Some of the changes, or sectors of them."""
        kind = draw.randrange(4)
        if kind == 0:
            return bytearray(self.safe)
        if kind == 1:
            return self.whole()
        changes = self.since[: draw.randrange(len(self.since) + 1)]
        return self.after(changes, None if kind == 2 else lambda: draw.random() < 0.5)

    def sync(self):
        self.safe, self.since = self.whole(), []


class Disk:
    def __init__(self):
        self.files = {}
        self.safe = {}  # names that have arrived: path -> file
        self.names = {}  # as the program sees them
        self.since = []  # ("bind", path, file) or ("free", path)

    def bind(self, path, file):
        self.names[path] = file
        self.since.append(("bind", path, file))

    def free(self, path):
        self.names.pop(path, None)
        self.since.append(("free", path))

    @staticmethod
    def renamed(names, changes):
        names = dict(names)
        for change in changes:
            if change[0] == "bind":
                names[change[1]] = change[2]
            else:
                names.pop(change[1], None)
        return names

    def arrive(self, wanted):
        """All up to the last change that is wanted: they arrive in order."""
        last = max((k for k, c in enumerate(self.since) if wanted(c)), default=-1) + 1
        self.safe = self.renamed(self.safe, self.since[:last])
        del self.since[:last]

    def apply(self, fields, data):
        kind = fields[0]
        if kind == "open":
            file = self.files.setdefault(fields[1], File(int(fields[2])))
            if self.names.get(fields[3]) is not file:
                self.bind(fields[3], file)
        elif kind == "write":
            self.files[fields[1]].since.append(("write", int(fields[2]), data))
        elif kind == "size":
            self.files[fields[1]].since.append(("size", int(fields[2])))
        elif kind == "sync":
            file = self.files[fields[1]]
            file.sync()
            self.arrive(lambda c: c[0] == "bind" and c[2] is file)
        elif kind == "syncdir":
            self.arrive(lambda c: str(pathlib.Path(c[1]).parent) == fields[1])
        elif kind == "rename":
            file = self.names[fields[1]]
            self.bind(fields[2], file)
            self.free(fields[1])
        elif kind == "link":
            self.bind(fields[2], self.names[fields[1]])
        elif kind == "unlink":
            self.free(fields[1])
        else:
            raise ValueError(kind)
        if kind in ("rename", "unlink"):  # another file may get the number of one that is gone
            for number in [n for n, f in self.files.items() if f not in self.names.values()]:
                del self.files[number]

    def left(self, draw):
        """What may be left: path -> bytes."""
        names = self.renamed(self.safe, self.since[: draw.randrange(len(self.since) + 1)])
        made = {}
        return {p: made.setdefault(id(f), f.torn(draw)) for p, f in names.items()}

    def seen(self):
        return {p: f.whole() for p, f in self.names.items()}


def records(log):
    at = 0
    while at < len(log):
        end = log.index(b"\n", at)
        fields = log[at:end].decode().split("\t")
        at = end + 1
        count = int(fields[3]) if fields[0] == "write" else 0
        yield fields, log[at : at + count]
        at += count


def put(folder, files):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for path, data in files.items():
        (folder / pathlib.Path(path).name).write_bytes(data)


def main():
    synthetic, library = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:3])
    states = int(sys.argv[3]) if len(sys.argv) > 3 else 150
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    scratch = pathlib.Path(tempfile.mkdtemp()).resolve()
    try:
        check(synthetic, library, scratch, states, seed)
    except AssertionError:
        print(f"what was left: {scratch / 'left'}", file=sys.stderr)
        raise
    shutil.rmtree(scratch)


def check(synthetic, library, scratch, states, seed):
    study, folder, log = scratch / "study.toml", scratch / "out", scratch / "log"
    study.write_text(STUDY)

    def run(*arguments, **environment):
        command = ["env"] + [f"{k}={v}" for k, v in environment.items()] + [synthetic, *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=120)

    def whole(**environment):
        return run("run", study, "--threads", 1, "--progress", "none", "-o", folder, **environment)

    def digest():
        return re.search(r"^results (\w+)", run("verify", folder, "--sample", "0%").stdout, re.M)

    def stored():
        end = run("status", folder)
        found = re.search(r": (\d+) of ", end.stdout)
        return int(found[1]) if found else (0, print(end.stdout, end.stderr, file=sys.stderr))[0]

    first = whole(LD_PRELOAD=library, DRIFT_DISK_LOG=log, DRIFT_DISK_UNDER=str(folder) + "/")
    assert first.returncode == 0, first.stderr
    expected, total = digest()[1], stored()
    journal = list(records(log.read_bytes()))

    # The log is true: played back it is what the program left, byte for byte.
    disk, before = Disk(), collections.OrderedDict()  # runs stored after each transaction
    ends = [k for k, (f, _) in enumerate(journal) if f[0] == "unlink" and f[1].endswith("-journal")]
    for k, (fields, data) in enumerate(journal):
        disk.apply(fields, data)
        if k in ends:
            left, kept = disk.seen(), scratch / "kept"
            if k == ends[-1] or k % 7 == 0:
                folder.rename(kept)
                put(folder, left)
                before[k] = stored()
                shutil.rmtree(folder)
                kept.rename(folder)
    for path, data in disk.seen().items():
        assert pathlib.Path(path).read_bytes() == data, f"{path}: the log of calls is not all that happened"
    assert before[ends[-1]] == total > 0, before

    draw = random.Random(seed)
    moments = sorted(draw.choices(range(1, len(journal)), k=states))
    disk, done, fewest = Disk(), 0, None
    for moment in moments:
        while done < moment:
            disk.apply(*journal[done])
            done += 1
        put(folder, disk.left(draw))
        last = [k for k in ends if k + 1 < moment]  # and the folder is synced, the call after it
        floor = max((before[k] for k in last if k in before), default=0)
        what = f"power fails after call {moment} of {len(journal)} ({' '.join(journal[moment - 1][0])}), seed {seed}"
        shutil.rmtree(scratch / "left", ignore_errors=True)
        shutil.copytree(folder, scratch / "left")
        got = stored()
        assert got >= floor, f"{what}: {got} runs are left, {floor} had been stored"
        end = whole()
        assert end.returncode == 0, f"{what}: exit {end.returncode}\n{end.stderr}"
        assert "damage" not in end.stderr, f"{what}: {end.stderr}"
        found = digest()
        assert found and found[1] == expected, f"{what}: other results"
    print(f"{states} power failures at {len(set(moments))} of {len(journal)} calls, "
          f"{len(ends)} transactions: nothing stored is lost, the same results")


main()
