"""Sweeps: the table of the command line to the bit, on any number of threads."""

import json

import numpy as np
import pytest
from conftest import ROOT, SWEEP
from test_same_bits import read, same

import jamming

OUTCOMES = ("outcome", "backward_flow", "decided_by")


@pytest.fixture(scope="module")
def plane():
    return jamming.sweep(SWEEP)


def test_it_is_that_of_the_command_line(plane, command_line, tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SWEEP, encoding="utf-8")
    printed = json.loads(command_line("sweep", path, "--tables-only", "--out", tmp_path, "--json"))
    expected, table = read(tmp_path / "cells.csv"), plane.to_pandas()
    assert list(table.columns) == list(expected)
    for column, numbers in expected.items():
        same(table[column], numbers)
    assert plane.counts() == {name: count for name, count in printed["outcomes"].items() if count}
    # several outcomes, and cells that were not run: two tiles share a border
    assert len(plane.counts()) > 2 and {"run", "both", "neighbours"} <= set(np.unique(plane.decided_by))


def test_threads_change_no_bit(plane):
    other = jamming.sweep(SWEEP, jobs=1)
    for name in OUTCOMES:
        assert (getattr(other, name) == getattr(plane, name)).all()
    for name, numbers in other.numbers.items():
        same(numbers.ravel(), plane.numbers[name].ravel())


def test_what_is_filled_in_is_what_a_run_gives(plane):
    every = jamming.sweep(SWEEP, **{"sweep.refine": False})
    assert "neighbours" not in every.decided_by
    assert (every.outcome == plane.outcome).all()


def test_rows_go_along_x(plane):
    table = plane.to_pandas()
    at = 3 * len(plane.y) + 2
    assert (table.headway[at], table.kappa[at], table.outcome[at]) == (plane.x[3], plane.y[2], plane.outcome[2, 3])


def test_edges_of_logarithmic_axes():
    made = jamming.sweep(SWEEP, **{"sweep.y.scale": "log", "sweep.x.cells": 2, "sweep.y.cells": 3})
    x, y = made.edges()
    assert np.allclose(np.sqrt(y[1:] * y[:-1]), made.y) and np.allclose((x[1:] + x[:-1]) / 2, made.x)


def test_complaints():
    with pytest.raises(jamming.SceneError) as caught:
        jamming.sweep(SWEEP, **{"sweep.refine": 1.0})
    assert (caught.value.key, caught.value.allowed) == ("sweep.refine", "true or false")
    with pytest.raises(jamming.SceneError, match="no .sweep."):
        jamming.sweep(ROOT / "scenes/ring.toml")
    with pytest.raises(jamming.SceneError, match="several steady speeds at headway"):
        jamming.sweep(SWEEP, **{"law.V": "0", "law.acceleration": "(kappa + v - 1)*(v - 2)*(3 - v)*(s + 1)/(V + 1)"})
    with pytest.raises(ValueError, match="jobs"):
        jamming.sweep(SWEEP, jobs=0)


def test_what_a_callback_raises_ends_it():
    def stop(part):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        jamming.sweep(SWEEP, progress=stop, **{"sweep.x.cells": 500, "sweep.y.cells": 500})


def test_a_picture(plane):
    pytest.importorskip("matplotlib").use("Agg")
    # from headways below the size of a body on
    closed = jamming.sweep(SWEEP, **{"law.body": 1.2, "sweep.x.cells": 6, "sweep.y.cells": 4})
    assert "closed" in closed.counts()
    for one in (plane, closed):
        ax = one.plot()
        assert {text.get_text() for text in ax.get_legend().get_texts()} == {one.words[name] for name in one.counts()}
        ax.figure.canvas.draw()
