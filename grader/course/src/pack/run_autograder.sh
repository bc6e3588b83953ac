#!/usr/bin/env bash
# Grades one upload. Gradescope runs it in /autograder; KINEMARK_AUTOGRADER names another folder, to try it elsewhere.
set -u
root="${KINEMARK_AUTOGRADER:-/autograder}"
results="$root/results/results.json"
mkdir -p "$root/results"
rm -f "$results"
# Gradescope ends a run after ten minutes and counts it as zero points. This ends it before, without points.
timeout --kill-after=10 540 "$root/source/kinemark" autograder @LAB@@OPTIONS@ --source "$root/source" \
  --submission "$root/submission" --metadata "$root/submission_metadata.json" --results "$results"
if [ ! -s "$results" ]; then
  # No score and no tests: the sum of an empty list of tests would be zero points.
  printf '%s\n' '{"output": "@FAILED@", "output_format": "text"}' > "$results"
fi
