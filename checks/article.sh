#!/usr/bin/env bash
# Sets the article and checks its PDF from outside. XTASK names the runner. Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -n "${CHECKS_INSTALL:-}" ]; then
  bash checks/install.sh python
elif ! command -v typst >/dev/null; then
  bash checks/python.sh --installed typst paper/requirements.txt >/dev/null
fi
status=0
"$XTASK" paper || status=$?
[ $status != 3 ] || { echo "the figures are not made (cargo xtask figures --all)" >&2; exit 5; }
[ $status = 0 ] || exit $status
installed=--installed
[ -z "${CHECKS_INSTALL:-}" ] || installed=
python=$(bash checks/python.sh $installed pdf checks/requirements-pdf.txt)
"$python" checks/pdf.py paper/jamming-reproduction.pdf
