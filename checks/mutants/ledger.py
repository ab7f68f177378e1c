"""The ledger of mutants, checks/mutants.csv, and what is said of the survivors, checks/mutants-survivors.toml.

A mutant is known by its file, the text of its line, its column there and the change, so that lines may move.
"""

import csv
import math
import pathlib
import re
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LEDGER = ROOT / "checks/mutants.csv"
SURVIVORS = ROOT / "checks/mutants-survivors.toml"
CRATES = ["math", "ode", "jam", "scene"]
COLUMNS = ["file", "line", "column", "code", "change", "outcome", "by"]
KEY = ["file", "code", "column", "change"]
OUTCOMES = ["caught", "timeout", "missed", "unviable"]


def key(row):
    return tuple(str(row[name]) for name in KEY)


def row(mutant, outcome="", by=""):
    """A row of the ledger from a mutant of cargo-mutants."""
    place, change = re.fullmatch(r"(\S+): (.*)", mutant["name"], re.DOTALL).groups()
    file, line, column = place.rsplit(":", 2)
    code = (ROOT / file).read_text().splitlines()[int(line) - 1].strip()
    return dict(file=file, line=line, column=column, code=code, change=change, outcome=outcome, by=by)


def read():
    if not LEDGER.exists():
        return {}
    with LEDGER.open(newline="") as file:
        return {key(one): one for one in csv.DictReader(file)}


def write(rows):
    with LEDGER.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows.values(), key=lambda one: (one["file"], int(one["line"]), int(one["column"]), one["change"])))


def keep(listed):
    """Forgets mutants that are no more."""
    current = {key(row(mutant)) for mutant in listed}
    write({known: one for known, one in read().items() if known in current})


def add(new):
    """Adds rows as they come, in place of older ones of the same mutants; writes every few."""
    rows = read()
    for count, one in enumerate(new, 1):
        rows[key(one)] = one
        if count % 20 == 0:
            write(rows)
    write(rows)


def survivors():
    """What is said of the survivors: kind ("equivalent" or "gap") and reason, by key."""
    if not SURVIVORS.exists():
        return {}
    return {key(one): one for one in tomllib.loads(SURVIVORS.read_text()).get("survivor", [])}


def interval(part, whole):
    """Wilson's interval for a share, 95 %."""
    z = 1.96
    centre, spread = part + z * z / 2, z * math.sqrt(part * (whole - part) / whole + z * z / 4)
    return (centre - spread) / (whole + z * z), (centre + spread) / (whole + z * z)


def summary(listed):
    """Prints the table; exit code 1 if a survivor is not explained, an explanation is stale or a mutant is not tried."""
    rows, explained = read(), survivors()
    current = {key(row(mutant)) for mutant in listed}
    lost = [one for one in explained if one not in rows or rows[one]["outcome"] != "missed"]
    for one in lost:
        print("explained, but not in the ledger as missed:", *one, sep=" | ")
    print("| crate | mutants | tried | caught | ran for ever | missed | equivalent | unviable | caught of what is viable and not equivalent |")
    print("|---|---|---|---|---|---|---|---|---|")
    known = [(one, explained.get(key(one), {}).get("kind", "")) for one in rows.values() if key(one) in current]
    for crate in [*CRATES, "all"]:
        inside = lambda file: crate == "all" or file.startswith(f"crates/{crate}/")
        mine = [(one["outcome"], kind) for one, kind in known if inside(one["file"])]
        count = {outcome: sum(one == outcome and kind != "equivalent" for one, kind in mine) for outcome in OUTCOMES}
        equivalent = sum(kind == "equivalent" for _, kind in mine)
        caught = count["caught"] + count["timeout"]
        viable, all_ = caught + count["missed"], sum(inside(one[0]) for one in current)
        share = f"{caught / viable:.1%}" if viable else ""
        if viable and len(mine) < all_:
            low, high = interval(caught, viable)
            share += f" ({low:.1%} to {high:.1%})"
        cells = [crate, all_, len(mine), count["caught"], count["timeout"], count["missed"], equivalent, count["unviable"], share]
        print("|", " | ".join(str(cell) for cell in cells), "|")
    open_ = [one for one, kind in known if one["outcome"] == "missed" and not kind]
    for one in open_:
        print("not explained:", f"{one['file']}:{one['line']}:{one['column']}: {one['change']}", "|", one["code"])
    untried = len(current - {key(one) for one, _ in known})
    if untried:
        print("not tried:", untried)
    return 1 if lost or open_ or untried else 0
