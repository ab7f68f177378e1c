#!/usr/bin/env python3
"""Runs integrators of other projects beside ours on the same samples, and prints who needs how long for which error.

python3 bench/peers.py [--quick] [--install]: see bench/README.md. Results: data/timing/peers.csv and peers.md.
"""

import argparse
import json
import platform
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import build
from cases import CASES, PEERS, TARGETS, Setting, error, exponents, read_states, read_trajectories, series
from report import csv, markdown

ROOT = Path(__file__).resolve().parent.parent
OURS = "ours"
BEFORE = "ours before"
PATIENCE = 2.0  # seconds after which a series of tolerances goes on no further


class Runner:
    """Runs a setting on a case: seconds, right-hand sides and, where it is asked for, the states."""

    def __init__(self, folder, programs, python, simulate):
        self.folder, self.simulate = folder, simulate
        # peers estimate no errors of a run and judge none; an earlier commit may not know the options
        self.without = {peer: known_options(program) for peer, program in simulate.items()}
        self.commands = {name: [path] for name, path in programs.items()}
        if python:
            for name in sorted(build.PYTHON):
                self.commands[name] = [python, build.BENCH / "python" / f"{name}_ring.py", programs["rhs"]]
        for case in CASES:
            for record in ["std", "trajectories"]:
                (folder / f"{case.name}-{record}.toml").write_text(case.scene(record))

    def ours(self, case, method, tolerance, record="std", peer=OURS):
        options = ["--method", method, "--tol", tolerance, "--json", *self.without[peer]]
        if record == "trajectories":
            options += ["--out", self.folder / "out", "--tables-only"]
        return [self.simulate[peer], self.folder / f"{case.name}-{record}.toml", *options]

    def our_methods(self):
        """The names in the message about an unknown one, without those that have no control of their steps."""
        asked = subprocess.run(self.ours(CASES[0], "?", "1e-6"), capture_output=True, text=True)
        found = re.search(r"must be one of (.*)", asked.stderr)
        if not found:
            raise build.Trouble(f"simulate does not list its methods: {asked.stderr}")
        names = re.findall(r"[a-z0-9-]+", found[1])
        return [name for name in names if run_quietly(self.ours(CASES[0], name, "1e-6"))]

    def time(self, case, setting, times):
        """(CPU seconds, right-hand sides), or None if it fails; the states of a peer are left in a file."""
        if setting.peer in self.simulate:
            done = run_quietly(self.ours(case, setting.method, setting.tolerance, peer=setting.peer))
            result = done and json.loads(done)
            # a run that an event ends early is no solution
            return (result["seconds"], result["right_hand_sides"]) if result and result["stop"] == "t_end" else None
        arguments = [case.name, setting.form, setting.method, setting.tolerance, setting.ratio, "1"]
        arguments += [",".join(map(str, times)), self.folder / "states.csv"]
        done = run_quietly([*self.commands[setting.program], *arguments])
        result = done and json.loads(done)
        return (result["seconds"][0], result["evaluations"]) if result else None

    def states(self, case, setting, times):
        """The states at these times, of the run just timed or, for ours, of another one that keeps them."""
        if setting.peer not in self.simulate:
            with (self.folder / "states.csv").open() as file:
                return read_states(file)
        build.run(self.ours(case, setting.method, setting.tolerance, "trajectories", setting.peer), "simulate")
        with (self.folder / "out" / "trajectories.csv").open() as file:
            return read_trajectories(file, 200.0, times)


def known_options(program):
    """The options of ours that leave out what no peer does, as far as the program has them."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True).stdout
    return [option for option in ["--no-check", "--no-outcome"] if option in text]


def run_quietly(command, limit=60.0):
    """What a command prints, or None if it fails or takes longer than `limit` seconds."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    return done.stdout if done.returncode == 0 else None


def reference(runner, case, folder):
    """The reference states, and where they come from."""
    file = folder / f"{case.name}.csv"
    if file.exists():
        with file.open() as lines:
            states = read_states(lines)
        return {key: state for key, state in states.items() if 0 < key[0] <= case.end}, "double-double reference"
    own = Setting(OURS, "", "deviation", "extrapolation", "1e-15", "")
    return runner.states(case, own, case.times()), "own extrapolation at 1e-15, no reference file"


def sweep(runner, case, wanted, truth):
    """Runs every series from its loosest tolerance on, until it reaches the smallest target or takes too long.

    [(setting, seconds, right-hand sides, largest error, error at the end)]
    """
    times, rows = sorted({t for t, _ in truth}), []
    for settings in wanted:
        for setting in settings:
            timed = runner.time(case, setting, times)
            if not timed:
                print(f"{case.name}: {setting.peer}: {setting.label()}: failed", file=sys.stderr)
                continue
            largest, last = error(runner.states(case, setting, times), truth)
            rows.append((setting, *timed, largest, last))
            print(f"{case.name}: {setting.peer}: {setting.label()}: {timed[0]:.5f} s, {largest:.1e}", file=sys.stderr)
            if largest <= min(TARGETS) or timed[0] > PATIENCE:
                break
    return rows


def candidates(rows, target):
    """The two fastest settings of each integrator that reach the target: the sweep's single times are noisy."""
    by_peer = {}
    for row in sorted((row for row in rows if row[3] <= target), key=lambda row: row[1]):
        by_peer.setdefault(row[0].peer, []).append(row)
    return [row for found in by_peer.values() for row in found[:2]]


