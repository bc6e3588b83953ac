# The steps of the gates, one function each, and how they are run. Sourced by .ci/run and .ci/full; docs/gate.md describes every step.

cd "$(dirname "${BASH_SOURCE[0]}")/.."
target=${CARGO_TARGET_DIR:-target}

# A golden file is compared here, and never written.
unset KINEMARK_BLESS
export INSTA_UPDATE=no
# What these set is another grade; a caller's must not decide.
unset KINEMARK_SALT KINEMARK_LABS KINEMARK_REFERENCE
# Everything is built once: what would make a second build faster takes time and twice the room on the disk.
[ "${CI:-}" != true ] || export CARGO_INCREMENTAL=0

sudo=""
[ "$(id -u)" = 0 ] || sudo="sudo -n"
updated=""
install() { # PACKAGE...: of Debian
  [ -n "$updated" ] || { $sudo apt-get update -qq && updated=yes; }
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# --- what a machine may lack -------------------------------------------------------------------------------------------------
# Names for KINEMARK_SKIP: node, browser, wasm, python; .ci/full adds windows, macos, musl, archives, qemu, wine, firefox, rerun, slurm, robots, taplo, book, fuzz.

not_run=()
skip() { # WHAT, WHY: said at once and in the last line
  not_run+=("$1 ($2)")
  echo "NOT RUN: $1 ($2)"
}
named() { # NAME: whether KINEMARK_SKIP names it
  case " ${KINEMARK_SKIP:-} " in *" $1 "*) return 0 ;; *) return 1 ;; esac
}
lacks() { # NAME, WHAT, WHY: something cannot be had here, which is a failure where CI=true
  if [ "${CI:-}" = true ]; then
    echo "$2 cannot be run: $3. Name \`$1\` in KINEMARK_SKIP to leave it out."
    exit 1
  fi
  skip "$2" "$3"
}
# Where a tool was found missing, what needs it is skipped once: has[NAME] is `yes` or `no` after `need NAME`.
declare -A has=()
need() { # NAME: fetches a tool where it is missing; false where it cannot be had or must not be used
  if [ -z "${has[$1]:-}" ]; then
    has[$1]=no
    if named "$1"; then
      skip "${what[$1]}" "KINEMARK_SKIP names \`$1\`"
    elif fetch_"$1"; then
      has[$1]=yes
    else
      lacks "$1" "${what[$1]}" "${why[$1]}"
    fi
  fi
  [ "${has[$1]}" = yes ]
}
declare -A what=(
  [node]="the viewer's bundle, reports in a browser, logs in JavaScript"
  [browser]="reports in a browser"
  [wasm]="the comparison with WebAssembly"
  [clang]="the reference solutions in C"
  [python]="logs in Python, unused dependencies"
)
declare -A why=(
  [node]="Node 20 or later with npm and its packages cannot be had here"
  [browser]="Chromium cannot be had here (CHROMIUM names another one)"
  [wasm]="the Rust target or Node cannot be had here"
  [clang]="clang and lld cannot be had here"
  [python]="Python 3.11 with the packages of tests/readers/requirements.txt cannot be had here"
)

