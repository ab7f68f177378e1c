"""Recomputes the tables under data/ from the formulas of the paper, with numpy alone: python3 checks/spot.py [--data DIR]

Nothing is shared with the Rust code but the scene files. Maps: every cell, slopes of the laws by complex steps, the
quadratic formula, the steady speed by bisection. Tables of std: from the start on, classical Runge-Kutta in gaps.
Trajectories: from one sample to the next. A line gives the difference that comes closest to its bound, and the bound.
"""

import argparse
import sys
import tomllib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
ULP = np.finfo(float).eps
C = np.e - 1.0


def ramp(x, epsilon):
    """eq:aTheta, for real and complex x."""
    return epsilon * np.log1p(np.exp(-x / epsilon))


def acceleration(law, room, v, ahead):
    """eq:invd, eq:sfm, eq:modlog; `room` is d_n of eq:effDistn, for the logarithmic law the gap."""
    v0, epsilon, a_v = law["v0"], law.get("epsilon", 0.1), law.get("a_v", 0.0)
    if law["kind"] == "algebraic":
        approach = law["delta"] * ramp(ahead - v, epsilon) if "delta" in law else 0.0
        return v0 - v - (law["mu"] + approach) ** 2 / room ** law["q"]
    if law["kind"] == "exponential":
        contact = law["c"] * ramp(room, epsilon) if "c" in law else 0.0
        return v0 - v - law["a"] * np.exp(-room / law["b"]) - contact
    return v0 * (1.0 - np.log1p(C * ramp(room / (2.0 + a_v * (v + ahead)) - 1.0, epsilon))) - v


def widening(law):
    return 0.0 if law["kind"] == "logarithmic" else law.get("a_v", 0.0)


def room_of(law, gap, v, ahead):
    return gap if law["kind"] == "logarithmic" else gap - widening(law) * (v + ahead) - 2.0


def steady_speed(law, headway):
    """Between standing and the desired speed, where the acceleration vanishes."""
    slow, fast = np.broadcast_arrays(0.0, law["v0"], law.get("a_v", 0.0))[:2]
    for _ in range(60):
        middle = 0.5 * (slow + fast)
        pushes = acceleration(law, room_of(law, headway, middle, middle), middle, middle) > 0.0
        slow, fast = np.where(pushes, middle, slow), np.where(pushes, fast, middle)
    return slow


def growth_rate(law, room, v, k):
    """Re z+ and its bound. A wave exp(z t + i k n) obeys z^2 = f_s (e^{ik} - 1) + (f_v + f_ahead e^{ik}) z."""

    def slope(by_room, by_v, by_ahead, tiny=1e-30):
        point = room + 1j * tiny * by_room, v + 1j * tiny * by_v, v + 1j * tiny * by_ahead
        return acceleration(law, *point).imag / tiny

    b = -(slope(-widening(law), 1, 0) + slope(-widening(law), 0, 1) * np.exp(1j * k))
    c = -slope(1, 0, 0) * 2j * np.sin(0.5 * k) * np.exp(0.5j * k)
    root = np.sqrt(b * b - 4.0 * c)
    # some 20 roundings in the discriminant; its square root passes them on divided by 2 |root|
    bound = 20 * ULP * (np.abs(b) ** 2 + 4.0 * np.abs(c)) / (2.0 * np.abs(root))
    return 0.5 * np.maximum((root - b).real, (-root - b).real), bound


def criterion(law, room, v, headway):
    """condition1, eq:stab_condition_exp, eq:log_condition as printed; the bound allows for 100 roundings."""
    a_v, delta = law.get("a_v", 0.0), law.get("delta", 0.0)
    if law["kind"] == "algebraic":
        gamma, power = law["mu"] + delta * law["epsilon"] * np.log(2.0), room ** law["q"]
        phi = law["q"] * gamma**2 / (power * room)
        value = phi / (2.0 * a_v * phi + 1.0) - delta * gamma / power - 0.5
    elif law["kind"] == "exponential":
        c = -law["a"] * np.exp(-room / law["b"]) / law["b"] - 0.5 * law.get("c", 0.0)
        value = c / (2.0 * a_v * c - 1.0) - 0.5
    else:
        distance = 2.0 * (1.0 + a_v * v)
        xi = C * law["v0"] / (distance * (1.0 + C * (1.0 - headway / distance)))
        wide = xi * a_v / distance * headway
        value = (xi / (1.0 + 2.0 * wide) + wide) / (1.0 + 2.0 * wide) - 0.5
    return value, 100 * ULP * (1.0 + np.abs(value))


