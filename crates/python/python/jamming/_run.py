"""Runs in time."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import RunError
from ._scene import Progress, Scene, given, plain, shown

if TYPE_CHECKING:
    import pandas as pd
    import pedpy
    from matplotlib.axes import Axes


class Event(NamedTuple):
    """The first event of its kind in a run."""

    event: str
    """``overlap``, ``negative_speed``, ``exchange``, ``blow_up`` or ``undefined``."""
    t: float
    """Its time, in units of tau."""
    n: int
    """The pedestrian, counted from 0."""
    gap: float
    """The spacing s_n at that time, in units of a_0."""
    step: float
    """The length of the integration step that contains it, in units of tau."""
    error: float | None
    """The estimated error of t; None if it was not estimated, or the second run had no such event."""


class Outcome(NamedTuple):
    """The outcome of a run, with the numbers that decide it."""

    name: str
    """In order of precedence: ``closed`` (two pedestrians touch at the start), ``no_uniform_flow``, ``undefined`` (the formula
    has no value for a pedestrian), ``blow_up``, ``contact``, ``decays`` (permanent return to the uniform flow),
    ``waves_backwards`` (lasting waves with backward motion), ``waves``, ``undecided``."""
    t: float
    """The time at which this was certain, in units of tau."""
    decided_by: str
    """The criterion that decided, in words."""
    missing: str | None
    """What is missing for a decision, if the run is undecided."""
    backward_flow: bool
    """Whether the uniform flow itself walks backwards."""
    least_gap: float
    """The least effective gap of the run (of the logarithmic law and of formulas without one the least spacing), in units of a_0."""
    least_speed: float
    """The least speed of the run, without the start from rest, in units of a_0/tau."""
    std: float
    """The standard deviation of the speeds: for waves the mean over the last window, otherwise the value at the end."""
    wave_speed: float | None
    """The speed of waves along the ring, negative against the direction of walking; None without waves."""
    distance: float | None
    """The distance of the deciding numbers from another outcome, in their units; 0 if undecided, None if unbounded."""


class Run:
    """The results of a run: T samples of N pedestrians. A run that stops at an event has the samples up to it.

    Arrays are views of one table in memory, not copies.
    """

    title: str
    """What the scene shows, in words."""
    summary: dict[str, Any]
    """The contents of ``summary.json``: law, steps, stop, events, jams, stability of the uniform flow, errors."""
    outcome: Outcome | None
    """The outcome; None if it was not requested."""
    events: tuple[Event, ...]
    """The first event of each kind, for all pedestrians to whom it happens at that time, in order of time."""
    t: NDArray[np.float64]
    """Times of the samples, shape (T,), in units of tau."""
    std: NDArray[np.float64]
    """Standard deviation of the speeds, ``sqrt(sum_n (v_n - mean)^2 / N)``, shape (T,), in units of a_0/tau."""
    x: NDArray[np.float64] | None
    """Positions, shape (T, N), in units of a_0: not wrapped around the ring. None if the scene has ``record = "std"``."""
    v: NDArray[np.float64] | None
    """Speeds, shape (T, N), in units of a_0/tau; None as for `x`."""
    x_end: NDArray[np.float64]
    """Positions at the end of the integration, ``summary["t"]``, shape (N,), in units of a_0."""
    v_end: NDArray[np.float64]
    """Speeds there, shape (N,), in units of a_0/tau."""
    sample: float
    """Time between samples, in units of tau."""
    desired_speed: float | None
    """v_0 of the law (of formulas v0, else scale), in units of a_0/tau; None if it has none."""

    def __init__(self, made: dict[str, Any]) -> None:
        self.title = made["title"]
        self.summary = json.loads(made["summary"])
        fields = [{"error": None, **event} for event in self.summary["events"]]
        self.events = tuple(Event(**event) for event in fields)
        self.outcome = None
        if (told := self.summary["outcome"]) is not None:
            self.outcome = Outcome(told["class"], **{name: told[name] for name in Outcome._fields[1:]})
        std = made["std"].reshape(-1, 2)
        self.t, self.std = std[:, 0], std[:, 1]
        self.x = self.v = None
        if made["trajectories"] is not None:
            table = made["trajectories"].reshape(-1, self.pedestrians, 4)
            self.x, self.v = table[:, :, 2], table[:, :, 3]
        self.x_end, self.v_end = made["x"], made["v"]
        self.sample, self.desired_speed = made["sample"], made["desired_speed"]

    def __repr__(self) -> str:
        law, steps = self.summary["law"], self.summary["steps"]
        return f"<Run: {law} law, {self.pedestrians} pedestrians, {steps} steps to t = {self.summary['t']!r}: {self.stop}>"

    @property
    def pedestrians(self) -> int:
        """N."""
        return int(self.summary["pedestrians"])

    @property
    def length(self) -> float:
        """The length L of the ring, in units of a_0."""
        return float(self.summary["length"])

    @property
    def stop(self) -> str:
        """What ended the tables: the name of an event, ``t_end``, or the reason why the run could not continue."""
        return str(self.summary["stop"])

    @property
    def errors(self) -> dict[str, float | None]:
        """Estimated errors: for ``std`` the largest over all samples, for ``x`` and ``v`` the largest at the end. Empty
        without a second run; None where that run ended elsewhere and gives no estimate."""
        return dict(self.summary["error"] or {})

    def to_pandas(self, table: str | None = None) -> pd.DataFrame:
        """A table of the command line as a DataFrame.

        ``"trajectories"`` (t, n, x, v; the default if they are recorded), ``"std"`` (t, std), or ``"events"`` (event, t, n,
        gap, step, error).
        """
        import pandas as pd

        match table or ("std" if self.x is None else "trajectories"):
            case "std":
                return pd.DataFrame({"t": self.t, "std": self.std})
            case "events":
                return pd.DataFrame(self.events, columns=Event._fields)
            case "trajectories" if self.x is not None and self.v is not None:
                count = self.pedestrians
                n = np.tile(np.arange(count), len(self.t))
                return pd.DataFrame({"t": np.repeat(self.t, count), "n": n, "x": self.x.ravel(), "v": self.v.ravel()})
            case "trajectories":
                raise ValueError('the scene does not keep trajectories: run.record must be "trajectories"')
            case other:
                raise ValueError(f"no table {other!r}; must be 'trajectories', 'std' or 'events'")

    def to_pedpy(self, a0: float | None = None, tau: float = 0.5, images: int = 0) -> pedpy.TrajectoryData:
        """The trajectories in metres and seconds, for PedPy's functions: one frame for each sample, y = 0.

        a0: the length a_0 in metres; by default such that the desired speed is 1.2 m/s, ``a_0 = 1.2 tau / v_0``.
        tau: the relaxation time in seconds. The frame rate is 1/(sample tau).
        images: the number of periodic images behind the last and ahead of the first pedestrian (numbers -1, -2, ... and N,
        N + 1, ...), so that all pedestrians have neighbours; n + N is the image of n one length of the ring ahead.
        """
        from ._pedpy import trajectories

        return trajectories(self, a0, tau, images)

    def walkable_area(self, a0: float | None = None, tau: float = 0.5) -> pedpy.WalkableArea:
        """A straight corridor, 1 m wide, that extends by the length of the ring behind and ahead of all. See `to_pedpy`."""
        from ._pedpy import corridor

        return corridor(self, a0, tau)

    def plot(self, what: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws ``"trajectories"`` (place on the ring against time, coloured by speed; the default if they are recorded) or
        ``"std"`` against time, with matplotlib."""
        from . import _plot

        match what or ("std" if self.x is None else "trajectories"):
            case "std":
                return _plot.std(self, ax)
            case "trajectories":
                return _plot.trajectories(self, ax)
            case other:
                raise ValueError(f"no picture {other!r}; must be 'trajectories' or 'std'")


