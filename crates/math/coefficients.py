"""Prints the constants of this crate's polynomials. Needs mpmath (pip install mpmath).

Each polynomial is a minimax one: the exchange algorithm of Remez moves a set of
points until the weighted error has the same size, with alternating sign, at all
of them. Coefficients are then rounded to doubles; their decimal form below reads
back to exactly that double.
"""

from mpmath import atanh, expm1, factorial, floor, ln, log, lu_solve, matrix, mp, mpf, pi, sqrt

mp.prec = 300


def remez(function, weight, low, high, count):
    """Coefficients of the polynomial p with `count` of them that minimises the
    largest |weight (p - function)| on [low, high], and that largest value."""
    number = count + 1
    middle, half = (low + high) / 2, (high - low) / 2
    points = [middle - half * mp.cos(pi * (2 * i + 1) / (2 * number)) for i in range(number)]
    for _ in range(30):
        rows = matrix(number, number)
        right = matrix(number, 1)
        for i, x in enumerate(points):
            for j in range(count):
                rows[i, j] = x**j
            rows[i, count] = (-1) ** i / weight(x)
            right[i] = function(x)
        solution = lu_solve(rows, right)
        coefficients = [solution[j] for j in range(count)]
        error = lambda x: weight(x) * (mp.polyval(coefficients[::-1], x) - function(x))
        grid = [middle - half * mp.cos(pi * i / 2000) for i in range(2001)]
        values = [error(x) for x in grid]
        # one extremum of the error in each run of equal sign
        extrema, start = [], 0
        for i in range(1, len(grid) + 1):
            if i == len(grid) or values[i] * values[start] < 0:
                extrema.append(max(range(start, i), key=lambda j: abs(values[j])))
                start = i
        if len(extrema) < number:
            raise ValueError(f"{len(extrema)} extrema, {number} are needed")
        while len(extrema) > number:
            extrema.pop(0 if abs(values[extrema[0]]) < abs(values[extrema[-1]]) else -1)
        sizes = [abs(values[i]) for i in extrema]
        points = [grid[i] for i in extrema]
        if max(sizes) < min(sizes) * mpf("1.0001"):
            break
    return coefficients, max(sizes)


def show(name, coefficients, error):
    print(f"{name}: largest weighted error 2^{float(log(error, 2)):.2f}")
    for value in coefficients:
        print(f"    {float(value)!r},")


def split(name, value, bits):
    """The value as a double of `bits` significant bits, and the rest."""
    unit = mpf(2) ** (floor(log(abs(value), 2)) + 1 - bits)
    head = mp.nint(value / unit) * unit
    print(f"{name}: {float(head)!r}, {float(value - head)!r}")


def exponential(count):
    """(e^r - 1 - r - r^2/2) / r^3 for |r| <= ln(2)/2; absolute error of e^r."""
    high = ln(mpf(2)) / 2 * (1 + mpf(2) ** -40)

    def function(r):
        if abs(r) < mpf(10) ** -8:
            return sum(r**n / factorial(n + 3) for n in range(6))
        return (expm1(r) - r - r * r / 2) / r**3

    # the weight |r|^3 vanishes at 0; a floor keeps the system regular
    weight = lambda r: abs(r) ** 3 + mpf(2) ** -20
    show("exponential", *remez(function, weight, -high, high, count))


def logarithm(count):
    """(ln((1+s)/(1-s)) / s - 2) / s^2 in z = s^2, for 1 <= (1+s)/(1-s) <= sqrt(2);
    error relative to the logarithm."""
    high = ((sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1)) ** 2 * (1 + mpf(2) ** -20)

    def function(z):
        if z < mpf(10) ** -12:
            return sum(2 * z**n / (2 * n + 3) for n in range(6))
        s = sqrt(z)
        return (2 * atanh(s) / s - 2) / z

    weight = lambda z: (z + mpf(2) ** -20) / 2
    show("logarithm", *remez(function, weight, mpf(0), high, count))


def pairs(name, values):
    """Each value as the double next to it and the double next to the rest."""
    print(f"{name}:")
    for value in values:
        print(f"    Twofold {{ hi: {float(value)!r}, lo: {float(value - float(value))!r} }},")


def two_over_pi(words):
    """The bits of 2 / pi after its binary point, behind 64 zeros, in words of 64."""
    print("2 / pi:")
    mp.prec = 64 * words + 64
    bits = int(floor(2 / pi * mpf(2) ** (64 * (words - 1))))
    for word in range(words):
        print(f"    0x{(bits >> 64 * (words - 1 - word)) & (2**64 - 1):016x},")


if __name__ == "__main__":
    exponential(10)
    logarithm(7)
    split("ln 2 (33 bits, rest)", ln(mpf(2)), 33)
    split("ln 2 (42 bits, rest)", ln(mpf(2)), 42)
    pairs("ln 2 less its first 42 bits", [ln(mpf(2)) - mp.nint(ln(mpf(2)) * 2**42) / 2**42])
    pairs("ln 2, 1 / ln 10, pi / 2", [ln(mpf(2)), 1 / ln(mpf(10)), pi / 2])
    pairs("1 / n!", [1 / factorial(n) for n in range(26)])
    pairs("2 / (2n + 1)", [mpf(2) / (2 * n + 1) for n in range(18)])
    two_over_pi(21)
