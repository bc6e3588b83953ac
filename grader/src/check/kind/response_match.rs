//! response-match: how far the response of a joint is from that of the reference solution in the same variant, over the whole run
//! \[root mean square, in the unit of the signal\].
//!
//! It earns points for one law or one motion alone, so it belongs where the brief prescribes it: an honest command of another shape is
//! further away than a wrong gain. It needs the reference solution's run, so in practice it is judged when the submission is handed in.

use kinemark_sim::control::linear_step::Fed;

use crate::check::prelude::*;
use crate::check::step_keys::OfName;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A joint that moves.
    joint: At<String>,
    /// The signal: `position` or `velocity`; `position` where it is left out.
    #[serde(default)]
    of: OfName,
    /// Distance of a `position` that earns all points \[rad, or m of a prismatic joint\].
    full_rad: Option<At<f64>>,
    /// Distance of a `position` that earns none.
    zero_rad: Option<At<f64>>,
    /// Distance of a `velocity` that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: Option<At<f64>>,
    /// Distance of a `velocity` that earns none.
    zero_rad_s: Option<At<f64>>,
}

problems! {
    /// A band that is not that of the signal.
    enum SignalProblem {
        BandOfOther { unit: &'static str }:
            "lab::step", "the band has the unit of another signal than `of` names", "of the wrong unit",
            format!("write `full_{unit}` and `zero_{unit}`");
        NoBand { unit: &'static str }:
            "lab::step", "a distance of responses needs its band", "the band is not complete",
            format!("write `full_{unit}` and `zero_{unit}`");
    }
}

impl MotionTable for Table {
    const NAME: &'static str = "response-match";
    type Check = InBand<ResponseMatch>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.joint(&self.joint)?;
        let units = JointUnits::of(reading.robot, joint);
        let of_position = [&self.full_rad, &self.zero_rad];
        let of_velocity = [&self.full_rad_s, &self.zero_rad_s];
        let (of, key, unit, band, foreign) = match self.of {
            OfName::Position => (
                Fed::Position,
                "rad",
                units.position(),
                of_position,
                of_velocity,
            ),
            OfName::Velocity => (
                Fed::Velocity,
                "rad_s",
                units.speed(),
                of_velocity,
                of_position,
            ),
        };
        if let Some(typed) = foreign.into_iter().flatten().next() {
            return reading.refuse_at(typed, SignalProblem::BandOfOther { unit: key });
        }
        let [Some(full), Some(zero)] = band else {
            return reading.refuse(SignalProblem::NoBand { unit: key });
        };
        let measure = ResponseMatch { joint, of, unit };
        reading.in_band([*full.get_ref(), *zero.get_ref()], unit, measure)
    }
}

/// The distance of a joint's response from the reference's.
#[derive(Debug)]
pub(crate) struct ResponseMatch {
    /// Index of the joint in `q`.
    joint: usize,
    of: Fed,
    unit: &'static str,
}

impl ResponseMatch {
    /// The signal at every tick.
    fn values(&self, trace: &Trace) -> Vec<f64> {
        let signal = match self.of {
            Fed::Position => &trace.q,
            Fed::Velocity => &trace.qd,
        };
        signal.component(self.joint).collect()
    }
}

impl RunMeasure for ResponseMatch {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let name = facts.joint_name(self.joint);
        let (what, column) = match self.of {
            Fed::Position => ("position", "q"),
            Fed::Velocity => ("velocity", "qd"),
        };
        let own = self.values(facts.trace);
        let reference = facts.solution.map_or_else(Vec::new, |run| self.values(run));
        let apart: Vec<f64> = own
            .iter()
            .zip(&reference)
            .map(|(own, reference)| own - reference)
            .collect();
        // a run that ended early, and no reference at all, are compared with nothing
        let value = match apart.len() {
            0 => f64::INFINITY,
            _ if apart.len() < reference.len() => f64::INFINITY,
            n => (apart.iter().map(|gap| gap * gap).sum::<f64>() / n as f64).sqrt(),
        };
        let quantity = format!("distance of the {what} of joint `{name}` from the reference's");
        let title = format!("{what} of joint `{name}`");
        let t_s = (0..own.len()).map(|tick| facts.time_s(tick)).collect();
        let curve = curve(title, self.unit, t_s, own, None);
        let furthest = greatest(apart.iter().map(|gap| gap.abs()));
        let mut finding = Finding::against(band, value, self.unit, quantity).drawn(curve);
        if let Some((tick, gap)) = furthest {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "the {what} of joint `{name}` is {} {unit} from the reference's (root mean square); the furthest is {} {unit} at {}",
                    trimmed(value, 4),
                    trimmed(gap, 4),
                    seconds(facts.time_s(tick)),
                    unit = self.unit,
                );
                (message, format!("{column}[{}]", self.joint), tick)
            });
        }
        finding.advise(
            "The brief prescribes this law: compare its gains and terms with yours, one by one.",
        )
    }

    fn compares_runs(&self) -> bool {
        true
    }
}
