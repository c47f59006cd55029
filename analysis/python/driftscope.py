"""Reads what driftscope writes, for Python: pure Python, one file, nothing to build.

    import driftscope
    ds = driftscope.open("out/study")           # a Monte Carlo study, exported as netcdf: xarray.Dataset
    ds.estimate.sel(filter="eq6", parameter="eta_x")
    driftscope.estimates("out/table1")          # an identification: pandas.DataFrame
    driftscope.ranking("out/rank")              # what a plan can show: pandas.DataFrame
    driftscope.diagnosis("out/diagnosis").causes

xarray (with netCDF4 or h5netcdf) and pandas are imported where they are needed.
"""

import contextlib
import importlib
import json
import os
import shlex
import sqlite3
import warnings
from pathlib import Path
from urllib.parse import quote

__all__ = ["DriftscopeError", "Diagnosis", "command_of", "covariance", "diagnosis", "estimates", "open",
           "ranking", "recording", "residuals", "summary"]


class DriftscopeError(Exception):
    """What is wrong, what was expected, and what to do."""


def _module(name, package):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise DriftscopeError(f"the Python module {name} is missing (expected for what was asked). "
                              f"Install it: apt install {package}, or pip install {name}") from error


def _pandas():
    return _module("pandas", "python3-pandas")


def _table(path, **how):
    """A CSV file, every number as it was written."""
    return _pandas().read_csv(path, float_precision="round_trip", **how)


def _folder(path):
    folder = Path(path)
    if not folder.is_dir():
        raise DriftscopeError(f"{folder}: no such folder (expected one that driftscope wrote with -o)")
    return folder


def _file(folder, name, how):
    path = _folder(folder) / name
    if not path.is_file():
        raise DriftscopeError(f"{folder}: holds no {name} (expected beside {how})")
    return path


def command_of(folder):
    """The command whose results a folder holds: "run", "identify", "diagnose", "rank" or "blind"."""
    register = _folder(folder) / ".driftscope"
    if register.is_file():
        words = register.read_text(encoding="utf-8", errors="replace").split(":", 1)[0].split()
        if words[:2] == ["#", "driftscope"] and len(words) == 3:
            return words[2]
        raise DriftscopeError(f"{register}: is damaged (expected '# driftscope COMMAND: ...'). Run the command again")
    if (Path(folder) / "manifest.json").is_file():  # a study at work
        return "run"
    raise DriftscopeError(f"{folder}: holds no results (expected a folder that driftscope wrote with -o)")


def _export_command(folder):
    return f"driftscope export {shlex.quote(str(folder))} --format netcdf"


def _export_of_study(folder):
    path = folder / "export.nc"
    if not path.is_file():
        raise DriftscopeError(f"{folder}: the study is not exported (expected export.nc). Make it with: "
                              f"{_export_command(folder)}")
    return path


def _runs_stored(folder):
    """The runs that the worker files of a study list, each once; None if not all of them can be read here."""
    blocks = {}
    try:
        for worker in folder.glob("worker-*.sqlite"):
            with contextlib.closing(sqlite3.connect(f"file:{quote(str(worker))}?mode=ro", uri=True)) as file:
                for point, first, runs in file.execute("SELECT point, first_run, runs FROM blocks"):
                    blocks[point, first] = max(runs, blocks.get((point, first), 0))
    except sqlite3.Error:
        return None
    return sum(blocks.values())


def _warn_if_outdated(folder, facts):
    """facts: attributes of the export. Says so if it is of another study, or of fewer runs than are stored
    now; a folder that was copied or looked into is no other one."""
    try:
        study = json.loads((folder / "manifest.json").read_text(encoding="utf-8")).get("study_hash")
    except (OSError, ValueError):
        study = None
    stored = _runs_stored(folder) if "runs_stored" in facts else None
    if study is not None and facts.get("study_hash", study) != study:
        what = "export.nc is of another study than the folder"
    elif stored is not None and int(facts["runs_stored"]) != stored:
        what = f"export.nc was written when {facts['runs_stored']} runs were stored, now there are {stored}"
    else:
        return
    warnings.warn(f"{folder}: {what}. Export again: {_export_command(folder)}", stacklevel=3)


