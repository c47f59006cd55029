#!/usr/bin/env python3
"""The Python reader: against the program's other exports, its errors, its notebooks, and the code of its chapter.

    tests/python_reader.py DRIFTSCOPE
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

source = Path(__file__).resolve().parent.parent
program = str(Path(sys.argv[1]).resolve())
reader = source / "analysis" / "python"
try:
    import netCDF4  # noqa: F401
    import h5py
    import numpy as np
    import pandas as pd
    import xarray as xr  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}. apt install python3-xarray python3-netcdf4 python3-h5py python3-pandas")
    sys.exit(77)

sys.path.insert(0, str(reader))
import driftscope  # noqa: E402

scratch = tempfile.TemporaryDirectory()
os.chdir(scratch.name)
os.symlink(source / "configs", "configs")
environment = {**os.environ, "PYTHONPATH": str(reader), "DRIFTSCOPE": program}

study = """schema = 1
title = "Points with other filters, a unit that changes, a name in UTF-8"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell = "20 min"
sample = "4 min"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
[[filter]]
name = "Köln, 5"
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
starts = 2
[[filter]]
name = "eq6"
coupling = "eq6"
terms = ["fixed_drift", "gyro_misalignment"]
[monte_carlo]
runs = 70
seed = 5
estimator = "ekf"
[sweep]
"truth.parameters.eta_x" = ["20 arcsec", "5 arcmin"]
"truth.coupling" = ["eq5", "eq6"]
"""


def run(*words):
    subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def refuses(action, *parts):
    try:
        action()
    except driftscope.DriftscopeError as error:
        assert all(part in str(error) for part in parts), error
    else:
        raise AssertionError(f"not refused: {parts}")


def exports_agree():
    Path("study.toml").write_text(study, encoding="utf-8")
    run("run", "study.toml", "-o", "out")
    refuses(lambda: driftscope.open("out"), "export.nc", "driftscope export out --format netcdf")
    for form in ("netcdf", "hdf5", "csv"):
        run("export", "out", "--format", form)
    ds = driftscope.open("out")
    assert ds.estimate.dims == ("point", "run", "filter", "start", "parameter")
    assert dict(ds.sizes) == {"point": 4, "run": 70, "filter": 2, "start": 2, "parameter": 15}, ds.sizes
    assert list(ds["filter"].values) == ["Köln, 5", "eq6"] and list(ds.start.values) == [1, 2]
    np.testing.assert_allclose(ds.truth_parameters_eta_x.values, [20, 20, 300, 300], rtol=1e-12)
    assert ds.truth_parameters_eta_x.attrs["units"] == "arcsec"
    assert list(ds.truth_coupling.values) == ["eq5", "eq6"] * 2
    assert ds.attrs["seed"] == "5" and all("units" in ds[v].attrs for v in ds.data_vars), "units everywhere"
    # The flat layout is another program path: every number of it is at its place.
    flat, csv = h5py.File("out/export.h5"), pd.read_csv("out/export.csv", comment="#", float_precision="round_trip")
    assert list(csv.columns[:5]) == ["point", "run", "status", "truth.parameters.eta_x [arcsec]", "truth.coupling"]
    swept = csv.groupby(["truth.parameters.eta_x [arcsec]", "truth.coupling"]).point.unique()
    assert list(swept.index) == [(20, "eq5"), (20, "eq6"), (300, "eq5"), (300, "eq6")] and [list(p) for p in swept] == [[0], [1], [2], [3]]
    run("export", "out", "--format", "json")
    made = json.loads(Path("out/export.json").read_text(encoding="utf-8"))["points"]
    assert made[2]["swept"] == {"truth.parameters.eta_x [arcsec]": 300, "truth.coupling": "eq5"}, made[2]["swept"]
    swept = flat["points/truth_parameters_eta_x"]
    assert list(swept[:]) == [20, 20, 300, 300] and swept.attrs["units"] == b"arcsec", swept[:]
    assert list(flat["points/truth_coupling"][:]) == [0, 1, 0, 1]
    assert flat["points/truth_coupling"].attrs["flag_meanings"] == b"eq5 eq6"
    point = flat["runs/point"][:]
    compared = 0
    for name in csv.columns:
        key, bracket, unit = name.partition(" [")
        parts = key.split("/")
        if not bracket or len(parts) == 1:
            continue
        at = {"parameter": parts[-1]} if parts[0] == "truth" or len(parts) == 4 else {}
        if parts[0] != "truth":
            at.update(filter=parts[0], start=int(parts[1]) + 1)
        array = {"truth": "truth", "status": "fit"}.get(parts[0] if parts[0] == "truth" else parts[2], parts[-1])
        if len(parts) == 4:
            array = parts[2]
        named = ds[array].sel(**at).values
        np.testing.assert_array_equal(named.ravel(), csv[name].to_numpy(), err_msg=name)
        if at.get("parameter"):
            assert str(ds.parameter_unit.sel(parameter=at["parameter"]).item()) == unit.rstrip("]")
        compared += 1
    assert compared == 15 + 2 * (7 + 30) + 7 + 18, compared
    assert np.isnan(ds.estimate.sel(filter="eq6", start=2)).all(), "a start that it does not have"
    assert np.isnan(ds.estimate.sel(filter="eq6", parameter="K0_x")).all(), "a parameter that it does not have"
    # The statistics, by another way.
    statistics = driftscope.open("out", "statistics")
    error = (ds.estimate - ds.truth).sel(filter="eq6", start=1, parameter="eta_x")
    rmse = np.sqrt((error**2).mean("run")) / ds.prior_sigma.sel(filter="eq6", parameter="eta_x")
    np.testing.assert_allclose(statistics.rmse.sel(filter="eq6", parameter="eta_x"), rmse, rtol=1e-9)
    rows = flat["statistics/point"].shape[0]
    assert rows == int(statistics.rmse.notnull().sum()), "every row of the table, and no other"
    filters = driftscope.open("out", "filters")
    assert sorted(set(flat["filters/start"][:])) == [1.0, 2.0], "starts are counted from 1"
    nis = (ds.nis.sum("run") / ds.nis_dof.sum("run")).values
    np.testing.assert_allclose(filters.nis.values, nis, rtol=1e-9, equal_nan=True)
    frame = driftscope.estimates("out")
    assert len(frame) == 4 * 70 * (2 * 15 + 9) and set(frame.columns) >= {
        "point", "run", "filter", "start", "parameter", "unit", "estimate", "sigma", "truth"}, frame.columns
    assert point.size == 280
    one = driftscope.open("out/export.nc")
    assert one.sizes == ds.sizes
    one.close(), ds.close(), statistics.close(), filters.close()


def sections_that_are_swept_are_coordinates():
    """`truth = [{...}]`: the array of true values keeps its name."""
    sweep = '[sweep]\ntruth = [{ coupling = "eq5" }, { angle_random_walk = "0.01 deg/sqrt(h)" }]\n'
    Path("sections.toml").write_text(study[:study.index("[sweep]")] + sweep, encoding="utf-8")
    run("run", "sections.toml", "--runs", "8", "-o", "sections")
    run("export", "sections", "--format", "netcdf")
    for group in (None, "statistics", "filters"):
        ds = driftscope.open("sections", group)
        assert ["coupling" in word for word in ds.truth_.values] == [True, False], ds.truth_.values
        assert ds.truth_.dims == ("point",) and "truth_" in ds.coords
        ds.close()
    ds = driftscope.open("sections")
    assert ds.truth.dims == ("point", "run", "parameter")
    frame = driftscope.estimates("sections")
    assert len(frame) == 2 * 8 * (2 * 15 + 9) and set(frame.truth_) == set(ds.truth_.values)
    assert frame.truth.notnull().all()
    ds.close()


def points_of_different_lengths_are_padded():
    stop = '[monte_carlo.stop]\nquantity = "silent_failure_rate"\nhalf_width = 0.04\n[sweep]'
    Path("uneven.toml").write_text(study.replace("runs = 70", "runs = 300").replace("[sweep]", stop), encoding="utf-8")
    run("run", "uneven.toml", "-o", "uneven")
    run("export", "uneven", "--format", "netcdf")
    run("export", "uneven", "--format", "csv")
    ds = driftscope.open("uneven")
    csv = pd.read_csv("uneven/export.csv", comment="#")
    made = csv.groupby("point").size()
    assert len(set(made)) > 1, "points that stop at other runs"
    for point, runs in made.items():
        status = ds.status.isel(point=point).values
        assert (status[:runs] == 0).all() and (status[runs:] == -1).all()
        assert ds.nis.isel(point=point).sel(filter="eq6", start=1).notnull().sum() == runs
    ds.close()
    assert not warnings_of("uneven")


def warnings_of(folder, group=None):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        driftscope.open(folder, group).close()
    return [str(w.message) for w in said if "Export again" in str(w.message)]


def an_export_is_outdated_by_what_is_stored():
    """And not by the times of files: a copy has others."""
    Path("grown.toml").write_text(study, encoding="utf-8")
    run("run", "grown.toml", "-o", "grown it's")
    run("export", "grown it's", "--format", "netcdf")
    run("run", "grown.toml", "-o", "grown it's")  # a session more, and no run
    os.utime("grown it's/worker-0000.sqlite", (4e9, 4e9))
    assert not warnings_of("grown it's") and not warnings_of("grown it's", "statistics")
    run("run", "grown.toml", "--runs", "140", "-o", "grown it's")
    os.utime("grown it's/export.nc", (4e9, 4e9))
    for group in (None, "statistics"):
        said = warnings_of("grown it's", group)
        assert len(said) == 1 and "when 280 runs were stored, now there are 560" in said[0], said
        assert "driftscope export 'grown it'\"'\"'s' --format netcdf" in said[0], said
    shutil.copy("out/export.nc", "uneven/export.nc")
    assert any("of another study" in text for text in warnings_of("uneven"))


def an_identification_agrees_with_itself():
    Path("one.toml").write_text(study[:study.index("[sweep]")], encoding="utf-8")
    run("identify", "one.toml", "-o", "identified")
    ds, table = driftscope.open("identified"), driftscope.estimates("identified")
    for row in table.itertuples():
        place = dict(estimator=row.estimator, filter=row.filter, start=row.start, parameter=row.parameter)
        assert ds.estimate.sel(**place) == row.estimate and ds.sigma.sel(**place) == row.sigma
        variance = ds.covariance.sel(**place, parameter_2=row.parameter).item()
        assert abs(variance - row.sigma**2) < 1e-9 * row.sigma**2
    assert len(table) == 2 * (2 * 15 + 9)
    assert ds.attrs["program"].startswith("driftscope ") and "[[filter]]" in ds.attrs["study"], "from what it was made"
    matrix = driftscope.covariance("identified", filter="eq6", correlation=True)
    assert matrix.shape == (9, 9) and np.allclose(np.diag(matrix), 1) and np.allclose(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix).min() > 0
    residuals = driftscope.residuals("identified")
    total = residuals[(residuals["filter"] == "eq6")]["nis"].sum()
    assert abs(total - ds.chi2.sel(estimator="ekf", filter="eq6", start=1).item()) < 1e-9 * total
    assert np.allclose(residuals[residuals.start == 1]["residual_acc_x [sigma]"].to_numpy(),
                       ds.residual.sel(start=1, channel="acc_x").values.ravel(), equal_nan=True)
    refuses(lambda: driftscope.covariance("identified", filter="eq7"), "has no filter 'eq7'", "Köln, 5, eq6")
    refuses(lambda: driftscope.open("identified", "statistics"), "has no group 'statistics'")
    refuses(lambda: driftscope.diagnosis("identified"), "holds no diagnosis.json", "driftscope diagnose")
    ds.close()


def a_ranking_agrees_with_its_document():
    run("rank", "one.toml", "-o", "ranked")
    table, ds = driftscope.ranking("ranked"), driftscope.open("ranked")
    assert ds.posterior_sigma.dims == ("filter", "coupling", "parameter")
    assert list(ds["filter"].values) == ["Köln, 5", "eq6"] and set(ds.coupling.values) == {"eq5", "eq6"}
    assert len(table) == 2 * (15 + 9) and ds.bits.attrs["units"] == "bit"
    own = table[table.of_the_file == 1]
    assert dict(own.groupby("filter").coupling.first()) == {"Köln, 5": "eq5", "eq6": "eq6"}
    assert all(own.groupby("filter")["rank"].apply(lambda ranks: list(ranks) == list(range(1, len(ranks) + 1))))
    document = json.loads(Path("ranked/rank.json").read_text(encoding="utf-8"))
    compared = 0
    for group in document["filters"]:
        for model in group["models"]:
            for p in model["parameters"]:
                place = dict(filter=group["name"], coupling=model["coupling"], parameter=p["key"])
                row = table[(table["filter"] == group["name"]) & (table.coupling == model["coupling"])
                            & (table.parameter == p["key"])].iloc[0]
                assert row.unit == p["unit"] == ds.parameter_unit.sel(parameter=p["key"]).item()
                assert row["bits [bit]"] == p["bits"] == ds.bits.sel(**place).item()
                for name in ("rank", "nominal", "prior_sigma", "posterior_sigma", "learning_ratio",
                             "conditional_sigma", "collinearity", "correlation"):
                    assert row[name] == p[name] == ds[name].sel(**place).item(), (place, name)
                low, high = p["learning_ratio_at_drawn_truths"] or (np.nan, np.nan)
                np.testing.assert_array_equal([row.learning_ratio_at_drawn_truths_low, low],
                                              [low, ds.learning_ratio_at_drawn_truths_low.sel(**place).item()])
                np.testing.assert_array_equal(row.learning_ratio_at_drawn_truths_high, high)
                compared += 1
    assert compared == len(table), compared
    assert np.isnan(ds.posterior_sigma.sel(filter="eq6", parameter="K0_x")).all(), "a parameter that it does not have"
    refuses(lambda: driftscope.open("ranked", "statistics"), "has no group 'statistics'")
    refuses(lambda: driftscope.ranking("identified"), "holds no ranking.csv", "driftscope rank")
    refuses(lambda: driftscope.estimates("ranked"), "holds no estimates.csv", "driftscope identify")


def errors_say_what_to_do():
    refuses(lambda: driftscope.open("nowhere"), "nowhere: no such folder or file")
    refuses(lambda: driftscope.estimates("nowhere"), "nowhere: no such folder")
    os.mkdir("empty")
    refuses(lambda: driftscope.open("empty"), "holds no results")
    Path("bad.nc").write_text("no netCDF")
    refuses(lambda: driftscope.open("bad.nc"), "bad.nc: ")
    # Without the modules: named, with what installs them.
    code = ("import sys; sys.modules['xarray'] = None; sys.modules['pandas'] = None; import driftscope\n"
            "for call in (lambda: driftscope.open('out'), lambda: driftscope.estimates('identified')):\n"
            "    try: call()\n"
            "    except driftscope.DriftscopeError as error: print(error)\n")
    said = subprocess.run([sys.executable, "-c", code], env=environment, check=True, capture_output=True, text=True).stdout
    assert "python3-xarray" in said and "python3-pandas" in said, said


def notebooks_run():
    for name, parts in {"notebook_diagnosis": ["verdict: named", "magnetic_drift    y"],
                        "notebook_sweep": ["eq5: eta_x =   100 arcsec:   0.0%", "silent failures"]}.items():
        said = subprocess.run([sys.executable, reader / f"{name}.py", name], env=environment, check=True,
                              capture_output=True, text=True).stdout
        assert all(part in said for part in parts), said


def chapter_is_true():
    text = (source / "analysis/docs/python.md").read_text(encoding="utf-8")
    for line in re.findall(r"^    \./driftscope (.*)$", text, re.M):
        words = line.split("#")[0].split()
        if "--runs" in words:
            words[words.index("--runs") + 1] = "20"
        run(*words)
    code = "\n".join(re.findall(r"```python\n(.*?)```", text, re.S))
    assert code.count("driftscope.") > 10
    said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    assert said.returncode == 0, said.stderr
    # What the chapter prints as silent failures are those of the report.
    points = driftscope.summary("out/dwell")["points"]
    rates = [[f["starts"][0]["silent_failure_rate"]["value"] for f in point["filters"]] for point in points]
    filters = driftscope.open("out/dwell", "filters")
    assert np.array_equal(filters.silent_failure_rate.sel(start=1).values, rates) and np.max(rates) > 0.5, rates
    assert filters.silent_failure_rate.sel(start=1).to_pandas().to_string() in said.stdout, said.stdout


for test in (exports_agree, sections_that_are_swept_are_coordinates, points_of_different_lengths_are_padded, an_export_is_outdated_by_what_is_stored,
             an_identification_agrees_with_itself, a_ranking_agrees_with_its_document, errors_say_what_to_do, notebooks_run, chapter_is_true):
    test()
    print(f"{test.__name__}: ok", flush=True)
