//! tcp-speed: how fast the TCP is when the arm first touches a body, or at its fastest \[m/s\].
//!
//! The speed at tick `k` is `|p[k] - p[k-1]| / h`, the mean over the physics step that ends there; at tick 0 the arm is at rest. At
//! a touch it is that of the last step before the one in which the two first pressed, so the blow itself does not count. An arm that
//! never touches has no such speed and earns nothing.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Problem;
use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::trace::Trace;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::watched::{SpeedAt, TouchingParty};

/// The moment whose speed counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Moment {
    Touch,
    Run,
}

/// A body where none is looked at, or none where one is.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
enum NoMoment {
    #[error("`body` has no meaning over the whole run")]
    BodyOverRun,
    #[error("a speed at a touch needs the `body` that is touched")]
    TouchOfNothing,
}

impl Problem for NoMoment {
    fn code(&self) -> &'static str {
        "lab::tcp_speed"
    }

    fn label(&self) -> String {
        match self {
            Self::BodyOverRun => "not looked at".to_owned(),
            Self::TouchOfNothing => "`body` is missing".to_owned(),
        }
    }

    fn help(&self) -> Option<String> {
        Some(match self {
            Self::BodyOverRun => "remove it, or write `at = \"touch\"`".to_owned(),
            Self::TouchOfNothing => "add it, such as `body = \"can\"`".to_owned(),
        })
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The moment: `touch` (the first touch of `body` by any link) or `run` (whenever the speed is greatest).
    at: Moment,
    /// A body of the scene, at a `touch`.
    #[schemars(with = "Option<String>")]
    body: Option<Spanned<String>>,
    /// Speed that earns all points \[m/s\].
    full_m_s: f64,
    /// Speed that earns none \[m/s\].
    zero_m_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "tcp-speed";
    type Check = TcpSpeed;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<TcpSpeed, LabError> {
        let moment = match (self.at, &self.body) {
            (Moment::Run, None) => SpeedAt::Run,
            (Moment::Run, Some(body)) => {
                return reading.report.refuse(body.span(), NoMoment::BodyOverRun);
            }
            (Moment::Touch, Some(body)) => {
                let scene = reading.scene(Self::NAME, at.clone())?;
                SpeedAt::Touch(reading.body(scene, body)?)
            }
            (Moment::Touch, None) => return reading.report.refuse(at, NoMoment::TouchOfNothing),
        };
        Ok(TcpSpeed {
            at: moment,
            band: reading.report.band(self.full_m_s, self.zero_m_s, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct TcpSpeed {
    at: SpeedAt,
    band: Band,
}

impl CheckKind for TcpSpeed {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m/s"))
    }
}

/// Speed of the TCP at every tick \[m/s\].
fn speeds_m_s(trace: &Trace) -> Vec<f64> {
    let speed = |tick: usize| match tick.checked_sub(1) {
        None => 0.0,
        Some(before) => {
            (trace.tcp_position(tick) - trace.tcp_position(before)).norm() / trace.step_s
        }
    };
    (0..trace.len()).map(speed).collect()
}

/// The tick of the greatest speed; one that is no number is the greatest of all.
fn fastest(speeds_m_s: &[f64]) -> Option<usize> {
    (0..speeds_m_s.len()).max_by(|a, b| {
        let speed = |tick: usize| speeds_m_s[tick].abs();
        // of equal ones the first
        speed(*a).total_cmp(&speed(*b)).then(b.cmp(a))
    })
}

/// The first touch of a body by any link.
fn first_touch(facts: &MotionFacts<'_>, body: usize) -> Option<usize> {
    let (arm, body) = (TouchingParty::Arm, TouchingParty::Body(body));
    let contacts = facts.trace.contacts.iter();
    let touches = contacts.filter(|contact| arm.meets(body, contact.parties));
    touches.map(|contact| contact.first_tick as usize).min()
}

impl TcpSpeed {
    /// The speed at `tick`, which is `what`; infinite where there is no such tick.
    fn finding(
        &self,
        facts: &MotionFacts<'_>,
        speeds: &[f64],
        tick: Option<usize>,
        quantity: String,
        what: &str,
    ) -> Finding {
        let speed = tick.and_then(|tick| speeds.get(tick).copied());
        let value = speed.unwrap_or(f64::INFINITY);
        let finding = Finding::against(self.band, value, "m/s", quantity);
        let Some(tick) = tick else {
            return finding;
        };
        finding.shown_at(facts, || {
            let message = format!(
                "the TCP goes at {} m/s at {}, {what}",
                trimmed(value, 3),
                seconds(facts.time_s(tick)),
            );
            (message, "tcp".to_owned(), tick)
        })
    }

    fn at_touch(&self, facts: &MotionFacts<'_>, speeds: &[f64], body: usize) -> Finding {
        let name = facts.names.body(body);
        let touch = first_touch(facts, body);
        // the step that ends at the touch has the blow in it
        let before = touch.map(|tick| tick.saturating_sub(1));
        let what = format!("when the arm first touches `{name}`");
        let quantity = format!("speed of the TCP {what}");
        let finding = self.finding(facts, speeds, before, quantity, &what);
        if touch.is_some() {
            return finding.advise(format!("Come to `{name}` more slowly: a push is enough."));
        }
        let message = format!("the arm never touched `{name}`");
        finding
            .with(facts.evidence(message, "contacts".to_owned(), facts.last_tick()))
            .advise(format!("Lead the arm to `{name}`."))
    }
}

impl MotionCheck for TcpSpeed {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let speeds = speeds_m_s(facts.trace);
        let (finding, touch) = match self.at {
            SpeedAt::Run => {
                let quantity = "greatest speed of the TCP".to_owned();
                let tick = fastest(&speeds);
                let finding = self.finding(facts, &speeds, tick, quantity, "its greatest speed");
                let finding = finding.advise("Give the fastest part of the move more time.");
                (finding, None)
            }
            SpeedAt::Touch(body) => (
                self.at_touch(facts, &speeds, body),
                first_touch(facts, body),
            ),
        };
        let mut curve = facts.curve("speed of the TCP", "m/s", speeds, self.band);
        let touch = touch.map(|tick| (facts.time_s(tick), "first touch".to_owned()));
        curve.marks = touch.into_iter().collect();
        finding.drawn(curve)
    }

    fn first_loss(&self) -> FirstLoss {
        match self.at {
            SpeedAt::Run => FirstLoss::Greatest,
            SpeedAt::Touch(_) => FirstLoss::Evidence,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_of_a_turning_link_is_radius_times_rate() {
        // one joint at 0.5 rad/s; the TCP of this chain is the last link's frame, 0.2 m from the first axis of two
        let run = crate::record::sample::chain(2, 100, |tick, joint| {
            if joint == 0 {
                0.0005 * tick as f64
            } else {
                0.0
            }
        });
        let speeds = speeds_m_s(&run.trace);
        let expected = 0.2 * 0.5;
        assert_eq!(speeds[0], 0.0);
        for speed in &speeds[1..] {
            // chord against arc: relative 1e-8 at 0.5 mrad a step
            assert!((speed - expected).abs() < 1e-8, "{speed}");
        }
    }

    #[test]
    fn the_fastest_is_the_first_of_equals_and_nan_is_faster_than_all() {
        assert_eq!(fastest(&[0.0, 2.0, 1.0, 2.0]), Some(1));
        assert_eq!(fastest(&[0.0, -f64::NAN, f64::INFINITY]), Some(1));
        assert_eq!(fastest(&[]), None);
    }
}
