"""Places, and scenes that many tests use."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]

SHORT = """
[law]
kind = "logarithmic"
v0 = 1.2
epsilon = 0.01
[ring]
pedestrians = 20
length = 30.0
[start]
shift = 0.1
[run]
t_end = 30.0
sample = 1.0
method = "dop853"
tolerance = 1e-10
"""

SWEEP = """
[law]
kind = "formula"
acceleration = "kappa*(V - v)"
V = "tanh(s - 2) + tanh(2)"
body = 0.0
scale = 1.0
[ring]
pedestrians = 8
[start]
shift = 0.1
[run]
t_end = 500.0
method = "dop853"
tolerance = 1e-8
[sweep]
x = { parameter = "headway", from = 1.0, to = 3.0, cells = 27 }
y = { parameter = "kappa", from = 0.5, to = 4.0, cells = 8 }
"""

# minutes of work each
FIXED = {"t_end": 1e5, "sample": 1.0, "method": "heun", "dt": 1e-5, "record": "std"}
LONG = {"run.t_end": 1e6, "run.tolerance": 1e-13, "run.record": "std"}


@pytest.fixture
def command_line():
    """Runs a program of the command line, such as `simulate`, and returns what it prints."""
    folder = os.environ.get("JAMMING_PROGRAMS")
    if not folder:
        pytest.skip("JAMMING_PROGRAMS does not name the folder of simulate and map (checks/python-door.sh does)")

    def run(program, *arguments):
        words = [Path(folder) / program, *map(str, arguments)]
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout

    return run
