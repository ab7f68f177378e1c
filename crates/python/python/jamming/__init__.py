"""Force-based models of pedestrians (or cars) in single file on a ring: runs, their outcomes, and stability maps.

    >>> import jamming
    >>> run = jamming.simulate({
    ...     "law": {"kind": "logarithmic", "v0": 1.0, "epsilon": 0.01},
    ...     "ring": {"pedestrians": 10, "length": 20.0},
    ...     "start": {"shift": 0.1},
    ...     "run": {"t_end": 20.0, "sample": 1.0, "method": "dop853", "tolerance": 1e-9},
    ... })
    >>> run.x.shape, run.stop
    ((21, 10), 't_end')

Each pedestrian n obeys ``dx_n/dt = v_n``, ``dv_n/dt = f(s_n, v_n, ...)`` with the spacing ``s_n = x_{n+1} - x_n`` to the one
ahead; the last follows the first, one length of the ring ahead. A scene states the law f, the ring, the start and the
duration: see ``scenes/ring.toml`` and ``scenes/map.toml``, and ``scenes/FORMULAS.md`` for laws of your own. All quantities
are dimensionless: lengths are in units of a_0 (half the length of a standing pedestrian), times in units of the
relaxation time tau, speeds in units of a_0/tau.

The numbers are those of the command line, to the last bit. Source of the laws and of most scenes: Chraibi et al.,
Phys. Rev. E 92, 042809 (2015).
"""

from ._errors import RunError, SceneError
from ._map import Map, map
from ._run import Event, Outcome, Run, simulate
from ._stability import Ring, Stability, stability
from ._sweep import Sweep, sweep

__all__ = [
    "Event",
    "Map",
    "Outcome",
    "Ring",
    "Run",
    "RunError",
    "SceneError",
    "Stability",
    "Sweep",
    "map",
    "simulate",
    "stability",
    "sweep",
]
