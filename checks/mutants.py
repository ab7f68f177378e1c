"""The ledger of mutants, checks/mutants.csv, and what is said of the survivors, checks/mutants-survivors.toml.

    mutants.py add OUTCOMES.json     adds outcomes of cargo-mutants, in place of older ones of the same mutants
    mutants.py patterns CRATE        what was missed and is not explained, as regular expressions for cargo-mutants
    mutants.py copy FOLDER           copies the checkout there; files whose contents are equal keep their times
    mutants.py                       the table of crates: caught, missed, equivalent, share with its interval

A mutant is known by its file, the text of its line, its column there and the change, so that lines may move.
"""

import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LEDGER = ROOT / "checks/mutants.csv"
SURVIVORS = ROOT / "checks/mutants-survivors.toml"
CRATES = ["math", "ode", "jam", "scene"]
COLUMNS = ["file", "line", "column", "code", "change", "outcome"]
KEY = ["file", "code", "column", "change"]
OUTCOMES = {"CaughtMutant": "caught", "MissedMutant": "missed", "Timeout": "timeout", "Unviable": "unviable"}


def key(row):
    return tuple(str(row[name]) for name in KEY)


def read():
    if not LEDGER.exists():
        return {}
    with LEDGER.open(newline="") as file:
        return {key(row): row for row in csv.DictReader(file)}


def write(rows):
    with LEDGER.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows.values(), key=lambda row: (row["file"], int(row["line"]), int(row["column"]), row["change"])))


def add(outcomes):
    rows = read()
    for one in json.loads(pathlib.Path(outcomes).read_text())["outcomes"]:
        if one["scenario"] == "Baseline" or one["summary"] not in OUTCOMES:
            continue
        mutant = one["scenario"]["Mutant"]
        place, change = re.fullmatch(r"(\S+): (.*)", mutant["name"], re.DOTALL).groups()
        file, line, column = place.rsplit(":", 2)
        code = (ROOT / file).read_text().splitlines()[int(line) - 1].strip()
        row = dict(file=file, line=line, column=column, code=code, change=change, outcome=OUTCOMES[one["summary"]])
        rows[key(row)] = row
    write(rows)


def survivors():
    """What is said of the survivors: kind ("equivalent" or "gap") and reason, by key."""
    if not SURVIVORS.exists():
        return {}
    return {key(one): one for one in tomllib.loads(SURVIVORS.read_text()).get("survivor", [])}


def patterns(crate):
    explained = survivors()
    for row in read().values():
        if row["outcome"] == "missed" and row["file"].startswith(f"crates/{crate}/") and key(row) not in explained:
            print("^" + re.escape(f"{row['file']}:{row['line']}:{row['column']}: {row['change']}") + "$")


def copy(folder):
    target = pathlib.Path(folder)
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    wanted = {name for name in names.split("\0") if name and (ROOT / name).is_file()}
    for name in wanted:
        source, place = ROOT / name, target / name
        if not place.is_file() or place.read_bytes() != source.read_bytes():
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, place)
    for place in [place for folder in ("crates", "figures", "xtask") for place in (target / folder).rglob("*.rs")]:
        if str(place.relative_to(target)) not in wanted:
            place.unlink()


def interval(part, whole):
    """Wilson's interval for a share, 95 %."""
    z = 1.96
    centre, spread = part + z * z / 2, z * math.sqrt(part * (whole - part) / whole + z * z / 4)
    return (centre - spread) / (whole + z * z), (centre + spread) / (whole + z * z)


def summary():
    rows, explained = read(), survivors()
    lost = [one for one in explained if one not in rows or rows[one]["outcome"] != "missed"]
    for one in lost:
        print("explained, but not in the ledger as missed:", *one, sep=" | ")
    known = [(row, explained.get(key(row), {}).get("kind", "")) for row in rows.values()]
    print("| crate | tried | caught | ran for ever | missed | equivalent | unviable | caught of what is viable and not equivalent |")
    print("|---|---|---|---|---|---|---|---|")
    for crate in [*CRATES, "all"]:
        mine = [(row["outcome"], kind) for row, kind in known if crate == "all" or row["file"].startswith(f"crates/{crate}/")]
        count = {outcome: sum(one == outcome and kind != "equivalent" for one, kind in mine) for outcome in OUTCOMES.values()}
        equivalent = sum(kind == "equivalent" for _, kind in mine)
        caught = count["caught"] + count["timeout"]
        viable = caught + count["missed"]
        low, high = interval(caught, viable) if viable else (0, 1)
        share = f"{caught / viable:.1%} ({low:.1%} to {high:.1%})" if viable else ""
        cells = [crate, len(mine), count["caught"], count["timeout"], count["missed"], equivalent, count["unviable"], share]
        print("|", " | ".join(str(cell) for cell in cells), "|")
    open_ = [row for row, kind in known if row["outcome"] == "missed" and not kind]
    for row in open_:
        print("not explained:", f"{row['file']}:{row['line']}:{row['column']}: {row['change']}", "|", row["code"])
    return 1 if lost or open_ else 0


def main(arguments):
    match arguments:
        case []:
            return summary()
        case ["add", outcomes]:
            add(outcomes)
        case ["patterns", crate]:
            patterns(crate)
        case ["copy", folder]:
            copy(folder)
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
