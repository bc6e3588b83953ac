//! robustness: an earlier check of the task, of the same motion under disturbances that grow like the rungs of a ladder.
//!
//! The grader runs the motion once under every rung ([`crate::judge::robustness_sweep`]) and has the earlier check judge it; measured is the mean of its
//! scores, each with its rung's share. The disturbances are the same for every submission.

use super::Finding;
use crate::lab::ladder::{Ladder, Rung};
use crate::record::grade::{Evidence, Measure};
use crate::record::quantity::{seconds, with_unit};

/// How a motion went under one rung.
#[derive(Debug, Clone)]
pub struct RungFacts {
    /// What the earlier check found, or why the run had no end.
    pub outcome: Result<Finding, RungEnd>,
    /// Identity of the run.
    pub digest: String,
}

/// How a run under a rung ended before its time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RungEnd {
    /// What happened.
    pub message: String,
    /// The tick.
    pub tick: u64,
}

/// Judges the check: `repeated` is the title of the earlier one, `facts` has one entry per rung, and `time_s` tells the time of a tick.
pub fn judge(
    ladder: &Ladder,
    repeated: &str,
    facts: &[RungFacts],
    time_s: impl Fn(u64) -> f64,
) -> Finding {
    let scores: Vec<f64> = ladder
        .rungs
        .iter()
        .enumerate()
        .map(|(i, _)| match facts.get(i).map(|facts| &facts.outcome) {
            Some(Ok(finding)) if finding.score >= 0.0 => finding.score.min(1.0),
            _ => 0.0,
        })
        .collect();
    let score = mean(ladder, &scores);
    let mut lost: Vec<usize> = (0..scores.len()).filter(|i| scores[*i] < 1.0).collect();
    // where most was lost first, else in the order of the ladder
    lost.sort_by(|a, b| scores[*a].total_cmp(&scores[*b]));
    let evidence = lost.iter().filter_map(|&i| {
        let rung = ladder.rungs.get(i)?;
        Some(told(rung, repeated, facts.get(i)?, scores[i], &time_s))
    });
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("\"{repeated}\" under disturbances, mean of {} rungs", scores.len()),
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence: evidence.collect(),
        next_step: "Leave a margin: correct by what is measured, with gains that also hold when commands are late, measurements are noisy or the arm is heavier.".to_owned(),
        curve: None,
    }
}

/// The mean of the rungs' scores by their shares.
fn mean(ladder: &Ladder, scores: &[f64]) -> f64 {
    if scores.iter().all(|score| *score >= 1.0) {
        return 1.0;
    }
    let shares: f64 = ladder.rungs.iter().map(|rung| rung.share).sum();
    let rungs = ladder.rungs.iter().zip(scores);
    let sum: f64 = rungs.map(|(rung, score)| rung.share * score).sum();
    sum / shares
}

fn told(
    rung: &Rung,
    repeated: &str,
    facts: &RungFacts,
    score: f64,
    time_s: &impl Fn(u64) -> f64,
) -> Evidence {
    let under = format!("in the run `{}` ({})", rung.name, rung.told());
    let mut evidence = Evidence {
        message: String::new(),
        signal: String::new(),
        tick: None,
        time_s: None,
        // a tick of that run is none of the one that is shown
        run: Some(rung.name.clone()),
        case: None,
        value: None,
        limit: None,
        unit: String::new(),
    };
    match &facts.outcome {
        Err(end) => {
            let at = seconds(time_s(end.tick));
            evidence.message = format!("{under}, at {at}: {}", end.message);
        }
        Ok(finding) => {
            let first = finding.evidence.first();
            let why = first.map_or(String::new(), |first| format!("; {}", first.message));
            evidence.message = format!(
                "{under}: \"{repeated}\" earns {} of its points{why}",
                with_unit(score, "")
            );
            if let Some(first) = first {
                evidence.signal.clone_from(&first.signal);
            }
            if let Some(measure) = &finding.measure {
                evidence.value = measure.value;
                evidence.limit = Some(measure.full);
                evidence.unit.clone_from(&measure.unit);
            }
        }
    }
    evidence
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rung(name: &str, share: f64) -> Rung {
        Rung {
            name: name.to_owned(),
            share,
            q_noise: 0.0,
            qd_noise: 0.0,
            delay_periods: 1,
            delay_s: 0.01,
            payload_kg: 0.0,
            friction: 0.0,
            damping: None,
        }
    }

    fn scored(score: f64) -> RungFacts {
        let finding = Finding {
            insists: false,
            score,
            measure: None,
            evidence: Vec::new(),
            next_step: String::new(),
            curve: None,
        };
        RungFacts {
            outcome: Ok(finding),
            digest: String::new(),
        }
    }

    fn ladder(shares: &[f64]) -> Ladder {
        let rungs = shares.iter().enumerate();
        Ladder {
            check: 0,
            rungs: rungs
                .map(|(i, share)| rung(&format!("r{i}"), *share))
                .collect(),
        }
    }

    fn judged(shares: &[f64], facts: &[RungFacts]) -> Finding {
        judge(&ladder(shares), "On the line", facts, |tick| {
            tick as f64 * 1e-3
        })
    }

    #[test]
    fn every_rung_gives_its_share() {
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
    fn a_run_without_an_end_earns_nothing_and_is_told_first() {
        let ended = RungFacts {
            outcome: Err(RungEnd {
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
