"""Linear stability of one uniform flow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._scene import Scene, given, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Ring(NamedTuple):
    """The growth of small waves on a ring of N pedestrians, k = 2 pi l / N."""

    margin: float
    """The largest margin of its waves: negative where all decay."""
    growth_rate: float
    """Re z of the fastest wave, in units of 1/tau."""
    waves: int
    """The number l of periods of that wave on the ring."""


class Stability:
    """The growth of small waves exp(z t + i k n) on a uniform flow with one headway; see `jamming.map` for the equations."""

    headway: float
    """The spacing L/N of the uniform flow, in units of a_0."""
    speed: float
    """The steady speed v', at which the acceleration is 0, in units of a_0/tau."""
    margin: float | None
    """The distance from instability: negative where waves of all lengths decay. None where the flow lies on a kink of the
    law and has no derivatives."""
    margin_error: float | None
    """The difference from the margin computed in double-double arithmetic on a finer grid of waves."""
    growing: tuple[float, float] | None
    """The least and the largest wave number k that grows (0: the limit of long waves); None where none does. Between the two,
    a law with several neighbours may have waves that decay: `growth_rate(k)` shows them."""

    def __init__(self, headway: float, response: _native.Response) -> None:
        self.headway, self.speed, self._response = headway, response.speed, response
        self.margin = self.margin_error = None
        if (margins := response.margin()) is not None:
            self.margin, self.margin_error = margins[0], abs(margins[0] - margins[1])
        self.growing = response.growing()

    def __repr__(self) -> str:
        words = {True: "stable", False: "unstable", None: "on a kink of the law"}[self.stable]
        return f"<Stability: headway {self.headway!r}, speed {self.speed:.6g}: {words}>"

    @property
    def stable(self) -> bool | None:
        """Whether waves of all lengths decay; None where the flow lies on a kink of the law."""
        return None if self.margin is None else self.margin < 0.0

    def growth_rate(self, k: ArrayLike) -> NDArray[np.float64]:
        """Re z of the faster root, in units of 1/tau, for wave numbers k in (0, pi] of any shape; NaN on a kink of the law."""
        rate, _ = self._rates(k)
        return rate

    def growth_rate_error(self, k: ArrayLike) -> NDArray[np.float64]:
        """The estimated error of `growth_rate`: the difference from the rate with derivatives and residual in double-double
        arithmetic."""
        rate, refined = self._rates(k)
        return np.asarray(np.abs(rate - refined))

    def _rates(self, k: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        k = np.asarray(k, dtype=np.float64)
        if not np.all((k > 0.0) & (k <= np.pi)):
            raise ValueError("a wave number k must be above 0 and at most pi")
        rates = self._response.growth_rates(np.ascontiguousarray(k.ravel()))
        if rates is None:
            return np.full(k.shape, np.nan), np.full(k.shape, np.nan)
        return rates[0].reshape(k.shape), rates[1].reshape(k.shape)

    def on_ring(self, pedestrians: int) -> Ring | None:
        """The waves of a ring with the given number of pedestrians (at least 2); None where the flow lies on a kink of the law."""
        if pedestrians < 2:
            raise ValueError(f"pedestrians = {pedestrians}: must be at least 2")
        found = self._response.on_ring(pedestrians)
        return None if found is None else Ring(*found)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the growth rate against the wave number with matplotlib."""
        from . import _plot

        return _plot.growth(self, ax)


def stability(law: Scene, headway: float, *, speed: float | None = None, **overrides: Any) -> Stability:
    """The stability of the uniform flow in which all pedestrians keep the spacing ``headway`` and the steady speed.

    law: the table ``[law]`` as a dictionary or as text, or a scene that has one: a path, a text or a dictionary.
    headway: L/N, in units of a_0.
    speed: which steady speed is meant where a formula has several: the nearest is taken.
    overrides: values that replace those of the scene, by dotted keys, ``**{"law.a_v": 0.3}``.

    Raises `SceneError` (a ValueError) for a law that is wrong or has no uniform flow at this headway.

    >>> import numpy as np
    >>> law = {"kind": "formula", "acceleration": "kappa*(V - v)", "V": "tanh(s - 2) + tanh(2)", "kappa": 1.0, "body": 0.0}
    >>> flow = stability(law, 2.0)
    >>> flow
    <Stability: headway 2.0, speed 0.964028: unstable>
    >>> k = np.array([0.1, 1.0, np.pi])
    >>> flow.growth_rate(k).round(6).tolist()                      # long waves grow, short ones decay
    [0.004761, 0.073371, -0.5]
    >>> exact = ((np.sqrt(1.0 - 4.0 * (1.0 - np.exp(1j * k))) - 1.0) / 2.0).real     # z^2 + z + V' (1 - e^{ik}) = 0, V' = 1
    >>> bool(np.allclose(flow.growth_rate(k), exact, rtol=0.0, atol=1e-15))
    True
    >>> stability(law, 2.0, **{"law.kappa": 2.5}).stable           # kappa > 2 V'(s) = 2
    True
    >>> flow.on_ring(20).waves                                     # k = 2 pi 3/20 grows fastest
    3
    """
    return Stability(headway, _native.response(given(law), headway, speed, plain(overrides)))
