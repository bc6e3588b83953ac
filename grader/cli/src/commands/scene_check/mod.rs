//! `kinemark scene check`: what is wrong with a scene, before anything runs in it; for people, and as JSON for machines.

mod record;
mod subject;
mod typed;
mod words;

use std::process::ExitCode;

use kinemark_sim::scene_check::{Finding, SceneCheckError, Severity, check};
use serde_json::{Value, json};

use crate::args::SceneCheckArgs;
use crate::failure::{Failure, LOST};
use crate::output;
use subject::Subject;

/// Checks the scene, or each scene of the lab.
pub(crate) fn run(args: &SceneCheckArgs) -> Result<ExitCode, Failure> {
    let request = subject::load(args)?;
    let mut checked: Vec<(&Subject, Vec<Finding>)> = Vec::new();
    for subject in &request.subjects {
        let findings = check(&subject.scene, subject.work().as_ref());
        checked.push((subject, findings.map_err(failure)?));
    }
    if args.json {
        let mut records: Vec<Value> = checked
            .iter()
            .map(|(subject, findings)| record::record(subject, findings))
            .collect();
        match (&request.lab, records.pop()) {
            (None, Some(record)) => output::print_json(&record)?,
            (lab, last) => {
                records.extend(last);
                output::print_json(&json!({ "lab": lab, "scenes": records }))?;
            }
        }
    } else {
        let texts = checked
            .iter()
            .map(|(subject, findings)| words::text(subject, findings));
        output::print(&texts.collect::<Vec<String>>().join("\n"))?;
    }
    let mut findings = checked.iter().flat_map(|(_, findings)| findings);
    let bad = findings.any(|finding| finding.severity == Severity::Error);
    Ok(ExitCode::from(if bad { LOST } else { 0 }))
}

fn failure(error: SceneCheckError) -> Failure {
    match error {
        SceneCheckError::Engine(error) => Failure::broken(
            error.to_string(),
            "change the shape or the mass it names: nothing can touch it as it is",
        ),
        SceneCheckError::Inverse(error) => Failure::usage(
            error.to_string(),
            "give positions that the robot can stand at; `kinemark robot show` lists its joints",
        ),
    }
}
