"""SciPy: DOP853, RK45 and LSODA of solve_ivp, VODE's Adams of ode; the right-hand side in C."""

import ctypes
import sys

import common
import numpy as np
from scipy.integrate import ode, solve_ivp


def integrate(job):
    address, nothing = ctypes.c_void_p, ctypes.c_void_p(0)
    c_rates = job.library.ring_rates
    c_rates.argtypes = [ctypes.c_double, address, address, address]
    c_rates.restype = None

    def rates(t, y):
        y = np.ascontiguousarray(y)
        f = np.empty_like(y)
        c_rates(t, y.ctypes.data, f.ctypes.data, nothing)
        return f

    def ivp():
        before = job.evaluations()
        span = (0.0, float(job.end))
        tolerances = {"rtol": job.relative, "atol": job.absolute}
        result = solve_ivp(rates, span, job.start(), job.method, t_eval=job.samples, **tolerances)
        if not result.success:
            sys.exit(result.message)
        return result.y.T, job.evaluations() - before

    def vode():
        before = job.evaluations()
        solver = ode(rates).set_integrator(
            "vode", method="adams", rtol=job.relative, atol=job.absolute, nsteps=100_000_000
        )
        solver.set_initial_value(job.start(), 0.0)
        states = np.empty((job.end + 1, job.dimension))
        states[0] = solver.y
        for t in range(1, job.end + 1):
            states[t] = solver.integrate(t)
            if not solver.successful():
                sys.exit("vode failed")
        return states, job.evaluations() - before

    return vode if job.method == "vode-adams" else ivp


common.main(integrate)
