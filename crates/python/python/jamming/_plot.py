"""Pictures with matplotlib, in the colours of the project's own."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap, LinearSegmentedColormap, ListedColormap
from matplotlib.patches import Patch

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from ._map import Map
    from ._run import Run
    from ._stability import Stability
    from ._sweep import Sweep

# As crates/plot has them (a test compares): color.rs and style.rs say how they were chosen.
DIVERGING = (
    "#668ada #7598df #85a5e4 #95b3e9 #a7c1ed #b9cef0 #ccdcf3 #e0e9f6 #f6f6f6 "
    "#f1dcd2 #e8c3b2 #deaa94 #d39178 #c7775e #ba5e47 #ac4331 #9d231e"
).split()
SEQUENTIAL = "#440154 #482475 #414487 #355f8d #2a788e #21918c #22a884 #44bf70 #7ad151".split()
SERIES = "#00468b #d97a00 #1b1b1b #008a72 #b81c45".split()
INK, GREY, MISSING = "#111111", "#777777", "#b8b8b0"

# What became of a run, as the pictures of `cargo xtask sweep` have it (crates/plot, fill.rs): a colour, or a hatching on white.
FLAT = {
    "decays": "#e9f0f5",
    "waves": "#2470b8",
    "waves_backwards": "#5c2a86",
    "contact": "#e8842c",
    "blow_up": "#38090c",
    "undecided": "#bfbfb9",
}
HATCHED = {"closed": "//", "no_uniform_flow": "\\\\", "undefined": "xx"}
PAPER = "#ffffff"
# Names of parameters as the paper writes them.
SYMBOLS = {
    "mu": r"\mu",
    "delta": r"\delta",
    "a_v": r"\tilde a_v",
    "v0": r"v_0'",
    "d_gap": r"d'",
    "headway": r"\Delta y",
    "shift": r"\epsilon_1",
    "pedestrians": "N",
    "k": r"k",
    "epsilon": r"\varepsilon",
}
GREEK = "alpha beta gamma delta epsilon eta kappa lambda mu nu rho sigma tau theta xi".split()
VALUES = {"margin": "margin", "phi": r"$\Phi$", "re_z": r"$\mathrm{Re}\,z^+$"}
# As many pieces of lines as a picture shows in a second or so.
MOST_PIECES = 150_000


def scale(stops: list[str]) -> Colormap:
    """A colour map through these stops."""
    return LinearSegmentedColormap.from_list("jamming", stops).with_extremes(bad=MISSING)


def axes(ax: Axes | None) -> Axes:
    """The axes to draw on."""
    return plt.subplots(layout="constrained")[1] if ax is None else ax


def std(run: Run, ax: Axes | None) -> Axes:
    """The standard deviation of the speeds against time."""
    ax = axes(ax)
    ax.plot(run.t, run.std, color=SERIES[0], linewidth=1.0)
    ax.set(xlabel="$t$", ylabel="std of speeds", xlim=(0.0, run.t[-1] or 1.0), ylim=(0.0, None))
    return ax


def trajectories(run: Run, ax: Axes | None) -> Axes:
    """Places on the ring against time, coloured by speed."""
    if run.x is None or run.v is None:
        raise ValueError('the scene does not keep trajectories: run.record must be "trajectories"')
    ax = axes(ax)
    every = max(1, math.ceil(run.x.size / MOST_PIECES))
    t, x, v = run.t[::every], run.x[::every], run.v[::every]
    lines = LineCollection(list(pieces(t, x, run.length)), cmap=scale(SEQUENTIAL), linewidth=0.8)
    lines.set_array(np.repeat(0.5 * (v[1:] + v[:-1]).ravel(), 2))
    ax.add_collection(lines)
    ax.set(xlabel="$t$", ylabel="$x'$", xlim=(0.0, run.t[-1] or 1.0), ylim=(0.0, run.length))
    ax.figure.colorbar(lines, ax=ax, label="speed $v_n$")
    return ax


def pieces(t: NDArray[np.float64], x: NDArray[np.float64], length: float) -> NDArray[np.float64]:
    """Each stretch between two samples, wrapped around the ring: once where it begins, once where it ends, since a stretch
    that passes the end of the ring is to be seen on both sides."""
    begin = np.stack([np.broadcast_to(t[:-1, None], x[:-1].shape), x[:-1]], axis=-1)
    end = np.stack([np.broadcast_to(t[1:, None], x[1:].shape), x[1:]], axis=-1)
    stretches = np.stack([begin, end], axis=-2).reshape(-1, 2, 2)
    turned = np.repeat(stretches, 2, axis=0)
    turns = np.floor(stretches[:, :, 1] / length).ravel()
    turned[:, :, 1] -= length * turns[:, None]
    return turned


def map(made: Map, ax: Axes | None) -> Axes:
    """The value over two parameters, and a line where it is 0."""
    ax = axes(ax)
    limit = colour_limit(made.values)
    edges = [np.linspace(*ends, len(centres) + 1) for ends, centres in ((made.x_range, made.x), (made.y_range, made.y))]
    cells = ax.pcolormesh(*edges, np.ma.masked_invalid(made.values), cmap=scale(DIVERGING), vmin=-limit, vmax=limit)
    if np.nanmin(made.values) < 0.0 < np.nanmax(made.values) and min(made.values.shape) > 1:
        ax.contour(made.x, made.y, made.values, levels=[0.0], colors=INK, linewidths=1.0)
    x, y, value = made.columns
    ax.set(xlabel=f"${symbol(x)}$", ylabel=f"${symbol(y)}$", xlim=made.x_range, ylim=made.y_range)
    extend = "both" if np.nanmax(np.abs(made.values)) > limit else "neither"
    ax.figure.colorbar(cells, ax=ax, label=VALUES[value], extend=extend)
    return ax


def outcomes(made: Sweep, ax: Axes | None) -> Axes:
    """The outcome over two parameters, in one colour each, with a legend of those that occur."""
    ax = axes(ax)
    present = [name for name in (*FLAT, *HATCHED) if (made.outcome == name).any()]
    index = np.select([made.outcome == name for name in present], range(len(present)))
    colours = ListedColormap([FLAT.get(name, PAPER) for name in present])
    ax.pcolormesh(*made.edges(), index, cmap=colours, vmin=-0.5, vmax=len(present) - 0.5)
    for name in HATCHED.keys() & set(present):
        cells = np.ma.masked_where(made.outcome != name, np.zeros(made.outcome.shape))
        white = ListedColormap([PAPER])
        ax.pcolor(*made.edges(), cells, cmap=white, hatch=HATCHED[name], edgecolor=GREY, linewidth=0.0)
    (x, y), logs = made.columns[:2], made.logarithmic
    ax.set(xlabel=f"${symbol(x)}$", ylabel=f"${symbol(y)}$", xlim=made.x_range, ylim=made.y_range)
    ax.set(xscale="log" if logs[0] else "linear", yscale="log" if logs[1] else "linear")
    patches = [
        Patch(facecolor=FLAT.get(name, PAPER), hatch=HATCHED.get(name), edgecolor=GREY, label=made.words[name])
        for name in present
    ]
    ax.legend(handles=patches, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return ax


def colour_limit(values: NDArray[np.float64]) -> float:
    """Where the colours end: 1, 2 or 4 times a power of ten, near the typical size of the values of one sign."""
    known = values[np.isfinite(values) & (values != 0.0)]
    sides = [np.sort(np.abs(side)) for side in (known[known < 0.0], known[known > 0.0])]
    sizes = [side[int(0.7 * len(side))] for side in sides if len(side) > 0.01 * len(known)]
    if not sizes:
        return 1.0
    size = 0.75 * min(sizes)
    power = 10.0 ** math.floor(math.log10(size))
    return next(factor * power for factor in (1.0, 2.0, 4.0, 10.0) if factor * power >= size)


def symbol(parameter: str) -> str:
    """A parameter as the paper writes it."""
    name, _, index = parameter.partition("_")
    other = rf"\{name}" if name in GREEK else name if len(name) == 1 else rf"\mathrm{{{name}}}"
    return SYMBOLS.get(parameter, rf"{other}_{{\mathrm{{{index}}}}}" if index else other)


def growth(flow: Stability, ax: Axes | None) -> Axes:
    """The growth rate against the wave number."""
    ax = axes(ax)
    k = np.linspace(0.0, np.pi, 401)[1:]
    ax.axhline(0.0, color=GREY, linewidth=0.6, dashes=(4.0, 2.5))
    ax.plot(k, flow.growth_rate(k), color=SERIES[0], linewidth=1.0)
    ax.set(xlabel="wave number $k$", ylabel=r"$\mathrm{Re}\,z^+$", xlim=(0.0, np.pi))
    ax.set_xticks(np.linspace(0.0, np.pi, 5), ["0", r"$\pi/4$", r"$\pi/2$", r"$3\pi/4$", r"$\pi$"])
    return ax
