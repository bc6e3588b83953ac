#!/bin/sh
# Runs every fuzz target for SECONDS each (default 180), from the robots and labs of this tree as seeds.
# Usage: tests/fuzz/run.sh [SECONDS] [TARGET...]
set -eu
cd "$(dirname "$0")"
seconds=${1:-180}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- urdf robot_toml config_string mesh
mkdir -p corpus/urdf corpus/robot_toml corpus/config_string corpus/mesh
cp ../golden/models/*.urdf seeds/urdf/* corpus/urdf/
cp ../../labs/robots/*.toml corpus/robot_toml/
cp seeds/config_string/* corpus/config_string/
cp seeds/mesh/* corpus/mesh/
for target in "$@"; do
    cargo +nightly fuzz run --fuzz-dir . "$target" -- \
        -dict="dictionaries/$target.dict" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 -max_len=20000
done
