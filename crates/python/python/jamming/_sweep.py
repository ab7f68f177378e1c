"""Outcomes of the runs in a plane of parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._scene import Progress, Scene, given, plain, shown

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes


class Sweep:
    """The outcomes of runs over two parameters, in X x Y cells. All arrays of cells have the shape (Y, X)."""

    title: str
    """What the scene shows, in words."""
    columns: tuple[str, ...]
    """Names of the columns of the table: the horizontal axis, the vertical one, and the results of each cell."""
    x: NDArray[np.float64]
    """Values of the cells along the horizontal axis, shape (X,)."""
    y: NDArray[np.float64]
    """Values of the cells along the vertical axis, shape (Y,)."""
    x_range: tuple[float, float]
    """The range of the horizontal axis."""
    y_range: tuple[float, float]
    """The range of the vertical axis."""
    logarithmic: tuple[bool, bool]
    """Whether the axes, x and y, are logarithmic: cells with equal ratios instead of equal widths."""
    outcome: NDArray[np.str_]
    """The outcome of each run: a name as in `jamming.Outcome`."""
    words: dict[str, str]
    """These names in words."""
    backward_flow: NDArray[np.bool_]
    """Whether the uniform flow itself walks backwards."""
    decided_by: NDArray[np.str_]
    """``criterion`` (the start, without a run), ``run``, ``both`` (a run near the uniform flow, and its stability), or
    ``neighbours`` (not run, since all cells around have this outcome)."""
    numbers: dict[str, NDArray[np.float64]]
    """``t_decided`` (tau), ``least_gap`` (a_0), ``least_speed``, ``std``, ``wave_speed`` (a_0/tau) as in `jamming.Outcome`, and
    ``error`` (of the least gap and the least speed, from a second run). NaN where a number is missing."""

    def __init__(self, made: dict[str, Any]) -> None:
        def cells(array: NDArray[Any]) -> NDArray[Any]:
            # the table runs up the columns of the plane
            return array.reshape(len(self.x), len(self.y)).T

        self.title, self.x, self.y = made["title"], made["x"], made["y"]
        (x, *x_range, x_log), (y, *y_range, y_log) = made["x_axis"], made["y_axis"]
        self.x_range, self.y_range, self.logarithmic = tuple(x_range), tuple(y_range), (x_log, y_log)
        self.outcome = cells(np.array(made["classes"])[made["outcome"]])
        self.words = dict(zip(made["classes"], made["words"]))
        self.backward_flow = cells(made["backward_flow"])
        self.decided_by = cells(np.array(made["deciders"])[made["decided_by"]])
        self.numbers = {name: cells(numbers) for name, numbers in made["numbers"].items()}
        self.columns = (x, y, "outcome", "backward_flow", "decided_by", *self.numbers)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {name}" for name, count in self.counts().items())
        return f"<Sweep: {self.columns[0]} and {self.columns[1]}, {len(self.x)} x {len(self.y)} cells: {counts}>"

    def counts(self) -> dict[str, int]:
        """The number of cells with each outcome that occurs."""
        counts = {name: int((self.outcome == name).sum()) for name in self.words}
        return {name: count for name, count in counts.items() if count}

    def edges(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The edges of the cells along both axes, shapes (X + 1,) and (Y + 1,)."""
        spaces = [np.geomspace if is_log else np.linspace for is_log in self.logarithmic]
        return spaces[0](*self.x_range, len(self.x) + 1), spaces[1](*self.y_range, len(self.y) + 1)

    def to_pandas(self) -> pd.DataFrame:
        """The table ``cells.csv`` of the command line: a row for each cell; `backward_flow` is 0 or 1."""
        import pandas as pd

        x, y, *_ = self.columns
        cells = {"outcome": self.outcome, "backward_flow": self.backward_flow.astype(int), "decided_by": self.decided_by}
        rows = {name: column.T.ravel() for name, column in {**cells, **self.numbers}.items()}
        return pd.DataFrame({x: np.repeat(self.x, len(self.y)), y: np.tile(self.y, len(self.x)), **rows})

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the plane with matplotlib, a colour for each outcome."""
        from . import _plot

        return _plot.outcomes(self, ax)


def sweep(
    scene: Scene,
    *,
    panel: str | None = None,
    jobs: int | None = None,
    progress: Progress = None,
    **overrides: Any,
) -> Sweep:
    """Finds the outcomes of the runs in a plane, as ``cargo xtask sweep`` does, to the same bits.

    scene: a path to a scene file with ``[sweep]`` beside law, ring, start and run, its text (a str with a line break), or its
        tables as a dictionary. Axes are parameters of the law (omitted there), ``shift``, ``headway`` or ``d_gap`` (at fixed
        N; omit ``ring.length``), or ``pedestrians`` (at a fixed headway). With ``refine`` (the default) regions whose border
        has a single outcome are filled in without runs.
    jobs: the number of threads; None for all processors. The cells do not depend on it.
    panel, progress, overrides: as for `simulate`. Ctrl-C stops the sweep after the runs in progress, and nothing is kept. Use
        the command line for planes that take hours: it resumes after a kill and combines shards from several machines.

    Raises `SceneError` (a ValueError) for an invalid scene.

    >>> plane = sweep({
    ...     "law": {"kind": "formula", "acceleration": "kappa*(V - v)", "V": "tanh(s - 2) + tanh(2)", "body": 0.0, "scale": 1.0},
    ...     "ring": {"pedestrians": 10},
    ...     "start": {"shift": 0.1},
    ...     "run": {"t_end": 2000.0, "method": "dop853", "tolerance": 1e-8},
    ...     "sweep": {"x": {"parameter": "headway", "from": 1.0, "to": 3.0, "cells": 5},
    ...               "y": {"parameter": "kappa", "from": 0.25, "to": 2.75, "cells": 5}},
    ... })
    >>> plane.outcome[:, 2].tolist()                      # at headway 2 waves grow where kappa < 2 V'(2) = 2
    ['contact', 'waves', 'waves', 'decays', 'decays']
    """
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs = {jobs}: must be at least 1")
    with shown(progress, "sweep") as told:
        return Sweep(_native.sweep(given(scene), panel, plain(overrides), jobs, told))
