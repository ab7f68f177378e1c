"""Writes the table functions.csv beside it: arguments that are doubles, and values of mpmath (pip install mpmath) with
40 digits. python3 crates/math/tests/functions.py"""

import random
from math import log10
from pathlib import Path

from mpmath import exp, expm1, ln, log1p, mp, mpf, nstr

mp.dps = 60
random.seed(1)


def spread(low, high):
    """A double whose logarithm lies anywhere between those of the two."""
    return 10.0 ** random.uniform(log10(low), log10(high))


def signed(low, high):
    return random.choice([-1, 1]) * spread(low, high)


near = [signed(1e-18, 0.5) for _ in range(30)]
exponents = near + [random.uniform(-5, 5) for _ in range(30)] + [random.uniform(-600, 600) for _ in range(30)]
numbers = [spread(1e-250, 1e250) for _ in range(30)] + [1.0 + x for x in near] + [random.uniform(0.4, 2.5) for _ in range(30)]
increments = near + [random.uniform(-0.999, 3) for _ in range(40)] + [spread(1.0, 1e250) for _ in range(20)]
functions = {"exp": (exp, exponents), "exp_m1": (expm1, exponents), "ln": (ln, numbers), "ln_1p": (log1p, increments)}
rows = ["function,x,value"]
for name, (function, arguments) in functions.items():
    rows += [f"{name},{x!r},{nstr(function(mpf(x)), 40)}" for x in arguments]
Path(__file__).with_name("functions.csv").write_text("\n".join(rows) + "\n")
