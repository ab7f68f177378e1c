#!/usr/bin/env bash
# Fuzzing of everything that reads a file: libFuzzer, guided by the coverage that rustc's own instrumentation counts.
#   checks/fuzz.sh 1000000           so many inputs for each reader
#   checks/fuzz.sh 1000000 scene     for one
#   checks/fuzz.sh --regress         only those that are kept in fuzz/corpus
# An input that makes a reader panic, take more than ten seconds or more than 1 GB stops it and lies in
# target/fuzz/found. New inputs that reach new code lie in target/fuzz/corpus and are the start of the next call.
# Needs a C++ compiler, which builds libFuzzer.
set -euo pipefail
cd "$(dirname "$0")/.."
[ -z "${CHECKS_INSTALL:-}" ] || bash checks/install.sh compiler
command -v c++ >/dev/null || { echo "a C++ compiler is missing (apt-get install g++)" >&2; exit 5; }
[ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] || { echo "tried on Linux on x86-64 only" >&2; exit 5; }
count=${1:?inputs for each reader, or --regress}
shift
[ $# -gt 0 ] || set -- scene run checkpoint table claims sheet sums events manifest precision formula
coverage="-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4"
coverage+=" -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table"
coverage+=" -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1"
host=x86_64-unknown-linux-gnu
# with a target named, the flags do not reach build scripts, which link no libFuzzer
RUSTFLAGS=$coverage CARGO_TARGET_DIR=$PWD/target/fuzz cargo build --quiet --release --locked \
    --manifest-path fuzz/Cargo.toml --target "$host"
mkdir -p target/fuzz/found
for name in "$@"; do
    program=target/fuzz/$host/release/$name
    limits=(-timeout=10 -rss_limit_mb=1024 -artifact_prefix="target/fuzz/found/$name-" -print_final_stats=1)
    [ ! -f "fuzz/$name.dict" ] || limits+=(-dict="fuzz/$name.dict")
    if [ "$count" = --regress ]; then
        arguments=(-runs=0 "fuzz/corpus/$name")
    else
        mkdir -p "target/fuzz/corpus/$name"
        arguments=(-runs="$count" -max_len=4096 "target/fuzz/corpus/$name" "fuzz/corpus/$name")
    fi
    if ! "$program" "${limits[@]}" "${arguments[@]}" >"target/fuzz/$name.log" 2>&1; then
        tail -n 40 "target/fuzz/$name.log"
        echo "$name: an input of target/fuzz/found is not read as it must be"
        exit 1
    fi
    awk -v name="$name" '
        /stat::number_of_executed_units/ { runs = $2 }
        /stat::peak_rss_mb/ { memory = $2 }
        /cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") cover = $(i + 1) }
        END { printf "%s: %d inputs, %d places of the code reached, %d MB\n", name, runs, cover, memory }
    ' "target/fuzz/$name.log"
done
