#!/usr/bin/env bash
# Exports the run of figure 11 at several frame rates and compares what PedPy reads with our tables (check.py).
# XTASK names the runner. Exit code 5: not tried, with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
scene=figures/fig11-trajectories/scene.toml
installed=--installed
if [ -n "${CHECKS_INSTALL:-}" ]; then
  installed=
  bash checks/install.sh python
  "$XTASK" figures s17 >&2
fi
for table in data/s17/states.csv data/s17/steady.csv; do
  [ -f "$table" ] || { echo "$table is missing (cargo xtask figures s17 makes it)" >&2; exit 5; }
done
python=$(bash checks/python.sh $installed pedpy checks/pedpy/requirements.txt)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# one run: NAME FRAMES-A-SECOND [END]; tau is half a second
one() {
  local out=$folder/$1
  "$XTASK" simulate "$scene" --tables-only --out "$out" --sample "$("$python" -c "print(1 / ($2 * 0.5))")" ${3:+--t-end "$3"}
  "$target/release/export" "$scene" --table "$out/trajectories.csv" --out "$out" --tau 0.5 --fps "$2"
}
"$XTASK" export fig11 --t-end 1 --out "$folder/built" >&2
for rate in 8 16 32 64; do one fps$rate $rate 60 >&2; done
one whole 8 >&2
rm -r "$folder/built"
# matplotlib, which PedPy loads, keeps its font cache there and not with the user
MPLCONFIGDIR=$target/python/matplotlib "$python" checks/pedpy/check.py "$folder" data/s17
