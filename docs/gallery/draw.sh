#!/usr/bin/env bash
# Makes the pictures of the gallery: the brief of every lab and the report of its good submission, light and dark, on a phone and a computer.
#
#     cargo build --release && (cd grader/web && npm ci) && docs/gallery/draw.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
kinemark=${KINEMARK:-${CARGO_TARGET_DIR:-target}/release/kinemark}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

rm -f docs/gallery/*.webp
{
  echo "# The course in pictures"
  echo
  echo "The brief of every lab and the report of a submission with full marks, on a computer and on a phone. Each picture shows one"
  echo "moment of a replay; in the report itself the replay moves. \`docs/gallery/draw.sh\` makes the pictures again."
} > docs/gallery/README.md

shown() { # NAME, width here, words: the picture that suits the reader's screen
  printf '\n<picture><source media="(prefers-color-scheme: dark)" srcset="%s-dark.webp"><img src="%s-light.webp" width="%s" alt="%s"></picture>\n' "$1" "$1" "$2" "$3"
}

for folder in labs/[0-9]*/; do
  lab=$(basename "$folder")
  "$kinemark" new "$lab" "$out/$lab" >/dev/null
  "$kinemark" grade "$lab" "tests/submissions/$lab/good/submission.rhai" --out "$out/$lab/out" >/dev/null
  node docs/gallery/draw.mjs "$out/$lab/brief.html" "$lab-brief" 1000
  cut=$(node docs/gallery/draw.mjs "$out/$lab/out/report.html" "$lab-report" 390 1440)
  phone="The same report on a phone"
  if [[ $cut == *"-390 shows the beginning"* ]]; then phone="The beginning of the same report on a phone"; fi
  {
    printf '\n## %s\n' "$lab"
    shown "$lab-brief-1000" 800 "The brief of lab $lab"
    shown "$lab-report-1440" 800 "The report of a good submission of lab $lab"
    shown "$lab-report-390" 300 "$phone"
  } >> docs/gallery/README.md
done

# the picture of the README: a lost point, and its moment in the replay beside it; points are lost, so the command ends with 1
lost=tests/submissions/04-knock-with-velocity/cuts-the-corner/submission.rhai
"$kinemark" grade 04-knock-with-velocity "$lost" --out "$out/lost" >/dev/null || [ $? = 1 ]
node docs/gallery/draw.mjs "$out/lost/report.html" lost-point '#task-2-check-down' 1440
