"""What each group of reference.py runs, and which numbers it reads from the answer."""
import json
import math
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

ROOT = Path(__file__).resolve().parents[2]
CONFIGS = ROOT / "configs"
RECORDINGS = ROOT.parent / "shared" / "recordings"


class Failed(Exception):
    """A command that should work ended with an error."""


class Absent(Exception):
    """A recording that is no part of the repository is not there."""


@dataclass
class Number:
    key: str
    value: Any  # float: compared within a tolerance; int or str: exactly
    kind: str  # row of tolerances.csv
    unit: str = ""
    sigma: float = 0.0  # for kinds whose rule is "sigmas", in the unit of the value


class Runner:
    """Runs the program in a folder of its own."""

    def __init__(self, program, scratch):
        self.program, self.scratch = str(Path(program).resolve()), scratch

    def __call__(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.scratch, capture_output=True, text=True)
        if done.returncode != 0:
            raise Failed(f"{' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def file(self, name):
        return self.scratch / name

    def json(self, name):
        return json.loads(self.file(name).read_text())


def real(value):
    """Of JSON: null, which stands for what is not a number, stays apart from any number."""
    return None if value is None else float(value)


def sets(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


# --- identify: Table 1

TABLE1 = ["D_I_z", "D_S_x", "eta_x"]  # what the paper prints
FEEDBACK = {"truth.coupling": "compensated", "truth.loop.estimate": "feedback"}
IDENTIFICATIONS = [  # name, study, overrides
    ("eq5", "table1", {}),
    ("eq6", "table1", {"truth.coupling": "eq6"}),
    ("servo", "table1", {"truth.coupling": "servo"}),
    ("feedback", "table1", FEEDBACK),
    ("reduced.eq5", "table1_reduced", {}),
    ("reduced.eq6", "table1_reduced", {"truth.coupling": "eq6"}),
]


def of_identification(name, answer):
    for f in answer["filters"]:
        at = f"truth_{name}.filter_{f['name']}"
        yield Number(f"{at}.unseen_directions", len(f["degeneracies"]), "count")
        for key in TABLE1:
            for estimator in ("ekf", "batch"):
                yield Number(f"{at}.{key}.{estimator}.start_ratio",
                             real(f["parameters"][key]["start_consistency"][estimator]), "ratio", "1")
        for start in f["starts"]:
            for estimator in ("ekf", "batch"):
                here, run = f"{at}.start{start['start']}.{estimator}", start[estimator]
                yield Number(f"{here}.status", run["status"], "word")
                yield Number(f"{here}.chi2_per_dof", real(run["chi2_per_dof"]), "chi2", "1")
                for key in TABLE1:
                    p = run["parameters"][key]
                    yield Number(f"{here}.{key}", real(p["estimate"]), "estimate", p["unit"], p["sigma"])
                    yield Number(f"{here}.{key}.sigma", real(p["sigma"]), "sigma", p["unit"])


def table1(run):
    for name, study, overrides in IDENTIFICATIONS:
        run("identify", CONFIGS / f"{study}.toml", "-o", name, *sets(overrides))
        yield from of_identification(name, run.json(f"{name}/identification.json"))


# --- run: the study table and the sweeps

def of_rate(key, rate):
    yield Number(key, rate["hits"], "count", f"of {rate['of']} runs")


def name_of_point(values):
    """Its swept values: "six.eq5"; of a table the quantities in it that are not zero."""
    words = [re.findall(r'"([^"]*)"', v) if v.startswith("{") else [v] for v in values.values()]
    flat = dict.fromkeys(w.replace(" ", "") for group in words for w in group if not w.startswith("0 "))
    return ".".join(flat)


def of_study(answer):
    for point in answer["points"]:
        name = name_of_point(point["values"])
        for f in point["filters"]:
            at = f"{name}.filter_{f['name']}"
            known = [p["coverage"][1] for p in f["parameters"] if p["learning_ratio"] < 0.5]
            yield Number(f"{at}.within_2_sigma", sum(c["hits"] for c in known), "count",
                         f"of {sum(c['of'] for c in known)}")
            for number, start in enumerate(f["starts"], 1):
                here = f"{at}.start{number}"
                yield Number(f"{here}.nis_per_dof", real(start["nis"]["mean"]), "chi2", "1")
                yield Number(f"{here}.nees_per_dof", real(start["nees_observed"]["mean"]), "nees", "1")
                for rate in ("healthy", "wrong", "silent_failure_rate", "diverged"):
                    yield from of_rate(f"{here}.{rate.removesuffix('_failure_rate')}", start[rate])
        yield from of_rate(f"{name}.lost", point["failures"]["lost"])


def study(run, config="study", *options):
    run("run", CONFIGS / f"{config}.toml", "-o", config, "--progress", "none", *options)
    yield from of_study(run.json(f"{config}/summary.json"))


def sweeps(run):
    for name in ("misalignment", "noise", "noise_by_plan", "noise_by_walk", "dwell", "plan", "level", "command_law"):
        for n in study(run, f"sweep_{name}"):
            n.key = f"{name}.{n.key}"
            yield n


# --- rank

def of_ranking(name, answer):
    for group in answer["filters"]:
        for model in group["models"]:
            at = f"{name}.{'+'.join(group['name']) if isinstance(group['name'], list) else group['name']}" \
                 f".{model['coupling']}"
            at = at.replace(" ", "_").replace(",", "")
            yield Number(f"{at}.bits", real(model["bits"]), "bits", "bit")
            yield Number(f"{at}.pwcs_rank", model["pwcs"]["rank"], "count", f"of {model['pwcs']['states']}")
            for k, direction in enumerate(model["null_directions"], 1):
                yield Number(f"{at}.null_direction{k}", direction["combination"], "word")
            for p in sorted(model["parameters"], key=lambda p: p["key"]):
                yield Number(f"{at}.{p['key']}.sigma", real(p["posterior_sigma"]), "sigma", p["unit"])
                if p["learning_ratio_at_drawn_truths"] is None:  # [truth] leaves nothing open
                    continue
                low, high = p["learning_ratio_at_drawn_truths"]
                yield Number(f"{at}.{p['key']}.left_at_drawn_truths.low", real(low), "sigma", "1")
                yield Number(f"{at}.{p['key']}.left_at_drawn_truths.high", real(high), "sigma", "1")


def of_improvement(name, better):
    for k, step in enumerate(better["steps"], 1):
        yield Number(f"{name}.improve.step{k}", f"{step['axes']} {step['mode']} {step['entry']}", "word")
        yield Number(f"{name}.improve.step{k}.{better['criterion']}", real(step["criterion_after"]), "sigma", "arcsec")
    for key in ("eta_x", "xi_x"):
        for when in ("before", "after"):
            s = better["sigma"][key]
            yield Number(f"{name}.improve.{key}.{when}", real(s[when]), "sigma", s["unit"])


def rank(run):
    answer = json.loads(run("rank", CONFIGS / "table1.toml", "--improve", 3, "--criterion", "eta_x", "--json",
                            "--progress", "none"))
    yield from of_ranking("table1", answer)
    yield from of_improvement("table1", answer["improvement"])
    yield from of_ranking("six", json.loads(run("rank", CONFIGS / "study.toml", "--json", "--progress", "none")))


# --- diagnose and blind

def log10(p):
    """Of a probability; one that is zero in double precision is as good as 1e-300."""
    return None if p is None else math.log10(max(float(p), 1e-300))


def of_cause(at, cause):
    yield Number(f"{at}.probability", real(cause["probability"]), "probability", "1")
    for p in cause["parameters"]:
        yield Number(f"{at}.{p['key']}", real(p["value"]), "size", p["unit"], p["sigma"] or 0.0)
        yield Number(f"{at}.{p['key']}.sigma", real(p["sigma"]), "size_sigma", p["unit"])
        for end, value in zip(("low_95", "high_95"), p.get("interval_95") or ()):  # by refits
            yield Number(f"{at}.{p['key']}.{end}", real(value), "size", p["unit"], p["sigma"] or 0.0)


def name_of_cause(cause):
    return cause["term"] + (f".{cause['axis']}" if cause["axis"] else "")


def of_causes(at, causes):
    """Their names, alternatives parted by |, simultaneous ones joined by +, and what is said of each."""
    names = {}
    for c in causes:
        names.setdefault(c["set"], []).append(name_of_cause(c))
    yield Number(f"{at}.causes", " | ".join(" + ".join(n) for n in names.values()), "word")
    for k, cause in enumerate(causes, 1):
        yield from of_cause(f"{at}.cause{k}", cause)


def of_diagnosis(at, d):
    fit = d["fit"]
    yield Number(f"{at}.verdict", d["verdict"], "word")
    yield Number(f"{at}.log10_p", log10(d["p_value"]), "log_p", "1")
    yield from of_causes(at, d["causes"])
    for c in d["causes"][:1]:
        yield Number(f"{at}.confusable_with", " ".join(map(name_of_cause, c["confusable_with"])), "word")
    yield Number(f"{at}.noise", " ".join(n["component"] for n in d["noise"] if n["significant"]), "word")
    yield Number(f"{at}.located", d["where"]["equation"] or "", "word")
    yield Number(f"{at}.other_equation_gain", real(d["other_equation_gain"]), "gain", "1")
    for sample, kind in (("in_sample", "chi2"), ("held_out", "held_chi2")):
        for when in ("before", "after"):
            yield Number(f"{at}.{sample}.chi2_per_dof_{when}", real(fit[sample][f"chi2_per_dof_{when}"]), kind, "1")
    yield Number(f"{at}.held_out.gain", real(fit["held_out"]["log_score_gain"]), "held_gain", "1")
    for p in fit["shifted_parameters"][:1]:
        yield Number(f"{at}.most_shifted", p["key"], "word")
        yield Number(f"{at}.most_shifted.sigmas", real(p["shift_sigma"]), "shift", "sigma")
    for k, advice in enumerate(d["advice"], 1):
        positions = "; ".join(f"{p.get('axes', '')} {p.get('mode', '')} {p.get('entry', '')}"
                              for p in advice["plan"]["position"])
        yield Number(f"{at}.advice{k}.positions", positions, "word")
        yield Number(f"{at}.advice{k}.separates", ", ".join(advice["separates"]), "word")
        for which in ("now", "expected", "verified"):
            yield Number(f"{at}.advice{k}.{which}", real(advice[f"{which}_sigma"]), "advice", "sigma")


def diagnosed(run, name, config, overrides=(), simulated=None, advise=None):
    """A recording of a study's truth, diagnosed with its nominal filter."""
    more = sets(dict(overrides))
    recording = simulated or f"{name}.csv"
    if simulated is None:
        run("simulate", config, "-o", recording, *more)
    run("diagnose", config, recording, "-o", name, "--progress", "none", *more, *(["--advise", advise] if advise else []))
    yield from of_diagnosis(name, run.json(f"{name}/diagnosis.json"))


def equation(run):
    config = CONFIGS / "diagnose_equation.toml"
    yield from diagnosed(run, "equation", config)


def equation_slew(run):
    slews = {"plan.preset": "slew12", "truth.coupling": "eq6", "filter.nominal.coupling": "eq5"}
    yield from diagnosed(run, "slews", CONFIGS / "diagnose_equation.toml", slews.items())


def level(run):
    yield from diagnosed(run, "level", CONFIGS / "diagnose_level.toml")
    yield from diagnosed(run, "advised", run.file("level/advised.toml"))


def of_trial(key, answer):
    at = f"trial{key['trial']:02}"
    hidden = " + ".join(name_of_cause(e) + (f" {e['size']:.1f} sigma" if e["size"] else "")
                        for e in key["effects"]) or "nothing"
    yield Number(f"{at}.hidden", f"{key['stratum']}: {hidden}", "word")
    yield Number(f"{at}.conditions", " ".join([key["plan"], key["mode"], "truth", key["truth_coupling"], "nominal",
                                               key["nominal_coupling"]]), "word")
    yield Number(f"{at}.verdict", "failed" if answer["failed"] else answer["verdict"], "word")
    yield Number(f"{at}.log10_p", log10(answer["p_value"]), "log_p", "1")
    yield from of_causes(at, answer["causes"])
    yield Number(f"{at}.noise", " ".join(answer["noise"]), "word")
    yield Number(f"{at}.located", answer["equation"], "word")
    yield Number(f"{at}.chi2_per_dof_before", real(answer["chi2_per_dof_before"]), "chi2", "1")
    yield Number(f"{at}.chi2_per_dof_after", real(answer["chi2_per_dof_after"]), "chi2", "1")
    if answer["held_out"]:
        yield Number(f"{at}.held_out_gain", real(answer["held_out_gain"]), "gain", "1")


def of_blind(run, folder):
    keys, answers = run.json(f"{folder}/key.json")["trials"], run.json(f"{folder}/answers.json")["answers"]
    for key, answer in zip(keys, answers):
        assert key["trial"] == answer["trial"]
        yield from of_trial(key, answer)
    summary = run.json(f"{folder}/blind.json")
    for target in summary["targets"]:
        yield Number(f"target.{target['name'].replace(',', '').replace(' ', '_')}", target["measured"]["successes"],
                     "count", f"of {target['measured']['trials']}")


def blind_few(run):
    run("blind", CONFIGS / "blind_small.toml", "--trials", 10, "--seed", 20261201, "-o", "blind", "--progress", "none")
    yield from of_blind(run, "blind")


def blind(run):
    run("blind", CONFIGS / "blind.toml", "--trials", 64, "--seed", 20261201, "-o", "blind", "--progress", "none")
    yield from of_blind(run, "blind")


# --- a real recording

def xsens(run):
    recording = RECORDINGS / "xsens_mti.csv"
    if not recording.exists():
        raise Absent("recordings by others are not in ../shared/recordings")
    run("identify", CONFIGS / "strapdown_xsens.toml", recording, "-o", "case")
    answer = run.json("case/identification.json")
    yield Number("xsens.dwells", answer["dwells"]["count"], "count")
    yield Number("xsens.rotations", answer["rotations"]["count"], "count")
    for fit in answer["filters"]:
        for what in ("gravity", "dwells", "rotations"):
            yield Number(f"xsens.{fit['equation']}.{what}.held_out", real(fit[what]["held_out"]), "held_error",
                         fit[what]["unit"])
    for p in answer["parameters"]:
        yield Number(f"xsens.{p['key']}", real(p["value"]), "estimate", p["unit"], p["sigma"] or 0.0)
    run("diagnose", CONFIGS / "diagnose_xsens.toml", recording, "-o", "diagnosis", "--progress", "none")
    d = run.json("diagnosis/diagnosis.json")
    yield Number("xsens.diagnosis.verdict", d["verdict"], "word")
    yield from of_causes("xsens.diagnosis", d["causes"])


@dataclass
class Group:
    what: str
    numbers: Callable
    nightly: bool = False


GROUPS = {
    "table1": Group("identify: Table 1 under every truth the README names, and its reduced form", table1),
    "study": Group("run: configs/study.toml, 16 runs of each point", lambda run: study(run, "study", "--runs", 16)),
    "rank": Group("rank: table1 with three more positions, and the plan of six", rank),
    "equation": Group("diagnose: configs/diagnose_equation.toml", equation, nightly=True),
    "level": Group("diagnose: configs/diagnose_level.toml, and the study that it advises", level),
    "blind_few": Group("blind: ten trials of configs/blind_small.toml", blind_few),
    "xsens": Group("identify and diagnose: the Xsens recording, where it is", xsens),
    "slews": Group("diagnose: the equations exchanged, on slews", equation_slew, nightly=True),
    "blind": Group("blind: 64 trials of configs/blind.toml", blind, nightly=True),
    "sweeps": Group("run: the sweeps of the README, in full", sweeps, nightly=True),
}
