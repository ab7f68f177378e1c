#!/usr/bin/env bash
# Tests the page in Chromium without a window (test.mjs), with packages that are pinned by hash and lie below target/.
# Where no compiler has the target of its WebAssembly module, the page is tested without. XTASK names the runner.
# Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
mkdir -p "${CARGO_TARGET_DIR:-target}/browser"
place=$(cd "${CARGO_TARGET_DIR:-target}/browser" && pwd)
if [ -n "${CHECKS_INSTALL:-}" ]; then
  bash checks/install.sh browser
  bash checks/install.sh wasm || echo "without the target of WebAssembly" >&2
fi
command -v chromium >/dev/null || command -v chromium-browser >/dev/null || { echo "chromium is missing" >&2; exit 5; }
major=$(node --version 2>/dev/null | sed 's/^v\([0-9]*\).*/\1/')
[ "${major:-0}" -ge 18 ] || { echo "node 18 or later is missing" >&2; exit 5; }
is_installed() {
  cmp -s checks/browser/package-lock.json "$place/package-lock.json" && [ -f "$place/node_modules/.package-lock.json" ]
}
if ! is_installed; then
  [ -n "${CHECKS_INSTALL:-}" ] || { echo "its packages are not installed (cargo xtask ci does that)" >&2; exit 5; }
  cp checks/browser/*.json "$place"
  (cd "$place" && npm ci --no-audit --no-fund --ignore-scripts >&2)
fi
cp checks/browser/*.mjs checks/browser/*.json "$place"
status=0
"$XTASK" report --check --out "$place/report.html" || status=$?
[ $status != 3 ] || { echo "the figures are not made (cargo xtask figures)" >&2; exit 5; }
[ $status = 0 ] || exit $status
node "$place/test.mjs" "$place/report.html" "$root"
