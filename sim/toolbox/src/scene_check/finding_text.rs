//! Findings for people: one line each, in the order of the check, and how many there are.

use kinemark_sim::scene_check::{Finding, Severity};

use super::checked_scene::CheckedScene;
use super::finding_message::message;
use crate::styled_text::{Emphasis, StyledText};

/// Nobody reads more lines than this.
const MOST_LINES: usize = 100;

/// All findings about a scene as text.
pub fn scene_text(checked: &CheckedScene<'_>) -> StyledText {
    let (scene, findings) = (checked.scene, &checked.findings);
    let mut text = StyledText::default();
    if let Some(task) = &scene.task {
        text.plain("task ");
        text.push(Emphasis::Strong, task);
        text.plain(": ");
    }
    text.plain("scene ");
    text.push(Emphasis::Strong, &scene.scene.name);
    if let Some(arm) = &scene.arm {
        text.plain(" with robot ");
        text.push(Emphasis::Strong, arm.robot.name());
    }
    text.plain("\n\n");
    for finding in findings.iter().take(MOST_LINES) {
        let emphasis = match finding.severity {
            Severity::Error => Emphasis::Error,
            Severity::Warning => Emphasis::Warning,
            Severity::Note => Emphasis::Note,
        };
        text.push(emphasis, format!("{:<9}", finding.severity.name()));
        text.plain(message(scene, finding));
        if let Some(line) = scene.line_of(finding) {
            let file = scene.file.source().name();
            text.push(Emphasis::Faint, format!("  ({file}:{line})"));
        }
        text.plain("\n");
    }
    if findings.len() > MOST_LINES {
        let more = findings.len() - MOST_LINES;
        text.plain(format!("and {more} more, which --json lists\n"));
    }
    if !findings.is_empty() {
        text.plain("\n");
    }
    text.plain(format!("{}\n", counts(findings)));
    text
}

fn counts(findings: &[Finding]) -> String {
    let counts: Vec<String> = [Severity::Error, Severity::Warning, Severity::Note]
        .into_iter()
        .map(|severity| {
            let count = findings.iter().filter(|f| f.severity == severity).count();
            (count, severity.name())
        })
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" }))
        .collect();
    if counts.is_empty() {
        "no problems found".to_owned()
    } else {
        counts.join(", ")
    }
}
