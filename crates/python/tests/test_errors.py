"""Exceptions say where, what and what would be valid."""

import pickle

import pytest
from conftest import ROOT, SHORT

import jamming


def complaint(scene, **overrides):
    with pytest.raises(jamming.SceneError) as caught:
        jamming.simulate(scene, **overrides)
    assert isinstance(caught.value, ValueError)
    return caught.value


def test_of_a_file(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SHORT.replace("v0 = 1.2", "v0 = -1.2"), encoding="utf-8")
    error = complaint(path)
    assert (error.file, error.line, error.key, error.value) == (str(path), 4, "law.v0", -1.2)
    assert error.allowed == "a number > 0.0"
    assert str(error) == f"{path}:4: law.v0 = -1.2: must be a number > 0.0"
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.allowed) == (str(error), error.allowed)


def test_of_an_override():
    error = complaint(SHORT, **{"run.t_end": -5})
    assert (error.file, error.line, error.key, error.value) == (None, None, "run.t_end", -5.0)
    error = complaint(SHORT, **{"run.method": "euler2"})
    assert error.value == "euler2" and "dop853" in error.allowed
    error = complaint(SHORT, **{"lw.v0": 1.0})
    assert error.key == "lw" and "law" in error.allowed
    assert complaint(SHORT, **{"run.sample": True}).key == "run.sample"
    assert "1.152921504606847e18" in str(complaint(SHORT, **{"run.most_steps": 2**60 + 1}))


def test_of_a_formula():
    law = {"kind": "formula", "acceleration": "V - v", "V": "tanh(s - c)", "body": 0.0}
    error = complaint(SHORT, law=law)
    assert error.key == "law.V" and "c" in str(error) and "column" in str(error)
    text = SHORT.replace('kind = "logarithmic"\nv0 = 1.2\nepsilon = 0.01', 'kind = "formula"\nacceleration = "V + - "\nbody = 0.0')
    error = complaint(text)
    assert (error.line, error.key) == (4, "law.acceleration")


def test_of_a_missing_file():
    with pytest.raises(FileNotFoundError):
        jamming.simulate(ROOT / "no-such-scene.toml")


def test_of_panels_and_kinds():
    gallery = ROOT / "scenes/gallery/seyfried.toml"
    assert "n15, n30" in str(complaint(gallery))
    with pytest.raises(jamming.SceneError, match="n15, n30"):
        jamming.simulate(gallery, panel="n16")
    assert "map" in str(complaint(ROOT / "scenes/map.toml"))
    with pytest.raises(jamming.SceneError, match="simulate"):
        jamming.map(ROOT / "scenes/ring.toml")


def test_of_a_map_with_a_cell_without_a_flow():
    scene = {
        "law": {"kind": "algebraic", "q": 2.0, "v0": 3.0},
        "uniform": {"headway": 1.5},
        "map": {
            "x": {"parameter": "mu", "from": 0.1, "to": 1e30, "cells": 2},
            "y": {"parameter": "a_v", "from": 0.0, "to": 1.0, "cells": 2},
        },
    }
    with pytest.raises(jamming.SceneError, match="mu = "):
        jamming.map(scene)


def test_of_stability():
    with pytest.raises(jamming.SceneError, match="headway"):
        jamming.stability({"kind": "formula", "acceleration": "1.0 + s - s", "body": 0.0}, 2.0)
    with pytest.raises(jamming.SceneError) as caught:
        jamming.stability(ROOT / "scenes/ring.toml", 1.5, **{"law.epsilon": -1.0})
    assert caught.value.key == "law.epsilon"


def test_of_a_run_that_cannot_go_on():
    with pytest.raises(jamming.RunError, match="steps") as caught:
        jamming.simulate(SHORT, **{"run.most_steps": 20})
    run = caught.value.run
    assert run.stop == "too_many_steps" and 0 < run.summary["t"] < 30 and len(run.std) > 0
    assert str(caught.value).startswith(run.summary["reason"][:20])
