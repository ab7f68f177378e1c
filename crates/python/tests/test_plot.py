"""Pictures: drawn, and in the house's colours."""

import re

import matplotlib
import numpy as np
import pytest
from conftest import ROOT, SHORT

import jamming
from jamming import _plot

matplotlib.use("Agg")


def constants(file):
    return (ROOT / "crates/plot/src" / file).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["DIVERGING", "SEQUENTIAL"])
def test_colour_maps_are_those_of_the_house(name):
    stops = re.search(rf"{name}: \[Color; \d+\] =\s*colors\(\[(.*?)\]\)", constants("color.rs"), re.DOTALL)[1]
    assert [f"#{stop}" for stop in re.findall(r"0x(\w{6})", stops)] == getattr(_plot, name)


def test_colours_are_those_of_the_house():
    def colour(text):
        return ["#" + "".join(one) for one in re.findall(r"Color\(0x(\w\w), 0x(\w\w), 0x(\w\w)\)", text)]

    style = constants("style.rs")
    assert colour(re.search(r"SERIES: .*?\];", style, re.DOTALL)[0]) == _plot.SERIES
    for name in ("INK", "GREY", "MISSING"):
        assert colour(re.search(rf"{name}: .*?;", style)[0]) == [getattr(_plot, name)]


def test_outcomes_look_as_those_of_the_house():
    fills = dict(re.findall(r"const (\w+): Fill = Fill::flat\((.*?)\)", constants("fill.rs")))
    planes = (ROOT / "crates/planes/src/picture.rs").read_text(encoding="utf-8")
    looks = {
        re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower(): fill
        for name, fill in re.findall(r"\(Class::(\w+), Fill::(\w+)\)", planes)
    }
    flat = {name: "#" + fills[fill].replace("0x", "").replace(", ", "") for name, fill in looks.items() if fill in fills}
    assert list(flat.items()) == list(_plot.FLAT.items())
    assert [name for name in looks if name not in flat] == list(_plot.HATCHED)


def test_runs():
    run = jamming.simulate(SHORT)
    ax = run.plot()
    (lines,) = ax.collections
    # a stretch that passes the end of the ring is drawn on both sides
    assert len(lines.get_segments()) == 2 * 30 * 20
    assert ax.get_ylim() == (0.0, 30.0)
    assert ax.figure.axes[1].get_ylabel() == "speed $v_n$"
    assert run.plot("std").get_ylabel() == "std of speeds"
    with pytest.raises(ValueError, match="trajectories"):
        run.plot("speeds")


def test_maps():
    found = jamming.map(ROOT / "scenes/map.toml", **{"map.x.cells": 30, "map.y.cells": 20})
    ax = found.plot()
    cells = ax.collections[0]
    assert cells.get_array().shape == (20, 30)
    assert cells.get_clim()[0] == -cells.get_clim()[1]
    assert ax.get_xlabel() == r"$\mu$"


def test_colours_end_where_those_of_the_house_do():
    assert _plot.colour_limit(np.array([-0.3, -0.2, 0.1, 100.0])) == 0.4
    assert _plot.colour_limit(np.array([np.nan, 0.0])) == 1.0


def test_growth_rates():
    flow = jamming.stability(ROOT / "scenes/ring.toml", 1.5)
    assert flow.plot().get_xlim() == (0.0, np.pi)
