//! joint-speed: the greatest speed of a joint over the run or a part of it, or its speed when something happens \[rad/s or m/s\].
//!
//! A speed that is no number earns nothing. With `at`, such as a limit switch that is reached, the speed is that of the tick before, so
//! that a blow does not count; of several times the worst counts, and where it never happens the check earns nothing.

use kinemark_sim::text::Problem;

use crate::check::occurrence::{Occurrence, OccurrenceTable};
use crate::check::prelude::*;

problems! {
    /// A part of the run that is none.
    enum SpeedProblem {
        Part { from_s: f64, to_s: f64 }:
            "lab::joint_speed", "the part that counts ends before it begins, got {from_s} s to {to_s} s", "this part",
            "exchange the two";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the fastest one where it is left out.
    joint: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// What happens when the speed counts: an event, a touch, a sensor or a joint's position, with the keys of `never`, such as
    /// `{ sensor = "switch", becomes = true }`. The speed counts all the time where it is left out.
    at: Option<OccurrenceTable>,
    /// Where the part of the run begins that counts \[s\]; the start where it is left out.
    from_s: Option<At<f64>>,
    /// Where it ends \[s\]; the end of the run where it is left out.
    to_s: Option<At<f64>>,
    /// Speed that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: BandEnd,
    /// Speed that earns none.
    zero_rad_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-speed";
    type Check = InBand<JointSpeed>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let unit = reading.units(joint).speed();
        let [first, last] = reading.part_of_run(
            self.from_s.as_ref(),
            self.to_s.as_ref(),
            |from_s, to_s| -> Box<dyn Problem> { Box::new(SpeedProblem::Part { from_s, to_s }) },
        )?;
        let at = self.at.as_ref();
        let at = at.map(|at| at.read(reading, Self::NAME)).transpose()?;
        reading.in_band_either(
            self.at_least,
            [self.full_rad_s, self.zero_rad_s],
            unit,
            JointSpeed {
                joint,
                at,
                first,
                last,
            },
        )
    }
}

/// The greatest speed in a part of the run, or that when something happens in it.
#[derive(Debug)]
pub(crate) struct JointSpeed {
    /// The index of the joint in `q`; the fastest one where there is none.
    joint: Option<usize>,
    /// What happens when the speed counts; all the time where there is none.
    at: Option<Occurrence>,
    /// The first tick that counts.
    first: usize,
    /// The last tick that counts.
    last: usize,
}

impl RunMeasure for JointSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        match &self.at {
            None => self.in_part(facts, band),
            Some(at) => self.when(facts, band, at),
        }
    }
}

impl JointSpeed {
    /// The first and the last tick that count.
    fn part(&self, facts: &MotionFacts<'_>) -> [usize; 2] {
        let last = self.last.min(facts.last_tick());
        [self.first.min(last), last]
    }

    /// The joint that counts at a tick, and its speed.
    fn speed(&self, facts: &MotionFacts<'_>, tick: usize) -> (usize, f64) {
        let qd = facts.trace.qd.at(tick);
        facts.worst_joint(self.joint, |joint| qd[joint].abs())
    }

    /// The speed over the run; what does not count is a gap.
    fn curve(&self, facts: &MotionFacts<'_>, band: Band) -> Curve {
        let [first, last] = self.part(facts);
        let speed = |tick: usize| match (first..=last).contains(&tick) {
            true => self.speed(facts, tick).1,
            false => f64::NAN,
        };
        let values = (0..facts.trace.len()).map(speed).collect();
        let (title, unit) = match self.joint {
            Some(joint) => (
                format!("speed of joint `{}`", facts.joint_name(joint)),
                facts.units(joint).speed(),
            ),
            None => (
                "speed of the fastest joint".to_owned(),
                JointUnits::of_all(facts.robot).speed(),
            ),
        };
        facts.curve(title, unit, values, band)
    }

    /// The greatest speed of the part that counts.
    fn in_part(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let [first, last] = self.part(facts);
        let curve = self.curve(facts, band);
        let counted = &curve.values[first..=last];
        let value = Statistic::Greatest.of(counted);
        let (tick, _) = greatest(counted.iter().copied()).unwrap_or_default();
        let tick = first + tick;
        let first_above = curve.values.iter().position(|speed| *speed > band.full);
        let first_above = first_above.filter(|_| !band.more_is_better());
        let (joint, _) = self.speed(facts, tick);
        let unit = facts.units(joint).speed();
        let quantity = match self.joint {
            Some(_) => format!("greatest speed of joint `{}`", facts.joint_name(joint)),
            None => "greatest speed of a joint".to_owned(),
        };
        let mut finding = Finding::against(band, value, unit, quantity);
        finding.statistic = Some(Statistic::Greatest);
        finding
            .drawn(curve)
            .shown_at(facts, || {
                let mut message = moves_at(facts, joint, value, tick);
                message += &match first_above {
                    Some(first) => format!(
                        "; {} {unit} are first passed at {}",
                        trimmed(band.full, 3),
                        seconds(facts.time_s(first)),
                    ),
                    None => ", its greatest speed".to_owned(),
                };
                (message, format!("qd[{joint}]"), tick)
            })
            .advise(band.advice(
                "Scale all joint velocities down together where the largest is too high: the direction of the hand stays.",
                "Give the fastest part of the move less time.",
            ))
    }

