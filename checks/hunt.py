"""A third integration of random scenes, by SciPy: cargo run --release -p hunt -- --json --count 300 | python3 checks/hunt.py

Reads runs with their scenes, the numbers of the first integration (those that users get) and of the second (by which the
hunt judges), integrates each scene in spacings and speeds with the laws written anew in NumPy, and compares all three.
Steps end where the argument of a ramp comes near its kink; within, they are short. The error of SciPy's own solution is
taken from a second one by another method. Exit code 1 if either integration is wrong.
"""

import json
import sys
import tomllib

import numpy as np
from scipy.integrate import solve_ivp

C = np.e - 1.0
# a kink is felt at this distance, in units of its width; wider ramps need no care
FELT, WIDE = 40.0, 0.03
# tab:model; what a preset leaves open stands in the scene
PRESETS = {
    "CFM": {"mu": 0.0, "delta": 1.0, "q": 1.0},
    "GCFM": {"delta": 1.0, "q": 1.0},
    "HFV": {"q": 2.0},
    "SEY": {"q": 2.0},
    "GUO": {"q": 1.0},
}


def ramp(x, epsilon):
    """eq:aTheta, without overflow."""
    return epsilon * np.logaddexp(0.0, -x / epsilon)


class Ring:
    def __init__(self, scene, panel):
        over = scene.get("panel", {}).get(panel, {})
        table = {name: scene[name] | over.get(name, {}) for name in ("law", "ring", "start")}
        self.law, self.count = table["law"] | PRESETS.get(table["law"].get("preset"), {}), table["ring"]["pedestrians"]
        self.epsilon, self.a_v = self.law.get("epsilon", 0.1), self.law.get("a_v", 0.0)
        self.headway = table["ring"]["length"] / self.count
        shift = table["start"]["shift"]
        spacings = np.full(self.count, self.headway)
        spacings[0] -= shift
        spacings[-1] += shift
        self.start = np.concatenate([spacings, np.zeros(self.count), [shift]])

    def parts(self, state):
        s, v = state[: self.count], state[self.count : 2 * self.count]
        return s, v, np.roll(v, -1)

    def room(self, state):
        s, v, ahead = self.parts(state)
        return s if self.law["kind"] == "logarithmic" else s - self.a_v * (v + ahead) - 2.0

    def argument(self, state):
        """Of the ramp; None where the law has none."""
        s, v, ahead = self.parts(state)
        if self.law["kind"] == "algebraic":
            return ahead - v if "delta" in self.law else None
        if self.law["kind"] == "exponential":
            return self.room(state) if "c" in self.law else None
        return s / (2.0 + self.a_v * (v + ahead)) - 1.0

    def rates(self, _t, state):
        law, (_, v, ahead) = self.law, self.parts(state)
        x = self.argument(state)
        r = 0.0 if x is None else ramp(x, self.epsilon)
        if law["kind"] == "algebraic":
            force = (law["mu"] + law.get("delta", 0.0) * r) ** 2 / self.room(state) ** law["q"]
        elif law["kind"] == "exponential":
            force = law["a"] * np.exp(-self.room(state) / law["b"]) + law.get("c", 0.0) * r
        else:
            force = law["v0"] * np.log1p(C * r)
        return np.concatenate([ahead - v, law["v0"] - v - force, [v[0]]])

    def solve(self, times, method, tolerance):
        """The states at ascending times, and the first time at which each event's value is negative."""
        state, t, states, events = self.start, 0.0, [], {}
        for end in times:
            while t < end:
                t, state = self.leg(t, state, end, method, tolerance, events)
                if t is None:
                    return None, None
            states.append(state)
        return states, events

    def leg(self, t, state, end, method, tolerance, events):
        """One call of SciPy: up to the neighbourhood of a kink, or with short steps within it."""
        longest, stops = np.inf, []
        argument = self.argument(state)
        if argument is not None and self.epsilon < WIDE:
            tiny = 1e-7
            moved = self.argument(state + tiny * self.rates(t, state))
            y, speed = argument / self.epsilon, np.abs(moved - argument) / (tiny * self.epsilon) + 1e-3
            inside = np.abs(y) < FELT
            if inside.any():
                longest = np.min(4.0 / speed[inside])
                end = min(end, t + 25.0 * longest)
            sign = np.where(inside, 0.0, np.sign(y))

            def near(_t, state):
                y = self.argument(state) / self.epsilon
                return np.min(np.where(sign == 0.0, np.inf, sign * y)) - 0.9 * FELT

            if (sign != 0.0).any():
                near.terminal = True
                stops = [near]
        watched = {
            "overlap": lambda _t, state: np.min(self.room(state)),
            "negative_speed": lambda _t, state: np.min(state[self.count : 2 * self.count]),
            "exchange": lambda _t, state: np.min(state[: self.count]),
        }
        for value in watched.values():
            value.direction = -1
        if t == 0.0 and np.min(self.rates(0.0, state)[self.count : 2 * self.count]) < 0.0:
            events["negative_speed"] = 0.0
        with np.errstate(all="ignore"):
            solution = solve_ivp(
                self.rates,
                (t, end),
                state,
                method=method,
                rtol=tolerance,
                atol=tolerance * 1e-3,
                max_step=longest,
                events=list(watched.values()) + stops,
            )
        if solution.status < 0 or len(solution.t) > 200_000:
            return None, None
        for name, found in zip(watched, solution.t_events):
            if len(found):
                events.setdefault(name, found[0])
        return solution.t[-1], solution.y[:, -1]

    def numbers(self, state):
        s, v, _ = self.parts(state)
        x = state[-1] + np.concatenate([[0.0], np.cumsum(s[:-1])])
        return np.std(v), x, v


