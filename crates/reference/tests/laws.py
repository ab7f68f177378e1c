"""Prints accelerations with 34 digits for tests/it/laws.rs. Needs mpmath: python3 crates/reference/tests/laws.py"""

from mpmath import e, exp, log1p, mp, mpf, nstr

mp.dps = 60
clearance, speed = mpf("0.75"), mpf("0.5")
print("algebraic", nstr(3 - speed - mpf(0.55) ** 2 / clearance**2, 34))
print("exponential", nstr(3 - speed - 3 * exp(-clearance / mpf("1.5")), 34))
for gap in [mpf("0.75"), mpf("2.0625"), mpf("1.96875")]:
    ramp = mpf(0.01) * log1p(exp(-(gap / 2 - 1) / mpf(0.01)))
    print("logarithmic", gap, nstr(1 - log1p((e - 1) * ramp) - speed, 34))
