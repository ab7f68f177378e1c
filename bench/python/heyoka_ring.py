"""heyoka: Taylor's method of high order, the equations compiled just in time; samples from its Taylor polynomials."""

import sys

import common
import heyoka as hy
import numpy as np


def equations(job):
    """The equations that bench/cpp/ring.hpp evaluates, in heyoka's symbols."""
    n = job.n
    gaps = [hy.make_vars(f"s{i}") for i in range(n)]
    speeds = [hy.make_vars(f"v{i}") for i in range(n)]
    c = np.e - 1.0

    def acceleration(s, v):
        if job.case == "algebraic_stable":
            return 3.0 - v - 0.45 * 0.45 * (s - 2.0) ** -2.0
        softplus = hy.log(1.0 + hy.exp((0.5 * s - 1.0) * -100.0))
        return 1.0 * (1.0 - hy.log(1.0 + c * 0.01 * softplus)) - v

    closing = [(gaps[i], speeds[(i + 1) % n] - speeds[i]) for i in range(n)]
    return closing + [(v, acceleration(s, v)) for s, v in zip(gaps, speeds)]


def integrate(job):
    if job.deviation:
        sys.exit("forms: plain")
    options = {"tol": job.relative, "compact_mode": True, "fast_math": True, "force_avx512": True}
    fresh = hy.taylor_adaptive(equations(job), job.start(), **options)

    def run():
        fresh.time = 0.0
        fresh.state[:] = job.start()
        outcome, *_, states = fresh.propagate_grid(job.samples)
        if outcome != hy.taylor_outcome.time_limit:
            sys.exit(f"heyoka: {outcome}")
        return states, None

    return run


common.main(integrate)
