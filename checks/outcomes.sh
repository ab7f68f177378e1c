#!/usr/bin/env bash
# Computes planes of outcomes again and compares them with the committed tables, byte by byte: data/outcomes. A plane takes
# minutes. `bash checks/outcomes.sh [--bless] [PANEL ...]`; by default the quickest plane.
#
# `bash checks/outcomes.sh --how-sure [PANEL ...]` prints how many cells of a coarse plane (25 x 25) change with a hundredth of the
# tolerance, twice the time, another method and other shifts: all that differ, and those that are decided both times.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=figures/s18-outcomes/scene.toml
bless=
if [ "${1:-}" = --bless ]; then bless=1; shift; fi
if [ "${1:-}" = --how-sure ]; then
    shift
    work=${CARGO_TARGET_DIR:-target}/outcomes/how-sure
    mkdir -p "$work"
    coarse='s/cells = [0-9]*/cells = 25/'
    echo "plane,change,cells,differ,decided_differ"
    [ $# -gt 0 ] || set -- logarithmic exponential relative plain
    for panel in "$@"; do
        for change in none 's/= 1e-6/= 1e-8/' 's/= 6000.0/= 12000.0/' 's/"taylor"/"dop853"/' \
            's/^shift = 0.1/shift = 0.05/' 's/^shift = 0.1/shift = 0.15/'; do
            name=$(printf %s "$panel $change" | tr -c 'a-zA-Z0-9.\n' _)
            if [ "$change" = none ]; then edit=; else edit=$change; fi
            sed -e "$coarse" -e "$edit" "$scene" > "$work/$name.toml"
            rm -rf "${work:?}/$name"
            cargo --quiet xtask sweep "$work/$name.toml" --panel "$panel" --out "$work/$name" --tables-only >&2
            if [ "$change" = none ]; then first=$work/$name/cells.csv; continue; fi
            paste -d, <(cut -d, -f3 "$first") <(cut -d, -f3 "$work/$name/cells.csv") | awk -F, -v plane="$panel" -v change="$change" '
                NR > 1 { cells++; if ($1 != $2) { differ++; if ($1 != "undecided" && $2 != "undecided") sure++ } }
                END { gsub(/^s.|\/$/, "", change); print plane "," change "," cells "," differ + 0 "," sure + 0 }'
        done
    done
    exit
fi
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
