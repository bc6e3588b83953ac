//! tcp-speed: how fast the TCP is when the arm touches a body, or at its fastest \[m/s\].
//!
//! The speed at tick `k` is `|p[k] - p[k-1]| / h`, the mean over the physics step that ends there; at tick 0 the arm is at rest. At
//! a touch it is that of the last step before the one in which the two began to press, so the blow itself does not count. Of several
//! touches the fastest counts, up to the body's first fall: a gentle touch does not pay for a blow after it. An arm that never touches
//! has no such speed and earns nothing.

use kinemark_sim::trace::Trace;

use super::time_limit::fell;
use crate::check::prelude::*;
use crate::task::watched::TouchingParty;

/// The moment whose speed counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Moment {
    Touch,
    Run,
}

problems! {
    /// A body where none is looked at, or none where one is.
    enum BodyProblem {
        OverRun: "lab::tcp_speed", "`body` has no meaning over the whole run", "not looked at",
            "remove it, or write `at = \"touch\"`";
        Missing: "lab::tcp_speed", "a speed at a touch needs the `body` that is touched", "`body` is missing",
            "add it, such as `body = \"can\"`";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The moment: `touch` (any link touches `body`, before `body` falls: the fastest of these touches) or `run` (whenever the speed is
    /// greatest).
    at: Moment,
    /// A body of the scene, at a `touch`.
    body: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Speed that earns all points \[m/s\].
    full_m_s: BandEnd,
    /// Speed that earns none \[m/s\].
    zero_m_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "tcp-speed";
    type Check = InBand<TcpSpeed>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let measure = match (self.at, &self.body) {
            (Moment::Run, None) => TcpSpeed::Greatest,
            (Moment::Run, Some(body)) => return reading.refuse_at(body, BodyProblem::OverRun),
            (Moment::Touch, Some(body)) => {
                TcpSpeed::AtTouch(reading.body(reading.scene(Self::NAME)?, body)?)
            }
            (Moment::Touch, None) => return reading.refuse(BodyProblem::Missing),
        };
        reading.in_band_either(
            self.at_least,
            [self.full_m_s, self.zero_m_s],
            "m/s",
            measure,
        )
    }
}

/// The moment whose speed counts.
#[derive(Debug)]
pub(crate) enum TcpSpeed {
    /// Whenever it is greatest.
    Greatest,
    /// When the arm touches the body of this index in the scene, before it falls.
    AtTouch(usize),
}

impl RunMeasure for TcpSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let speeds = speeds_m_s(facts.trace);
        match self {
            Self::Greatest => {
                let fastest = greatest(speeds.iter().copied());
                let (tick, speed_m_s) = fastest.unwrap_or_default();
                let curve = facts.curve("speed of the TCP", "m/s", speeds, band);
                let quantity = "greatest speed of the TCP";
                Finding::of_curve(band, Statistic::Greatest, "m/s", quantity, curve)
                    .shown_at(facts, || {
                        let message = message(facts, tick, speed_m_s, "its greatest speed");
                        (message, "tcp".to_owned(), tick)
                    })
                    .advise(band.advice(
                        "Give the fastest part of the move more time.",
                        "Give the fastest part of the move less time.",
                    ))
            }
            Self::AtTouch(body) => at_touch(facts, speeds, *body, band),
        }
    }
}

fn at_touch(facts: &MotionFacts<'_>, speeds: Vec<f64>, body: usize, band: Band) -> Finding {
    let name = facts.names.body(body);
    let touches = touches(facts, body);
    let at = |touch: &usize| speeds[touch.saturating_sub(1)];
    // of touches at one speed the first
    let fastest = touches.iter().rev().max_by(|a, b| at(a).total_cmp(&at(b)));
    let touch = fastest.copied();
    let nth = touch.map_or(0, |touch| touches.partition_point(|tick| *tick < touch));
    // the step that ends at the touch has the blow in it
    let before = touch.map(|tick| tick.saturating_sub(1));
    let value = before.map_or(f64::INFINITY, |tick| speeds[tick]);
    let when = if nth == 0 { "first touches" } else { "touches" };
    let what = format!("when the arm {when} `{name}`");
    let mut curve = facts.curve("speed of the TCP", "m/s", speeds, band);
    let label = match nth {
        0 => "first touch".to_owned(),
        nth => format!("touch {}", nth + 1),
    };
    let mark = touch.map(|tick| (facts.time_s(tick), label));
    curve.marks = mark.into_iter().collect();
    let quantity = format!("speed of the TCP {what}");
    let finding = Finding::against(band, value, "m/s", quantity).drawn(curve);
    let Some(tick) = before else {
        let mut message = format!("the arm never touched `{name}`");
        if let Some((tick, away_m)) = nearest(facts, body) {
            message += &format!(
                ": the hand comes no nearer to its middle than {}, at {}, where it is at {}; at the end it is at {}",
                metres(away_m),
                seconds(facts.time_s(tick)),
                list(facts.trace.tcp_position(tick).as_slice()),
                list(facts.trace.tcp_position(facts.last_tick()).as_slice()),
            );
        }
        return finding
            .with(facts.evidence(message, "contacts".to_owned(), facts.last_tick()))
            .advise(format!(
                "How near does the hand come to `{name}`, from which side, and where is it at the end of the run?"
            ))
            .insisting();
    };
    finding
        .shown_at(facts, || {
            (message(facts, tick, value, &what), "tcp".to_owned(), tick)
        })
        .advise(band.advice(
            format!("Come to `{name}` more slowly: a push is enough."),
            format!("Come to `{name}` faster: begin further away from it."),
        ))
}

/// When the hand is nearest to the middle of a body, and how near \[m\].
fn nearest(facts: &MotionFacts<'_>, body: usize) -> Option<(usize, f64)> {
    let away_m = |tick: usize| {
        let p_body_in_lab = facts.p_body_in_lab(body, tick)?;
        Some((facts.trace.tcp_position(tick) - p_body_in_lab).norm())
    };
    let distances = (0..facts.trace.len())
        .map(away_m)
        .collect::<Option<Vec<f64>>>()?;
    let mut least = (0, *distances.first()?);
    for (tick, away_m) in distances.into_iter().enumerate() {
        if away_m < least.1 {
            least = (tick, away_m);
        }
    }
    Some(least)
}

fn message(facts: &MotionFacts<'_>, tick: usize, speed_m_s: f64, what: &str) -> String {
    format!(
        "the TCP goes at {} m/s at {}, {what}",
        trimmed(speed_m_s, 3),
        seconds(facts.time_s(tick)),
    )
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

/// The first ticks of the touches of a body by any link, in order, up to its first fall.
fn touches(facts: &MotionFacts<'_>, body: usize) -> Vec<usize> {
    let until = fell(&facts.trace.events, body).unwrap_or(usize::MAX);
    let (arm, body) = (TouchingParty::Arm, TouchingParty::Body(body));
    let contacts = facts.trace.contacts.iter();
    let touches = contacts.filter(|contact| arm.meets(body, contact.parties));
    let ticks = touches.map(|contact| contact.first_tick as usize);
    let mut ticks: Vec<usize> = ticks.filter(|tick| *tick <= until).collect();
    ticks.sort_unstable();
    ticks.dedup();
    ticks
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
}