def simulate(
    scene: Scene,
    *,
    panel: str | None = None,
    check: bool = True,
    outcome: bool = True,
    progress: Progress = None,
    **overrides: Any,
) -> Run:
    """Runs a scene to its end, or to the event that ends it, as ``cargo xtask simulate`` does, to the same bits.

    scene: a path to a scene file, its text (a str with a line break), or its tables as a dictionary.
    panel: the panel, for a scene with several runs.
    check: whether to estimate the errors of std, final state and events, if necessary by a second run with another method,
        which takes about as long as the first.
    outcome: whether to determine the outcome of the run.
    progress: a function that is called with the fraction done, from 0 to 1; or True for a bar, if tqdm is installed.
    overrides: values that replace those of the scene, by dotted keys: ``**{"law.a_v": 0.3, "run.t_end": 100.0}``; or a whole
        table, ``run={...}``. ``run.dt`` replaces ``run.tolerance``, and vice versa.

    Raises `SceneError` (a ValueError) for an invalid scene and `RunError` if the integration cannot continue. Ctrl-C stops a
    run; other Python threads continue while it is computed.

    >>> ring = '''
    ... [law]                    # dv/dt = (V(s) - v), the optimal velocity model
    ... kind         = "formula"
    ... acceleration = "V - v"
    ... V            = "tanh(s - 2) + tanh(2)"
    ... body         = 0.0
    ... [ring]
    ... pedestrians = 20
    ... length      = 40.0
    ... [start]
    ... shift = 0.1
    ... [run]
    ... t_end     = 1000.0
    ... sample    = 1.0
    ... method    = "dop853"
    ... tolerance = 1e-9
    ... '''
    >>> run = simulate(ring)
    >>> run
    <Run: formula law, 20 pedestrians, 3653 steps to t = 1000.0: t_end>
    >>> run.t.shape, run.x.shape, run.v.shape
    ((1001,), (1001, 20), (1001, 20))
    >>> bool(run.v[-1].min() < 0.1 < 1.8 < run.v[-1].max())  # a jam has grown, and moves on
    True
    >>> run.outcome.name, run.errors["std"] < 1e-6
    ('waves', True)
    >>> sparse = simulate(ring, check=False, **{"ring.length": 80.0, "run.t_end": 2000.0})
    >>> bool(sparse.std[-1] < sparse.std[1]), sparse.outcome.name, sparse.errors
    (True, 'decays', {})
    """
    with shown(progress, "run") as told:
        made = _native.simulate(given(scene), panel, plain(overrides), (check, outcome), told)
    run = Run(made)
    if made["broken"] is not None:
        raise RunError(made["broken"], run)
    return run
