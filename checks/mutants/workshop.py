"""The copy of the checkout in which mutants are built and tried: `target/mutation/checkout`."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

import ledger
import switches

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HOME = ROOT / "target/mutation"
COPY = HOME / "checkout"
CRATES = ledger.CRATES
PROFILE = "mutants"
# Processes at a time, and what one may take: a mutant may ask for room without end, or never come back.
WORKERS = os.cpu_count() or 1
MEMORY = 6 << 30
PATIENCE = (5.0, 5.0)  # seconds, and times the time of the unchanged source

SWITCH = """
//! The switch of a test process: which mutant it is, and which functions it came by.
static mut ACTIVE: u32 = 0;
static mut HITS: [u8; 1 << 16] = [0; 1 << 16];
unsafe extern "C" { fn atexit(done: extern "C" fn()) -> i32; }
#[inline(always)]
pub fn active() -> u32 { unsafe { ACTIVE } }
#[inline(always)]
pub fn hit(function: usize) { unsafe { HITS[function] = 1 } }
extern "C" fn write() {
    let hits = &raw const HITS;
    if let Some(path) = std::env::var_os("MUTATION_HITS") { std::fs::write(path, unsafe { &*hits }).unwrap(); }
}
extern "C" fn start() {
    let number = std::env::var("MUTATION").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    unsafe { ACTIVE = number };
    if std::env::var_os("MUTATION_HITS").is_some() { unsafe { atexit(write) }; }
}
#[used]
#[unsafe(link_section = ".init_array")]
static START: extern "C" fn() = start;
"""


# Seconds for the compiler to check a crate, and to compile all; it takes a tenth of either.
CHECK, COMPILATION = 60, 900


def listed():
    """All mutants, as cargo-mutants lists them, in the order of the sources; the first has number 1."""
    packages = [word for crate in CRATES for word in ("--package", crate)]
    command = ["cargo", "mutants", "--list", "--json", *packages]
    text = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    place = lambda one: (CRATES.index(one["package"]), one["file"], one["span"]["start"]["line"], one["span"]["start"]["column"], one["name"])
    return dict(enumerate(sorted(json.loads(text), key=place), 1))


def function(mutant):
    """The function that a mutant is in, if any."""
    inside = mutant["function"]
    return (mutant["file"], json.dumps(inside["span"], sort_keys=True)) if inside else None


def put(path, text):
    """Writes a file unless it has that text: what is unchanged is not compiled again."""
    if not path.is_file() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def copy():
    """The tracked files, and the crate `mutation`, on which the four crates depend there."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    wanted = {name for name in names.split("\0") if name and (ROOT / name).is_file()}
    manifests = {f"crates/{crate}/Cargo.toml" for crate in CRATES} | {"Cargo.lock"}
    for name in wanted - manifests:
        source, place = ROOT / name, COPY / name
        if not place.is_file() or place.read_bytes() != source.read_bytes():
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, place)
    for place in [place for folder in ("crates", "figures", "xtask") for place in (COPY / folder).rglob("*.rs")]:
        if str(place.relative_to(COPY)) not in wanted and "crates/mutation" not in str(place):
            place.unlink()
    for crate in CRATES:
        text = (ROOT / f"crates/{crate}/Cargo.toml").read_text()
        put(COPY / f"crates/{crate}/Cargo.toml", text.replace("[dependencies]\n", '[dependencies]\nmutation = { path = "../mutation" }\n', 1))
    put(COPY / "crates/mutation/Cargo.toml", '[package]\nname = "mutation"\nversion = "0.0.0"\nedition = "2024"\n')
    put(COPY / "crates/mutation/src/lib.rs", SWITCH)
    if not (COPY / "Cargo.lock").is_file():
        shutil.copyfile(ROOT / "Cargo.lock", COPY / "Cargo.lock")


