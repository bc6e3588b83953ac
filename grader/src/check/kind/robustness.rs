//! robustness: an earlier check of the task, of the same motion under disturbances (a robustness sweep).
//!
//! The motion runs once more at every level, and the earlier check judges it; measured is the mean of its scores, each weighted by
//! the level's `share`. The disturbances are the same for every submission. It is not judged if the earlier check earned nothing.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::text::{Problem, suggest};
use kinemark_sim::ticks::whole_ratio;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::record::grade::Evidence;
use crate::record::quantity::with_unit;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// Levels of one sweep: each is a run of its own.
const MOST_RUNGS: usize = 10;
/// Control periods by which a command may be late.
const MOST_DELAY_PERIODS: u64 = 1000;
/// Above this, only numbers blow up.
const MOST_AMOUNT: f64 = 1e6;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The earlier check of the same task that judges every run.
    #[schemars(with = "String")]
    check: Spanned<String>,
    /// The levels, 1 to 10.
    #[serde(default)]
    #[schemars(with = "Vec<RungTable>")]
    rungs: Vec<Spanned<RungTable>>,
}

/// A level: at least one disturbance.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RungTable {
    /// Shown in reports; lower-case letters, digits and `-`.
    #[schemars(with = "String")]
    name: Spanned<String>,
    /// The weight of the level; 1 where it is left out.
    #[schemars(with = "Option<f64>")]
    share: Option<NumberAt>,
    /// Normal noise on what is measured.
    #[schemars(with = "Option<NoiseTable>")]
    noise: Option<Spanned<NoiseTable>>,
    /// Commands reach the servo this much later \[ms\]: 1 to 1000 whole control periods.
    #[schemars(with = "Option<f64>")]
    delay_ms: Option<NumberAt>,
    /// A point mass at the TCP, fixed to the TCP's link \[kg\].
    #[schemars(with = "Option<f64>")]
    payload_kg: Option<NumberAt>,
    /// Additional dry friction in every joint that moves \[N m, or N of a prismatic joint\].
    #[schemars(with = "Option<f64>")]
    friction_n_m: Option<NumberAt>,
    /// Factor of every joint's viscous damping; refused for a robot without any.
    #[schemars(with = "Option<f64>")]
    damping: Option<NumberAt>,
}

/// Standard deviations.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct NoiseTable {
    /// On measured positions \[rad, or m\].
    #[serde(default)]
    q_rad: f64,
    /// On measured velocities \[rad/s, or m/s\].
    #[serde(default)]
    qd_rad_s: f64,
}

/// What is wrong with a sweep or a level of it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum SweepProblem {
    #[error("no earlier check of this task that can be repeated is called `{check}`")]
    UnknownCheck { check: String, known: Vec<String> },
    #[error("a ladder has 1 to {MOST_RUNGS} rungs, got {count}")]
    Rungs { count: usize },
    #[error(
        "a delay of {delay_ms} ms is not 1 to {MOST_DELAY_PERIODS} whole control periods of {period_ms} ms"
    )]
    Delay {
        delay_ms: f64,
        period_ms: String,
        nearest_ms: String,
    },
    #[error("noise is up to 1000 and not all zero, got q_rad = {q_rad} and qd_rad_s = {qd_rad_s}")]
    Noise { q_rad: f64, qd_rad_s: f64 },
    #[error("{what} is at most 1e6, got {value:e}")]
    TooMuch { what: &'static str, value: f64 },
    #[error("robot `{robot}` has no damping that could be multiplied")]
    NoDamping { robot: String },
    #[error("rung `{rung}` changes nothing")]
    Nothing { rung: String },
}