    /// The speed just before `at` happens; of several times the worst.
    fn when(&self, facts: &MotionFacts<'_>, band: Band, at: &Occurrence) -> Finding {
        let [first, last] = self.part(facts);
        let what = at.in_words(facts);
        let times = at.ticks(facts).into_iter();
        let times = times.filter(|tick| (first..=last).contains(tick));
        // the step that ends there may have a blow in it
        let before: Vec<usize> = times.map(|tick| tick.saturating_sub(1)).collect();
        let cost = before.iter().map(|tick| {
            let (_, speed) = self.speed(facts, *tick);
            band.advice(speed, -speed)
        });
        let worst = greatest(cost).map(|(index, _)| before[index]);
        let (joint, value) = match worst {
            Some(tick) => self.speed(facts, tick),
            None => (self.joint.unwrap_or_default(), f64::INFINITY),
        };
        let mut curve = self.curve(facts, band);
        curve.marks = worst
            .map(|tick| (facts.time_s(tick), "what counts".to_owned()))
            .into_iter()
            .collect();
        let quantity = format!("{} when {what}", curve.title);
        let finding =
            Finding::against(band, value, facts.units(joint).speed(), quantity).drawn(curve);
        let Some(tick) = worst else {
            let part = match first > 0 || last < facts.last_tick() {
                true => " in the part of the run that counts",
                false => "",
            };
            let message = format!("the speed counts when {what}, and that never happens{part}");
            return finding
                .with(facts.evidence(message, at.signal(), facts.last_tick()))
                .advise(format!(
                    "What is missing until {what}? See in the replay how far the arm comes."
                ))
                .insisting();
        };
        finding
            .shown_at(facts, || {
                let message = moves_at(facts, joint, value, tick);
                (
                    format!("{message}, just before {what}"),
                    format!("qd[{joint}]"),
                    tick,
                )
            })
            .advise(band.advice(
                format!("Slow down before {what}."),
                format!("Move faster before {what}."),
            ))
    }
}

