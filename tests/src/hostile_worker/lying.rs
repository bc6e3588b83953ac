//! Workers that lie, babble, stop and die, of the cases of kind `frames`: each costs its own submission the verdict, and the next one
//! that the same host grades keeps its own.

use std::time::Duration;

use kinemark_grader::judge;
use kinemark_grader::submission::host::InProcess;
use kinemark_report::text::text;
use kinemark_sim::text::Source;

use crate::case::{Case, Kind, all_cases};
use crate::every_case::every_case;
use crate::testbed::{lab, root};
use crate::worker::{LIE, host};

/// What a worker may take that says nothing more.
const SHORT: Duration = Duration::from_secs(1);
/// Far above what others take.
const LONGEST: Duration = Duration::from_secs(60);

pub(crate) fn every_lie_costs_one_submission() {
    let mut cases = all_cases();
    cases.retain(|(_, case)| case.kind == Kind::Frames);
    assert!(cases.len() >= 30, "{} cases", cases.len());
    every_case(&cases, costs_one_submission);
}

fn costs_one_submission(case: &Case) {
    let lie = case.lie.as_ref().expect("what the worker sends");
    let is_silent = lie.silent || lie.signal.as_deref() == Some("STOP");
    let expect = case.expect.as_ref().expect("`expect`");
    let lab = lab(&case.lab);
    let mut host = host(if is_silent { SHORT } else { LONGEST });
    // the worker finds the lie where a submission is
    let lying = std::fs::read_to_string(case.folder.join(LIE)).expect("the case");
    let lying = Source::new(LIE, lying).into();
    let graded = judge::grade(&lab, None, &lying, &mut host).expect("not interrupted");
    let shown = text(&graded.grade);
    assert_eq!(
        Some(graded.grade.verdict.name()),
        expect.verdict.as_deref(),
        "{shown}"
    );
    for words in &expect.says {
        assert!(shown.contains(words.as_str()), "no `{words}` in {shown}");
    }
    for words in &expect.never {
        assert!(!shown.contains(words.as_str()), "`{words}` in {shown}");
    }
    let good = format!("tests/submissions/{}/good/submission.rhai", case.lab);
    let good = std::fs::read_to_string(root().join(good)).expect("a submission");
    let good = Source::new("submission.rhai", good).into();
    host.longest = LONGEST;
    let beside = judge::grade(&lab, None, &good, &mut host).expect("not interrupted");
    let alone = judge::grade(&lab, None, &good, &mut InProcess).expect("not interrupted");
    assert_eq!(text(&beside.grade), text(&alone.grade), "after the lie");
}