def measure(runner, case, rows, rounds):
    """Runs the chosen settings in turn, round by round: the median seconds of each."""
    chosen = {row[0]: [] for target in TARGETS for row in candidates(rows, target)}
    for _ in range(rounds):
        for setting, seconds in chosen.items():
            timed = runner.time(case, setting, [case.end])
            if timed:
                seconds.append(timed[0])
    return {setting: statistics.median(seconds) for setting, seconds in chosen.items() if seconds}


def best(rows, medians, target):
    """The fastest setting of each integrator for a target, fastest first."""
    found = {}
    for setting, _, evaluations, largest, last in rows:
        if largest <= target and setting in medians:
            seconds = medians[setting]
            if setting.peer not in found or seconds < found[setting.peer]["seconds"]:
                found[setting.peer] = {
                    "integrator": setting.peer,
                    "method": setting.method,
                    "form": setting.form,
                    "tolerance": setting.tolerance,
                    "ratio": setting.ratio,
                    "seconds": seconds,
                    "right_hand_sides": evaluations,
                    "error": largest,
                    "error_at_end": last,
                }
    return sorted(found.values(), key=lambda row: row["seconds"])


def names(text):
    return text.split(",")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scratch", type=Path, default=ROOT / "target" / "bench-peers", help="where peers are built")
    parser.add_argument("--reference", type=Path, default=ROOT / "data" / "reference" / "solutions", help="CASE.csv")
    parser.add_argument("--out", type=Path, default=ROOT / "data" / "timing", help="where peers.csv and peers.md go")
    parser.add_argument("--rounds", type=int, default=7, help="measurements of each setting in the table")
    parser.add_argument("--quick", action="store_true", help="fewer tolerances, 3 rounds")
    parser.add_argument("--cases", type=names, help=f"of {', '.join(case.name for case in CASES)}; all by default")
    parser.add_argument("--peers", type=names, help=f"of {', '.join(peer.name for peer in PEERS)}; all by default")
    parser.add_argument("--methods", type=names, help="of ours; all by default")
    parser.add_argument("--before", type=Path, help="the program `simulate` of an earlier commit, measured in turn with ours")
    parser.add_argument("--march", choices=["x86-64-v3", "x86-64-v4"], help="of the peers; the widest by default")
    parser.add_argument("--install", action="store_true", help="install missing system packages (apt-get, as root)")
    options = parser.parse_args()
    for wanted, known in [(options.cases, CASES), (options.peers, PEERS)]:
        unknown = set(wanted or []) - {one.name for one in known}
        if unknown:
            parser.error(f"unknown: {', '.join(sorted(unknown))}")
    return options


def compare(runner, options):
    """The tables of all cases asked for, [(case, target, rows)], and against what each was judged."""
    wanted = [
        [Setting(peer, "", "deviation", method, f"1e-{k}", "") for k in exponents(options.quick)]
        for peer in runner.simulate
        for method in (options.methods or runner.our_methods())
    ]
    wanted += [one for one in series(options.quick) if not options.peers or one[0].peer in options.peers]
    tables, truths = [], {}
    for case in [case for case in CASES if not options.cases or case.name in options.cases]:
        truth, truths[case.title] = reference(runner, case, options.reference)
        rows = sweep(runner, case, wanted, truth)
        medians = measure(runner, case, rows, 3 if options.quick else options.rounds)
        tables += [(case, target, best(rows, medians, target)) for target in TARGETS]
    return tables, truths


def main(options):
    scratch = options.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    wanted = {peer.program for peer in PEERS if not options.peers or peer.name in options.peers}
    build.system_packages(options.install, wanted)
    python = build.python_environment(scratch) if wanted & build.PYTHON else None
    programs, simulate = build.programs(scratch, wanted, options.march), {OURS: build.simulate()}
    if options.before:
        simulate[BEFORE] = options.before.resolve()
    with tempfile.TemporaryDirectory(dir=scratch) as folder:
        programs, simulate = (build.copies(paths, Path(folder)) for paths in (programs, simulate))
        tables, truths = compare(Runner(Path(folder), programs, python, simulate), options)
    facts = {
        "processor": processor(),
        "command": shlex.join(["python3", "bench/peers.py", *chosen(options)]),
        "flags": " ".join(build.flags(options.march)[0]),
        "versions": build.versions(python),
        "references": truths,
    }
    text = markdown(tables, facts)
    print(text)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "peers.md").write_text(text)
    (options.out / "peers.csv").write_text(csv(tables))


def chosen(options):
    """The options that change the tables, to make them again."""
    given = ["--quick"] if options.quick else ["--rounds", str(options.rounds)]
    for name, value in [("--cases", options.cases), ("--peers", options.peers), ("--methods", options.methods)]:
        given += [name, ",".join(value)] if value else []
    return given + (["--march", options.march] if options.march else [])


def processor():
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    return f"{names[0] if names else platform.machine()}, {len(names)} cores, Linux {platform.machine()}"


if __name__ == "__main__":
    try:
        main(arguments())
    except build.Trouble as trouble:
        sys.exit(f"peers.py: {trouble}")
