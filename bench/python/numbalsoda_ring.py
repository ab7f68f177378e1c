"""numbalsoda: LSODA and DOP853, compiled, with the right-hand side in C."""

import ctypes
import sys

import common
import numbalsoda


def integrate(job):
    address = ctypes.cast(job.library.ring_rates, ctypes.c_void_p).value
    solver = {"lsoda": numbalsoda.lsoda, "dop853": numbalsoda.dop853}[job.method]
    options = {"rtol": job.relative, "atol": job.absolute}
    if job.method == "lsoda":
        options["mxstep"] = 100_000_000
    start, samples = job.start(), job.samples

    def run():
        before = job.evaluations()
        states, success = solver(address, start, samples, **options)
        if not success:
            sys.exit(f"{job.method} failed")
        return states, job.evaluations() - before

    return run


common.main(integrate)
