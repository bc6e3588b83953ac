//! What a storyboard may show of a run: where points were lost, what was touched, goals, events, and where it left the reference.

use kinemark_sim::model::contact::Party;
use kinemark_sim::text::number::seconds;
use kinemark_sim::watch::event::EventKind;
use nalgebra::Vector3;

use crate::initial_contact::is_initial;
use crate::moment::{first_loss_of, has_lost, lost_points};
use kinemark_grader::record::grade::{CheckGrade, Divergence, TaskGrade};
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::{points, with_unit};

/// Where points were lost first, before everything.
const FIRST_LOSS: f64 = 1e6;
/// What a check lost most by, the costliest first: above all that cost nothing.
const LOSS: f64 = 1e3;
/// The other moments at which it lost, in the same order.
const FURTHER_LOSS: f64 = 1e2;

/// A cause to show a moment, the more telling the higher its rank.
pub(super) struct Cause {
    pub(super) rank: f64,
    pub(super) tick: u64,
    pub(super) words: String,
    /// Where it cost points: the title of the check, with what it earned.
    pub(super) lost: Option<String>,
    /// How many.
    pub(super) cost: f64,
    pub(super) touch_m: Option<Vector3<f64>>,
}

impl Cause {
    /// The caption of a panel at `tick`, which may be a little off.
    pub(super) fn caption_at(&self, tick: usize, step_s: f64) -> String {
        let time = || seconds(self.tick as f64 * step_s);
        let is_here = self.tick as usize == tick;
        match (&self.lost, is_here) {
            (Some(title), true) => format!("lost: {title}: {}", self.words),
            (Some(title), false) => format!("lost at {}: {title}: {}", time(), self.words),
            (None, true) => self.words.clone(),
            (None, false) => format!("at {}: {}", time(), self.words),
        }
    }
}

/// All causes of a run.
pub(super) fn causes(run: &TaskRun, grade: &TaskGrade) -> Vec<Cause> {
    let names = run.names();
    let mut found = losses(grade);
    let mut add = |rank: f64, tick: u64, words: String, touch_m: Option<Vector3<f64>>| {
        found.push(Cause {
            rank,
            tick,
            words,
            lost: None,
            cost: 0.0,
            touch_m,
        });
    };
    // goals reached: the start of the stay that was judged, if it was there
    for (i, goal) in run.goals.iter().enumerate() {
        let Some((from, to)) = goal.stay else {
            continue;
        };
        // it begins at the edge of the band; where it ends is where the arm stood
        let tick = (to as usize).min(run.trace.len().saturating_sub(1));
        let off_m = (run.trace.tcp_position(tick) - Vector3::from(goal.position_m)).norm();
        if off_m <= goal.full_m {
            add(60.0, from, format!("goal {} reached", i + 1), None);
        } else if off_m <= goal.zero_m {
            let off = with_unit(off_m, "m");
            add(60.0, from, format!("at goal {}, {off} off", i + 1), None);
        }
    }
    let mut event_words = Vec::new();
    for event in &run.trace.events {
        let rank = match event.kind {
            EventKind::BodyFell { .. } => 90.0,
            EventKind::Toppled { .. } => 55.0,
            EventKind::LimitHit { .. } => 40.0,
            EventKind::Moved { .. } => 35.0,
            EventKind::LeftSupport { .. } => 30.0,
            EventKind::UnderResolved { .. } => 25.0,
            EventKind::Saturated { .. } | EventKind::SpeedLimitHit { .. } => 20.0,
            EventKind::NearSingular => 15.0,
            EventKind::Touched { .. } | EventKind::Diverged | EventKind::Stopped => continue,
        };
        let words = names.event(&event.kind);
        // a loop that buzzes at its limit says so a thousand times
        if !event_words.contains(&words) {
            add(rank, event.tick, words.clone(), None);
            event_words.push(words);
        }
        if event_words.len() > 40 {
            break;
        }
    }
    if let Some(divergence) = &run.divergence {
        add(45.0, divergence.tick, differs(run, divergence), None);
    }
    // what touched, each pair once; that what stands on something touches it again is no news either
    let mut pairs = Vec::new();
    for contact in &run.trace.contacts {
        if pairs.contains(&contact.parties) || pairs.len() > 40 {
            continue;
        }
        pairs.push(contact.parties);
        if is_initial(contact.parties, contact.first_tick, run) {
            continue;
        }
        let arm = contact.parties.iter().any(|p| matches!(p, Party::Link(_)));
        let [first, second] = contact.parties.map(|party| names.party(party));
        add(
            if arm { 70.0 } else { 25.0 },
            contact.first_tick,
            format!("`{first}` touches `{second}`"),
            Some(contact.p_first_in_world),
        );
    }
    found
}

/// Where points were lost: what each check lost most by, then its other moments, the costliest check first, and before all of them
/// where the first points were lost.
fn losses(grade: &TaskGrade) -> Vec<Cause> {
    let mut found = Vec::new();
    let first = first_loss_of(grade).and_then(|loss| Some((loss.check?.name.as_str(), loss.at?)));
    for check in grade.checks.iter().filter(|check| has_lost(check)) {
        let lost = lost_points(check);
        let mut add = |rank: f64, tick: u64, words: String| {
            let rank = if first.is_some_and(|(name, at)| name == check.name && at.tick == tick) {
                FIRST_LOSS
            } else {
                rank + lost
            };
            found.push(Cause {
                rank,
                tick,
                words,
                lost: Some(titled(check)),
                cost: lost,
                touch_m: None,
            });
        };
        let timed = check.evidence.iter().filter_map(|e| Some((e.tick?, e)));
        for (i, (tick, evidence)) in timed.clone().enumerate() {
            let rank = if i == 0 { LOSS } else { FURTHER_LOSS };
            add(rank, tick, evidence.message.clone());
        }
        let without_evidence = check
            .first_lost
            .filter(|first| timed.clone().all(|(tick, _)| tick != first.tick));
        if let Some(began) = without_evidence {
            let beyond = check.measure.as_ref().map_or_else(
                || "from here on".to_owned(),
                |measure| {
                    format!(
                        "beyond {} from here on",
                        with_unit(measure.full, &measure.unit)
                    )
                },
            );
            add(FURTHER_LOSS, began.tick, beyond);
        }
    }
    found
}

/// The title of a check with what it earned.
fn titled(check: &CheckGrade) -> String {
    let of = points(check.max_points);
    format!("{} ({} of {of})", check.title, points(check.points))
}

/// Where a run leaves the reference solution's, in a student's words.
fn differs(run: &TaskRun, divergence: &Divergence) -> String {
    let far = with_unit(divergence.distance, &divergence.unit);
    let index = divergence.signal.strip_prefix("q[");
    let index = index.and_then(|rest| rest.strip_suffix(']')?.parse().ok());
    let what = match index {
        Some(joint) => format!("joint {}", run.names().joint(joint)),
        None => "the TCP".to_owned(),
    };
    format!("first differs from the reference: {what} is {far} off")
}
