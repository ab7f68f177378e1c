#!/usr/bin/env bash
# Computes planes of outcomes again and compares them with the committed tables, byte by byte: data/outcomes. A plane takes
# seconds to minutes. `bash checks/outcomes.sh [--bless] [PANEL ...]`; by default the quickest plane.
#
# `bash checks/outcomes.sh --how-sure [PANEL ...]` prints rows of data/outcomes/how_sure.csv: how many cells of a coarse plane
# (25 x 25) change with a hundredth of the tolerance, twice the time, another method and other shifts, and of how many both
# outcomes are decided. `bash checks/outcomes.sh --whole [PANEL ...]` prints the row that compares the committed plane with
# one of which every cell was run; `--whole=CELLS` compares both kinds of a plane of CELLS x CELLS.
set -euo pipefail
cd "$(dirname "$0")/.."
work=${CARGO_TARGET_DIR:-target}/outcomes
header="plane,change,cells,differ,decided_differ"

scene_of() {
    grep -l "^\[panel\.$1\." figures/s*-outcomes*/scene.toml || { echo "no plane is called $1" >&2; exit 2; }
}

# PANEL NAME EDIT...: the table of the plane of a scene to which these edits were made
computed() {
    local panel=$1 name=$2
    shift 2
    mkdir -p "$work"
    sed "$@" "$(scene_of "$panel")" > "$work/$panel-$name.toml"
    rm -rf "${work:?}/$panel-$name"
    cargo --quiet xtask sweep "$work/$panel-$name.toml" --panel "$panel" --out "$work/$panel-$name" --tables-only >&2
    echo "$work/$panel-$name/cells.csv"
}

# PANEL CHANGE TABLE TABLE: a row of how_sure.csv
compared() {
    paste -d, <(cut -d, -f3 "$3") <(cut -d, -f3 "$4") | awk -F, -v row="$1,$2" '
        NR > 1 { cells++; if ($1 != $2) { differ++; if ($1 != "undecided" && $2 != "undecided") sure++ } }
        END { print row "," cells "," differ + 0 "," sure + 0 }'
}

case ${1:-} in
--how-sure)
    shift
    echo "$header"
    [ $# -gt 0 ] || set -- logarithmic exponential relative plain
    coarse='s/cells = [0-9]*/cells = 25/'
    for panel in "$@"; do
        first=$(computed "$panel" coarse -e "$coarse")
        while read -r change edit; do
            grep -q "${edit:2:8}" "$(scene_of "$panel")" || continue
            compared "$panel" "$change" "$first" "$(computed "$panel" "$change" -e "$coarse" -e "$edit")"
        done <<'EDITS'
tolerance_1e-8 s/tolerance = 1e-6/tolerance = 1e-8/
t_end_12000 s/t_end     = 6000.0/t_end     = 12000.0/
dop853 s/"taylor"/"dop853"/
shift_0.05 s/^shift = 0.1/shift = 0.05/
shift_0.15 s/^shift = 0.1/shift = 0.15/
EDITS
    done
    ;;
--whole*)
    cells=${1#--whole}
    cells=${cells#=}
    shift
    echo "$header"
    [ $# -gt 0 ] || set -- exponential plain
    every='/^\[.*sweep\]$/a refine = false'
    for panel in "$@"; do
        if [ -n "$cells" ]; then
            size="s/cells = [0-9]*/cells = $cells/"
            compared "$panel" "every_cell_run" "$(computed "$panel" "$cells" -e "$size")" \
                "$(computed "$panel" "whole-$cells" -e "$size" -e "$every")"
        else
            compared "$panel" "every_cell_run" "data/outcomes/$panel.csv" "$(computed "$panel" whole -e "$every")"
        fi
    done
    ;;
*)
    bless=
    if [ "${1:-}" = --bless ]; then bless=1; shift; fi
    for panel in "${@:-exponential}"; do
        table=$(computed "$panel" plane)
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
