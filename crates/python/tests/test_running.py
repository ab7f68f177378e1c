"""Other threads, Ctrl-C and callbacks, while something is computed."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import LONG, ROOT, SHORT

import jamming


def test_other_threads_go_on():
    ends = threading.Event()
    ticks = []

    def tick():
        while not ends.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    begin = time.monotonic()
    jamming.simulate(ROOT / "scenes/ring.toml", **{"run.tolerance": 1e-13})
    end = time.monotonic()
    ends.set()
    thread.join()
    during = [one for one in ticks if begin < one < end]
    # with the lock held there would be none
    assert len(during) > 20 * (end - begin)


INTERRUPTED = """
import sys, time
import jamming
sys.path.insert(0, {tests!r})
from conftest import FIXED, LONG, SHORT, SWEEP
print("ready", flush=True)
begin = time.monotonic()
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", time.monotonic() - begin)
"""

CALLS = {
    "run": "jamming.simulate(SHORT, **LONG)",
    "fixed steps": 'jamming.simulate(SHORT, run=FIXED)',
    "sweep": 'jamming.sweep(SWEEP, **{"sweep.x.cells": 500, "sweep.y.cells": 500})',
    "map": 'jamming.map("MAP", **{"map.x.cells": 2000, "map.y.cells": 2000})',
}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
@pytest.mark.parametrize("call", CALLS)
def test_an_interrupt_stops_it(call):
    words = CALLS[call].replace("MAP", str(ROOT / "scenes/map.toml"))
    text = INTERRUPTED.format(tests=os.path.dirname(__file__), call=words)
    with subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        sent = time.monotonic()
        told = child.stdout.readline().split()
        assert told[0] == "interrupted" and float(told[1]) > 0.4
        assert time.monotonic() - sent < 2.0
        child.wait(10)


def test_progress_rises_to_the_end():
    parts = []
    jamming.simulate(SHORT, progress=parts.append, **{"run.t_end": 1e4, "run.record": "std"})
    assert len(parts) > 3 and parts == sorted(parts) and parts[0] > 0 and parts[-1] == 1.0
    parts.clear()
    jamming.map(ROOT / "scenes/map.toml", progress=parts.append)
    assert parts == sorted(parts) and parts[-1] == 1.0


def test_what_a_callback_raises_ends_the_run():
    def stop(part):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        jamming.simulate(SHORT, progress=stop, **LONG)


def test_a_bar(capsys):
    pytest.importorskip("tqdm")
    jamming.simulate(SHORT, progress=True)
    assert "100%" in capsys.readouterr().err


def test_looking_on_changes_no_bit():
    plain, seen = (jamming.simulate(SHORT, progress=one) for one in (None, lambda part: None))
    assert plain.std.tobytes() == seen.std.tobytes()