def open(path, group=None):
    """The arrays of a study, of an identification or of a ranking, by names: an xarray.Dataset.

    path: the results folder of `run`, `identify` or `rank`, or a .nc file. Of a study the dimensions are run,
    filter, start, parameter, and point where it has several; group "statistics" has what the runs say of
    each parameter, "filters" of each start. Of a ranking they are filter, coupling, parameter. Numbers stand in
    the unit of the coordinate parameter_unit, or of the attribute `units`. Nothing but a ranking is read before
    it is asked for.
    """
    where, study = Path(path), None
    if where.is_dir():
        command = command_of(where)
        if command == "run":
            study, where = where, _export_of_study(where)
        elif command == "identify":
            where = _file(where, "identification.nc", "the results of `driftscope identify` on a platform")
        elif command == "rank" and group is None:
            return _arrays_of_ranking(where)
        elif command == "rank":
            raise DriftscopeError(f"{where}: has no group {group!r} (expected statistics or filters, of a study)")
        else:
            raise DriftscopeError(f"{path}: holds the results of `driftscope {command}` (expected those of "
                                  "run, identify or rank)")
    elif not where.is_file():
        raise DriftscopeError(f"{path}: no such folder or file (expected a results folder, or a .nc file)")
    xarray = _module("xarray", "python3-xarray")
    try:
        if study is not None:
            with xarray.open_dataset(where) as root:  # the facts stand beside the groups
                _warn_if_outdated(study, root.attrs)
        return xarray.open_dataset(where, group=group)
    except OSError as error:
        if group is not None and "group" in str(error):
            raise DriftscopeError(f"{where}: has no group {group!r} (expected statistics or filters, of a "
                                  "study)") from error
        raise DriftscopeError(f"{where}: is no netCDF file that can be read ({error}). Export it again") from error
    except ValueError as error:  # xarray finds no engine
        raise DriftscopeError(f"{where}: xarray cannot read netCDF here ({error}). Install netCDF4 or "
                              "h5netcdf: apt install python3-netcdf4, or pip install netCDF4") from error


def _arrays_of_ranking(folder):
    """The table by filter, coupling and parameter, each in its order there; a number with one unit has it as attribute."""
    _module("xarray", "python3-xarray")
    table = ranking(folder)
    names = ["filter", "coupling", "parameter"]
    units = table.drop_duplicates("parameter").set_index("parameter")["unit"]
    ds = table.drop(columns="unit").set_index(names).to_xarray()
    ds = ds.reindex({name: table[name].unique() for name in names})
    ds = ds.assign_coords(parameter_unit=("parameter", list(units[ds.parameter.values])))
    for column in list(ds.data_vars):
        name, bracket, unit = column.partition(" [")
        if bracket:
            ds = ds.rename({column: name})
            ds[name].attrs["units"] = unit.rstrip("]")
    return ds


def ranking(folder):
    """What a plan shows of every parameter, one a row, best known first: a pandas.DataFrame with the columns
    filter, coupling, parameter, unit, prior_sigma, posterior_sigma, learning_ratio, ... Beside the equation of a
    filter stands the other of eqs. (5) and (6): of_the_file is 0 there."""
    return _table(_file(folder, "ranking.csv", "the results of `driftscope rank`"))


def _study_estimates(folder):
    ds = open(folder)
    table = ds[["estimate", "sigma", "truth"]].to_dataframe().reset_index()
    table = table.dropna(subset=["sigma"])  # a filter does not estimate every parameter
    return table.rename(columns={"parameter_unit": "unit"}).reset_index(drop=True)


def estimates(folder):
    """Estimates, one a row: a pandas.DataFrame with the columns filter, start, parameter, unit, estimate,
    sigma, ... Of an identification also estimator, prior and status; of a study also run (and point)."""
    if command_of(folder) == "run":
        _pandas()
        return _study_estimates(folder)
    return _table(_file(folder, "estimates.csv", "the results of `driftscope identify`"))


def residuals(folder):
    """Residuals of the batch fit and NIS of the EKF in every sample of an identification, one a row."""
    return _table(_file(folder, "residuals.csv", "the results of `driftscope identify` on a platform"))


