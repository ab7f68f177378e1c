"""The table of bench/peers.py: markdown for readers, CSV for programs."""

COLUMNS = "integrator,method,form,tolerance,ratio,seconds,right_hand_sides,error,error_at_end"


def csv(tables):
    """A row for each case, target and integrator that reaches it."""
    lines = [f"case,target,{COLUMNS}"]
    for case, target, rows in tables:
        for row in rows:
            values = ["" if row[name] is None else str(row[name]) for name in COLUMNS.split(",")]
            lines.append(",".join([case.name, f"{target:.0e}", *values]))
    return "\n".join(lines) + "\n"


def duration(seconds):
    return f"{1e3 * seconds:.2f} ms" if seconds < 0.1 else f"{seconds:.3f} s"


def line(row, ours):
    ratio = "" if ours is None else f"{row['seconds'] / ours['seconds']:.2f}"
    sides = "" if row["right_hand_sides"] is None else str(row["right_hand_sides"])
    scale = "" if row["ratio"] in ("", "1") else f" (absolute {row['ratio']} of it)"
    cells = [row["integrator"], row["method"], row["form"], row["tolerance"] + scale, duration(row["seconds"])]
    return "| " + " | ".join([*cells, sides, f"{row['error']:.1e}", ratio]) + " |"


def markdown(tables, facts):
    """The tables and what they were measured on."""
    text = ["# Integrators of other projects beside ours", ""]
    text += [
        "CPU seconds of the integration on one core, with the standard deviation of the speeds at t = 0, 1, 2, ...;",
        "median of runs in turn. Error: the largest of any gap or speed at any time of the reference. Each row has the",
        "fastest setting of an integrator that reaches the error; who is not named does not. Last: time over ours.",
        "How it is measured, and how fair: [bench/README.md](../../bench/README.md).",
        "",
        f"- {facts['processor']}",
        f"- `{facts['command']}`; C++ with `{facts['flags']}` (exponentials and logarithms from libmvec)",
        f"- {'; '.join(facts['versions'])}",
    ]
    text += [f"- {case}: against {truth}" for case, truth in facts["references"].items()]
    for case, target, rows in tables:
        text += ["", f"## {case.title}, error {target:.0e}", ""]
        if not rows:
            text += ["Nobody."]
            continue
        text += ["| integrator | method | state | tolerance | time | right-hand sides | error | over ours |"]
        text += ["|---|---|---|---|---|---|---|---|"]
        ours = next((row for row in rows if row["integrator"] == "ours"), None)
        text += [line(row, ours) for row in rows]
    return "\n".join(text) + "\n"
