//! The hidden cases and runs in which a submission of the course staff lost points, with their numbers.

use kinemark_sim::text::Source;
use serde::Serialize;

use super::reference::place_of;
use crate::judge::explain;
use crate::lab::{Lab, Staff};
use crate::record::explanation::{DrawCheck, ExplainedDraw, HiddenDraw};
use crate::record::grade::Measure;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;

/// The losses that a row shows in words.
const MOST_LINES: usize = 6;

/// A hidden case or run in which a check lost points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LostDraw {
    /// The case or run.
    #[serde(flatten)]
    pub draw: HiddenDraw,
    /// The check; `null` if the submission was stopped.
    pub check: Option<String>,
    /// The share of its points; `null` where it was not judged.
    pub score: Option<f64>,
    /// What was measured in a run, with its band.
    pub measure: Option<Measure>,
    /// What happened, in words.
    pub message: String,
}

/// What `submission` lost in the hidden cases and runs of the task called `task`.
pub(super) fn hidden_losses(
    lab: &Lab,
    staff: &Staff,
    task: &str,
    submission: &Source,
) -> Vec<LostDraw> {
    let mut part = lab.clone();
    part.tasks.retain(|known| known.name == task);
    // nobody can interrupt this host
    let Ok(explanation) = explain(&part, staff, &Submission::from(submission), &mut InProcess)
    else {
        return Vec::new();
    };
    let draws = explanation.draws();
    draws.flat_map(|draw| lost_in(draw, submission)).collect()
}

fn lost_in(explained: &ExplainedDraw, submission: &Source) -> Vec<LostDraw> {
    let draw = &explained.draw;
    if let Some(stopped) = &explained.stopped {
        let place = place_of(stopped, submission);
        return vec![LostDraw {
            draw: draw.clone(),
            check: None,
            score: None,
            measure: None,
            message: format!("{}{place}", stopped.message),
        }];
    }
    let lost = explained.checks.iter().filter(|check| check.is_lost());
    lost.map(|check| LostDraw {
        draw: draw.clone(),
        check: Some(check.name.clone()),
        score: check.score,
        measure: check.measure.clone().filter(|_| check.counted.is_some()),
        message: loss_in_words(check),
    })
    .collect()
}

fn loss_in_words(check: &DrawCheck) -> String {
    let [full, zero] = &check.bounds;
    let (title, words) = (&check.title, check.words());
    format!("\"{title}\": {words} (all points {full}, none {zero})")
}

/// A line below a row for each loss, the first ones only; with the sentence before it.
pub(super) fn lines_of(lost: &[LostDraw]) -> String {
    let lines = lost.iter().take(MOST_LINES).map(|lost| {
        let (name, words, message) = (lost.draw.name(), &lost.draw.words, &lost.message);
        format!("\n      in {name}, {words}: {message}")
    });
    let mut lines: String = lines.collect();
    if lost.len() > MOST_LINES {
        let more = lost.len() - MOST_LINES;
        lines += &format!("\n      and {more} more, which `--json` lists");
    }
    lines
}
