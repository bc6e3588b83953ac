#!/usr/bin/env bash
# Runs once, when Gradescope builds the image: is everything there, and does it run on this system?
set -euo pipefail
source="$(cd "$(dirname "$0")" && pwd)"
chmod +x "$source/kinemark" "$source/run_autograder"
if ! "$source/kinemark" --version; then
  echo "This kinemark does not run here. Choose a newer Ubuntu image in the assignment's settings, or pack one that was" >&2
  echo "built for this system: kinemark lab pack @LAB@ --for gradescope --binary FILE" >&2
  exit 1
fi
"$source/kinemark" autograder @LAB@ --source "$source" --check
