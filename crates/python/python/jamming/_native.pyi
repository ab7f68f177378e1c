"""What the package computes with; see its sources in Rust."""

from os import PathLike
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

Given = dict[str, Any] | str | PathLike[str]

def simulate(
    given: Given,
    panel: str | None,
    values: dict[str, Any],
    wanted: tuple[bool, bool],
    progress: Callable[[float], object] | None,
) -> dict[str, Any]: ...
def map(
    given: Given, panel: str | None, values: dict[str, Any], progress: Callable[[float], object] | None
) -> dict[str, Any]: ...
def sweep(
    given: Given,
    panel: str | None,
    values: dict[str, Any],
    jobs: int | None,
    progress: Callable[[float], object] | None,
) -> dict[str, Any]: ...
def response(given: Given, headway: float, speed: float | None, values: dict[str, Any]) -> Response: ...

class Response:
    speed: float
    def margin(self) -> tuple[float, float] | None: ...
    def growing(self) -> tuple[float, float] | None: ...
    def on_ring(self, pedestrians: int) -> tuple[float, float, int] | None: ...
    def growth_rates(self, k: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None: ...
