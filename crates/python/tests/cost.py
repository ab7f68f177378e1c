"""What the door costs: seconds of the command line and of Python, in turns; seconds of a call that computes next to nothing.

    JAMMING_PROGRAMS=target/release python crates/python/tests/cost.py
"""

import json
import os
import statistics
import subprocess
import time
from pathlib import Path

from conftest import ROOT, SHORT

import jamming

SCENES = ["scenes/ring.toml", "scenes/gallery/mean-spacing.toml", "figures/fig11-trajectories/scene.toml"]
TURNS = 15


def seconds(scene):
    """CPU of the integration alone by the command line, by Python; CPU of all of the call."""
    words = [Path(os.environ["JAMMING_PROGRAMS"]) / "simulate", scene, "--json", "--no-check"]
    told = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    begin = time.thread_time()
    run = jamming.simulate(scene, check=False, progress=lambda part: None)
    return told["seconds"], run.summary["seconds"], time.thread_time() - begin


def median(function, turns):
    function()
    times = []
    for _ in range(turns):
        begin = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin)
    return 1e3 * statistics.median(times)


if __name__ == "__main__":
    for scene in SCENES:
        turns = [seconds(ROOT / scene) for _ in range(TURNS)]
        line, here, call = (statistics.median(column) for column in zip(*turns))
        ratios = statistics.median(turn[1] / turn[0] for turn in turns)
        print(f"{scene}: {line:.3f} s, in Python {here:.3f} s, whole call {call:.3f} s; median of the ratios {ratios:.3f}")
    tiny = {"run.t_end": 1e-3, "run.record": "std", "ring.pedestrians": 2, "ring.length": 3.0}
    law = {"kind": "logarithmic", "v0": 1.2, "epsilon": 0.01}
    one = {"map.x.cells": 1, "map.y.cells": 1}
    print(f"a run of next to nothing: {median(lambda: jamming.simulate(SHORT, check=False, **tiny), 200):.3f} ms")
    print(f"a map of one cell: {median(lambda: jamming.map(ROOT / 'scenes/map.toml', **one), 200):.3f} ms")
    print(f"stability: {median(lambda: jamming.stability(law, 1.5), 200):.3f} ms")
