"""Installs and builds what bench/peers.py runs, below its scratch folder."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

BENCH = Path(__file__).resolve().parent
PACKAGES = {
    "g++": lambda: shutil.which("g++"),
    "gfortran": lambda: shutil.which("gfortran"),
    "libsundials-dev": lambda: Path("/usr/include/cvode/cvode.h").exists(),
    "libgsl-dev": lambda: Path("/usr/include/gsl/gsl_odeiv2.h").exists(),
    "libboost-dev": lambda: Path("/usr/include/boost/numeric/odeint.hpp").exists(),
}
# of these programs; the others are needed for any
NEEDED_BY = {
    "gfortran": {"numbalsoda"},
    "libsundials-dev": {"cvode", "arkode"},
    "libgsl-dev": {"gsl"},
    "libboost-dev": {"odeint"},
}
# the integrators that are called from Python
PYTHON = {"scipy", "numbalsoda", "heyoka"}
LIBRARIES = {
    "cvode": ["-lsundials_cvode", "-lsundials_nvecserial"],
    "arkode": ["-lsundials_arkode", "-lsundials_nvecserial"],
    "gsl": ["-lgsl", "-lgslcblas"],
    "odeint": [],
}


class Trouble(Exception):
    """What is missing or failed, in one message."""


def run(command, what, **options):
    """Runs a command whose output matters only when it fails."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    except OSError as error:
        raise Trouble(f"{what}: {error}") from error
    if done.returncode:
        raise Trouble(f"{what} failed:\n  {' '.join(map(str, command))}\n{done.stdout[-3000:]}")
    return done.stdout


def system_packages(install, wanted):
    """Checks for what the wanted programs need of the system; installs it if that was asked for and is allowed."""
    needed = {name: found for name, found in PACKAGES.items() if NEEDED_BY.get(name, wanted) & wanted}
    missing = [name for name, found in needed.items() if not found()]
    if not missing:
        return
    if not install:
        raise Trouble(f"missing: {' '.join(missing)}\n  apt-get install {' '.join(missing)}\nor --install, as root")
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise Trouble(f"--install needs root and apt-get; missing: {' '.join(missing)}")
    run(["apt-get", "update"], "apt-get update")
    run(["apt-get", "install", "-y", *missing], "apt-get install")


def widest():
    """The level of x86-64 with the widest vectors of this processor."""
    words = Path("/proc/cpuinfo").read_text().split()
    wide = all(word in words for word in ["avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512cd"])
    return "x86-64-v4" if wide else "x86-64-v3"


def flags(level=None):
    """Flags for C++, and their level: by default that of the widest vectors, since ours choose theirs as they start."""
    level = level or widest()
    width = ["-mprefer-vector-width=512"] if level == "x86-64-v4" else []
    return ["-O3", f"-march={level}", *width, "-ffast-math", "-std=c++17"], level


def python_environment(scratch):
    """The interpreter of an environment with the packages of requirements.txt, made once."""
    folder = scratch / "venv"
    python, wanted = folder / "bin" / "python", BENCH / "python" / "requirements.txt"
    stamp = folder / "requirements.txt"
    if stamp.exists() and stamp.read_text() == wanted.read_text():
        return python
    print("installing Python packages", file=sys.stderr)
    run([sys.executable, "-m", "venv", "--clear", folder], "venv")
    pip = [python, "-m", "pip", "install", "--disable-pip-version-check"]
    lines = [line for line in wanted.read_text().splitlines() if line and not line.startswith("#")]
    from_source = [line for line in lines if line.startswith("numbalsoda")]
    run([*pip, *[line for line in lines if line not in from_source]], "pip install")
    # its build description asks for versions of cmake and of build tools that are gone; these do
    environment = os.environ | {"CMAKE_POLICY_VERSION_MINIMUM": "3.5", "PATH": f"{folder}/bin:{os.environ['PATH']}"}
    run([*pip, "--no-build-isolation", *from_source], "pip install numbalsoda", env=environment)
    stamp.write_text(wanted.read_text())
    return python


def programs(scratch, wanted, level=None):
    """Builds the wanted programs in C++ and Rust, for a level of x86-64 or the widest vectors: their paths by name."""
    options, level = flags(level)
    library = scratch / "librhs.so"
    source = BENCH / "cpp"
    run(["g++", *options, "-shared", "-fPIC", source / "rhs.cpp", "-o", library], "g++ rhs.cpp")
    built = {"rhs": library}
    for name, libraries in [(name, libraries) for name, libraries in LIBRARIES.items() if name in wanted]:
        built[name] = scratch / name
        run(["g++", *options, source / f"{name}.cpp", "-o", built[name], *libraries], f"g++ {name}.cpp")
    if "differential-equations" not in wanted:
        return built
    rust = f"-C target-cpu={level} -L {scratch} -C link-arg=-Wl,-rpath,{scratch}"
    environment = os.environ | {"CARGO_TARGET_DIR": str(scratch / "cargo"), "RUSTFLAGS": rust}
    package = BENCH / "differential-equations"
    run(["cargo", "build", "--release", "--locked"], "cargo build", cwd=package, env=environment)
    built["differential-equations"] = scratch / "cargo" / "release" / "differential-equations-ring"
    return built


def simulate():
    """Our own program, built if need be."""
    run(["cargo", "build", "--release", "-p", "figures", "--bin", "simulate"], "cargo build", cwd=BENCH.parent)
    target = Path(os.environ.get("CARGO_TARGET_DIR", BENCH.parent / "target"))
    return target / "release" / "simulate"


def copies(programs, folder):
    """The same programs, copied. As the linker leaves it a program starts slower, by 0.03 ms within the time that is taken."""
    made = {}
    for name, path in programs.items():
        made[name] = Path(shutil.copy(path, folder / f"{name} {path.name}".replace(" ", "-")))
    return made


def versions(python):
    """Versions of what was run, a line each."""
    code = (
        "from importlib.metadata import version as v\n"
        "print(*(f'{n} {v(n)}' for n in ['numpy', 'scipy', 'numba', 'numbalsoda', 'heyoka']), sep='\\n')"
    )
    found = run([python, "-c", code], "versions").split("\n")[:-1] if python else []
    for name in ["libsundials-dev", "libgsl-dev", "libboost-dev"]:
        if shutil.which("dpkg-query") and PACKAGES[name]():
            found.append(f"{name} " + run(["dpkg-query", "-W", "-f", "${Version}", name], "dpkg-query"))
    manifest = (BENCH / "differential-equations" / "Cargo.toml").read_text()
    found.append("differential-equations " + manifest.split('differential-equations = "=')[1].split('"')[0])
    found.append(run(["g++", "--version"], "g++").split("\n")[0])
    found.append(run(["rustc", "--version"], "rustc").strip())
    return found
