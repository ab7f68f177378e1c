#!/usr/bin/env bash
# Installs what the checks need and this machine lacks, where that is possible (Debian, as root):
#   checks/install.sh [compiler] [python] [browser] [wasm] [git] [valgrind] [slurm] [parallel]
# Exit code 0: everything is installed; 5: something is missing and cannot be installed here; other codes: an installation
# failed.
set -euo pipefail
packages=()
need() { command -v "$1" >/dev/null 2>&1 || packages+=("$2"); }
for part in "$@"; do
  case $part in
    compiler) need cc build-essential; need c++ build-essential ;;
    valgrind) need valgrind valgrind ;;
    git) need git git ;;
    wasm)
      # the target, or Debian's compiler with the sources of the library
      rustup target add wasm32-unknown-unknown >/dev/null 2>&1 || packages+=(rustc-web rust-web-src lld-19)
      ;;
    slurm) need slurmctld slurm-wlm; need munged munge ;;
    parallel) need parallel parallel ;;
    python) python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || packages+=(python3 python3-venv) ;;
    browser)
      command -v chromium-browser >/dev/null 2>&1 || need chromium chromium
      need node nodejs
      need npm npm
      ;;
    *) echo "$0: $part: valid are compiler, git, python, browser, wasm, valgrind, slurm, parallel" >&2; exit 2 ;;
  esac
done
[ ${#packages[@]} -gt 0 ] || exit 0
if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then
  echo "missing: ${packages[*]} (apt-get install ${packages[*]})" >&2
  exit 5
fi
echo "installing ${packages[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
# one installation at a time, of scripts that run at once
exec 9<"$0"
flock 9
apt-get update -qq
apt-get install -y -qq --no-install-recommends "${packages[@]}" >&2
