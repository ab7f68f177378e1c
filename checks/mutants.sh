#!/usr/bin/env bash
# Mutants: one small change of a source after another (an operator, a sign, a returned value), and whether a test fails.
#   checks/mutants.sh shard 3/8       the third of eight shards of all mutants of math, ode, jam and scene
#   checks/mutants.sh shard 1/2 jam   of one crate
#   checks/mutants.sh missed          what the ledger says was missed, or was never tried
#   checks/mutants.sh file PATH...    those of some files
#   checks/mutants.sh alone SITE...   some (FILE:LINE:COLUMN), each compiled for itself
#   checks/mutants.sh compare N       N random ones compiled for themselves, compared with the table
#   checks/mutants.sh                 the table, from checks/mutants.csv, and what is not explained
# Needs python3. cargo-mutants, which lists the mutants, and two Python packages go below the target folder.
set -euo pipefail
cd "$(dirname "$0")/.."
version=27.1.0
python=target/python/mutants
PATH=$PWD/target/tools/bin:$PATH
if [ "$(cargo mutants --version 2>/dev/null)" != "cargo-mutants $version" ]; then
    cargo install cargo-mutants --version "$version" --locked --root target/tools
fi
if ! "$python/bin/python" -c 'import tree_sitter_rust' 2>/dev/null; then
    python3 -m venv "$python"
    "$python/bin/pip" install --quiet --require-hashes --requirement checks/mutants/requirements.txt
fi
exec "$python/bin/python" -u checks/mutants "$@"
