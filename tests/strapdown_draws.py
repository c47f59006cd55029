#!/usr/bin/env python3
"""A strapdown unit with more noise: strapdown_draws.py DRIFTSCOPE RECORDING

To the recording of the PSINS toolbox (analysis/docs/real_recording.md) white noise of 0.3, 1, 2, 5 and 10 times its
own is added, from fixed seeds, and `identify` and `diagnose` are asked each time. Nothing may be found that is not
there, what is told must be the same parameters, and all errors in sigmas together must have an rms of 0.8 to 1.25.
They are no independent numbers: draws share the noise that the recording came with, and estimates are correlated.
The rms is said with what it may vary by, and the chi-square of all of them counts both; the correlations of estimates
are those of a second implementation (independent_strapdown.py). With the accelerometers read in turns, lever arms and
delay must be named. Skipped (77) where the recording is absent.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import independent_strapdown as other

TIMES = (0.3, 1.0, 2.0, 5.0, 10.0)  # the recording's own noise
SEEDS = (1, 2, 3, 4)  # of each
STUDY = pathlib.Path(__file__).resolve().parents[1] / "configs/strapdown_psins.toml"
SAMPLES = 100.0  # [Hz]
GYRO, ACC = np.sqrt(other.WALK * SAMPLES), other.ACC * np.sqrt(SAMPLES)  # of a sample of the recording
MOST_DRIFT = 0.005  # [deg/h]
MOST_PULL = 4.5  # of the numbers of 20 draws
MOST_CHI2 = 3.29  # in standard deviations: once in a thousand

# What its simulator knew, by the names and units of `identify`.
TRUTH = {"D_F_x": -0.1, "D_F_y": -0.2, "D_F_z": -0.3, "s_x": -10, "s_y": -20, "s_z": -30, "xi_x": 10, "eta_x": 20,
         "eta_y": 30, "xi_y": 40, "xi_z": 50, "eta_z": 60, "K0_x": -10, "K0_y": -20, "K0_z": -30, "K1_x": -10,
         "K1_y": -20, "K1_z": -30, "K2_x": -10, "K2_y": -20, "K2_z": -30, "dO_y": 10, "dP_z": 20, "dO_z": 30}
ARMS = {"arm_x_x": -1, "arm_y_x": -2, "arm_z_x": -3, "arm_x_y": -4, "arm_y_y": -5, "arm_z_y": -6, "arm_x_z": 0,
        "arm_y_z": 0, "arm_z_z": 0, "acc_delay": -1}
# The names of the second implementation.
NAMES = {**{key: name for key, (name, _) in other.SAME.items()}, "dO_y": "Ayx", "dP_z": "Azx", "dO_z": "Azy",
         **{f"K1_{a}": f"A{a}{a}" for a in "xyz"}}


def asked(program, command, recording, folder, *more):
    subprocess.run([program, command, STUDY, recording, "-o", folder, "--threads", "1", "--progress", "none", *more],
                   check=True, stdout=subprocess.DEVNULL)
    name = {"identify": "identification.json", "diagnose": "diagnosis.json"}[command]
    return json.loads((pathlib.Path(folder) / name).read_text())


def noisier(text, rows, times, seed, path):
    """The recording with more noise; of seed 0 as it is."""
    random, more = np.random.default_rng((seed, round(10 * times))), rows.copy()
    more[:, 1:4] += times * GYRO * random.standard_normal((len(rows), 3))
    more[:, 4:7] += times * ACC * random.standard_normal((len(rows), 3))
    np.savetxt(path, more, delimiter=",", fmt="%.10g", header="\n".join(text), comments="")


def correlations(recording):
    """Of the estimates, in the order of TRUTH. Of a linear part that the cubic one hides nothing else depends on."""
    names = [other.NAMES[k] for k in other.FREE]
    _, P, _ = other.estimate(recording)
    at = [names.index(NAMES.get(key, key)) for key in TRUTH]
    sigma = np.sqrt(np.diag(P)[at])
    R = P[np.ix_(at, at)] / np.outer(sigma, sigma)
    for k, key in enumerate(TRUTH):
        if key.startswith("K1_"):
            R[k, :] = R[:, k] = 0.0
            R[k, k] = 1.0
    return R


def pulls(parameters, truth):
    said = {p["key"]: (p["value"] - truth[p["key"]]) / p["sigma"] for p in parameters}
    assert said.keys() == truth.keys(), f"told are {sorted(said)}"
    return np.array([said[key] for key in truth])


def rms(numbers):
    return np.sqrt(np.mean(np.square(numbers)))


def together(z, times, R, what):
    """z: a row for each draw. The rms, and the chi-square of all of them, as correlated as they are."""
    root = np.sqrt(1.0 + np.square(times))
    shared = 1.0 / np.outer(root, root)  # the recording's own noise in both
    np.fill_diagonal(shared, 1.0)
    count = z.size
    wander = np.sqrt(2.0 * np.sum(np.square(shared)) * np.sum(np.square(R))) / count  # of the mean square
    chi2 = np.sum(z * np.linalg.solve(shared, np.linalg.solve(R, z.T).T))
    off = (chi2 - count) / np.sqrt(2.0 * count)
    print(f"{what}: rms {rms(z):.3f} of {count} errors in sigmas (noise takes it to {np.sqrt(1 - wander):.2f} to "
          f"{np.sqrt(1 + wander):.2f}, as many as {2 / wander ** 2:.0f} independent ones); largest "
          f"{np.max(np.abs(z)):.1f}; chi-square {chi2:.0f} of {count}, {off:+.1f} standard deviations")
    assert 0.8 <= rms(z) <= 1.25, what
    assert np.max(np.abs(z)) < MOST_PULL, what
    assert off < MOST_CHI2, what


def as_it_rests(ask, recording, make):
    draws, z, verdicts = [], [], []
    for times, seed in [(0.0, 0), *((k, seed) for k in TIMES for seed in SEEDS)]:
        path = make(times, seed)
        told = ask("identify", path)["filters"][0]["parameters"]
        of_draw = pulls(told, TRUTH)
        d = ask("diagnose", path)
        verdicts.append(d["verdict"])
        print(f"noise +{times:g}, seed {seed}: {d['verdict']} {d['probabilities']['consistent']:.2f}, "
              f"rms {rms(of_draw):.2f} of {len(told)}", flush=True)
        assert not any(c["term"] == "g_drift" for c in d["causes"]), "g-sensitive drift is claimed"
        if seed == 0:
            off = max(abs(p["value"] - TRUTH[p["key"]]) for p in told if p["key"].startswith("D_F"))
            print(f"drift within {off:.4f} deg/h")
            assert off < MOST_DRIFT
        else:
            draws.append(times)
            z.append(of_draw)
    assert set(verdicts) == {"consistent"}, verdicts
    z, draws, R = np.array(z), np.array(draws), correlations(recording)
    for times in TIMES:
        print(f"noise +{times:g}: rms {rms(z[draws == times]):.2f}")
    together(z, draws, R, "all draws")
    seen = [k for k, key in enumerate(TRUTH) if not key.startswith("K1_")]
    together(z[:, seen], draws, R[np.ix_(seen, seen)], "without linear parts that the prior of the cubic hides")


def read_in_turns(ask, make):
    for times, seed in [(0.0, 0), *((k, SEEDS[0]) for k in TIMES)]:
        d = ask("diagnose", make(times, seed), "--set", "plan.accelerometers_in_turns=true")
        assert d["verdict"] == "named", d["sentence"]
        assert {c["term"] for c in d["causes"]} == {"inner_lever_arm", "accelerometer_delay"}, d["sentence"]
        z = pulls([p for c in d["causes"] for p in c["parameters"]], ARMS)
        print(f"in turns, noise +{times:g}: lever arms and delay named, rms {rms(z):.2f}, largest "
              f"{np.max(np.abs(z)):.1f} ({list(ARMS)[int(np.argmax(np.abs(z)))]})", flush=True)
        assert np.max(np.abs(z)) < MOST_PULL


def main():
    program, recording = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    if not recording.exists():
        print(f"skipped: {recording.name} is no part of the repository")
        sys.exit(77)
    text = recording.read_text().splitlines()[:2]
    rows = np.loadtxt(recording, delimiter=",", skiprows=2)
    with tempfile.TemporaryDirectory() as scratch:

        def make(times, seed):
            if seed == 0:
                return recording
            path = pathlib.Path(scratch) / "draw.csv"
            noisier(text, rows, times, seed, path)
            return path

        def ask(command, path, *more):
            return asked(program, command, path, pathlib.Path(scratch) / command, *more)

        as_it_rests(ask, recording, make)
        read_in_turns(ask, make)


main()
