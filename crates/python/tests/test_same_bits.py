"""Every table is that of the command line, to the last bit."""

import csv
import json
import re
import tomllib

import numpy as np
import pytest
from conftest import ROOT, SHORT

import jamming

SCENES = [ROOT / "scenes/ring.toml", ROOT / "scenes/map.toml", *sorted((ROOT / "scenes/gallery").glob("*.toml"))]
FIGURES = ["fig04-algebraic-std", "fig10-logarithmic-criterion"]
SCENES += [ROOT / "figures" / name / "scene.toml" for name in FIGURES]
LONGEST = 500.0


def panels(kind):
    """Scene and panel of everything that is of a kind; None for a scene without panels."""
    found = []
    for path in SCENES:
        scene = tomllib.loads(path.read_text(encoding="utf-8"))
        for name, panel in scene.get("panel", {None: {}}).items():
            if kind in scene or kind in panel:
                found.append(pytest.param(path, name, id=f"{path.relative_to(ROOT)}-{name or 'main'}"))
    return found


def t_end_of(path, panel):
    """When the run of a panel ends."""
    scene = tomllib.loads(path.read_text(encoding="utf-8"))
    return {**scene.get("run", {}), **scene.get("panel", {}).get(panel, {}).get("run", {})}["t_end"]


def read(file):
    """The columns of a table: numbers as the nearest double, an empty cell as NaN, words as they are."""
    with open(file, encoding="utf-8", newline="") as lines:
        header, *rows = csv.reader(lines)
    return {name: [cell(row[index]) for row in rows] for index, name in enumerate(header)}


def cell(text):
    try:
        return float(text or "nan")
    except ValueError:
        return text


def same(found, expected):
    """Whether two columns are the same to the bit; where a number is missing, in both."""
    if any(isinstance(one, str) for one in expected):
        assert list(found) == list(expected)
        return
    found, expected = np.asarray(found).astype(float), np.array(expected, dtype=float)
    assert found.shape == expected.shape
    missing = np.isnan(expected)
    assert (np.isnan(found) == missing).all()
    assert (found.view(np.int64) == expected.view(np.int64))[~missing].all()


@pytest.mark.parametrize(("scene", "panel"), panels("run"))
def test_runs(scene, panel, command_line, tmp_path):
    # whole, but for the longest
    t_end = min(LONGEST, t_end_of(scene, panel))
    words = ["--t-end", t_end, *(["--panel", panel] if panel else [])]
    state = tmp_path / "state.csv"
    command_line("simulate", scene, "--tables-only", "--out", tmp_path, "--state", state, *words)
    run = jamming.simulate(scene, panel=panel, **{"run.t_end": t_end})
    tables = {"std": run.to_pandas("std"), "events": run.to_pandas("events")}
    if run.x is not None:
        tables["trajectories"] = run.to_pandas("trajectories")
    written = {file.stem for file in tmp_path.glob("*.csv")} - {"state"}
    assert written == set(tables)
    for name, table in tables.items():
        expected = read(tmp_path / f"{name}.csv")
        assert set(expected) <= set(table.columns)
        for column, numbers in expected.items():
            same(table[column], numbers)
    expected = read(state)
    same(run.x_end, expected["x"])
    same(run.v_end, expected["v"])
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary.pop("seconds") >= 0 and run.summary.pop("seconds") >= 0
    assert run.summary == summary
    assert (run.outcome.name, run.outcome.t) == (summary["outcome"]["class"], summary["outcome"]["t"])


@pytest.mark.parametrize(("scene", "panel"), panels("map"))
def test_maps(scene, panel, command_line, tmp_path):
    # fewer cells, for quickness
    text = re.sub(r"cells *= *\d+ *}", "cells = 24 }", scene.read_text(encoding="utf-8"))
    scene = tmp_path / "scene.toml"
    scene.write_text(text, encoding="utf-8")
    printed = json.loads(command_line("map", scene, "--tables-only", "--out", tmp_path, "--json"))
    found = jamming.map(scene, panel=panel)
    expected = read(tmp_path / f"{panel or 'main'}.csv")
    table = found.to_pandas()
    assert list(table.columns) == list(expected)
    for column, numbers in expected.items():
        same(table[column], numbers)
    assert found.summary == next(one for one in printed["maps"] if one["panel"] == (panel or "main"))
    # rows of the array go along x, as pcolormesh and imshow take them
    at = len(found.y) + 2
    assert (table.iloc[at, 0], table.iloc[at, 1]) == (found.x[1], found.y[2])
    same([found.values[2, 1]], [table.iloc[at, 2]])


def test_a_scene_is_the_same_as_path_text_and_dictionary(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SHORT, encoding="utf-8")
    runs = [jamming.simulate(scene) for scene in (path, str(path), SHORT, tomllib.loads(SHORT))]
    for run in runs[1:]:
        same(run.x.ravel(), runs[0].x.ravel())
        same(run.std, runs[0].std)


def test_overrides_are_the_scene_with_other_values(command_line, tmp_path):
    overrides = {"run.tolerance": 1e-8, "run.sample": 0.5, "run.t_end": 12.0}
    changed = SHORT.replace("1e-10", "1e-8").replace("sample = 1.0", "sample = 0.5").replace("30.0\nsample", "12.0\nsample")
    same(jamming.simulate(SHORT, **overrides).x.ravel(), jamming.simulate(changed).x.ravel())
    path = tmp_path / "scene.toml"
    path.write_text(SHORT, encoding="utf-8")
    words = ["--tol", 1e-8, "--sample", 0.5, "--t-end", 12.0]
    command_line("simulate", path, "--tables-only", "--out", tmp_path, *words)
    same(jamming.simulate(SHORT, **overrides).to_pandas()["x"], read(tmp_path / "trajectories.csv")["x"])
    fixed = jamming.simulate(SHORT, **{"run.method": "heun", "run.dt": 0.01})
    assert fixed.summary["control"] == {"dt": 0.01}


def test_arrays_are_views_of_one_table():
    run = jamming.simulate(SHORT)
    assert np.shares_memory(run.x, run.v.base) and np.shares_memory(run.t, run.std.base)
    found = jamming.map(ROOT / "scenes/map.toml", **{"map.x.cells": 3, "map.y.cells": 2})
    assert found.values.shape == (2, 3) and found.values.base is not None
