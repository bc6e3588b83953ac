//! joint-reached: a joint stands at a position for the last part of the run.
//!
//! Measured is the greatest distance from the position over the last `hold_s` \[rad or m\].

use kinemark_sim::control::Mode;

use crate::check::prelude::*;

problems! {
    /// Turns of a joint that slides.
    enum TurnsProblem {
        Slides { joint: String }:
            "lab::joint_reached", "joint `{joint}` slides: it makes no turns", "this joint", "leave `turns` out";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint.
    joint: At<String>,
    /// Where it should stand \[rad, or m of a prismatic joint\].
    position_rad: f64,
    /// The part at the end of the run that counts \[s\]; a multiple of the physics step.
    hold_s: At<f64>,
    /// Whether whole turns make no difference, as where it may end at -π as well as at π; false where it is left out.
    #[serde(default)]
    turns: bool,
    /// Distance that earns all points.
    full_rad: BandEnd,
    /// Distance that earns none.
    zero_rad: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-reached";
    type Check = InBand<JointReached>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.joint(&self.joint)?;
        if self.turns && reading.units(Some(joint)) == JointUnits::Sliding {
            let joint = self.joint.get_ref().clone();
            return reading.refuse_at(&self.joint, TurnsProblem::Slides { joint });
        }
        let measure = JointReached {
            joint,
            position: self.position_rad,
            turns: self.turns,
            hold_ticks: reading.ticks(&self.hold_s, "`hold_s`")? as usize,
        };
        let unit = reading.units(Some(measure.joint)).position();
        reading.in_band([self.full_rad, self.zero_rad], unit, measure)
    }
}

/// The distance of a joint from a position.
#[derive(Debug)]
pub(crate) struct JointReached {
    /// Index in `q`.
    joint: usize,
    /// Where it should stand \[rad or m\].
    position: f64,
    /// Whether whole turns make no difference.
    turns: bool,
    /// Ticks at the end in which it must stand there.
    hold_ticks: usize,
}

impl RunMeasure for JointReached {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let joint = self.joint;
        let (name, unit) = (facts.joint_name(joint), facts.units(joint).position());
        let position = trimmed(self.position, 4);
        let last = facts.last_tick();
        let first = last.saturating_sub(self.hold_ticks);
        let error_at = |tick: usize| self.distance(facts.trace.q.at(tick)[joint]);
        let worst = (first..=last)
            .max_by(|a, b| error_at(*a).total_cmp(&error_at(*b)))
            .unwrap_or(last);
        let value = error_at(worst);
        let mut quantity = format!("distance of joint `{name}` from {position} {unit}");
        if self.turns {
            quantity += ", but for whole turns";
        }
        let mut finding = Finding::against(band, value, unit, quantity);
        if finding.is_lost() {
            let message = self.message(facts, value, (first, worst));
            finding = finding.with(Evidence {
                value: Some(facts.trace.q.at(worst)[joint]),
                limit: Some(self.position),
                unit: unit.to_owned(),
                ..facts.evidence(message, format!("q[{joint}]"), worst)
            });
        }
        let title = format!("distance of joint `{name}` from its target");
        let values = (0..facts.trace.len()).map(error_at).collect();
        let mut curve = facts.curve(title, unit, values, band);
        curve.marks = vec![(facts.time_s(first), "judged from here".to_owned())];
        let is_passive = facts
            .robot
            .moving_joints()
            .nth(joint)
            .is_some_and(|joint| joint.passive);
        let advice = match facts.motion.servo.mode {
            _ if is_passive => format!(
                "Joint `{name}` has no drive: move the other joints so that it comes to {position} {unit} and stays there."
            ),
            Mode::Position | Mode::Prescribed => {
                format!("Return {position} for joint `{name}` from `control`, at every call.")
            }
            Mode::Velocity => format!(
                "Command a velocity that takes joint `{name}` to {position} {unit} and is zero there: what is left of the way, times a gain."
            ),
            Mode::Effort => format!(
                "Command the effort that takes joint `{name}` to {position} {unit} and keeps it there: at rest, it is what gravity asks for there."
            ),
        };
        finding.advise(advice).drawn(curve)
    }
}

