#!/usr/bin/env bash
# Computes planes of outcomes again and compares them with the committed tables, byte by byte: data/outcomes. A plane takes
# seconds to minutes. `bash checks/outcomes.sh [--bless] [PANEL ...]`; by default the quickest plane.
#
# `bash checks/outcomes.sh --how-sure COUNT [PANEL ...]` prints rows of data/outcomes/how_sure.csv. Of the committed plane, so
# many cells that were filled in are run, and so many that were run are run again with a hundredth of the tolerance, for twice
# the time, with another method and with other shifts; a row says how many have another outcome, and of how many both outcomes
# are decided. With COUNT = 0 all cells are: hours for some planes.
set -euo pipefail
cd "$(dirname "$0")/.."
work=${CARGO_TARGET_DIR:-target}/outcomes

scene_of() {
    grep -l "^\[panel\.$1\." figures/s*-outcomes*/scene.toml || { echo "no plane is called $1" >&2; exit 2; }
}

case ${1:-} in
--how-sure)
    count=${2:?how many cells of a kind}
    shift 2
    [ "$count" -gt 0 ] || count=1000000
    [ $# -gt 0 ] || set -- exponential
    mkdir -p "$work"
    echo "plane,change,cells,differ,decided_differ"
    cargo build --quiet --release --package studies --bin again
    for panel in "$@"; do
        scene=$(scene_of "$panel")
        while read -r kind change edit; do
            sed "$edit" "$scene" > "$work/$panel-$change.toml"
            "${CARGO_TARGET_DIR:-target}/release/again" "$work/$panel-$change.toml" "$panel" "data/outcomes/$panel.csv" \
                "$count" "$kind" "$change"
        done <<'EDITS'
filled filled_cells_run
run tolerance_1e-8 s/tolerance = 1e-6/tolerance = 1e-8/
run t_end_12000 s/t_end     = 6000.0/t_end     = 12000.0/
run dop853 s/"taylor"/"dop853"/
run shift_0.05 s/^shift = 0.1/shift = 0.05/
run shift_0.15 s/^shift = 0.1/shift = 0.15/
EDITS
    done
    ;;
*)
    bless=
    if [ "${1:-}" = --bless ]; then bless=1; shift; fi
    for panel in "${@:-exponential}"; do
        table=$work/$panel/cells.csv
        rm -rf "${work:?}/$panel"
        cargo --quiet xtask sweep "$(scene_of "$panel")" --panel "$panel" --out "$work/$panel" --tables-only
        if [ -n "$bless" ]; then
            mkdir -p data/outcomes
            cp "$table" "data/outcomes/$panel.csv"
        elif cmp "$table" "data/outcomes/$panel.csv"; then
            echo "$panel: the same bytes"
        else
            exit 1
        fi
    done
    ;;
esac
