#!/usr/bin/env python3
"""A thousand short runs in one process, beside Boost.Odeint: python3 bench/cells.py. See bench/README.md, "Short runs".

Prints the table; --out writes it as cells.md there.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

import build
from cases import CASES, error, read_states
from peers import ROOT, processor

OURS = [
    ("run", "taylor", "a run to t = 500: events, samples at t = 0, 1, 2, ..."),
    ("run", "dopri54", "the same"),
    ("judged", "taylor", "a run to t = 500: events, judged, no samples"),
    ("cell", "taylor", "a cell of a sweep: two runs, judged, each to where its outcome is certain"),
    ("cell", "dop853", "the same"),
]
THEIRS = [("plain", "1e-6", "1"), ("deviation", "1e-6", "1e-3")]


def seconds_of(command):
    """CPU seconds of all runs, and the right-hand sides of one."""
    done = json.loads(build.run(list(map(str, command)), command[0].name))
    seconds = done["seconds"]
    return (sum(seconds) if isinstance(seconds, list) else seconds), done["evaluations"]


def peak(command):
    """The peak memory of a process, in MB."""
    child = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL)
    _, _, usage = os.wait4(child.pid, 0)
    return usage.ru_maxrss / 1024


def main(options):
    scratch = options.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    build.system_packages(False, {"odeint"})
    odeint = build.programs(scratch, {"odeint"}, options.march)["odeint"]
    example = ["cargo", "build", "--release", "-p", "sweep", "--example", "cells"]
    build.run(example, "cargo build", cwd=ROOT)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    cells, states = target / "release" / "examples" / "cells", scratch / "states.csv"
    case = CASES[0]
    with (ROOT / "data/reference/solutions" / f"{case.name}.csv").open() as file:
        truth = {key: state for key, state in read_states(file).items() if 0 < key[0] <= case.end}
    times = ",".join(map(str, sorted({t for t, _ in truth})))
    commands = {("ours", how, method): [cells, how, method, "1e-6", options.count] for how, method, _ in OURS}
    for form, tolerance, ratio in THEIRS:
        commands["Boost.Odeint", form, "dopri54"] = [
            odeint, case.name, form, "dopri54", tolerance, ratio, options.count, times, states
        ]  # fmt: skip
    found = {key: [] for key in commands}
    for _ in range(options.rounds):
        for key, command in commands.items():
            found[key].append(seconds_of(command))
    best = min((key for key in commands if key[0] != "ours"), key=lambda key: total(found[key]))
    lines = header(options, cells, commands)
    for key, command in commands.items():
        what = next((words for how, method, words in OURS if key[1:] == (how, method)), "a run to t = 500: samples")
        if key[0] != "ours":
            seconds_of(command)
            with states.open() as file:
                what += f"; state {key[1]}, error {error(read_states(file), truth)[0]:.1e}"
        pairs = [theirs[0] / own[0] for theirs, own in zip(found[best], found[key], strict=True)]
        rate = options.count / total(found[key])
        lines.append(f"| {key[0]}, {key[2]} | {what} | {rate:.0f} | {statistics.median(pairs):.2f} |")
    text = "\n".join(lines) + "\n"
    print(text)
    if options.out:
        (options.out / "cells.md").write_text(text)


def total(measured):
    return statistics.median(seconds for seconds, _ in measured)


def header(options, cells, commands):
    march = f" --march {options.march}" if options.march else ""
    memory = peak(commands["ours", "cell", "taylor"])
    return [
        "# A thousand short runs in one process",
        "",
        f"Figure 4, stable (67 pedestrians, t = 500), tolerance 1e-6, {options.count} runs; one core, seconds of CPU, in turn,",
        f"median of {options.rounds} rounds. Last column: the faster form of Boost.Odeint's seconds over those of the row (median of the",
        "ratios of each round). Ours looks for events and follows the positions, the peer does neither.",
        f"Peak memory of a process of ours that computes {options.count} cells: {memory:.0f} MB.",
        "",
        f"- {processor()}",
        f"- `python3 bench/cells.py --rounds {options.rounds} --count {options.count}{march}`; C++ with `{' '.join(build.flags(options.march)[0])}`",
        "",
        "| integrator | what it does | a second and core | as fast as Boost.Odeint, times |",
        "|---|---|---|---|",
    ]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scratch", type=Path, default=ROOT / "target" / "bench-peers", help="where peers are built")
    parser.add_argument("--rounds", type=int, default=15, help="measurements of each")
    parser.add_argument("--count", type=int, default=1000, help="runs in a process")
    parser.add_argument("--march", choices=["x86-64-v3", "x86-64-v4"], help="of the peer; the widest by default")
    parser.add_argument("--out", type=Path, help="a folder for cells.md")
    try:
        main(parser.parse_args())
    except build.Trouble as trouble:
        sys.exit(f"cells.py: {trouble}")
