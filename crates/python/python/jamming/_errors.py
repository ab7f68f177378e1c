"""Exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._run import Run


class SceneError(ValueError):
    """An invalid scene. The message is complete; the attributes give its parts, None where they do not apply.

    >>> import jamming
    >>> try:
    ...     jamming.stability({"kind": "logarithmic", "v0": -1.0, "epsilon": 0.01}, 1.5)
    ... except jamming.SceneError as error:
    ...     print(error)
    ...     print(error.key, error.value, error.allowed, sep=" | ")
    <dict>: law.v0 = -1: must be a number > 0.0
    law.v0 | -1.0 | a number > 0.0
    """

    file: str | None
    """The scene file; None for a text or a dictionary."""
    line: int | None
    """The line, counted from 1; None for values that come from no file, such as an override."""
    key: str | None
    """The key with its table, such as ``run.t_end``."""
    value: float | str | None
    """The value found, if it is a number or a text."""
    allowed: str | None
    """What would be valid, in words."""

    def __init__(
        self,
        message: str,
        file: str | None = None,
        line: int | None = None,
        key: str | None = None,
        value: float | str | None = None,
        allowed: str | None = None,
    ) -> None:
        super().__init__(message, file, line, key, value, allowed)
        self.file, self.line, self.key, self.value, self.allowed = file, line, key, value, allowed

    def __str__(self) -> str:
        return str(self.args[0])


class RunError(RuntimeError):
    """A run that could not continue although no event ended it. The message says why and what helps."""

    run: Run
    """Its results up to that point."""

    def __init__(self, message: str, run: Run) -> None:
        super().__init__(message, run)
        self.run = run

    def __str__(self) -> str:
        return str(self.args[0])
