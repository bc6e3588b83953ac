#!/usr/bin/env bash
# Draws the gallery anew: the brief of every lab, and the report of its good submission, light and dark.
#
#     cargo build --release && docs/gallery/draw.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
kinemark=${CARGO_TARGET_DIR:-target}/release/kinemark
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

{
  echo "# The course in pictures"
  echo
  echo "The brief of every lab, and the report of a submission with full marks. \`docs/gallery/draw.sh\` draws them anew."
} > docs/gallery/README.md

shown() { # NAME, words: the picture that suits the reader's screen
  printf '\n<picture><source media="(prefers-color-scheme: dark)" srcset="%s-dark.webp"><img src="%s-light.webp" width="800" alt="%s"></picture>\n' "$1" "$1" "$2"
}

for folder in labs/[0-9]*/; do
  lab=$(basename "$folder")
  "$kinemark" new "$lab" "$out/$lab" >/dev/null
  "$kinemark" grade "$lab" "tests/submissions/$lab/good/submission.rhai" --out "$out/$lab/out" >/dev/null
  node docs/gallery/draw.mjs "$out/$lab/brief.html" "$lab-brief"
  node docs/gallery/draw.mjs "$out/$lab/out/report.html" "$lab-report"
  {
    printf '\n## %s\n' "$lab"
    shown "$lab-brief" "The brief of lab $lab"
    shown "$lab-report" "The report of a good submission of lab $lab"
  } >> docs/gallery/README.md
done
