#!/usr/bin/env bash
# Prints the Python of an environment below target/ that holds exactly the packages of a requirements file, each by its
# hash: checks/python.sh NAME REQUIREMENTS. Made if it is not there, unless --installed is given first.
# Built packages only, so that no code runs while they are installed. Where a file like REQUIREMENTS-build.txt stands
# beside REQUIREMENTS, source archives that REQUIREMENTS names by --no-binary are built with what it lists.
# Exit code 5: it is not there, or Python cannot make it; nothing is installed outside of target/.
set -euo pipefail
cd "$(dirname "$0")/.."
only=no
[ "${1:-}" != --installed ] || { only=yes; shift; }
name=${1:?NAME} requirements=${2:?REQUIREMENTS}
folder=${CARGO_TARGET_DIR:-target}/python/$name
unset PYTHONPATH PYTHONHOME
export PYTHONNOUSERSITE=1
python=python3
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || {
  echo "Python 3.11 or later is missing (Debian: apt-get install python3 python3-venv)" >&2
  exit 5
}
build=${requirements%.txt}-build.txt
[ -f "$build" ] || build=
contents="$("$python" --version) $(cat "$requirements" ${build:+"$build"} | sha256sum)"
# written last: an environment without it was broken off
if [ "$(cat "$folder/contents.txt" 2>/dev/null || true)" != "$contents" ]; then
  if [ $only = yes ]; then
    echo "$requirements is not installed below target/ (cargo xtask ci does that)" >&2
    exit 5
  fi
  mkdir -p "$(dirname "$folder")"
  exec 9>"$folder.lock"
  flock 9 2>/dev/null || true
  if [ "$(cat "$folder/contents.txt" 2>/dev/null || true)" != "$contents" ]; then
    echo "installing $requirements below $folder" >&2
    rm -rf "$folder"
    "$python" -m venv "$folder" >&2 || {
      echo "$python cannot make environments (Debian: apt-get install python3-venv)" >&2
      exit 5
    }
    for file in ${build:+"$build"} "$requirements"; do
      "$folder/bin/python" -m pip install --quiet --no-input --disable-pip-version-check --require-hashes \
        --no-build-isolation --only-binary :all: --requirement "$file" >&2
    done
    printf '%s' "$contents" >"$folder/contents.txt"
  fi
fi
echo "$folder/bin/python"