def check_map(scene, table, _data):
    law, point, spec = dict(scene["law"]), dict(scene.get("uniform", {})), scene["map"]
    axes = [spec["x"], spec["y"]]
    centres = [a["from"] + (a["to"] - a["from"]) * (np.arange(a["cells"]) + 0.5) / a["cells"] for a in axes]
    grid = [values.ravel() for values in np.meshgrid(*centres, indexing="ij")]
    for axis, values in zip(axes, grid):
        (point if axis["parameter"] in ("d_gap", "headway", "k") else law)[axis["parameter"]] = values
    if "d_gap" in point:
        headway, v, room = None, 0.0, point["d_gap"]
    else:
        headway, v = point["headway"], steady_speed(law, point["headway"])
        room = room_of(law, headway, v, v)
    is_criterion = spec["value"] == "criterion"
    value = criterion(law, room, v, headway) if is_criterion else growth_rate(law, room, v, point["k"])
    pairs = [(table[:, i], grid[i], 4 * ULP * np.abs(grid[i])) for i in (0, 1)]
    return pairs + [(table[:, 2], *value)], f"{len(table)} cells"


def check_curve(scene, table, _data):
    spec = scene["curve"]
    x = spec["from"] + (spec["to"] - spec["from"]) * np.arange(spec["points"]) / (spec["points"] - 1)
    if spec["value"] == "ramp":
        values, steepness = [np.where(x < 0.0, -x, 0.0), ramp(x, spec["epsilon"])], 1.0 / spec["epsilon"]
    else:
        law = scene["law"]
        values, steepness = [1.0 - acceleration(law, x, 0.0, 0.0) / law["v0"]], 1.0 / law["epsilon"]
    # the rounding of x / eps, about |x| / eps ulp, is passed on by exp; 1 - (1 - ln ..) loses an ulp of 1
    bounds = [4 * ULP * (np.abs(x) * steepness * np.abs(value) + 1.0) for value in values]
    pairs = [(table[:, i + 1], value, bounds[i]) for i, value in enumerate(values)]
    return [(table[:, 0], x, 4 * ULP)] + pairs, f"{len(x)} points"


def runge_kutta(law, state, step, steps):
    """Carries [gaps, speeds, positions], arrays [3, .., N], over this many steps."""

    def change(state):
        gaps, v, _ = state
        ahead = np.roll(v, -1, axis=-1)
        return np.stack([ahead - v, acceleration(law, room_of(law, gaps, v, ahead), v, ahead), v])

    for _ in range(steps):
        k1 = change(state)
        k2 = change(state + 0.5 * step * k1)
        k3 = change(state + 0.5 * step * k2)
        state = state + step / 6.0 * (k1 + 2.0 * (k2 + k3) + change(state + step * k3))
    return state


def start(scene):
    """Equal gaps, nobody moves, pedestrian 0 moved forward by the shift."""
    count, length, shift = scene["ring"]["pedestrians"], scene["ring"]["length"], scene["start"]["shift"]
    gaps, positions = np.full(count, length / count), np.arange(count) * length / count
    gaps[0], gaps[-1], positions[0] = gaps[0] - shift, gaps[-1] + shift, shift
    return np.stack([gaps, np.zeros(count), positions])


def check_std(scene, table, data, step=0.05):
    """With two steps; where they part by more than 1 % (walls) the comparison ends."""
    times, sample, results = table[:, 0], scene["run"]["sample"], []
    for h in (2.0 * step, step):
        state, stds = start(scene), [0.0]
        for _ in times[1:]:
            state = runge_kutta(scene["law"], state, h, round(sample / h))
            stds.append(state[1].std())
        results.append(np.array(stds))
    coarse, fine = results
    # a rounding of the gaps in each step, grown no faster than the perturbation itself
    growth = np.maximum(1.0, fine / np.minimum.accumulate(np.where(times > 0.0, fine, np.inf)))
    rounding = times / step * ULP * scene["ring"]["length"] / scene["ring"]["pedestrians"] * growth
    # and in the table the tolerance, relative to the perturbation, in each of about ten steps a unit of time
    local = 10.0 * times * scene["run"]["tolerance"] * scene["start"]["shift"] * growth
    bound = np.abs(coarse - fine) + rounding + local
    usable = np.logical_and.accumulate(bound <= 0.01 * fine)
    pairs = [(times, sample * np.arange(len(times)), 0.0), (table[usable, 1], fine[usable], bound[usable])]
    if scene["run"]["record"] == "trajectories":
        speeds = load(data / "fig11" / "trajectories.csv")[1][:, 3].reshape(len(times), -1)
        pairs.append((table[:, 1], speeds.std(axis=1), 100 * ULP))
    return pairs, f"to t = {times[usable][-1]:g} of {times[-1]:g}"


