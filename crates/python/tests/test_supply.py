"""What is compiled: build scripts that are known (checks/build-scripts.csv)."""

import csv
import json
import shutil
import subprocess

import pytest
from conftest import ROOT


@pytest.mark.skipif(not shutil.which("cargo"), reason="needs cargo")
def test_build_scripts_are_known():
    host = next(line for line in output("rustc", "-vV").splitlines() if line.startswith("host: ")).split()[1]
    manifest = ROOT / "crates/python/Cargo.toml"
    words = ["metadata", "--locked", "--format-version", "1", "--filter-platform", host, "--manifest-path", manifest]
    metadata = json.loads(output("cargo", *words))
    built = {node["id"] for node in metadata["resolve"]["nodes"]}
    packages = [package for package in metadata["packages"] if package["id"] in built]
    found = {one["name"] for one in packages for target in one["targets"] if "custom-build" in target["kind"]}
    with open(ROOT / "checks/build-scripts.csv", encoding="utf-8", newline="") as lines:
        known = {row["crate"] for row in csv.DictReader(lines) if row["what its build script does"]}
    assert found and found <= known, found - known


def output(*words):
    return subprocess.run(list(map(str, words)), check=True, capture_output=True, text=True, cwd=ROOT).stdout
