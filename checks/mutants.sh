#!/usr/bin/env bash
# Mutants: one small change of a source after another (an operator, a sign, a returned value), and whether a test fails.
#   checks/mutants.sh 3/48            the third of forty-eight shards of the crates math, ode, jam and scene
#   checks/mutants.sh 3/48 ode        of one crate
#   checks/mutants.sh --missed [ode]  what the ledger says was missed, against all tests of the four crates
# Outcomes are added to checks/mutants.csv; python3 checks/mutants.py sums them up. A shard of 48 takes about an
# hour on two cores; what it compiled is kept in target/mutation, so that the next one starts at once.
set -euo pipefail
cd "$(dirname "$0")/.."
version=27.1.0
copy=$PWD/target/mutation/checkout
PATH=$PWD/target/tools/bin:$PATH
if [ "$(cargo mutants --version 2>/dev/null)" != "cargo-mutants $version" ]; then
    cargo install cargo-mutants --version "$version" --locked --root target/tools
fi
python3 checks/mutants.py copy "$copy"
one() { # CRATE NAME ARGUMENTS: exit codes 2 and 3 of cargo-mutants say that some were missed or took too long
    local crate=$1 out=target/mutation/$2 code=0
    shift 2
    rm -rf "$out"
    mkdir -p "$out"
    cargo mutants --dir "$copy" --in-place --package "$crate" --output "$out" "$@" || code=$?
    case $code in 0 | 2 | 3) ;; *) exit "$code" ;; esac
    python3 checks/mutants.py add "$out/mutants.out/outcomes.json"
}
shard=${1:?SHARD/OF or --missed}
shift
[ $# -gt 0 ] || set -- math ode jam scene
for crate in "$@"; do
    if [ "$shard" = --missed ]; then
        mapfile -t patterns < <(python3 checks/mutants.py patterns "$crate" | sed 's/^/--re=/')
        [ "${#patterns[@]}" -gt 0 ] || continue
        # without the configuration, which leaves a long test out
        one "$crate" "$crate-missed" --no-config --profile mutants --cargo-arg=--config \
            --cargo-arg=checks/mutants-profile.toml --test-package math,ode,jam,scene --timeout 300 "${patterns[@]}"
    else
        # cargo-mutants counts shards from 0
        one "$crate" "$crate-${shard/\//-of-}" --shard "$((${shard%/*} - 1))/${shard#*/}" --sharding round-robin
    fi
done