def check_trajectories(scene, table, _data):
    """Every 30th sample is taken as a start and carried to the next one."""
    ring, run, first = scene["ring"], scene["run"], start(scene)
    t, n, x, v = table.reshape(-1, ring["pedestrians"], 4).transpose(2, 0, 1)
    gaps = np.diff(x, axis=1, append=x[:, :1] + ring["length"])
    samples = round(run["t_end"] / run["sample"]) + 1
    begin = np.arange(0, samples - 1, 30)
    states = np.stack([gaps, v, x])[:, begin]
    coarse, fine = (runge_kutta(scene["law"], states, h, round(run["sample"] / h)) for h in (0.02, 0.01))
    # the digits of x, and the tolerance in each of some hundred steps
    floor = 10 * ULP * np.abs(x).max() + 100 * run["tolerance"]
    pairs = [(np.minimum(gaps, 0.0), 0.0 * gaps, 0.0), (x[0], first[2], 4 * ULP * ring["length"]), (v[0], first[1], 0.0)]
    pairs += [(t, run["sample"] * np.arange(samples)[:, None] + 0.0 * t, 0.0), (n, np.arange(n.shape[1]) + 0.0 * n, 0.0)]
    pairs += [(y[begin + 1], fine[i], np.abs(coarse[i] - fine[i]) + floor) for i, y in ((1, v), (2, x))]
    return pairs, f"{len(begin)} of {samples - 1} intervals"


def check_rows(time):
    """The part of figure 11 at this time."""

    def check(_scene, table, data):
        run = load(data / "fig11" / "trajectories.csv")[1]
        return [(table, run[run[:, 0] == time][:, 1:], 0.0)], f"{len(table)} rows of figure 11"

    return check


def load(path):
    with open(path) as file:
        return file.readline().strip(), np.loadtxt(file, delimiter=",", ndmin=2)


def merged(base, over):
    nested = {key: merged(base.get(key, {}), value) for key, value in over.items() if isinstance(value, dict)}
    return {**base, **over, **nested}


def check_of(path, columns, scene):
    checks = {"t,std": check_std, "t,n,x,v": check_trajectories}
    if columns == "n,x,v":
        return check_rows(float(path.stem.removeprefix("t")))
    if columns not in checks and not {"map", "curve"} & scene.keys():
        raise ValueError(f"there is no check for a table {columns}")
    return checks.get(columns) or (check_map if "map" in scene else check_curve)


def judge(path, data):
    """Prints the line of a table; whether it is right."""
    name = f"{path.parent.name}/{path.stem}"
    try:
        document = tomllib.loads(next(ROOT.glob(f"figures/{path.parent.name}-*/scene.toml")).read_text())
        scene = merged(document, document["panel"][path.stem]) if "panel" in document else document
        columns, table = load(path)
        pairs, remark = check_of(path, columns, scene)(scene, table, data)
        closest = (-1.0, 0.0, 0.0)
        for found, value, bound in pairs:
            difference, bound = np.abs(found - value).ravel(), np.broadcast_to(bound, value.shape).ravel()
            share = np.where(difference == 0.0, 0.0, difference / np.maximum(bound, 5e-324))
            worst = np.argmax(share)
            closest = max(closest, (np.nan_to_num(share[worst], nan=np.inf), difference[worst], bound[worst]))
    except Exception as error:  # a table that cannot be judged fails with a line like any other
        print(f"FAILED  {name:22} {type(error).__name__}: {error}")
        return False
    share, difference, bound = closest
    print(f"{'passed' if share <= 1.0 else 'FAILED'}  {name:22} {difference:7.1e} of {bound:7.1e} allowed, {remark}")
    return share <= 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, default=ROOT / "data")
    data = parser.parse_args().data
    np.seterr(all="ignore")  # what is not a number fails its comparison
    tables = set(data.glob("fig[0-9][0-9]/*.csv"))
    for scene in ROOT.glob("figures/fig[0-9][0-9]-*/scene.toml"):
        panels = tomllib.loads(scene.read_text()).get("panel", {})
        tables |= {data / scene.parent.name[:5] / f"{panel}.csv" for panel in panels}
    verdicts = [judge(path, data) for path in sorted(tables)]
    print(f"{sum(verdicts)} passed, {len(verdicts) - sum(verdicts)} failed")
    return 0 if verdicts and all(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
