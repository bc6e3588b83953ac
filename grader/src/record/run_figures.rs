//! Figures of a run that earned all points of its task: how long, how much work, how hard, how smooth. They are worth no points; students
//! compare them with their own earlier ones.

use kinemark_sim::text::number::short;
use kinemark_sim::trace::Trace;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::with_unit;

/// A slower joint is at rest \[rad/s or m/s\].
const AT_REST: f64 = 0.01;

/// What a run took. Lower is better in all of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunFigures {
    /// Time from which on every joint is slower than 0.01 rad/s or m/s \[s\]; absent where one still moves at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_rest_s: Option<f64>,
    /// Work of the motors: the integral of |effort * velocity| over the run, summed over the joints \[J\].
    pub work_j: f64,
    /// The greatest effort of a joint, as a share of its limit; absent where no joint has a limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_effort: Option<f64>,
    /// Root mean square of the jerk of the TCP, of its positions at every call of `control` \[m/s^3\].
    pub jerk_m_s3: f64,
}

impl RunFigures {
    /// The figures of a run whose `control` is called every `stride` ticks; `limits` are the effort limits of the joints, infinity where
    /// there is none. None for a run of fewer than four calls, which has no jerk.
    pub fn of(trace: &Trace, stride: usize, limits: &[f64]) -> Option<Self> {
        let ticks = trace.len();
        if stride == 0 || ticks <= 3 * stride {
            return None;
        }
        let step_s = trace.step_s;
        let moves = |tick: usize| trace.qd.at(tick).iter().any(|speed| speed.abs() >= AT_REST);
        let last = (0..ticks).rev().find(|tick| moves(*tick));
        let at_rest_s = match last {
            None => Some(0.0),
            Some(tick) if tick + 1 < ticks => Some((tick + 1) as f64 * step_s),
            Some(_) => None,
        };
        let power = |tick: usize| {
            let joints = trace.effort.at(tick).iter().zip(trace.qd.at(tick));
            joints
                .map(|(effort, speed)| (effort * speed).abs())
                .sum::<f64>()
        };
        let shares = (0..ticks).flat_map(|tick| trace.effort.at(tick).iter().zip(limits));
        let shares = shares.filter(|(_, limit)| limit.is_finite() && **limit > 0.0);
        let position = |call: usize| trace.tcp_position(call * stride);
        let (calls, period_s) = (ticks.div_ceil(stride), stride as f64 * step_s);
        let squares = (3..calls).map(|call| {
            let third = position(call) - 3.0 * position(call - 1) + 3.0 * position(call - 2)
                - position(call - 3);
            (third / (period_s * period_s * period_s)).norm_squared()
        });
        Some(Self {
            at_rest_s,
            work_j: (0..ticks).map(power).sum::<f64>() * step_s,
            peak_effort: shares
                .map(|(effort, limit)| effort.abs() / limit)
                .reduce(f64::max),
            jerk_m_s3: (squares.sum::<f64>() / (calls - 3) as f64).sqrt(),
        })
    }

    /// The figures there are: a short name, what it is called, the value, its unit.
    pub fn named(&self) -> Vec<(&'static str, &'static str, f64, &'static str)> {
        let all = [
            ("at-rest", "at rest after", self.at_rest_s, "s"),
            ("work", "work", Some(self.work_j), "J"),
            (
                "peak-effort",
                "peak effort",
                self.peak_effort.map(|share| 100.0 * share),
                "%",
            ),
            ("jerk", "jerk", Some(self.jerk_m_s3), "m/s^3"),
        ];
        let there = all.into_iter();
        there
            .filter_map(|(name, title, value, unit)| Some((name, title, value?, unit)))
            .collect()
    }

    /// A figure as people read it: `4.36 s`, `41 % of the limit`.
    pub fn shown(value: f64, unit: &str) -> String {
        match unit {
            "%" => format!("{value:.0} % of the limit"),
            "s" => with_unit(value, unit),
            "m/s^3" => format!("{} m/s³", short(value)),
            _ => format!("{} {unit}", short(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::sample::task_run;

    /// First differences by the step.
    fn slopes(values: &[f64], step_s: f64) -> Vec<f64> {
        values
            .windows(2)
            .map(|pair| (pair[1] - pair[0]) / step_s)
            .collect()
    }

    #[test]
    fn figures_are_what_their_definitions_give() {
        let run = task_run();
        let (trace, limits) = (&run.trace, [30.0, 15.0]);
        let figures = RunFigures::of(trace, 10, &limits).expect("a run");
        let (mut work, mut peak) = (0.0, 0.0_f64);
        for (joint, limit) in limits.into_iter().enumerate() {
            let speeds = trace.qd.component(joint);
            for (effort, speed) in trace.effort.component(joint).zip(speeds) {
                work += 0.001 * effort.abs() * speed.abs();
                peak = peak.max(effort.abs() / limit);
            }
        }
        assert!((figures.work_j - work).abs() < 1e-9 * work, "{figures:?}");
        let effort = figures.peak_effort.expect("limits");
        assert!((effort - peak).abs() < 1e-15 && peak <= 1.0, "{figures:?}");
        let jerks = [0, 1, 2].map(|axis| {
            let path: Vec<f64> = trace.tcp.component(axis).step_by(10).collect();
            slopes(&slopes(&slopes(&path, 0.01), 0.01), 0.01)
        });
        let squares = jerks.iter().flatten().map(|jerk| jerk * jerk);
        let jerk = (squares.sum::<f64>() / jerks[0].len() as f64).sqrt();
        // third differences by two ways: rounding of 1e-16 m, by 1e-9 s^3
        assert!(
            (figures.jerk_m_s3 - jerk).abs() < 1e-4 * jerk,
            "{figures:?} {jerk}"
        );
        // the arm stands at both places: it is at rest a while after the second move began, and from then on
        let at_rest = figures.at_rest_s.expect("it comes to rest");
        assert!((3.2..6.0).contains(&at_rest), "{figures:?}");
        let tick = (at_rest / 0.001).round() as usize;
        let fast = |tick: usize| trace.qd.at(tick).iter().any(|speed| speed.abs() >= 0.01);
        assert!(fast(tick - 1) && !(tick..trace.len()).any(fast));
    }

    #[test]
    fn what_a_run_does_not_have_is_left_out() {
        let run = task_run();
        let figures = RunFigures::of(&run.trace, 10, &[f64::INFINITY; 2]).expect("a run");
        assert_eq!(figures.peak_effort, None);
        let names: Vec<_> = figures.named().iter().map(|figure| figure.0).collect();
        assert_eq!(names, ["at-rest", "work", "jerk"]);
    }

    #[test]
    fn figures_are_shown_with_their_units() {
        for (value, unit, shown) in [
            (4.36, "s", "4.36 s"),
            (41.2, "%", "41 % of the limit"),
            (12.3456, "J", "12.35 J"),
            (35.26, "m/s^3", "35.26 m/s³"),
        ] {
            assert_eq!(RunFigures::shown(value, unit), shown);
        }
    }
}
