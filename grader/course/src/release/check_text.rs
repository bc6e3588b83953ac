//! What a check says in lines of text: its facts, the next step, the hints, and points by hand with their reasons.

use kinemark_grader::record::grade::Outcome;

use super::decided::CheckPoints;
use super::feedback::{change, plain};

/// The lines of a check; none where it is full.
pub(super) fn check_text(of: &CheckPoints<'_>) -> String {
    let check = of.check;
    let mut lines = Vec::new();
    if check.outcome == Outcome::NotJudged {
        lines.push(match &of.task.stopped {
            Some(stopped) if stopped.kept.is_none() => format!(
                "Not judged, because the submission was stopped: {}",
                plain(&stopped.message, 600)
            ),
            _ => "Not judged, because a check that it needs earned nothing.".to_owned(),
        });
    }
    lines.extend(check.evidence.iter().map(|fact| plain(&fact.message, 600)));
    if let Some(next) = &check.next_step {
        lines.push(format!("Next: {}", plain(next, 600)));
    }
    lines.extend(
        of.hints
            .iter()
            .map(|hint| format!("Hint: {}", plain(hint, 600))),
    );
    for by_hand in &of.by_hand {
        lines.push(format!(
            "By hand: {}: {}",
            change(by_hand.change),
            plain(&by_hand.why, 600)
        ));
    }
    lines.join("\n")
}