impl Problem for SweepProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::UnknownCheck { .. } => "lab::unknown_check",
            Self::Rungs { .. } | Self::NoDamping { .. } | Self::Nothing { .. } => "lab::robustness",
            Self::Delay { .. } => "lab::periods",
            Self::Noise { .. } | Self::TooMuch { .. } => "lab::out_of_range",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::UnknownCheck { .. } => "must stand before this check",
            Self::Rungs { .. } => "this check",
            Self::Delay { .. } => "does not divide",
            Self::Noise { .. } => "this noise",
            Self::TooMuch { .. } => "out of range",
            Self::NoDamping { .. } => "changes nothing",
            Self::Nothing { .. } => "this rung",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        let help = match self {
            Self::UnknownCheck { check, known } => {
                let known = known.iter().map(String::as_str);
                return Some(suggest(check, "earlier checks", known));
            }
            Self::Delay { nearest_ms, .. } => {
                return Some(format!("the nearest delay that fits is {nearest_ms} ms"));
            }
            Self::TooMuch { .. } => return None,
            Self::Rungs { .. } => "such as `rungs = [{ name = \"late\", delay_ms = 10 }]`",
            Self::Noise { .. } => "such as `noise = { q_rad = 1e-4, qd_rad_s = 1e-2 }`",
            Self::NoDamping { .. } => "add dry friction instead, such as `friction_n_m = 0.3`",
            Self::Nothing { .. } => {
                "give it `noise`, `delay_ms`, `payload_kg`, `friction_n_m` or `damping`"
            }
        };
        Some(help.to_owned())
    }
}

/// The runs that a robustness check asks for, and who judges them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Index, among the task's checks, of the one that judges every level; earlier than the robustness check.
    pub check: usize,
    /// Its levels, at least one.
    pub rungs: Vec<Rung>,
}

/// One level: the disturbance under which the motion is run again. It is the same for every submission.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// Unique in its sweep.
    pub name: String,
    /// How much it counts against the others; positive.
    pub share: f64,
    /// Standard deviation of the noise on measured joint positions \[rad or m\].
    pub q_noise: f64,
    /// Standard deviation of the noise on measured joint velocities \[rad/s or m/s\].
    pub qd_noise: f64,
    /// By how many control periods commands are late.
    pub delay_periods: u32,
    /// The same as a time \[s\].
    pub delay_s: f64,
    /// Mass at the TCP that is not in the submission's model \[kg\].
    pub payload_kg: f64,
    /// Dry friction that every joint has more \[N m or N\].
    pub friction: f64,
    /// Factor of every joint's viscous damping, where it changes.
    pub damping: Option<f64>,
}

impl Rung {
    /// What is different, in words: `commands 0.01 s late, 0.2 kg more at the TCP`.
    pub fn told(&self) -> String {
        let mut parts = Vec::new();
        let noises = [(self.q_noise, "rad on q"), (self.qd_noise, "rad/s on qd")];
        let noises = noises.iter().filter(|(noise, _)| *noise > 0.0);
        let noises: Vec<String> = noises
            .map(|(noise, what)| format!("{noise} {what}"))
            .collect();
        if !noises.is_empty() {
            parts.push(format!("noise of {}", noises.join(" and ")));
        }
        if self.delay_periods > 0 {
            parts.push(format!("commands {} late", seconds(self.delay_s)));
        }
        if self.payload_kg > 0.0 {
            let mass = trimmed(self.payload_kg, 4);
            parts.push(format!("{mass} kg more at the TCP"));
        }
        if self.friction > 0.0 {
            let friction = trimmed(self.friction, 4);
            parts.push(format!("{friction} N m more friction in every joint"));
        }
        if let Some(factor) = self.damping {
            let factor = trimmed(factor, 4);
            parts.push(format!("{factor} times the damping"));
        }
        parts.join(", ")
    }
}

