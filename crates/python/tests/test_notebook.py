"""The notebooks run, and print what they show."""

import pytest
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")


@pytest.mark.parametrize("path", sorted((ROOT / "crates/python/docs").glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook(path, tmp_path):
    notebook = nbformat.read(path, as_version=4)
    shown = [printed(cell) for cell in notebook.cells]
    assert any(shown), "committed without what it prints"
    resources = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(notebook, timeout=120, record_timing=False, resources=resources).execute()
    for cell, expected in zip(notebook.cells, shown, strict=True):
        assert printed(cell) == expected


def printed(cell):
    """The texts and the kinds of the other outputs of a cell."""
    outputs = cell.get("outputs", [])
    return [one.get("text") or sorted(one.get("data", {})) for one in outputs]
