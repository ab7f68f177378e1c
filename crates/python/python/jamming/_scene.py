"""Conversion of scenes and progress arguments."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Union

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A path, the text of a scene file (a str with a line break), or its tables as a mapping."""

Progress = Union[bool, Callable[[float], object], None]
"""A function that is called with the fraction done, 0 to 1; True: a bar by tqdm, if it is installed."""


def given(scene: Scene) -> dict[str, Any] | str | Path:
    """The scene in the form that the native module accepts."""
    if isinstance(scene, Mapping):
        return plain(scene)
    if isinstance(scene, str) and "\n" in scene:
        return scene
    path = Path(scene)
    path.stat()  # FileNotFoundError rather than a complaint about a scene
    return path


def plain(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Mappings of any kind as dictionaries."""
    return {key: plain(value) if isinstance(value, Mapping) else value for key, value in tables.items()}


@contextmanager
def shown(progress: Progress, words: str) -> Iterator[Callable[[float], object] | None]:
    """The function that receives the progress of a computation."""
    if progress is not True:
        yield progress or None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=100, desc=words, bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:
        yield lambda part: bar.update(100 * part - bar.n)
