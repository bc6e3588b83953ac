//! robustness: an earlier check of the task, of the same motion under disturbances (a robustness sweep).
//!
//! The motion runs once more at every level, and the earlier check judges it; measured is the mean of its scores, each weighted by
//! the level's `share`. The disturbances are the same for every submission. It is not judged if the earlier check earned nothing.

use crate::check::disturbance::{Level, LevelTable};
use crate::check::prelude::*;

/// Levels of one sweep: each is a run of its own.
const MOST_LEVELS: usize = 10;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The earlier check of the same task that judges every run.
    check: At<String>,
    /// The disturbance levels, 1 to 10.
    #[serde(default)]
    rungs: Vec<At<LevelTable>>,
}

problems! {
    /// What is wrong with a sweep.
    enum SweepProblem {
        UnknownCheck { check: String, known: Vec<String> }:
            "lab::unknown_check", "no earlier check of this task that can be repeated is called `{check}`",
            "must stand before this check", near(check, "earlier checks", known);
        Levels { count: usize }:
            "lab::robustness", "a robustness sweep has 1 to {MOST_LEVELS} `rungs`, got {count}", "this check",
            "such as `rungs = [{ name = \"late\", delay_ms = 10 }]`";
    }
}

/// The runs that a robustness check asks for, and who judges them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Index, among the task's checks, of the one that judges every level; earlier than the robustness check.
    pub check: usize,
    /// Title of that check.
    pub repeated: String,
    /// Its levels, at least one.
    pub levels: Vec<Level>,
}

impl MotionTable for Table {
    const NAME: &'static str = "robustness";
    type Check = Robustness;

