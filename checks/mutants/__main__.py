"""Mutants of `math`, `ode`, `jam` and `scene`: one small change of a source after another, and whether a test fails.

    python3 checks/mutants shard K/N [CRATE...]   tries the K-th of N shards of all mutants; outcomes go to checks/mutants.csv
    python3 checks/mutants missed [CRATE...]      tries again what the ledger says was missed, or was never tried
    python3 checks/mutants file PATH...           tries those of some files
    python3 checks/mutants alone SITE...          tries some, named FILE:LINE:COLUMN, each in a build of its own
    python3 checks/mutants compare N [SEED]       tries N random ones in builds of their own and compares with the ledger
    python3 checks/mutants                        the table of crates; exit code 1 if a survivor is not explained

cargo-mutants lists the mutants. Hundreds of them are compiled into one set of test programs, each behind a switch
(switches.py), and only the tests that come by the function of a mutant are run, quick ones first, until one fails.
"""

import concurrent.futures
import random
import re
import subprocess
import sys
import time

import ledger
import workshop

# Files change speed when they hold switches, so that a build holds few files; those of a crate stand together.
BUILD = 500


def portions(mutants):
    """Mutants in portions of whole files, about BUILD each."""
    out, current = [], {}
    files = {}
    for number, mutant in mutants.items():
        files.setdefault(mutant["file"], {})[number] = mutant
    for mine in files.values():
        if current and len(current) + len(mine) > BUILD:
            out.append(current)
            current = {}
        current.update(mine)
    return out + ([current] if current else [])


def tried_alone(number, mutant, tests):
    """The outcome of a mutant that is written into the source, and the test that told."""
    workshop.write_one(mutant)
    if not workshop.is_viable(mutant["package"]):
        return "unviable", ""
    # the crates above take as long to compile as all tests
    for packages in ([mutant["package"]], workshop.CRATES)[: 2 if mutant["function"] else 1]:
        programs, _ = workshop.compiled(packages)
        outcome, by = workshop.judge(number, mutant, programs, tests, every=True)
        if outcome != "missed":
            break
    return outcome, by


def alone(mutants, tests):
    """Mutants that take no switch, each compiled for itself; their rows."""
    for number, mutant in mutants.items():
        try:
            outcome, by = tried_alone(number, mutant, tests)
        except subprocess.TimeoutExpired:
            outcome, by = "timeout", "the compiler"
        yield row(mutant, outcome, by)


def together(portion, tests):
    """Mutants in one build: those that took no switch, and the rows of the others, a few at a time."""
    programs, left = workshop.build(portion)
    tried = {number: mutant for number, mutant in portion.items() if number not in left}

    def rows():
        judge = lambda one: workshop.judge(one[0], one[1], programs, tests)
        with concurrent.futures.ThreadPoolExecutor(workshop.WORKERS) as pool:
            for mutant, (outcome, by) in zip(tried.values(), pool.map(judge, tried.items())):
                yield row(mutant, outcome, by)

    return {number: portion[number] for number in left}, rows()


def row(mutant, outcome, by):
    if outcome in ("missed", "timeout"):
        print(f"  {outcome}: {mutant['name']} {by}", flush=True)
    return ledger.row(mutant, outcome, by)


def attempt(mutants, listed):
    """Tries mutants, one build after another, and writes the ledger on the way."""
    ledger.keep(listed.values())
    workshop.copy()
    tests = workshop.coverage(listed)
    left = {}
    for portion in portions(mutants):
        begin = time.monotonic()
        print(f"{len(portion)} mutants of {', '.join(sorted({mutant['file'] for mutant in portion.values()}))}", flush=True)
        without, rows = together(portion, tests)
        left.update(without)
        ledger.add(rows)
        print(f"  {time.monotonic() - begin:.0f} s", flush=True)
    print(f"{len(left)} take no switch", flush=True)
    ledger.add(alone(left, tests))


def compare(listed, count, seed):
    """Whether a mutant behind a switch fares as one that is written into the source; exit code 1 if one does not."""
    rows = ledger.read()
    known = {number: one for number, one in listed.items() if ledger.key(ledger.row(one)) in rows}
    chosen = random.Random(seed).sample(sorted(known), count)
    workshop.copy()
    tests, good, different = workshop.coverage(listed), ("caught", "timeout"), 0
    for one in alone({number: listed[number] for number in sorted(chosen)}, tests):
        before = rows[ledger.key(one)]["outcome"]
        same = before == one["outcome"] or {before, one["outcome"]} == set(good)
        different += not same
        print("same" if same else "DIFFERENT", one["outcome"], before, f"{one['file']}:{one['line']}:{one['column']}", one["change"])
    print(f"{different} of {count} differ")
    return 1 if different else 0


def main(arguments):
    listed = workshop.listed()
    chosen = lambda crates: {number: one for number, one in listed.items() if one["package"] in (crates or workshop.CRATES)}
    match arguments:
        case []:
            return ledger.summary(list(listed.values()))
        case ["shard", which, *crates] if re.fullmatch(r"\d+/\d+", which):
            shard, of = map(int, which.split("/"))
            # by whole files, so that few builds are needed
            parts = portions(chosen(crates))
            attempt({number: one for part in parts[shard - 1 :: of] for number, one in part.items()}, listed)
        case ["missed", *crates]:
            rows, explained = ledger.read(), ledger.survivors()
            wanted = lambda one: (key := ledger.key(ledger.row(one))) not in rows or rows[key]["outcome"] == "missed" and key not in explained
            attempt({number: one for number, one in chosen(crates).items() if wanted(one)}, listed)
        case ["file", *paths] if paths:
            attempt({number: one for number, one in listed.items() if one["file"] in paths}, listed)
        case ["alone", *sites] if sites:
            workshop.copy()
            named = {number: one for number, one in listed.items() if one["name"].split(": ")[0] in sites}
            ledger.add(alone(named, workshop.coverage(listed)))
        case ["compare", count, *seed]:
            return compare(listed, int(count), int(seed[0]) if seed else 0)
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