def judge(case):
    """Ratios of the errors of first and second to those allowed, by number; None where SciPy gives up."""
    ring = Ring(tomllib.loads(case["text"]), case["panel"])
    times = sorted(set(case["times"]) | {case["end"]})
    states, events = ring.solve(times, "DOP853", 1e-12)
    others, _ = ring.solve(times, "DOP853", 1e-11) if states else (None, None)
    if not states or not others:
        return None
    right, twin = [ring.numbers(s) for s in states], [ring.numbers(s) for s in others]
    at = {t: i for i, t in enumerate(times)}
    scale = max(1.0, np.max(np.abs(right[-1][1])))
    worst = {}

    def note(who, what, found, index, part, allowed):
        error = np.max(np.abs(np.asarray(found) - right[index][part]))
        own = np.max(np.abs(right[index][part] - twin[index][part])) + 1e-13 * scale
        ratio = error / (allowed + 3.0 * own)
        worst[who, what] = max(worst.get((who, what), 0.0), ratio)

    for who in ("first", "second"):
        numbers, given = case[who], who == "first"
        allowed = {key: (value or np.inf) if given else 0.0 for key, value in case["allowed"].items()}
        for t, std in zip(case["times"], numbers["std"]):
            note(who, "std", std, at[t], 0, allowed["std"])
        note(who, "position", numbers["x"], at[case["end"]], 1, allowed["x"])
        note(who, "speed", numbers["v"], at[case["end"]], 2, allowed["v"])
        for name, t, _ in numbers["events"]:
            if name in events and t < case["end"]:
                slack = 1e-9 * case["end"] + (1e-6 if not given else 30.0 * allowed["v"])
                worst[who, "event"] = max(worst.get((who, "event"), 0.0), abs(t - events[name]) / slack)
    return worst


def main():
    ratios, wrong, given_up = {}, [], []
    for line in sys.stdin:
        case = json.loads(line)
        label = f"{case['seed']} {case['panel']}"
        worst = judge(case)
        if worst is None:
            given_up.append(label)
            continue
        for key, ratio in worst.items():
            ratios.setdefault(key, []).append(ratio)
            if not ratio <= 1.0:
                wrong.append(f"{label}: {key[1]} of the {key[0]} integration: {ratio:.3g} times the error allowed")
    for (who, what), values in sorted(ratios.items()):
        print(f"{who:6} {what:8}: {len(values)} runs, error / allowed: median {np.median(values):.2e}, worst {np.max(values):.2e}")
    print(f"SciPy gives up {len(given_up)}: {', '.join(given_up)}")
    print("\n".join(wrong) or "nothing is wrong")
    return 1 if wrong or not ratios else 0


if __name__ == "__main__":
    sys.exit(main())
