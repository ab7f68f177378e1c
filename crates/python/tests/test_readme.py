"""The lines of README.md that a user pastes."""

import re

import matplotlib
import pytest
from conftest import ROOT


def test_they_run(tmp_path, monkeypatch):
    pytest.importorskip("pedpy")
    matplotlib.use("Agg")
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert len(block.splitlines()) == 5
    names = {}
    exec(block, names)
    assert (tmp_path / "run.png").stat().st_size > 10_000
    assert len(names["trajectories"].data) == names["run"].x.size