/// How fast a joint is at a tick.
fn moves_at(facts: &MotionFacts<'_>, joint: usize, speed: f64, tick: usize) -> String {
    let moves = match facts.units(joint) {
        JointUnits::Sliding => "slides",
        JointUnits::Turning | JointUnits::Mixed => "turns",
    };
    format!(
        "joint `{}` {moves} at {} {} at {}",
        facts.joint_name(joint),
        trimmed(speed, 3),
        facts.units(joint).speed(),
        seconds(facts.time_s(tick)),
    )
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"velocity\"\nduration_s = 1.0";
    const KIND: &str = "joint-speed = { full_rad_s = 1.0, zero_rad_s = 3.0 }";

    #[test]
    fn the_fastest_joint_counts_whichever_way_it_turns() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            qd: [0.5, -2.0 * t_s],
            ..HandRow::default()
        });
        // the last tick of the run is 1 s
        assert!((value(&finding) - 2.0).abs() < 1e-12, "{finding:?}");
        assert!((finding.score - 0.5).abs() < 1e-12);
        let message = &finding.evidence[0].message;
        assert!(
            message.contains("joint `elbow`") && message.contains("first passed at 0.501 s"),
            "{message}"
        );
        assert_eq!(judged(MOTION, KIND, |_| HandRow::default()).score, 1.0);
    }

    #[test]
    fn a_joint_that_is_named_counts_alone_and_more_may_be_better() {
        let kind = "joint-speed = { joint = \"shoulder\", at_least = true, full_rad_s = 1.0, zero_rad_s = 0.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            qd: [0.5 * t_s, 4.0],
            ..HandRow::default()
        });
        assert!((value(&finding) - 0.5).abs() < 1e-12 && (finding.score - 0.5).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "joint `shoulder` turns at 0.5 rad/s at 1 s, its greatest speed"
        );
        assert!(finding.next_step.ends_with("less time."), "{finding:?}");
    }

    #[test]
    fn only_the_part_that_is_named_counts() {
        let kind = "joint-speed = { from_s = 0.5, full_rad_s = 1.0, zero_rad_s = 3.0 }";
        let of = |early: f64, late: f64| {
            judged(MOTION, kind, |t_s| HandRow {
                qd: [if t_s < 0.4999 { early } else { late }, 0.5],
                ..HandRow::default()
            })
        };
        let early = of(9.0, 0.0);
        assert_eq!((value(&early), early.score), (0.5, 1.0));
        let late = of(0.0, -2.0);
        assert!(
            (late.score - 0.5).abs() < 1e-12 && late.evidence[0].tick == Some(500),
            "{late:?}"
        );
        assert_eq!(of(0.0, f64::NAN).score, 0.0);
    }

    /// The shoulder turns at 0.8 rad/s through 0.4 rad, and back at 2 rad/s.
    fn there_and_back(t_s: f64) -> HandRow {
        let (q, qd) = match t_s < 0.75 {
            true => (0.8 * t_s, 0.8),
            false => (0.6 - 2.0 * (t_s - 0.75), -2.0),
        };
        HandRow {
            q: [q, 0.0],
            qd: [qd, 5.0],
            ..HandRow::default()
        }
    }

    #[test]
    fn the_speed_counts_when_a_position_is_passed() {
        let of = |keys: &str| {
            let kind = format!("joint-speed = {{ joint = \"shoulder\", {keys} }}");
            judged(MOTION, &kind, there_and_back)
        };
        // 0.4 rad are passed at 0.5 s and, on the way back, at 0.85 s
        let up = of(
            "at = { joint = \"shoulder\", becomes = { above = 0.4 } }, full_rad_s = 0.6, zero_rad_s = 1.0",
        );
        assert!(
            (value(&up) - 0.8).abs() < 1e-12 && (up.score - 0.5).abs() < 1e-9,
            "{up:?}"
        );
        assert_eq!(
            up.evidence[0].message,
            "joint `shoulder` turns at 0.8 rad/s at 0.5 s, just before joint `shoulder` rises above 0.4 rad"
        );
        let back = of(
            "at = { joint = \"shoulder\", becomes = { below = 0.4 } }, full_rad_s = 0.6, zero_rad_s = 1.0",
        );
        assert_eq!((value(&back), back.score), (2.0, 0.0));
        // the part of the run counts, too
        let never = of(
            "at = { joint = \"shoulder\", becomes = { above = 0.4 } }, from_s = 0.6, full_rad_s = 0.6, zero_rad_s = 1.0",
        );
        assert_eq!(never.score, 0.0, "{never:?}");
        assert!(
            never.evidence[0]
                .message
                .ends_with("never happens in the part of the run that counts"),
            "{never:?}"
        );
    }

    #[test]
    fn of_several_times_the_worst_counts() {
        let of = |keys: &str| {
            let kind = format!(
                "joint-speed = {{ at = {{ joint = \"shoulder\", becomes = {{ above = 0.5 }} }}, joint = \"shoulder\", {keys} }}"
            );
            // 0.5 rad are passed upwards at 0.25 s with 2 rad/s, and at 0.75 s with 1 rad/s
            judged(MOTION, &kind, |t_s| {
                let (q, qd) = match t_s {
                    t_s if t_s < 0.4 => (2.0 * t_s, 2.0),
                    t_s if t_s < 0.5 => (0.0, 0.0),
                    t_s => (0.25 + t_s - 0.5, 1.0),
                };
                HandRow {
                    q: [q, 0.0],
                    qd: [qd, 9.0],
                    ..HandRow::default()
                }
            })
        };
        assert_eq!(value(&of("full_rad_s = 1.5, zero_rad_s = 2.5")), 2.0);
        assert_eq!(
            value(&of("at_least = true, full_rad_s = 1.5, zero_rad_s = 0.5")),
            1.0
        );
        // an arm that never comes there earns nothing, whichever end is the better
        for keys in [
            "full_rad_s = 1.5, zero_rad_s = 2.5",
            "at_least = true, full_rad_s = 1.5, zero_rad_s = 0.5",
        ] {
            let kind = format!(
                "joint-speed = {{ at = {{ joint = \"shoulder\", becomes = {{ above = 0.5 }} }}, {keys} }}"
            );
            let idle = judged(MOTION, &kind, |_| HandRow::default());
            assert_eq!(idle.score, 0.0, "{keys}");
            assert_eq!(
                idle.evidence[0].message,
                "the speed counts when joint `shoulder` rises above 0.5 rad, and that never happens"
            );
        }
    }

    #[test]
    fn a_speed_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            qd: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
