"""The cases, the settings of every integrator, and the errors of their results."""

from dataclasses import dataclass

TARGETS = [1e-6, 1e-9, 1e-12]

SCENE = """title = "{title}"
source = "{source}"
[law]
{law}
[ring]
pedestrians = {pedestrians}
length = 200.0
[start]
shift = {shift}
[run]
t_end = {end}.0
sample = 1.0
method = "dop853"
tolerance = 1e-12
record = "{record}"
"""


@dataclass(frozen=True)
class Case:
    """A run: its name in data/reference/solutions, what a reader calls it, its scene."""

    name: str
    title: str
    source: str
    law: str
    pedestrians: int
    shift: str
    end: int

    def scene(self, record):
        return SCENE.format(record=record, **vars(self))

    def times(self):
        """Where the errors are taken, unless a reference says it."""
        return [t for t in (1, 10, 50, 100, 300, 500, 1000, 1500, 2000, 2500, 3000) if t <= self.end]


_LOGARITHMIC = 'kind = "logarithmic"\nv0 = 1.0\nepsilon = 0.01'
_ALGEBRAIC = 'kind = "algebraic"\nmu = 0.45\nq = 2.0\nv0 = 3.0'
CASES = [
    Case("algebraic_stable", "figure 4, stable, t = 500", "fig:stdv_rec", _ALGEBRAIC, 67, "1e-4", 500),
    Case("logarithmic", "figure 11, shift 0.1, t = 3000", "fig:jams", _LOGARITHMIC, 133, "0.1", 3000),
    Case("logarithmic_small_shift", "figure 11, shift 1e-4, t = 3000", "fig:jams", _LOGARITHMIC, 133, "1e-4", 3000),
]


@dataclass(frozen=True)
class Peer:
    """An integrator: the program that runs it, its methods, the forms of the state that it is given."""

    name: str
    program: str
    methods: tuple
    forms: tuple = ("plain",)


PEERS = [
    Peer("SUNDIALS CVODE", "cvode", ("adams",), ("plain", "deviation")),
    Peer(
        "SUNDIALS ARKODE",
        "arkode",
        ("dormand-prince54", "verner65", "verner65-landing", "fehlberg87-landing"),
    ),
    Peer("GSL", "gsl", ("rk8pd", "rkf45", "msadams")),
    Peer(
        "Boost.Odeint",
        "odeint",
        ("dopri54", "fehlberg87", "bulirsch-stoer", "bulirsch-stoer-dense"),
        ("plain", "deviation"),
    ),
    Peer(
        "differential-equations",
        "differential-equations",
        ("dopri54", "dop853", "verner65", "verner76", "verner87", "verner98"),
    ),
    Peer("SciPy", "scipy", ("DOP853", "LSODA", "vode-adams")),
    Peer("numbalsoda", "numbalsoda", ("lsoda", "dop853")),
    Peer("heyoka", "heyoka", ("taylor",)),
]


@dataclass(frozen=True)
class Setting:
    """One way to run one case."""

    peer: str
    program: str
    form: str
    method: str
    tolerance: str
    ratio: str

    def label(self):
        ratio = "" if self.ratio in ("", "1") else f", absolute/relative {self.ratio}"
        return f"{self.method}, {self.form}, tolerance {self.tolerance}{ratio}"


def exponents(quick):
    """Tolerances are ten to the minus these, the loosest first."""
    return range(4, 15, 2) if quick else range(3, 16)


def series(quick):
    """For every way to run every peer its settings, the loosest tolerance first.

    A deviation is small, so its absolute tolerance is below the relative one.
    """
    for peer in PEERS:
        for form in peer.forms:
            ratio = "1" if form == "plain" else "1e-3"
            for method in peer.methods:
                yield [Setting(peer.name, peer.program, form, method, f"1e-{k}", ratio) for k in exponents(quick)]


def read_states(lines):
    """{(t, n): (gap, speed)} of a table t,n,gap,speed."""
    states = {}
    for line in lines:
        t, n, gap, speed = line.split(",")
        if t != "t":
            states[int(float(t)), int(n)] = (float(gap), float(speed))
    return states


def read_trajectories(lines, length, times):
    """The same of a table t,n,x,v."""
    wanted, rows = {float(t) for t in times}, {}
    for line in lines:
        t, rest = line.split(",", 1)
        if t != "t" and float(t) in wanted:
            n, x, v = rest.split(",")
            rows[int(float(t)), int(float(n))] = (float(x), float(v))
    count = max(n for _, n in rows) + 1
    return {
        (t, n): (rows[t, (n + 1) % count][0] + (length if n + 1 == count else 0.0) - x, v)
        for (t, n), (x, v) in rows.items()
    }


def error(states, reference):
    """The largest difference of a gap or speed at any time, and at the last; not a number where a state is."""
    worst = {}
    for key, (gap, speed) in reference.items():
        difference = max(abs(states[key][0] - gap), abs(states[key][1] - speed))
        # written so that a NaN is kept as the worst there is
        if not difference <= worst.get(key[0], 0.0):
            worst[key[0]] = difference
    return max(worst.values(), default=0.0), worst.get(max(t for t, _ in reference), 0.0)
