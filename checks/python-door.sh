#!/usr/bin/env bash
# Builds the package for Python as `pip install ./crates/python` does, installs the wheel into a folder below target/, and
# tries it there: types, doctests, pytest against the tables of the command line, notebooks.
# XTASK names the runner. Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
mkdir -p "$target/python"
target=$(cd "$target" && pwd)
host=$(rustc -vV | sed -n 's/^host: //p')
crates=(cargo fetch --quiet --locked --manifest-path crates/python/Cargo.toml --target "$host")
installed=--installed
if [ -n "${CHECKS_INSTALL:-}" ]; then
  installed=
  bash checks/install.sh python
  "${crates[@]}"
elif ! "${crates[@]}" --offline 2>/dev/null; then
  echo "the crates of crates/python/Cargo.lock are not downloaded (cargo xtask ci does that)" >&2
  exit 5
fi
python=$(bash checks/python.sh $installed pedpy checks/pedpy/requirements.txt)
python=$(cd "$(dirname "$python")" && pwd)/python
export PATH="$(dirname "$python"):$PATH" PYTHONNOUSERSITE=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1
unset PYTHONPATH PYTHONHOME
pip=("$python" -m pip --quiet)

# nothing is looked for elsewhere: maturin is in that environment
rm -rf "$target/python/wheels" "$target/python/door"
CARGO_NET_OFFLINE=true CARGO_TARGET_DIR=$target/python/cargo "${pip[@]}" wheel --no-index --no-deps --no-build-isolation \
  --wheel-dir "$target/python/wheels" ./crates/python >&2
"${pip[@]}" install --no-index --no-deps --target "$target/python/door" "$target"/python/wheels/jamming-*.whl >&2
ls -s --block-size=K "$target/python/wheels" >&2

# the programs whose tables are compared, built by the runner
"$XTASK" map scenes/map.toml --tables-only >/dev/null
export PYTHONPATH=$target/python/door JAMMING_PROGRAMS=$target/release
# matplotlib keeps its font cache there and not with the user
export MPLCONFIGDIR=$target/python/matplotlib IPYTHONDIR=$target/python/ipython
cd crates/python
cache=$target/python/cache
"$python" -m mypy --cache-dir "$cache/mypy" -p jamming >&2
"$python" -m pytest -q -W error -o cache_dir="$cache/pytest" --doctest-modules tests --pyargs jamming