def cargo(*arguments, patience=COMPILATION):
    """A command of cargo in the copy: whether it succeeded, all its messages, and the errors among them.

    A constant that a mutant computes for ever keeps the compiler busy for ever: subprocess.TimeoutExpired."""
    command = ["cargo", *arguments, "--offline", "--config", "checks/mutants-profile.toml", "--profile", PROFILE]
    environment = dict(os.environ, RUSTFLAGS="--cap-lints=allow", CARGO_TARGET_DIR=str(HOME / "target"))
    done = subprocess.Popen(
        [*command, "--message-format", "json"], cwd=COPY, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, start_new_session=True,
    )
    try:
        output, words = done.communicate(timeout=patience)
    except subprocess.TimeoutExpired:
        os.killpg(done.pid, 9)
        done.communicate()
        raise
    messages = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    errors = [one["message"] for one in messages if one["reason"] == "compiler-message" and one["message"]["level"] == "error"]
    if done.returncode and not errors:
        raise SystemExit(words[-3000:])
    return done.returncode == 0, messages, errors


def is_viable(crate):
    """Whether the sources of a crate compile."""
    return cargo("check", "--lib", "--package", crate, patience=CHECK)[0]


def compiled(packages):
    """Test programs of packages, as (crate, program), or what the compiler said."""
    chosen = [word for crate in packages for word in ("--package", crate)]
    done, messages, errors = cargo("test", "--no-run", "--lib", "--tests", *chosen)
    programs = []
    for one in messages:
        if one["reason"] == "compiler-artifact" and one.get("executable") and one["profile"]["test"]:
            crate = pathlib.Path(one["manifest_path"]).parent.name
            if crate in packages:
                programs.append((crate, one["executable"]))
    return (programs, []) if done else (None, errors)


def blamed(text, error):
    """Numbers of the mutants that an error of the compiler is about."""
    found = set()
    for span in error["spans"]:
        if not span["is_primary"]:
            continue
        before = text.encode()[: span["byte_end"]].decode()
        marks = list(re.finditer(r"(\d+) => |== (\d+) \{ return|!= (\d+) && |_ => |_(\d+): ", before))
        if not marks:
            continue
        if marks[-1].lastindex:
            found.add(int(marks[-1].group(marks[-1].lastindex)))
        else:
            start = before.rfind("active() {", 0, marks[-1].start())
            found |= {int(number) for number in re.findall(r"(\d+) => ", before[start:])}
    return found


def write(mutants, functions):
    """Writes the sources with these mutants behind switches; returns the texts and the mutants that took none."""
    texts, left = {}, set()
    sources = [path for crate in CRATES for path in (ROOT / f"crates/{crate}/src").rglob("*.rs")]
    tables = {}
    for path in sources:
        name = str(path.relative_to(ROOT))
        mine = [(number, mutant) for number, mutant in mutants.items() if mutant["file"] == name]
        text = path.read_text()
        within = "::".join(["crate", *pathlib.Path(name).with_suffix("").parts[3:]])
        tables.update({table: within for table in (switches.table_names(text, mine) if mine else [])})
    for path in sources:
        name = str(path.relative_to(ROOT))
        mine = [(number, mutant) for number, mutant in mutants.items() if mutant["file"] == name]
        source = switches.Source(path.read_text(), mine, [(number, span) for number, (file, span) in functions.items() if file == name])
        left |= set(source.left)
        texts[name] = switches.use_tables(source.text(), tables) if name.startswith("crates/ode/") else source.text()
    for name, text in texts.items():
        put(COPY / name, text)
    return texts, left


def write_one(mutant):
    """Writes the sources with one mutant, as cargo-mutants would."""
    for path in [path for crate in CRATES for path in (ROOT / f"crates/{crate}/src").rglob("*.rs")]:
        name, text = str(path.relative_to(ROOT)), path.read_text()
        if name == mutant["file"]:
            start, end = switches.offsets(text, mutant["span"])
            raw = text.encode()
            text = (raw[:start] + mutant["replacement"].encode() + raw[end:]).decode()
        put(COPY / name, text)


