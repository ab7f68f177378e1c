#!/usr/bin/env bash
# Licences and sources of all crates, and crates that are not allowed (deny.toml); installs cargo-deny below target/ where
# there is none.
set -euo pipefail
cd "$(dirname "$0")/.."
version=0.18.9
target=${CARGO_TARGET_DIR:-target}
deny=cargo-deny
if ! command -v cargo-deny >/dev/null; then
  deny=$target/tools/bin/cargo-deny
  [ -x "$deny" ] || cargo install --locked --version $version --root "$target/tools" cargo-deny
fi
for manifest in Cargo.toml crates/python/Cargo.toml; do
  # so that the check itself needs no network
  cargo fetch --quiet --locked --manifest-path "$manifest"
  "$deny" --offline --manifest-path "$manifest" check --config "$PWD/deny.toml" licenses bans sources
done