def _covariance_of_table(folder, filter, start, estimator, correlation):
    table = _table(_file(folder, "covariance.csv", "the results of `driftscope identify`"))
    names = list(table["filter"].unique())
    if filter is None and len(names) == 1:
        filter = names[0]
    for name, value in (("filter", filter), ("start", start), ("estimator", estimator)):
        if value not in table[name].values:
            raise DriftscopeError(f"{folder}: has no {name} {value!r} (expected one of "
                                  f"{', '.join(str(v) for v in table[name].unique())})")
        table = table[table[name] == value]
    keys = list(dict.fromkeys(table["parameter"]))
    half = table.pivot(index="parameter", columns="parameter_2",
                       values="correlation" if correlation else "covariance").reindex(index=keys, columns=keys)
    return half.fillna(half.T)


def covariance(folder, filter=None, start=1, estimator="batch", correlation=False):
    """Covariance (or correlation) matrix of an identification: a square DataFrame by parameter.

    filter: a name of the study; may be left out where it has one."""
    if (Path(folder) / "covariance.csv").is_file() and not (Path(folder) / "identification.nc").is_file():
        return _covariance_of_table(folder, filter, start, estimator, correlation)  # of a strapdown recording
    ds = open(folder)
    if "covariance" not in ds:
        raise DriftscopeError(f"{folder}: has no covariance (expected the results of `driftscope identify`)")
    _pandas()
    names = list(ds["filter"].values)
    if filter is None and len(names) == 1:
        filter = names[0]
    for name, value in (("filter", filter), ("start", start), ("estimator", estimator)):
        if value not in ds[name].values:
            raise DriftscopeError(f"{folder}: has no {name} {value!r} (expected one of "
                                  f"{', '.join(str(v) for v in ds[name].values)})")
    matrix = ds["correlation" if correlation else "covariance"].sel(filter=filter, start=start, estimator=estimator)
    table = matrix.to_pandas()
    return table.dropna(how="all").dropna(how="all", axis=1)


def summary(folder):
    """summary.json of a study: its points, filters and headlines."""
    return _json(_file(folder, "summary.json", "the results of `driftscope run`"))


def _json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise DriftscopeError(f"{path}: is no JSON ({error}). Run the command again") from error


class Diagnosis(dict):
    """diagnosis.json, with its lists as tables. diagnosis["verdict"] is any member of the document."""

    def __init__(self, folder):
        self.folder = _folder(folder)
        super().__init__(_json(_file(folder, "diagnosis.json", "the results of `driftscope diagnose`")))

    @property
    def verdict(self):
        """"consistent", "named", "ambiguous" or "unexplained"."""
        return self["verdict"]

    @property
    def causes(self):
        """The causes that were named: a row for each of their parameters."""
        rows = [{"term": cause["term"], "axis": cause.get("axis"), "probability": cause.get("probability"),
                 "p_value": cause.get("p_value"), **parameter}
                for cause in self["causes"] for parameter in cause["parameters"]]
        columns = ["term", "axis", "probability", "p_value", "key", "value", "sigma", "unit"]
        table = _pandas().DataFrame(rows)
        return table if rows else _pandas().DataFrame(columns=columns)

    @property
    def candidates(self):
        """Every effect that was tried, the most significant first."""
        return _pandas().DataFrame(self["candidates"])

    @property
    def shifted(self):
        """Parameters that the named causes moved."""
        return _pandas().DataFrame(self["fit"]["shifted_parameters"])

    @property
    def signal(self):
        """What the nominal model does not explain, as a time series of each equation."""
        return _table(_file(self.folder, "residual_signal.csv", "diagnosis.json"), comment="#")


def diagnosis(folder):
    """The results of `driftscope diagnose`: verdict, causes, candidates, shifted, signal."""
    return Diagnosis(folder)


def recording(path):
    """A recording as CSV: a DataFrame whose columns have names alone; their units are attrs["units"], its
    facts attrs["facts"]."""
    if not os.path.isfile(path):
        raise DriftscopeError(f"{path}: no such file (expected a recording as CSV)")
    facts = {}
    with Path(path).open(encoding="utf-8-sig") as file:
        for line in file:
            if not line.startswith("#"):
                break
            key, equals, value = line[1:].partition("=")
            if equals:
                facts[key.strip()] = value.strip()
    table = _table(path, comment="#")
    units = {}
    for column in list(table.columns):
        name, bracket, unit = column.partition("[")
        if bracket:
            units[name.strip()] = unit.rstrip("] ")
            table = table.rename(columns={column: name.strip()})
    table.attrs = {"units": units, "facts": facts}
    return table
