#!/bin/sh
# Copies the seeds of every fuzz target to FOLDER/TARGET: its files in seeds/, and what this tree has of its kind.
# Usage: tests/fuzz/seeds.sh FOLDER
set -eu
mkdir -p "$1"
out=$(cd "$1" && pwd)
cd "$(dirname "$0")"
for target in fuzz_targets/*.rs; do
    mkdir -p "$out/$(basename "$target" .rs)"
done
for folder in seeds/*/; do
    cp "$folder"* "$out/$(basename "$folder")/"
done
cp ../golden/models/*.urdf "$out/urdf/"
cp ../../labs/robots/*.toml "$out/robot_toml/"
cp ../../labs/scenes/*.toml "$out/scene/"
for lab in ../../labs/[0-9]*/; do
    name=$(basename "$lab")
    cp "$lab/lab.toml" "$out/lab/$name"
    cp "../../reference/$name/solution.rhai" "$out/script/$name"
done
for attack in ../attacks/*/submission.rhai; do
    cp "$attack" "$out/script/$(basename "$(dirname "$attack")")"
done
