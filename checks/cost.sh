#!/usr/bin/env bash
# Instructions a pedestrian and evaluation of each law, with all its terms and with fewer: what a term costs, and that a
# term which a scene does not name costs nothing. Needs valgrind, whose processor has AVX2 at most.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v valgrind >/dev/null || { echo "skipped: valgrind is missing (apt-get install valgrind)"; exit 0; }
cargo build --quiet --release --locked -p jam --example cost
program="${CARGO_TARGET_DIR:-target}/release/examples/cost"
out=$(mktemp)
trap 'rm -f "$out"' EXIT
count() { # VARIANT EVALUATIONS
    valgrind --tool=callgrind --callgrind-out-file="$out" "$program" "$1" "$2" >/dev/null 2>&1
    sed -n 's/^summary: //p; s/^totals: //p' "$out" | head -n 1
}
printf '%-24s %s\n' variant "instructions a pedestrian"
for variant in $("$program"); do
    # the difference of two runs leaves out the start of the program
    printf '%-24s %s\n' "$variant" "$(( ($(count "$variant" 3000) - $(count "$variant" 1000)) / (2000 * 133) ))"
done