def build(mutants, functions=None):
    """Builds all test programs with these mutants; returns the programs and the mutants that are not in them."""
    mutants, left = dict(mutants), set()
    while True:
        texts, without = write(mutants, functions or {})
        left |= without
        programs, errors = compiled(CRATES)
        if programs is not None:
            return programs, left
        wrong = set()
        for error in errors:
            files = {span["file_name"] for span in error["spans"] if span["is_primary"]}
            for name in files:
                wrong |= blamed(texts[name], error) & mutants.keys()
        if not wrong:
            raise SystemExit("\n".join(error["rendered"] for error in errors)[:6000])
        left |= wrong
        mutants = {number: mutant for number, mutant in mutants.items() if number not in wrong}


def run(program, crate, test, patience, **environment):
    """Runs one test of a program: "passed", "caught" or "timeout"."""
    command = ["prlimit", f"--as={MEMORY}", "--core=0", program, "--exact", "--test-threads=1", test]
    process = subprocess.Popen(
        command, cwd=COPY / "crates" / crate, env=dict(os.environ, **environment), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True,
    )
    try:
        output = process.communicate(timeout=patience)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.communicate()
        return "timeout"
    if process.returncode == 0 and "1 passed" not in output:
        raise SystemExit(f"{crate}: {test} is no test:\n{output[-2000:]}")
    return "caught" if process.returncode else "passed"


def names(program):
    listing = subprocess.run([program, "--list"], capture_output=True, text=True, check=True).stdout
    ignored = subprocess.run([program, "--list", "--ignored"], capture_output=True, text=True, check=True).stdout
    all_, left = (re.findall(r"^(\S+): test$", text, re.MULTILINE) for text in (listing, ignored))
    return [name for name in all_ if name not in left]


def coverage(mutants):
    """For each test, as `crate name`: seconds, and the functions it comes by. Kept until a source changes."""
    digest = hashlib.sha256()
    for path in sorted(path for crate in CRATES for path in (ROOT / "crates" / crate).rglob("*.rs")):
        digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes())
    kept = HOME / "coverage.json"
    if kept.is_file() and json.loads(kept.read_text())["sources"] == digest.hexdigest():
        return json.loads(kept.read_text())["tests"]
    print("which test comes by which function", flush=True)
    spans = sorted({function(mutant) for mutant in mutants.values() if function(mutant)})
    numbered = {number: (file, json.loads(span)) for number, (file, span) in enumerate(spans)}
    programs, _ = build({}, numbered)
    found = {}

    def one(job):
        crate, program, name = job
        with tempfile.NamedTemporaryFile() as hits:
            begin = time.monotonic()
            outcome, seconds = run(program, crate, name, 900, MUTATION_HITS=hits.name), time.monotonic() - begin
            if outcome != "passed":
                raise SystemExit(f"{crate}: {name} fails without a mutant")
            bits = pathlib.Path(hits.name).read_bytes()
        found[f"{crate} {name}"] = {"seconds": seconds, "functions": [list(spans[i]) for i in range(len(spans)) if bits[i]]}

    jobs = [(crate, program, name) for crate, program in programs for name in names(program)]
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(one, jobs))
    kept.write_text(json.dumps({"sources": digest.hexdigest(), "tests": found}))
    return found


def candidates(mutant, tests, every):
    """Tests that come by a mutant, or every test, of its crate and those above, the quickest first: (seconds, crate, name).
    Constants are in no function: every test of their crate."""
    place, crates = function(mutant), CRATES[CRATES.index(mutant["package"]) :]
    if place is None:
        every, crates = True, crates[:1]
    chosen = [(one["seconds"], *key.split(" ")) for key, one in tests.items() if every or list(place) in one["functions"]]
    return sorted(one for one in chosen if one[1] in crates)


def judge(number, mutant, programs, tests, every=False):
    """The outcome of one mutant, and the test that told."""
    for seconds, crate, name in candidates(mutant, tests, every):
        for program in [program for one, program in programs if one == crate and name in known(program)]:
            outcome = run(program, crate, name, PATIENCE[0] + PATIENCE[1] * seconds, MUTATION=str(number))
            if outcome != "passed":
                return outcome, f"{crate}: {name}"
    return "missed", ""


KNOWN = {}


def known(program):
    if program not in KNOWN:
        KNOWN[program] = set(names(program))
    return KNOWN[program]