impl JointReached {
    /// How far `q` is off \[rad or m\].
    fn distance(&self, q: f64) -> f64 {
        let away = q - self.position;
        if self.turns {
            libm::remainder(away, std::f64::consts::TAU).abs()
        } else {
            away.abs()
        }
    }

    /// Why points are lost: `value` off at tick `worst`, of those from `first` on.
    fn message(
        &self,
        facts: &MotionFacts<'_>,
        value: f64,
        (first, worst): (usize, usize),
    ) -> String {
        let (name, unit) = (
            facts.joint_name(self.joint),
            facts.units(self.joint).position(),
        );
        let position = trimmed(self.position, 4);
        let last = facts.last_tick();
        let at_end = facts.trace.q.at(last)[self.joint];
        let started = facts.trace.q.at(0)[self.joint];
        let is_to_move = self.distance(started) > 1e-3;
        if is_to_move && (at_end - started).abs() < 1e-3 {
            format!(
                "joint `{name}` is where it began at the end, at {} {unit}: {position} {unit} was asked for",
                trimmed(at_end, 4),
            )
        } else {
            format!(
                "joint `{name}` is {} {unit} from {position} {unit} at {}, within the last {} that count",
                trimmed(value, 4),
                seconds(facts.time_s(worst)),
                seconds(facts.time_s(last - first)),
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, judged_undriven, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";

    #[test]
    fn what_is_advised_is_what_control_commands() {
        for (mode, advice) in [
            ("position", "Return 3.1 for joint `elbow` from `control`"),
            (
                "velocity",
                "Command a velocity that takes joint `elbow` to 3.1 rad",
            ),
            (
                "effort",
                "Command the effort that takes joint `elbow` to 3.1 rad",
            ),
        ] {
            let motion = format!("mode = \"{mode}\"\nduration_s = 1.0");
            let kind = "joint-reached = { joint = \"elbow\", position_rad = 3.1, hold_s = 0.5, full_rad = 0.1, zero_rad = 1.0 }";
            let finding = judged(&motion, kind, |_| HandRow::default());
            assert!(
                finding.next_step.starts_with(advice),
                "{}",
                finding.next_step
            );
        }
    }

    #[test]
    fn nobody_is_advised_to_drive_a_joint_without_a_drive() {
        let kind = "joint-reached = { joint = \"elbow\", position_rad = 3.1, hold_s = 0.5, full_rad = 0.1, zero_rad = 1.0 }";
        let finding = judged_undriven(MOTION, kind, |_| HandRow::default());
        let advice = "Joint `elbow` has no drive: move the other joints";
        assert!(
            finding.next_step.starts_with(advice),
            "{}",
            finding.next_step
        );
    }

    #[test]
    fn whole_turns_make_no_difference_where_the_lab_says_so() {
        let kind = |turns| {
            format!(
                "joint-reached = {{ joint = \"elbow\", position_rad = 3.1, hold_s = 0.5, {turns}full_rad = 0.1, zero_rad = 1.0 }}"
            )
        };
        let below = |_: f64| HandRow {
            q: [0.0, -3.2],
            ..HandRow::default()
        };
        let modulo = judged(MOTION, &kind("turns = true, "), below);
        // -3.2 is 3.0832 but for a turn
        assert!((value(&modulo) - (6.3 - std::f64::consts::TAU)).abs() < 1e-12);
        assert_eq!(modulo.score, 1.0);
        let plain = judged(MOTION, &kind(""), below);
        assert!((value(&plain) - 6.3).abs() < 1e-12);
        assert_eq!(plain.score, 0.0);
    }
}