node_is_new() { [ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null || echo 0)" -ge 20 ]; }
fetch_node() {
  command -v node >/dev/null || install nodejs || return 1
  node_is_new || { why[node]="Node 20 or later is needed, and $(node --version) is here"; return 1; }
  command -v npm >/dev/null || install npm || return 1
  export npm_config_fetch_retries=1
  if ! (cd grader/web && npm ci --no-audit --no-fund --loglevel=error); then
    # with a registry that answers it is the lock file that is wrong
    if npm ping >/dev/null 2>&1; then
      echo "npm is there, and grader/web/package-lock.json cannot be installed"
      exit 1
    fi
    why[node]="npm reaches no packages here"
    return 1
  fi
}
fetch_browser() {
  need node || { why[browser]="it needs Node"; return 1; }
  export CHROMIUM=${CHROMIUM:-/usr/bin/chromium}
  [ -x "$CHROMIUM" ] || { install chromium && [ -x "$CHROMIUM" ]; }
}
target_is_there() { [ -d "$(rustc --print target-libdir --target "$1")" ]; }
fetch_wasm() {
  command -v node >/dev/null || install nodejs || return 1
  target_is_there wasm32-unknown-unknown || rustup target add wasm32-unknown-unknown
}
fetch_clang() {
  command -v clang >/dev/null && command -v wasm-ld >/dev/null || install clang lld
}
# C for other systems
what[zig]="what needs zig"
why[zig]="ziglang and cargo-zigbuild of PyPI, which cannot be had here"
fetch_zig() {
  [ -x "$target/ci-zig/bin/cargo-zigbuild" ] && return
  python3 -m venv "$target/ci-zig" >/dev/null 2>&1 || { install python3-venv && python3 -m venv "$target/ci-zig"; } || return 1
  "$target/ci-zig/bin/pip" install --quiet --disable-pip-version-check ziglang==0.17.1 cargo-zigbuild==0.24.0
}
python=$target/ci-python/bin/python
fetch_python() {
  "$python" -c 'import foxglove_schemas_protobuf, jsonschema, mcap, zstandard' 2>/dev/null && return
  rm -rf "$target/ci-python"
  python3 -m venv "$target/ci-python" >/dev/null 2>&1 || { install python3-venv && python3 -m venv "$target/ci-python"; } || return 1
  "$target/ci-python/bin/pip" install --quiet --disable-pip-version-check --requirement tests/readers/requirements.txt
}

# --- steps that look at text and types: seconds to two minutes ---------------------------------------------------------------

step_format() {
  cargo fmt --all -- --check
  # declared by a macro, which cargo fmt does not look into
  rustfmt --edition 2024 --check grader/src/check/kind/*.rs sim/src/sensor/kind/*.rs sim/src/format/*/mod.rs
  cargo fmt --manifest-path tests/fuzz/Cargo.toml -- --check
  cargo fmt --manifest-path grader/python/Cargo.toml --all -- --check
}

step_paths() { # a path of somebody's machine in the tree
  if git grep -nE '/(home|root|work)/[a-z]' -- . ':!*.lock' ':!.ci/steps.bash'; then
    echo "a path of some machine is in the tree"
    return 1
  fi
}

step_dialect() { .ci/dialect; }

# As `cargo lint`, and each target's unused dependencies beside it: one pass for both.
step_lint() {
  command -v cc >/dev/null || install build-essential
  [ "$(sed -n 's/^lint = "\(.*\)"$/\1/p' .cargo/config.toml)" = "clippy --workspace --all-targets --locked -- -D warnings" ] ||
    { echo "cargo lint is no longer what this step runs"; return 1; }
  local found=$target/ci-lint.json failed=""
  mkdir -p "$target"
  cargo clippy --workspace --all-targets --locked --message-format=json-diagnostic-rendered-ansi -- \
    -D warnings --force-warn unused_crate_dependencies >"$found" || failed=yes
  if need python; then
    .ci/unused "$found" || failed=yes
  fi
  [ -z "$failed" ] || { cargo lint || true; return 1; }
}

# The fuzz targets are a workspace of their own, with the versions of this one: what is fuzzed is what is shipped.
locked() { awk '/^name = /{name = $3} /^version = /{print name, $3}' "$1" | sort -u; }
step_fuzz_check() {
  local other
  other=$(comm -23 <(locked tests/fuzz/Cargo.lock) <(locked Cargo.lock) | grep -vE '^"(kinemark-fuzz|libfuzzer-sys|arbitrary)" ' || true)
  if [ -n "$other" ]; then
    echo "tests/fuzz/Cargo.lock has versions that Cargo.lock has not; tests/fuzz/README.md says how to renew it:"
    echo "$other"
    return 1
  fi
  # they need everything built again
  [ -z "$with_fuzz_targets" ] || cargo check --manifest-path tests/fuzz/Cargo.toml --locked --all-targets --target-dir "$target/fuzz"
}
with_fuzz_targets=""

# What a browser calls: pages and plots without logs and pixels, and the toolbox.
step_wasm() {
  need wasm || return 0
  cargo check --locked --package kinemark-report --package kinemark-toolbox --lib --no-default-features \
    --target wasm32-unknown-unknown --target-dir "$target/other"
}

step_doc() { RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked --quiet; }

step_licences() {
  if cargo deny --version >/dev/null 2>&1; then
    cargo deny --offline check bans licenses sources
  else
    skip "licences, sources, duplicates" "cargo-deny is not installed here"
  fi
}

# --- steps that build and run --------------------------------------------------------------------------------------------------

step_test() { # the README's command
  local command
  command=$(sed -n '/^```/,/^```/p' README.md | grep -m1 '^cargo test')
  [ "$command" = "cargo test --workspace" ] || { echo "README's test command is: $command"; return 1; }
  $command --locked
}

# Hostile workers, and in the full gate the corpus, again as a user without privileges, where the gate runs as root: what seals a worker
# must not need any.
as_nobody=hostile_worker
step_attacks() {
  [ "$(id -u)" = 0 ] || { echo "the tests ran as an ordinary user"; return; }
  local built folder binary test
  built=$(cargo test --workspace --locked --test attacks --test hostile-worker --no-run 2>&1 |
    sed -nE 's/.*\((.*(attacks|hostile_worker)-[0-9a-f]+)\).*/\1/p')
  folder=$(mktemp -d)
  # where a user without privileges can read it
  for binary in $built; do
    cp "$binary" "$folder/$(basename "${binary%-*}")"
  done
  cp "$target/debug/kinemark" "$folder/kinemark"
  mkdir "$folder/tests" && cp -r tests/attacks tests/submissions "$folder/tests"
  cp -r labs reference "$folder"
  chmod -R a+rX "$folder"
  for test in $as_nobody; do
    (cd "$folder" && setpriv --reuid=65534 --regid=65534 --clear-groups \
      env HOME=/nonexistent KINEMARK_CHECKOUT="$folder" KINEMARK_BINARY="$folder/kinemark" "./$test")
  done
  rm -rf "$folder"
}

# Builds the program that the next steps try, and names it: that of the tests in .ci/run, and the one that is shipped in .ci/full.
tried=release
program() {
  if [ "$tried" = debug ]; then
    # of the whole workspace, so that dependencies have the features they were built with
    cargo build --workspace --bins --tests --locked --quiet
  else
    cargo build --release --quiet --locked
  fi
  KINEMARK=$(realpath "$target/$tried/kinemark")
  export KINEMARK
}

# The README's first command with the program of the tests; the step `release` runs it as it is written.
step_readme() {
  program
  local command
  command=$(sed -n '/^```/,/^```/p' README.md | grep -m1 '^cargo run --release -- ')
  rm -rf "$target/ci/readme"
  "$KINEMARK" ${command#cargo run --release -- } --out "$target/ci/readme"
}

# The reference solutions in C and Rust: the points and the very digests of the scripts.
step_modules() {
  need clang || return 0
  need wasm || return 0
  local lab name module out=$target/ci/modules built=$target/ci/modules/rust
  mkdir -p "$out"
  program
  cargo build --quiet --release --locked --lib --examples --target wasm32-unknown-unknown \
    --manifest-path reference/rust/Cargo.toml --target-dir "$built"
  for lab in labs/[0-9]*/; do
    name=$(basename "$lab")
    "$KINEMARK" grade "$name" "reference/$name/solution.rhai" --out "$out/script" --json 2>/dev/null | digests >"$out/script.txt"
    grep -q digest "$out/script.txt"
    clang --target=wasm32 -O2 -Wall -Werror -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -Igrader/plugin/c \
      -o "$out/c.wasm" "reference/$name/solution.c"
    for module in "$out/c.wasm" "$built/wasm32-unknown-unknown/release/$(rust_module "$name")"; do
      "$KINEMARK" grade "$name" "$module" --out "$out/module" --json 2>/dev/null | digests | diff "$out/script.txt" -
    done
    echo "$name: the same points and digests in C, Rust and as a script"
  done
}
digests() { sed -n 's/^ *"\(points\|all\|seconds\|q\|qd\)": \(.*\)$/digest \1 \2/p'; }
rust_module() { sed -n 's/^name = "\(.*\)"$/\1/p' "reference/$1/rust/Cargo.toml" | head -1 | tr - _ | sed 's/$/.wasm/'; }

# The same bytes from a build without optimisation and from WebAssembly, since both build everything again, and every submission explained:
# what `cargo test` leaves out.
step_exact() {
  local skipped=${KINEMARK_SKIP:-}
  need wasm || skipped="$skipped wasm"
  # of the whole workspace, so that dependencies have the features they were built with
  KINEMARK_EXACT=all KINEMARK_SKIP=$skipped cargo test --workspace --locked --test system -- determinism compiled_solutions wasm explained
}

# The same for Python: without optimisation the interpreter alone takes a hundred times as long.
step_exact_python() {
  KINEMARK_EXACT=all cargo test --workspace --locked --test system -- python
}

release() { cargo run --release --quiet --locked -- "$@"; }

step_release() { # the README's first command, and every lab: the optimised build writes what the tested one writes
  local command lab good out=$target/ci
  command=$(sed -n '/^```/,/^```/p' README.md | grep -m1 '^cargo run --release')
  rm -rf "$out/readme" "$out/release" "$out/dev"
  cargo build --workspace --bins --tests --locked --quiet
  $command --out "$out/readme"
  for lab in labs/[0-9]*/; do
    lab=$(basename "$lab")
    good=tests/submissions/$lab/good/submission.rhai
    release grade "$lab" "$good" --out "$out/release/$lab" --json >/dev/null
    "$target/debug/kinemark" grade "$lab" "$good" --out "$out/dev/$lab" --json >/dev/null
    release verify "$out/release/$lab"
  done
  # as an interpreter in an interpreter: one lab with functions and a motion, one with a scene
  for lab in 01-kinematics 04-knock-with-velocity; do
    good=reference/$lab/solution.py
    release grade "$lab" "$good" --out "$out/release/python-$lab" --json >/dev/null
    "$target/debug/kinemark" grade "$lab" "$good" --out "$out/dev/python-$lab" --json >/dev/null
  done
  diff -r "$out/release" "$out/dev"
}

step_viewer() { # types, and the committed bundle is what its source gives
  need node || return 0
  local kept=$target/ci/dist
  rm -rf "$kept" && mkdir -p "$target/ci" && cp -rp grader/web/dist "$kept"
  (cd grader/web && npm run --silent check && npm run --silent build)
  diff -r "$kept" grader/web/dist
  # the same bytes with their old times: Rust would be built again for new ones
  cp -rp "$kept/." grader/web/dist/
}

# A report of a good submission of each lab, in ci/good.
good_reports() {
  local lab
  program
  rm -rf "$target/ci/good"
  for lab in labs/[0-9]*/; do
    lab=$(basename "$lab")
    "$KINEMARK" grade "$lab" "tests/submissions/$lab/good/submission.rhai" --out "$target/ci/good/$lab" --json >/dev/null
  done
}

# Reports and logs of all labs, and of labs that are hard on them: made once for the next three steps.
reports() {
  program
  KINEMARK_REPORTS=$(realpath "$target")/ci/reports
  export KINEMARK_REPORTS
  [ -z "${reports_made:-}" ] || return 0
  rm -rf "$KINEMARK_REPORTS"
  node grader/web/test/graded.mjs "$KINEMARK_REPORTS"
  reports_made=yes
}

# The viewer on pages made for it, and the kinematics of briefs against the engine's: what needs no minutes. .ci/full has the briefs, the pages of a class,
# the reports of all labs, and that the tests can fail, beside these.
step_browser_sample() {
  need browser || return 0
  # the program of this tree, not one that was left there
  program
  (cd grader/web && node --test --test-concurrency=2 test/reading.test.mjs test/viewer.test.mjs test/docking.test.mjs test/plots.test.mjs test/pace.test.mjs test/views.test.mjs test/left.test.mjs test/arrows.test.mjs test/kinematics.test.mjs)
}

step_browser() {
  need browser || return 0
  reports
  (cd grader/web && node --test --test-concurrency=2 $(ls test/*.test.mjs | grep -v '/logs\.'))
}

step_logs() { # read by two other implementations
  if need node; then
    reports
    (cd grader/web && node --test test/logs.test.mjs)
  fi
  if need python; then
    # without Node there are the labs' own reports only
    [ -n "${KINEMARK_REPORTS:-}" ] || good_reports
    find "${KINEMARK_REPORTS:-$target/ci/good}" -name run.mcap -print0 | sort -z | xargs -0 "$python" tests/readers/read_log.py
    "$python" tests/readers/run_notebook.py docs/examples/robot-and-report.ipynb
    rm -rf docs/examples/out
  fi
}

check_labs() { # VARIANTS: starter, reference solution in so many variants, mutants of every lab
  local lab name out=$target/ci/checked
  rm -rf "$out" && mkdir -p "$out"
  program
  for lab in labs/[0-9]*/; do
    name=$(basename "$lab")
    "$KINEMARK" lab check "$name" --variants "$1" --json >"$out/$name.json" ||
      { "$KINEMARK" lab check "$name" --variants "$1"; return 1; }
    echo "$name: nothing is wrong"
  done
}

mutate_labs() { # OPTIONS...: small changes of the reference solution of every lab, each graded
  local lab name out=$target/ci/mutations
  mkdir -p "$out"
  program
  for lab in labs/[0-9]*/; do
    name=$(basename "$lab")
    "$KINEMARK" lab check "$name" --mutate "$@" >"$out/$name.txt" || { cat "$out/$name.txt"; return 1; }
    echo "$name: $(tail -1 "$out/$name.txt")"
  done
}
step_mutations() { mutate_labs --draw 15; }

# --- how steps are run -----------------------------------------------------------------------------------------------------------

times=()
run_steps() { # NAME...: `a-b` is step_a_b
  local name began
  for name in "$@"; do
    declare -F "step_${name//-/_}" >/dev/null || { echo "there is no step \`$name\`; there are: ${all[*]} ${before_a_release[*]:-}"; exit 2; }
  done
  for name in "$@"; do
    printf '\n== %s\n' "$name"
    began=$SECONDS
    "step_${name//-/_}"
    times+=("$(printf '%5d s  %s' $((SECONDS - began)) "$name")")
  done
}

finish() { # GATE: the times, and in the last line what was not run
  printf '\n'
  printf '%s\n' "${times[@]}"
  printf '%5d s  in all\n' "$SECONDS"
  local line="$1: all steps passed"
  [ ${#not_run[@]} -eq 0 ] || line="$line. NOT RUN: $(printf '%s; ' "${not_run[@]}" | sed 's/; $//')"
  echo "$line"
}
