#!/bin/sh
# Runs every fuzz target for SECONDS each (default 180), from its seeds and what earlier runs found.
# Usage: tests/fuzz/run.sh [SECONDS] [TARGET...]
set -eu
cd "$(dirname "$0")"
seconds=${1:-180}
[ $# -eq 0 ] || shift
./seeds.sh corpus
[ $# -gt 0 ] || set -- corpus/*/
for target in "$@"; do
    target=$(basename "$target")
    cargo +nightly fuzz run --fuzz-dir . "$target" -- \
        $([ ! -f "dictionaries/$target.dict" ] || echo "-dict=dictionaries/$target.dict") -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=32768
done
