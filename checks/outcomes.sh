#!/usr/bin/env bash
# Computes planes of outcomes again and compares them with the committed tables, byte by byte: data/outcomes. A plane takes
# minutes. `bash checks/outcomes.sh [--bless] [PANEL ...]`; by default the quickest plane.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=figures/s18-outcomes/scene.toml
bless=
if [ "${1:-}" = --bless ]; then bless=1; shift; fi
for panel in "${@:-exponential}"; do
    out=${CARGO_TARGET_DIR:-target}/outcomes/$panel
    rm -rf "$out"
    cargo --quiet xtask sweep "$scene" --panel "$panel" --out "$out" --tables-only
    if [ -n "$bless" ]; then
        mkdir -p data/outcomes
        cp "$out/cells.csv" "data/outcomes/$panel.csv"
    elif cmp "$out/cells.csv" "data/outcomes/$panel.csv"; then
        echo "$panel: the same bytes"
    else
        exit 1
    fi
done
