//! The comparisons that need a build of their own, for which `KINEMARK_EXACT=all` asks: `.ci/full` does.
//!
//! What does not run says so past the test harness, which would keep it to itself.

use std::io::Write as _;

fn is_set_to(name: &str, word: &str) -> bool {
    let value = std::env::var(name).unwrap_or_default();
    value.split([',', ' ']).any(|known| known == word)
}

/// Whether `what` should be compared; prints a note if not.
pub(crate) fn is_asked_for(what: &str) -> bool {
    let asked = is_set_to("KINEMARK_EXACT", "all");
    if !asked {
        say(&format!("{what}: not run: set KINEMARK_EXACT=all"));
    }
    asked
}

/// `what` lacks `needed`. In the gate (`CI=true`) that is a failure unless `KINEMARK_SKIP` has the `word`.
#[track_caller]
pub(crate) fn cannot_run(what: &str, word: &str, needed: &[String]) {
    let why = format!("NOT RUN: {what}, there is no {}", needed.join(" and no "));
    let excused = !is_set_to("CI", "true") || is_set_to("KINEMARK_SKIP", word);
    assert!(excused, "{why}; KINEMARK_SKIP={word} leaves it out");
    say(&why);
}

fn say(line: &str) {
    let mut stderr = std::io::stderr();
    let line = format!("\n{line}\n");
    stderr.write_all(line.as_bytes()).expect("standard error");
}
