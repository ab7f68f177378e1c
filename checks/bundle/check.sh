#!/usr/bin/env bash
# Checks an archive that `cargo xtask bundle` wrote: its sums, its descriptions by the validators of their own projects,
# and the commands of the README in a copy that has no network and nothing of cargo's but the programs.
#   checks/bundle/check.sh ARCHIVE
set -euo pipefail
archive=$(realpath "${1:?ARCHIVE}")
cd "$(dirname "$0")/../.."
python=$(realpath "$(bash checks/python.sh bundle checks/bundle/requirements.txt)" --no-symlinks)
place=${CARGO_TARGET_DIR:-target}/bundle/unpacked
rm -rf "$place"
mkdir -p "$place/empty home"
tar -xf "$archive" -C "$place"
home=$(cd "$place/empty home" && pwd)
cd "$place"/*/
sha256sum --check --quiet SHA256SUMS
listed=$(wc -l <SHA256SUMS) found=$(find . -type f ! -path ./SHA256SUMS | wc -l)
[ "$listed" = "$found" ] || { echo "$found files, $listed in SHA256SUMS" >&2; exit 1; }
echo "$listed files with the sums in SHA256SUMS"
"$python" checks/bundle/run_crate.py
"$python" -c 'from cffconvert.cli.cli import cli; cli()' --validate
"$python" -m frictionless validate data/datapackage.json
walls=(unshare -n)
unshare -n true 2>/dev/null || { walls=(); echo "unshare -n is not possible here: cargo is told to use no network"; }
# cargo as who follows the README starts it
for words in "xtask figures" "test --release --locked --quiet -p jamming-math -p jamming-ode -p jamming -p files -p scene"; do
  echo "without a network: cargo $words"
  # shellcheck disable=SC2086
  env -i PATH="$PATH" HOME="$HOME" ${RUSTUP_HOME:+RUSTUP_HOME="$RUSTUP_HOME"} CARGO_HOME="$home" CARGO_NET_OFFLINE=true \
    "${walls[@]}" cargo $words
done
cd - >/dev/null
rm -rf "$place"
