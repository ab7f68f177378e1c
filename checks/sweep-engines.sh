#!/usr/bin/env bash
# A small plane of outcomes by every engine that workflow/README.md names: one process, Snakemake here, Snakemake with
# Slurm, a Slurm array, HyperQueue, GNU parallel. In each, a shard is killed half-way. All must give the same sums.
#   checks/sweep-engines.sh [ENGINE]...     of snakemake snakemake-slurm slurm-array hyperqueue parallel
# XTASK names the runner. Exit code 5: not all were tried, with the reason of each; 1: sums differ, or an engine failed.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
target=$(mkdir -p "${CARGO_TARGET_DIR:-target}" && cd "${CARGO_TARGET_DIR:-target}" && pwd)
export CARGO_TARGET_DIR=$target
export XTASK=${XTASK:-cargo xtask}
read -ra runner <<<"$XTASK"
shards=3
scratch=$target/sweep-engines
scene=$scratch/scene.toml
untried=()
slurm=
killer=

finish() {
  [ -z "$killer" ] || kill "$killer" 2>/dev/null || true
  [ -z "$slurm" ] || bash checks/slurm.sh stop
}
trap finish EXIT

# Kills one shard of OUT, once its journal has 200 lines; says so in OUT/killed.
kill_one() { # OUT
  local part pid lines
  while sleep 0.02; do
    for part in "$1"/shards/*.part; do
      # the shard may be done, and gone, by now
      lines=$(grep -c . "$part" 2>/dev/null) || continue
      [ "$lines" -gt 200 ] || continue
      for pid in $(pgrep -x sweep || true); do
        tr '\0' '\n' <"/proc/$pid/cmdline" 2>/dev/null | grep -qxF "$1" || continue
        kill -KILL "$pid" 2>/dev/null || continue
        echo "$part" >"$1/killed"
        return
      done
    done
  done
}

# Computes the plane by an engine, which is a function of the folder, and compares the sums with the first ones.
try() { # ENGINE
  local out=$scratch/$1 status=0
  echo "$1" >&2
  mkdir -p "$out/shards"
  kill_one "$out" &
  killer=$!
  "engine-$1" "$out" >"$scratch/$1.log" 2>&1 || status=$?
  kill "$killer" 2>/dev/null || true
  wait "$killer" 2>/dev/null || true
  killer=
  if [ $status != 0 ]; then
    tail -n 30 "$scratch/$1.log" >&2
    echo "$1: exit code $status" >&2
    exit 1
  fi
  [ -s "$out/killed" ] || { echo "$1: no shard was killed half-way" >&2; exit 1; }
  [ "$(find "$out/shards" -name "*-of-$shards.csv" | wc -l)" = $shards ] || { echo "$1: not $shards shards" >&2; exit 1; }
  diff "$scratch/one/SHA256SUMS" "$out/SHA256SUMS" >&2 || { echo "$1: the sums differ" >&2; exit 1; }
  (cd "$out" && sha256sum --check --quiet SHA256SUMS)
}

snakemake_with() { # PROFILE OUT
  "$python" -m snakemake --snakefile workflow/Snakefile --profile "workflow/profiles/$1" --directory "$2" \
    --config scene="$scene" shards=$shards tables_only=yes runner="$XTASK"
}
engine-snakemake() { snakemake_with local "$1"; }
engine-snakemake-slurm() { snakemake_with slurm "$1"; }
engine-hyperqueue() { "$python" workflow/hq_shards.py "$scene" --out "$1" --shards $shards --tables-only; }
engine-parallel() {
  parallel --will-cite --retries 3 "$XTASK sweep $scene --out $1 --shard {}/$shards --jobs 1" ::: $(seq $shards)
  "${runner[@]}" sweep "$scene" --out "$1" --gather --tables-only
}
engine-slurm-array() {
  # a shard that was killed ends the first array with an error; the second finds the others done
  local attempt
  for attempt in 1 2 3; do
    ! sbatch --wait --array=1-$shards --mem=200 --output="$1/%a-of-$shards-$attempt.log" \
      --wrap "$XTASK sweep $scene --out $1 --shard \$SLURM_ARRAY_TASK_ID/$shards --jobs 1" || break
  done
  "${runner[@]}" sweep "$scene" --out "$1" --gather --tables-only
}

engines=("$@")
[ ${#engines[@]} -gt 0 ] || engines=(snakemake snakemake-slurm slurm-array hyperqueue parallel)
rm -rf "$scratch"
mkdir -p "$scratch"
cat >"$scene" <<'SCENE'
title  = "Ten pedestrians"
source = "a check"

[law]
kind    = "logarithmic"
epsilon = 0.01

[ring]
pedestrians = 10
length      = 15.0

[start]
shift = 0.1

[run]
t_end     = 1000.0
method    = "dop853"
tolerance = 1e-6

[sweep]
x = { parameter = "a_v", from = 0.0, to = 0.6, cells = 60 }
y = { parameter = "v0", from = 0.5, to = 3.0, cells = 30 }
SCENE
"${runner[@]}" sweep "$scene" --out "$scratch/one" --jobs 1 --tables-only
python=
why_python=
for engine in "${engines[@]}"; do
  case $engine in
    snakemake | snakemake-slurm | hyperqueue)
      if [ -z "$python$why_python" ]; then
        installed=--installed
        if [ -n "${CHECKS_INSTALL:-}" ]; then
          installed=
          bash checks/install.sh python
        fi
        status=0
        python=$(bash checks/python.sh $installed sweep workflow/requirements.txt 2>"$scratch/python.log") || status=$?
        [ $status = 0 ] || [ $status = 5 ] || { cat "$scratch/python.log" >&2; exit 1; }
        why_python=$(tail -n 1 "$scratch/python.log")
        [ -z "$python" ] || python=$root/${python#"$root"/}
      fi
      [ -n "$python" ] || { untried+=("$engine: $why_python"); continue; }
      ;;
    parallel)
      [ -z "${CHECKS_INSTALL:-}" ] || bash checks/install.sh parallel || true
      command -v parallel >/dev/null || { untried+=("$engine: GNU parallel is missing (Debian: apt-get install parallel)"); continue; }
      ;;
    slurm-array) ;;
    *) echo "$engine: must be of snakemake snakemake-slurm slurm-array hyperqueue parallel" >&2; exit 2 ;;
  esac
  case $engine in
    *slurm*)
      if [ -z "$slurm" ]; then
        status=0
        bash checks/slurm.sh start 2>"$scratch/slurm.log" || status=$?
        [ $status = 0 ] || [ $status = 5 ] || { cat "$scratch/slurm.log" >&2; exit 1; }
        [ $status = 5 ] || slurm=started
      fi
      [ -n "$slurm" ] || { untried+=("$engine: $(tail -n 1 "$scratch/slurm.log")"); continue; }
      ;;
  esac
  try "$engine"
done
if [ ${#untried[@]} -gt 0 ]; then
  printf '%s; ' "${untried[@]}" | sed 's/; $/\n/' >&2
  exit 5
fi
echo "one sum by ${engines[*]}: $(sha256sum <"$scratch/one/SHA256SUMS" | cut -c 1-16)"
