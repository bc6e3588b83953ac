//! The record of a report: compared with itself, and with the submission graded again.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_grader::record::difference::first_difference;
use kinemark_grader::record::grade::{Digests, Grade, Outcome, TaskGrade, TaskKind};
use kinemark_grader::record::sums::{self, Contradiction};
use kinemark_grader::record::visible_part;
use kinemark_report::output::SOURCES_FOLDER;

use super::files::MISSING;
use super::findings::{Difference, Findings, Subject};

/// Sums, outcomes and verdicts, which follow from the rest of the record.
pub(super) fn with_itself(recorded: &Grade, findings: &mut Findings) {
    add(sums::contradictions(recorded), findings);
}

/// Compares a record with the submission graded again, and gives how many tasks were compared: wholly, and in part. Where `now` is of
/// another mode, because the course staff's part is not at hand, only what is visible is compared.
pub(super) fn compare(recorded: &Grade, now: &Grade, findings: &mut Findings) -> (usize, usize) {
    let before = findings.differences.len();
    findings.compare(Subject::Engine, "engine", &recorded.engine, &now.engine);
    let [was, is] = [&recorded.submission, &now.submission];
    findings.compare(Subject::Submission, "submission", &was.digest, &is.digest);
    compare_sources(recorded, now, findings);
    let is_whole = recorded.mode == now.mode;
    if is_whole {
        let digest = |grade: &Grade| {
            let reference = grade.reference.as_ref();
            reference.map_or_else(|| "none".to_owned(), |part| part.digest.clone())
        };
        let [was, is] = [recorded, now].map(digest);
        findings.compare(Subject::Reference, "reference", &was, &is);
    }
    let mut in_part = 0;
    for was in &recorded.tasks {
        let is = now.tasks.iter().find(|task| task.name == was.name);
        let Some(is) = is else { continue };
        if let Some(difference) = run_difference(was, is, is_whole) {
            findings.differ(difference);
        }
        if !is_whole {
            let left_out = left_out(was, is);
            in_part += usize::from(!left_out.is_empty());
            for what in left_out {
                let why = "they need the course staff's part";
                findings.leave_out(&format!("{what} of task `{}`", was.name), why);
            }
        }
    }
    // points, evidence and words too, where the runs are the same
    if findings.differences.len() == before {
        let found = if is_whole {
            let value = |grade: &Grade| serde_json::to_value(grade).unwrap_or_default();
            first_difference("", &value(recorded), &value(now))
                .into_iter()
                .collect()
        } else {
            visible_part::contradictions(recorded, now)
        };
        add(found, findings);
    }
    if findings.differences.len() == before {
        with_itself(recorded, findings);
    }
    (recorded.tasks.len() - in_part, in_part)
}

/// The sources of a module, each by its name.
fn compare_sources(recorded: &Grade, now: &Grade, findings: &mut Findings) {
    let by_name = |grade: &Grade| -> BTreeMap<String, String> {
        let sources = grade.sources.iter().flatten();
        sources
            .map(|source| (source.name.clone(), source.digest.clone()))
            .collect()
    };
    let [was, is] = [recorded, now].map(by_name);
    let names: BTreeSet<&String> = was.keys().chain(is.keys()).collect();
    for name in names {
        let [was, is] =
            [&was, &is].map(|sources| sources.get(name).map_or(MISSING, String::as_str));
        let place = format!("{SOURCES_FOLDER}/{name}");
        findings.compare(Subject::Submission, &place, was, is);
    }
}

fn add(found: Vec<Contradiction>, findings: &mut Findings) {
    for contradiction in found {
        let what = format!("record at `{}`", contradiction.place);
        let Contradiction {
            recorded, follows, ..
        } = &contradiction;
        findings.differ(Difference::of(Subject::Record, &what, recorded, follows));
    }
}

/// What of a task takes part with the course staff's part alone.
fn left_out(recorded: &TaskGrade, now: &TaskGrade) -> Vec<&'static str> {
    let mut what = Vec::new();
    if !recorded.hidden.is_empty() {
        what.push(match recorded.kind {
            TaskKind::Function => "hidden cases",
            TaskKind::Motion => "hidden runs",
        });
    }
    let of_reference = recorded.checks.iter().chain(&now.checks).any(|check| {
        let measure = check.measure.as_ref();
        check.outcome == Outcome::AtHandIn
            || measure.is_some_and(|measure| measure.reference.is_some())
    });
    if of_reference {
        what.push("checks that compare with the reference solution");
    }
    what
}

/// Where a run or the answers first differ. Without hidden cases and runs, the digest of all of them is left out.
fn run_difference(before: &TaskGrade, after: &TaskGrade, is_whole: bool) -> Option<Difference> {
    let [was, is] = [&before.digests, &after.digests];
    let kind = match before.kind {
        TaskKind::Function => "answers",
        TaskKind::Motion => "trace",
    };
    let of = |what: &str, recorded: &str, now: &str| {
        Difference::of(Subject::Run, what, recorded, now).in_task(&before.name)
    };
    if let Some((second, signal, recorded, now)) = signal_difference(was, is) {
        return Some(Difference {
            second: Some(second),
            signal: Some(signal),
            ..of(kind, &recorded, &now)
        });
    }
    let levels = was.rungs.iter().zip(&is.rungs);
    if let Some((old, new)) = levels.into_iter().find(|(old, new)| old != new) {
        let what = format!("run of level `{}` of check `{}`", old.rung, old.check);
        return Some(of(&what, &old.digest, &new.digest));
    }
    let is_comparable = is_whole || before.hidden.is_empty();
    (is_comparable && was.all != is.all).then(|| of(kind, &was.all, &is.all))
}

/// The first second and its first signal that differ, with both digests.
fn signal_difference(was: &Digests, is: &Digests) -> Option<(usize, &'static str, String, String)> {
    let seconds = was.seconds.iter().zip(&is.seconds).enumerate();
    let mut differences = seconds.filter_map(|(second, (old, new))| {
        // a signal that is not there has no digest
        let some = |digest: &Option<String>| digest.clone().unwrap_or_default();
        let signals = [
            ("q", old.q.clone(), new.q.clone()),
            ("qd", old.qd.clone(), new.qd.clone()),
            ("command", old.command.clone(), new.command.clone()),
            ("effort", old.effort.clone(), new.effort.clone()),
            ("tcp", old.tcp.clone(), new.tcp.clone()),
            ("bodies", some(&old.bodies), some(&new.bodies)),
            ("sensors", some(&old.sensors), some(&new.sensors)),
        ];
        let differing = signals.into_iter().find(|(_, old, new)| old != new);
        differing.map(|(signal, old, new)| (second, signal, old, new))
    });
    differences.next()
}
