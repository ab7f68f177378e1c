"""Arguments, samples, the clock of the process and results of a program around an integrator called from Python.

PROGRAM LIBRARY CASE FORM METHOD TOLERANCE RATIO REPEATS TIMES STATES: as bench/cpp/harness.hpp, which says what they
mean; LIBRARY is the right-hand side compiled from bench/cpp/rhs.cpp.
"""

import ctypes
import json
import sys
import time
from pathlib import Path

import numpy as np

CASES = {
    "algebraic_stable": {"pedestrians": 67, "length": 200.0, "end": 500},
    "logarithmic": {"pedestrians": 133, "length": 200.0, "end": 3000},
    "logarithmic_small_shift": {"pedestrians": 133, "length": 200.0, "end": 3000},
}


class Job:
    """What the command line asks for, with the ring opened in the library."""

    def __init__(self, arguments):
        library, self.case, form, self.method, tolerance, ratio, repeats, times, self.states = arguments
        self.deviation = form == "deviation"
        self.relative = float(tolerance)
        self.absolute = self.relative * float(ratio)
        self.repeats = int(repeats)
        self.times = [int(time) for time in times.split(",")]
        self.n, self.end = CASES[self.case]["pedestrians"], CASES[self.case]["end"]
        self.headway = CASES[self.case]["length"] / self.n
        self.library = ctypes.CDLL(library)
        self.dimension = self.library.ring_open(self.case.encode(), int(self.deviation))
        self.samples = np.arange(self.end + 1.0)

    def start(self):
        y = np.empty(self.dimension)
        self.library.ring_start(ctypes.c_void_p(y.ctypes.data))
        return y

    def evaluations(self):
        return self.library.ring_evaluations()


def main(integrate):
    """`integrate(job)` prepares (and compiles) once, and gives a function from nothing to the states at 0, 1, 2, ...,
    a row each, and the number of right-hand sides, or None."""
    job = Job(sys.argv[1:])
    run = integrate(job)
    run()  # whatever is compiled just in time
    seconds = []
    for _ in range(job.repeats):
        start = time.process_time()
        states, evaluations = run()
        np.std(states[:, job.n : 2 * job.n], axis=1)
        seconds.append(time.process_time() - start)
    if len(states) != job.end + 1:
        sys.exit("not all samples were taken")
    with Path(job.states).open("w") as file:
        file.write("t,n,gap,speed\n")
        for t in job.times:
            y = states[t]
            gaps, speeds = y[: job.n], y[job.n : 2 * job.n]
            if job.deviation:
                gaps, speeds = job.headway + gaps, y[-1] + speeds
            for n, (gap, speed) in enumerate(zip(gaps.tolist(), speeds.tolist())):
                file.write(f"{t},{n},{gap!r},{speed!r}\n")
    print(json.dumps({"seconds": seconds, "evaluations": evaluations, "steps": -1}))
