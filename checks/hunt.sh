#!/usr/bin/env bash
# Random scenes integrated a third time, by SciPy (hunt.py): checks/hunt.sh [COUNT [FROM]], by default the first 300 seeds.
# SciPy is that of this machine or of the environment of PedPy. Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
python=python3
if ! python3 -c 'import scipy' 2>/dev/null; then
  [ -f checks/python.sh ] || { echo "python3 with scipy not found" >&2; exit 5; }
  installed=--installed
  if [ -n "${CHECKS_INSTALL:-}" ]; then
    installed=
    bash checks/install.sh python
  fi
  python=$(bash checks/python.sh $installed pedpy checks/pedpy/requirements.txt)
fi
cargo run --quiet --release --locked -p hunt -- --json --count "${1:-300}" --from "${2:-0}" | "$python" checks/hunt.py
