"""Trajectories in metres and seconds, as PedPy takes them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pedpy
    from numpy.typing import NDArray

    from ._run import Run

# The desired speed that the paper calls typical, in tenths of a metre a second: as `cargo xtask export` has it.
TYPICAL_SPEED = 12


def metres(run: Run, a0: float | None, tau: float) -> float:
    """a_0 in metres."""
    if not 0.0 < tau < math.inf:
        raise ValueError(f"tau = {tau!r}: must be a number of seconds above 0")
    if a0 is None:
        if run.desired_speed is None:
            raise ValueError("the law has neither v0 nor scale, so that a0 cannot follow from 1.2 m/s: a0= must be given")
        return TYPICAL_SPEED * tau / (10.0 * run.desired_speed)
    if not 0.0 < a0 < math.inf:
        raise ValueError(f"a0 = {a0!r}: must be a number of metres above 0")
    return a0


def positions(run: Run) -> NDArray[np.float64]:
    """The positions, if they are kept."""
    if run.x is None:
        raise ValueError('the scene does not keep trajectories: run.record must be "trajectories"')
    return run.x


def trajectories(run: Run, a0: float | None, tau: float, images: int) -> pedpy.TrajectoryData:
    """See `Run.to_pedpy`."""
    import pandas as pd
    import pedpy

    unit, x = metres(run, a0, tau), positions(run)
    if images < 0:
        raise ValueError(f"images = {images}: must be 0 or more")
    turns, places = np.divmod(np.arange(-images, run.pedestrians + images), run.pedestrians)
    frames, count = len(x), len(places)
    table = {
        "id": np.tile(np.arange(-images, run.pedestrians + images), frames),
        "frame": np.repeat(np.arange(frames), count),
        "x": (unit * x[:, places] + unit * run.length * turns).ravel(),
        "y": np.zeros(frames * count),
    }
    return pedpy.TrajectoryData(data=pd.DataFrame(table), frame_rate=1.0 / (run.sample * tau))


def corridor(run: Run, a0: float | None, tau: float) -> pedpy.WalkableArea:
    """See `Run.walkable_area`."""
    import pedpy

    unit, x = metres(run, a0, tau), positions(run)
    behind, ahead = unit * (x.min() - run.length), unit * (x.max() + run.length)
    return pedpy.WalkableArea([(behind, -0.5), (ahead, -0.5), (ahead, 0.5), (behind, 0.5)])