impl MotionTable for Table {
    const NAME: &'static str = "robustness";
    type Check = Robustness;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Robustness, LabError> {
        // one that has runs of its own has none to be disturbed
        let is_repeatable = |check: usize| reading.earlier[check].kind.sweep().is_none();
        let repeatable: Vec<usize> = (0..reading.earlier.len())
            .filter(|check| is_repeatable(*check))
            .collect();
        let wanted = self.check.get_ref();
        let found = repeatable
            .iter()
            .find(|check| reading.earlier[**check].name == *wanted);
        let Some(&check) = found else {
            let known = repeatable.iter().map(|check| &reading.earlier[*check].name);
            let problem = SweepProblem::UnknownCheck {
                check: wanted.clone(),
                known: known.cloned().collect(),
            };
            return reading.report.refuse(self.check.span(), problem);
        };
        let count = self.rungs.len();
        if !(1..=MOST_RUNGS).contains(&count) {
            return reading.report.refuse(at, SweepProblem::Rungs { count });
        }
        let names = self.rungs.iter().map(|rung| &rung.get_ref().name);
        reading.report.unique("rung", names)?;
        let rungs = self
            .rungs
            .iter()
            .map(|rung| rung.get_ref().read(rung.span(), reading));
        Ok(Robustness {
            name: reading.check.to_owned(),
            sweep: Sweep {
                check,
                rungs: rungs.collect::<Result<_, _>>()?,
            },
        })
    }
}

impl RungTable {
    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Rung, LabError> {
        let report = reading.report;
        let (delay_periods, delay_s) = self.delay(reading)?;
        let (q_noise, qd_noise) = self.noise(reading)?;
        self.amounts(reading)?;
        let amount = |typed: &Option<NumberAt>, what: &str, absent: f64| match typed {
            None => Ok(absent),
            Some(number) => report.positive(number, what),
        };
        let rung = Rung {
            name: self.name.get_ref().clone(),
            share: amount(&self.share, "`share`", 1.0)?,
            q_noise,
            qd_noise,
            delay_periods,
            delay_s,
            payload_kg: amount(&self.payload_kg, "`payload_kg`", 0.0)?,
            friction: amount(&self.friction_n_m, "`friction_n_m`", 0.0)?,
            damping: match &self.damping {
                None => None,
                Some(number) => Some(report.positive(number, "`damping`")?),
            },
        };
        let damped = reading
            .robot
            .joints()
            .iter()
            .any(|joint| joint.damping > 0.0);
        if let Some(damping) = self.damping.as_ref().filter(|_| !damped) {
            let robot = reading.robot.name().to_owned();
            return report.refuse(damping.span(), SweepProblem::NoDamping { robot });
        }
        if rung.told().is_empty() {
            let rung = rung.name;
            return report.refuse(at, SweepProblem::Nothing { rung });
        }
        Ok(rung)
    }

    /// How late commands are, in control periods and in seconds.
    fn delay(&self, reading: &InTask<'_>) -> Result<(u32, f64), LabError> {
        let Some(delay_ms) = &self.delay_ms else {
            return Ok((0, 0.0));
        };
        let delay_s = reading.report.positive(delay_ms, "`delay_ms`")? / 1000.0;
        let period_s = reading.motion.periods.control_s();
        if let Some(periods) = whole_ratio(delay_s, period_s)
            && periods <= MOST_DELAY_PERIODS
        {
            return Ok((periods as u32, delay_s));
        }
        let nearest = (delay_s / period_s).round().max(1.0);
        let nearest_ms = nearest.min(MOST_DELAY_PERIODS as f64) * period_s * 1e3;
        let problem = SweepProblem::Delay {
            delay_ms: *delay_ms.get_ref(),
            period_ms: trimmed(period_s * 1e3, 6),
            nearest_ms: trimmed(nearest_ms, 6),
        };
        reading.report.refuse(delay_ms.span(), problem)
    }

    /// Standard deviations of the noise on positions and velocities.
    fn noise(&self, reading: &InTask<'_>) -> Result<(f64, f64), LabError> {
        let Some(noise) = &self.noise else {
            return Ok((0.0, 0.0));
        };
        let NoiseTable { q_rad, qd_rad_s } = *noise.get_ref();
        let fits = |x: f64| (0.0..=1e3).contains(&x);
        if fits(q_rad) && fits(qd_rad_s) && q_rad + qd_rad_s > 0.0 {
            return Ok((q_rad, qd_rad_s));
        }
        let problem = SweepProblem::Noise { q_rad, qd_rad_s };
        reading.report.refuse(noise.span(), problem)
    }

