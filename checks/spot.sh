#!/usr/bin/env bash
# The NumPy checks of checks/spot.py, by a NumPy of this machine or by that of the environment of PedPy.
# Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
while read -r _ name; do
  case $name in *.csv) [ -f "$name" ] || { echo "$name is missing (cargo xtask figures makes it)" >&2; exit 5; } ;; esac
done <data/SHA256SUMS
python=python3
if ! python3 -c 'import numpy' 2>/dev/null; then
  installed=--installed
  if [ -n "${CHECKS_INSTALL:-}" ]; then
    installed=
    bash checks/install.sh python
  fi
  python=$(bash checks/python.sh $installed pedpy checks/pedpy/requirements.txt)
fi
"$python" checks/spot.py
