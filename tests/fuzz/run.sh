#!/bin/sh
# Runs every fuzz target for SECONDS each (default 180), from the robots and labs of this tree as seeds.
# Usage: tests/fuzz/run.sh [SECONDS] [TARGET...]
set -eu
cd "$(dirname "$0")"
seconds=${1:-180}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- urdf robot_toml config_string mesh scene script module
mkdir -p corpus/urdf corpus/robot_toml corpus/config_string corpus/mesh corpus/scene corpus/script corpus/module
cp ../golden/models/*.urdf seeds/urdf/* corpus/urdf/
cp ../../labs/robots/*.toml corpus/robot_toml/
cp seeds/config_string/* corpus/config_string/
cp seeds/mesh/* corpus/mesh/
for lab in ../../labs/[0-9]*/; do
    name=$(basename "$lab")
    cp "../../reference/$name/solution.rhai" "corpus/script/$name"
done
for attack in ../attacks/*/submission.rhai; do
    cp "$attack" "corpus/script/$(basename "$(dirname "$attack")")"
done
cp seeds/module/* corpus/module/
cp ../../labs/scenes/*.toml corpus/scene/
for target in "$@"; do
    cargo +nightly fuzz run --fuzz-dir . "$target" -- \
        $([ ! -f "dictionaries/$target.dict" ] || echo "-dict=dictionaries/$target.dict") -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 -max_len=20000
done