    /// Refuses amounts with which only numbers would blow up.
    fn amounts(&self, reading: &InTask<'_>) -> Result<(), LabError> {
        let amounts = [
            (&self.share, "`share`"),
            (&self.damping, "`damping`"),
            (&self.friction_n_m, "`friction_n_m`"),
            (&self.payload_kg, "`payload_kg`"),
        ];
        for (typed, what) in amounts {
            if let Some(number) = typed
                .as_ref()
                .filter(|number| *number.get_ref() > MOST_AMOUNT)
            {
                let value = *number.get_ref();
                let problem = SweepProblem::TooMuch { what, value };
                return reading.report.refuse(number.span(), problem);
            }
        }
        Ok(())
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Robustness {
    /// Its own name, by which its runs are found.
    name: String,
    sweep: Sweep,
}

impl CheckKind for Robustness {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        None
    }

    fn bounds(&self, _: &Robot, titles: &[&str]) -> [String; 2] {
        [
            format!("\"{}\" in full on every rung", titles[self.sweep.check]),
            "nothing on any rung".to_owned(),
        ]
    }
}

impl MotionCheck for Robustness {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let climb = facts.climbs.iter().find(|climb| climb.check == self.name);
        let (repeated, rungs) =
            climb.map_or(("", &[][..]), |climb| (&climb.repeated, &climb.rungs));
        let periods = facts.motion.periods;
        judge(&self.sweep, repeated, rungs, |tick| periods.time_s(tick))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }

    fn sweep(&self) -> Option<&Sweep> {
        Some(&self.sweep)
    }
}

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

/// Judges the sweep: `repeated` is the title of the earlier check, `facts` has one entry per level, and `time_s` gives the time of a
/// tick.
fn judge(
    ladder: &Sweep,
    repeated: &str,
    facts: &[RungFacts],
    time_s: impl Fn(u64) -> f64,
) -> Finding {
    let scores = ladder.rungs.iter().enumerate();
    let scores: Vec<f64> = scores
        .map(|(i, _)| match facts.get(i).map(|facts| &facts.outcome) {
            Some(Ok(finding)) if finding.score >= 0.0 => finding.score.min(1.0),
            _ => 0.0,
        })
        .collect();
    let mut lost: Vec<usize> = (0..scores.len()).filter(|i| scores[*i] < 1.0).collect();
    // where most was lost first, else in the order of the ladder
    lost.sort_by(|a, b| scores[*a].total_cmp(&scores[*b]));
    let evidence = lost.iter().filter_map(|&i| {
        let rung = ladder.rungs.get(i)?;
        Some(told(rung, repeated, facts.get(i)?, scores[i], &time_s))
    });
    let quantity = format!(
        "\"{repeated}\" under disturbances, mean of {} rungs",
        scores.len()
    );
    Finding::share(mean(ladder, &scores), quantity)
        .because(evidence.collect())
        .advise("Leave a margin: correct by what is measured, with gains that also hold when commands are late, measurements are noisy or the arm is heavier.")
}

/// The mean of the rungs' scores by their shares.
fn mean(ladder: &Sweep, scores: &[f64]) -> f64 {
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
        let mut finding = Finding::share(score, "");
        finding.measure = None;
        RungFacts {
            outcome: Ok(finding),
            digest: String::new(),
        }
    }

    fn ladder(shares: &[f64]) -> Sweep {
        let rungs = shares.iter().enumerate();
        Sweep {
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

    #[test]
    fn a_rung_tells_all_that_is_different() {
        let rung = Rung {
            name: "all".to_owned(),
            share: 1.0,
            q_noise: 1e-4,
            qd_noise: 0.01,
            delay_periods: 2,
            delay_s: 0.02,
            payload_kg: 0.2,
            friction: 0.3,
            damping: Some(1.3),
        };
        assert_eq!(
            rung.told(),
            "noise of 0.0001 rad on q and 0.01 rad/s on qd, commands 0.02 s late, 0.2 kg more at the TCP, \
             0.3 N m more friction in every joint, 1.3 times the damping"
        );
    }
}
