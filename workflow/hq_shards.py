#!/usr/bin/env python3
"""Computes the shards of a sweep by HyperQueue, then gathers them. From the root of the checkout:

    python workflow/hq_shards.py scenes/sweep.toml --out my-sweep --shards 4 [--server DIR] [--tables-only]

Without --server, a server with one worker runs on this machine for as long as it takes. With it, the shards go to the
server of that folder and run where its workers are. XTASK names the program that starts a sweep, by default "cargo xtask".
"""

import argparse
import os
import shlex
import subprocess
import sys
from pathlib import Path

from hyperqueue import Client, Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

ROOT = Path(__file__).resolve().parent.parent
ATTEMPTS = 3


def compute(client: Client, sweep: list[str], logs: Path, shards: int) -> bool:
    """Whether all shards are there: those that fail are tried again, and go on where they were."""
    for _ in range(ATTEMPTS):
        # a shard that fails keeps no other from being computed; one that is there is read and left as it is
        job = Job(default_workdir=ROOT, max_fails=None, default_env=dict(os.environ), name="sweep")
        for i in range(1, shards + 1):
            log = str(logs / f"{i}-of-{shards}.log")
            job.program([*sweep, "--shard", f"{i}/{shards}", "--jobs", "1"], stdout=log, stderr=log)
        if client.wait_for_jobs([client.submit(job)], raise_on_error=False):
            return True
    return False


def main() -> int:
    parser = argparse.ArgumentParser(description="The shards of a sweep by HyperQueue")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--shards", type=int, default=4)
    parser.add_argument("--server", type=Path, help="the folder of a server that runs already")
    parser.add_argument("--tables-only", action="store_true", help="no picture")
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    runner = shlex.split(os.environ.get("XTASK", "cargo xtask"))
    sweep = [*runner, "sweep", str(arguments.scene.resolve()), "--out", str(out)]
    # built once, before the shards
    subprocess.run([*sweep[:-2], "--dry-run"], cwd=ROOT, check=True)
    logs = out / "hyperqueue"
    logs.mkdir(parents=True, exist_ok=True)
    if arguments.server:
        is_done = compute(Client(arguments.server), sweep, logs, arguments.shards)
    else:
        with LocalCluster(str(logs / "server"), WorkerConfig()) as cluster:
            is_done = compute(cluster.client(), sweep, logs, arguments.shards)
    if not is_done:
        print(f"a shard failed {ATTEMPTS} times: see {logs}", file=sys.stderr)
        return 1
    tables_only = ["--tables-only"] if arguments.tables_only else []
    return subprocess.run([*sweep, "--gather", *tables_only], cwd=ROOT).returncode


if __name__ == "__main__":
    sys.exit(main())