    fn about(&self) -> Option<&str> {
        Some(self.check.get_ref())
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        // one that has runs of its own has none to be disturbed
        let earlier = reading.earlier.iter().enumerate();
        let mut repeatable = earlier.filter(|(_, check)| check.kind.sweep().is_none());
        let wanted = self.check.get_ref();
        let mut known = repeatable.clone();
        let Some((check, repeated)) = repeatable.find(|(_, check)| check.name == *wanted) else {
            let known = known.by_ref().map(|(_, check)| check.name.clone());
            let problem = SweepProblem::UnknownCheck {
                check: wanted.clone(),
                known: known.collect(),
            };
            return reading.refuse_at(&self.check, problem);
        };
        let count = self.rungs.len();
        if !(1..=MOST_LEVELS).contains(&count) {
            return reading.refuse(SweepProblem::Levels { count });
        }
        let names = self.rungs.iter().map(|level| &level.get_ref().name);
        reading.report.unique("level", names)?;
        let levels = self
            .rungs
            .iter()
            .map(|level| LevelTable::read(level, reading));
        Ok(Robustness {
            name: reading.check.to_owned(),
            sweep: Sweep {
                check,
                repeated: repeated.title.clone(),
                levels: levels.collect::<Result<_, _>>()?,
            },
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Robustness {
    /// Its own name, by which its runs are found.
    name: String,
    sweep: Sweep,
}

impl MotionCheck for Robustness {
    fn bounds(&self) -> [String; 2] {
        [
            format!("\"{}\" in full at every level", self.sweep.repeated),
            "nothing at any level".to_owned(),
        ]
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let runs = facts.sweeps.iter().find(|runs| runs.check == self.name);
        let outcomes = runs.map_or(&[][..], |runs| &runs.levels);
        let periods = facts.motion.periods;
        judge(&self.sweep, outcomes, |tick| periods.time_s(tick))
    }

    fn sweep(&self) -> Option<&Sweep> {
        Some(&self.sweep)
    }
}

/// How a motion went under one level.
#[derive(Debug, Clone)]
pub struct LevelOutcome {
    /// What the earlier check found, or why the run had no end.
    pub outcome: Result<Finding, EarlyEnd>,
    /// Identity of the run.
    pub digest: String,
}

/// How a run under a level ended before its time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EarlyEnd {
    /// What happened.
    pub message: String,
    /// The tick.
    pub tick: u64,
}

/// Judges the sweep: `outcomes` has one entry per level, and `time_s` gives the time of a tick.
fn judge(sweep: &Sweep, outcomes: &[LevelOutcome], time_s: impl Fn(u64) -> f64) -> Finding {
    let score = |i: usize| match outcomes.get(i).map(|level| &level.outcome) {
        Some(Ok(finding)) if finding.score >= 0.0 => finding.score.min(1.0),
        _ => 0.0,
    };
    let scores: Vec<f64> = (0..sweep.levels.len()).map(score).collect();
    let mut lost: Vec<usize> = (0..scores.len()).filter(|i| scores[*i] < 1.0).collect();
    // where most was lost first, else in the order of the levels
    lost.sort_by(|a, b| scores[*a].total_cmp(&scores[*b]));
    let evidence = lost.iter().filter_map(|&i| {
        let outcome = &outcomes.get(i)?.outcome;
        let score = scores[i];
        Some(evidence(
            &sweep.levels[i],
            &sweep.repeated,
            outcome,
            score,
            &time_s,
        ))
    });
    let quantity = format!(
        "share of the points of \"{}\" earned under disturbances, mean of {} {}",
        sweep.repeated,
        scores.len(),
        if scores.len() == 1 { "run" } else { "runs" }
    );
    Finding::share(mean(sweep, &scores), quantity)
        .because(evidence.collect())
        .advise("Leave a margin: correct by what is measured, with gains that also hold when commands are late, measurements are noisy or the arm is heavier.")
}

/// The mean of the levels' scores by their shares.
fn mean(sweep: &Sweep, scores: &[f64]) -> f64 {
    if scores.iter().all(|score| *score >= 1.0) {
        return 1.0;
    }
    let shares: f64 = sweep.levels.iter().map(|level| level.share).sum();
    let levels = sweep.levels.iter().zip(scores);
    let sum: f64 = levels.map(|(level, score)| level.share * score).sum();
    sum / shares
}

/// Why a level loses points; a tick of its run is none of the one that is shown.
fn evidence(
    level: &Level,
    repeated: &str,
    outcome: &Result<Finding, EarlyEnd>,
    score: f64,
    time_s: &impl Fn(u64) -> f64,
) -> Evidence {
    let under = format!("in the run `{}` ({})", level.name, level.in_words());
    let run = Some(level.name.clone());
    let finding = match outcome {
        Err(end) => {
            let at = seconds(time_s(end.tick));
            return Evidence {
                message: format!("{under}, at {at}: {}", end.message),
                run,
                ..Evidence::default()
            };
        }
        Ok(finding) => finding,
    };
    let first = finding.evidence.first();
    let why = first.map_or(String::new(), |first| format!("; {}", first.message));
    let earned = with_unit(score, "");
    let measure = finding.measure.as_ref();
    Evidence {
        message: format!("{under}: \"{repeated}\" earns {earned} of its points{why}"),
        signal: first.map_or(String::new(), |first| first.signal.clone()),
        run,
        value: measure.and_then(|measure| measure.value),
        limit: measure.map(|measure| measure.full),
        unit: measure.map_or(String::new(), |measure| measure.unit.clone()),
        ..Evidence::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(name: &str, share: f64) -> Level {
        Level {
            name: name.to_owned(),
            share,
            q_noise: 0.0,
            qd_noise: 0.0,
            delay_periods: 1,
            delay_s: 0.01,
            payload_kg: 0.0,
            friction: 0.0,
            damping: None,
            pushes: Vec::new(),
            start: None,
        }
    }

    fn scored(score: f64) -> LevelOutcome {
        let mut finding = Finding::share(score, "");
        finding.measure = None;
        LevelOutcome {
            outcome: Ok(finding),
            digest: String::new(),
        }
    }

    fn sweep(shares: &[f64]) -> Sweep {
        let levels = shares.iter().enumerate();
        Sweep {
            check: 0,
            repeated: "On the line".to_owned(),
            levels: levels
                .map(|(i, share)| level(&format!("r{i}"), *share))
                .collect(),
        }
    }

    fn judged(shares: &[f64], facts: &[LevelOutcome]) -> Finding {
        judge(&sweep(shares), facts, |tick| tick as f64 * 1e-3)
    }

    #[test]
    fn every_level_gives_its_share() {
        let facts = [scored(1.0), scored(0.5), scored(0.0)];
        assert_eq!(judged(&[1.0, 1.0, 1.0], &facts).score, 0.5);
        // (2 * 1 + 1 * 0.5 + 1 * 0) / 4
        assert_eq!(judged(&[2.0, 1.0, 1.0], &facts).score, 0.625);
        // thirds and tenths that do not add up in binary numbers
        let full = [scored(1.0), scored(1.0), scored(1.0)];
        assert_eq!(judged(&[0.1, 0.2, 0.7], &full).score, 1.0);
        assert!(judged(&[0.1, 0.2, 0.7], &full).evidence.is_empty());
    }

    #[test]
    fn a_run_without_an_end_earns_nothing_and_comes_first() {
        let ended = LevelOutcome {
            outcome: Err(EarlyEnd {
                message: "the motion blew up".to_owned(),
                tick: 1500,
            }),
            digest: String::new(),
        };
        let finding = judged(&[1.0, 1.0], &[scored(0.5), ended]);
        assert_eq!(finding.score, 0.25);
        let first = &finding.evidence[0];
        assert_eq!(
            first.message,
            "in the run `r1` (commands 0.01 s late), at 1.5 s: the motion blew up"
        );
        assert_eq!((first.tick, first.time_s), (None, None));
        assert_eq!(first.run.as_deref(), Some("r1"));
        assert_eq!(
            finding.evidence[1].message,
            "in the run `r0` (commands 0.01 s late): \"On the line\" earns 50 % of its points"
        );
    }

    #[test]
    fn no_number_and_no_run_earn_nothing() {
        assert_eq!(judged(&[1.0, 1.0], &[scored(f64::NAN)]).score, 0.0);
    }
}
