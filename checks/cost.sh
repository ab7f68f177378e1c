#!/usr/bin/env bash
# Instructions of each law for one pedestrian and one evaluation, or (step-*) one step of Heun's scheme, with all its
# terms and with fewer: what a term costs, and that a term which a scene does not name costs nothing. Compared with
# checks/instructions.csv within 2 %: a loop that is no longer vector code shows on the noisiest machine.
#   checks/cost.sh             compares; exit code 1 names what needs more instructions than it should
#   checks/cost.sh --bless     writes the numbers down
# Needs valgrind, whose processor has AVX2 at most, on x86-64.
set -euo pipefail
cd "$(dirname "$0")/.."
[ -z "${CHECKS_INSTALL:-}" ] || bash checks/install.sh valgrind
command -v valgrind >/dev/null || { echo "valgrind is missing (apt-get install valgrind)" >&2; exit 5; }
[ "$(uname -m)" = x86_64 ] || { echo "the numbers are those of x86-64" >&2; exit 5; }
cargo build --quiet --release --locked -p jamming --example cost
program="${CARGO_TARGET_DIR:-target}/release/examples/cost"
known=checks/instructions.csv
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
count() { # VARIANT TIMES
    valgrind --tool=callgrind --callgrind-out-file="$scratch/out" "$program" "$1" "$2" >/dev/null 2>&1
    sed -n 's/^summary: //p; s/^totals: //p' "$scratch/out" | head -n 1
}
echo "variant,pedestrians,instructions" >"$scratch/now.csv"
while read -r variant pedestrians; do
    # the difference of two runs leaves out the start of the program
    difference=$(($(count "$variant" 600) - $(count "$variant" 200)))
    awk -v v="$variant" -v n="$pedestrians" -v d="$difference" 'BEGIN { printf "%s,%d,%.1f\n", v, n, d / (400 * n) }' \
        >>"$scratch/now.csv"
done < <("$program")
if [ "${1:-}" = --bless ]; then
    cp "$scratch/now.csv" "$known"
    column -s, -t "$known"
    exit 0
fi
awk -F, '
    NR == FNR { before[$1] = $3; next }
    FNR == 1 { printf "%-28s %12s %12s %8s\n", "variant", "instructions", "committed", "change"; next }
    !($1 in before) { printf "%-28s %12s is not in checks/instructions.csv\n", $1, $3; failed = 1; next }
    {
        change = 100 * ($3 / before[$1] - 1)
        verdict = change > 2 || change < -2 ? "  <- more than 2 %" : ""
        printf "%-28s %12s %12s %+7.1f%%%s\n", $1, $3, before[$1], change, verdict
        if (verdict != "") { failed = 1; names = names " " $1 }
        delete before[$1]
    }
    END {
        for (name in before) if (name != "variant") { print "missing: " name; failed = 1 }
        if (names != "") print "differ from checks/instructions.csv:" names "; if on purpose: checks/cost.sh --bless"
        exit failed
    }' "$known" "$scratch/now.csv"
