"""Stability maps over two parameters."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._scene import Progress, Scene, given, plain, shown

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes


class Map:
    """A value over two parameters, in X x Y cells of equal size."""

    title: str
    """What the scene shows, in words."""
    summary: dict[str, Any]
    """The output of ``cargo xtask map --json``: cells, shares of unstable and blank ones, reasons for blanks, error."""
    columns: tuple[str, str, str]
    """Names of the horizontal axis, of the vertical one and of the value (``margin``, ``phi`` or ``re_z``)."""
    x: NDArray[np.float64]
    """Centres of the cells along the horizontal axis, shape (X,)."""
    y: NDArray[np.float64]
    """Centres of the cells along the vertical axis, shape (Y,)."""
    x_range: tuple[float, float]
    """The range of the horizontal axis."""
    y_range: tuple[float, float]
    """The range of the vertical axis."""
    values: NDArray[np.float64]
    """The value of each cell, shape (Y, X), NaN where it is blank: negative where the uniform flow is stable."""

    def __init__(self, made: dict[str, Any]) -> None:
        self.title = made["title"]
        self.summary = json.loads(made["summary"])
        self.columns = tuple(made["columns"])
        self.x, self.y = made["x"], made["y"]
        self.x_range, self.y_range = made["x_range"], made["y_range"]
        # the table runs up the columns of the map
        self.values = made["values"].reshape(len(self.x), len(self.y)).T

    def __repr__(self) -> str:
        x, y, value = self.columns
        share = 100 * self.summary["unstable_share"]
        return f"<Map: {value} over {x} and {y}, {len(self.x)} x {len(self.y)} cells, {share:.1f} % above 0>"

    @property
    def error(self) -> float:
        """The largest difference from the same value computed in another way; relative for values above 1."""
        return float(self.summary["error"])

    def to_pandas(self) -> pd.DataFrame:
        """The table of the command line: a row for each cell, the two parameters and the value, NaN where it is blank."""
        import pandas as pd

        x, y, value = self.columns
        rows = {x: np.repeat(self.x, len(self.y)), y: np.tile(self.y, len(self.x)), value: self.values.T.ravel()}
        return pd.DataFrame(rows)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the map with matplotlib: blue where the uniform flow is stable, red where it is not, a line at 0."""
        from . import _plot

        return _plot.map(self, ax)


def map(scene: Scene, *, panel: str | None = None, progress: Progress = None, **overrides: Any) -> Map:
    """Computes a stability map, as ``cargo xtask map`` does, to the same bits.

    scene: a path to a scene file with ``[map]``, its text (a str with a line break), or its tables as a dictionary.
    panel, progress, overrides: as for `simulate`.

    Let f_{s_j}, f_{v_j} be the derivatives of the acceleration of n with respect to the spacing and speed of n + j in the
    uniform flow. A small wave exp(z t + i k n) obeys z^2 + b z + c = 0, b(k) = -sum_j f_{v_j} e^{ijk}, c(k) = sum_j f_{s_j} e^{ijk} (1 - e^{ik}).
    It decays if and only if Re b > 0 and D = (Re b)^2 Re c + Re b Im b Im c - (Im c)^2 > 0. The value ``margin`` (the
    default) is the largest -D / ((1 - cos k) sum_j f_{s_j}) over all k, negative where all waves decay; ``growth_rate`` is
    Re z of one k; ``criterion`` is the paper's, blank where its assumptions fail.

    Cells without a uniform flow or a value are blank. Raises `SceneError` (a ValueError) for an invalid scene, if a cell has
    several uniform flows and the scene names none, and if no cell has a value of 256
    that are spread over the plane (of a small one: of all).

    >>> speeds = map({
    ...     "law": {"kind": "formula", "acceleration": "kappa*(V - v)", "V": "tanh(s - 2) + tanh(2)", "body": 0.0},
    ...     "map": {"x": {"parameter": "headway", "from": 0.5, "to": 4.0, "cells": 7},
    ...             "y": {"parameter": "kappa", "from": 0.0, "to": 3.0, "cells": 6}},
    ... })
    >>> speeds
    <Map: margin over headway and kappa, 7 x 6 cells, 33.3 % above 0>
    >>> import numpy as np
    >>> exact = 2.0 / np.cosh(speeds.x - 2.0)**2 - speeds.y[:, None]   # unstable if kappa < 2 V'(s)
    >>> bool(((speeds.values > 0) == (exact > 0)).all()), speeds.error < 1e-12
    (True, True)
    """
    with shown(progress, "map") as told:
        return Map(_native.map(given(scene), panel, plain(overrides), told))
