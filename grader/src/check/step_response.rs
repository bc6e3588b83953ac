//! The step response of a joint as its checks see it: where it starts, where it ends, whether it got anywhere, and its curve with
//! the linear prediction.
//!
//! The signal is the joint's position or velocity at every tick. It *starts* at its value at tick 0; its *final value* is the mean over
//! the last `final_s`; its *step* is the one from start to final value. A joint that *hardly moved*, by less than 1 % of the way to
//! its target (or, without one, by less than 0.001), and one that *never settles*, with a tick of the final part further from
//! the final value than a share of the step, have no step response: they earn nothing.

use kinemark_sim::control::StepCurve;
use kinemark_sim::control::linear_step::Fed;
pub(super) use kinemark_sim::control::step_metrics::SETTLED;
use kinemark_sim::control::step_metrics::{LEAST_STEP, final_value};
use kinemark_sim::text::number::{seconds, trimmed};

use super::alternation;
use super::facts::MotionFacts;
use super::finding::{Finding, curve};
use super::shape::{self, Seen};
use super::step_keys::StepResponse;
use crate::record::grade::Evidence;
use crate::record::graded::{Curve, StepBackdrop};
use crate::task::model::Band;

/// A step response as measured.
pub(super) struct Response<'a> {
    pub(super) facts: &'a MotionFacts<'a>,
    pub(super) asked: &'a StepResponse,
    /// The signal at every tick.
    pub(super) values: Vec<f64>,
    pub(super) start: f64,
    /// The final value.
    pub(super) end: f64,
    /// First tick of the final part.
    pub(super) final_tick: usize,
}

/// Why points are lost, and what to do.
pub(super) struct Loss {
    pub(super) evidence: Evidence,
    pub(super) next_step: String,
    /// Whether it is a mistake that the run shows.
    pub(super) insists: bool,
}

/// What the linear loop would have done.
pub(super) struct Predicted {
    /// The signal at every tick.
    pub(super) values: Vec<f64>,
    /// Where it ends over the final part.
    pub(super) end: f64,
}

impl Predicted {
    /// Its response to a step from `start`.
    pub(super) fn curve(&self, start: f64) -> StepCurve<'_> {
        StepCurve {
            values: &self.values,
            start,
            end: self.end,
        }
    }
}

impl<'a> Response<'a> {
    pub(super) fn new(facts: &'a MotionFacts<'a>, asked: &'a StepResponse) -> Self {
        let signal = match asked.of {
            Fed::Position => &facts.trace.q,
            Fed::Velocity => &facts.trace.qd,
        };
        let values: Vec<f64> = signal.component(asked.joint).collect();
        let final_tick = values.len().saturating_sub(1 + asked.final_ticks);
        // a signal that is no number somewhere has no final value, and so earns nothing
        let end = if values.iter().all(|value| value.is_finite()) {
            final_value(&values, asked.final_ticks)
        } else {
            f64::NAN
        };
        Self {
            facts,
            asked,
            start: values.first().copied().unwrap_or(f64::NAN),
            end,
            values,
            final_tick,
        }
    }

    /// What is measured of it.
    pub(super) fn measured(&self) -> StepCurve<'_> {
        StepCurve {
            values: &self.values,
            start: self.start,
            end: self.end,
        }
    }

    pub(super) fn step(&self) -> f64 {
        self.measured().step()
    }

    pub(super) fn name(&self) -> &str {
        self.facts.joint_name(self.asked.joint)
    }

    /// The joint's signal in words.
    pub(super) fn what(&self) -> String {
        match self.asked.of {
            Fed::Position => format!("joint `{}`", self.name()),
            Fed::Velocity => format!("the velocity of joint `{}`", self.name()),
        }
    }

    /// A value of the signal with its unit.
    pub(super) fn with_unit(&self, value: f64) -> String {
        format!("{} {}", trimmed(value, 4), self.asked.unit())
    }

    /// Time of a tick and a part of one \[s\].
    pub(super) fn time_s(&self, ticks: f64) -> f64 {
        ticks * self.facts.motion.periods.step_s
    }

    /// Evidence at a tick.
    pub(super) fn evidence(&self, message: String, tick: usize) -> Evidence {
        let signal = format!("{}[{}]", self.asked.column(), self.asked.joint);
        Evidence {
            value: self
                .values
                .get(tick)
                .copied()
                .filter(|value| value.is_finite()),
            unit: self.asked.unit().to_owned(),
            ..self.facts.evidence(message, signal, tick)
        }
    }

    /// Why a time of `value_s`, which ends at `tick`, loses points in `band`.
    pub(super) fn late(
        &self,
        message: String,
        (value_s, tick): (f64, f64),
        band: Band,
        next_step: &str,
    ) -> Loss {
        let tick = (tick.max(0.0) as usize).min(self.values.len().saturating_sub(1));
        Loss {
            evidence: Evidence {
                value: value_s.is_finite().then_some(value_s),
                limit: Some(band.full),
                unit: "s".to_owned(),
                ..self.evidence(message, tick)
            },
            next_step: next_step.to_owned(),
            insists: false,
        }
    }

    /// Why points are lost, by what is seen.
    fn loss_of(&self, seen: Seen) -> Loss {
        Loss {
            evidence: self.evidence(seen.words, seen.tick),
            next_step: seen.next_step,
            insists: true,
        }
    }

    /// Why there is no step response to judge, if there is none: the joint hardly moved, or never settles.
    pub(super) fn fault(&self, tolerance: f64) -> Option<Loss> {
        self.stayed().or_else(|| self.unsettled(tolerance))
    }

    /// Whether the joint hardly moved.
    pub(super) fn stayed(&self) -> Option<Loss> {
        if self.measured().has_moved(self.asked.target) {
            return None;
        }
        if let Some(seen) = shape::seen(self) {
            return Some(self.loss_of(seen));
        }
        let asked = self.asked.target.map_or_else(String::new, |target| {
            format!("; {} was asked for", self.with_unit(target))
        });
        let message = if self.step().abs() < LEAST_STEP {
            format!(
                "{} ends where it began, at {}{asked}",
                self.what(),
                self.with_unit(self.end)
            )
        } else {
            format!(
                "{} is not at its target at the end: it starts at {} and ends at {}{asked}",
                self.what(),
                self.with_unit(self.start),
                self.with_unit(self.end)
            )
        };
        let last = self.values.len().saturating_sub(1);
        Some(Loss {
            evidence: self.evidence(message, last),
            next_step:
                "What does your `control` return for this joint, and which way does that drive it?"
                    .to_owned(),
            insists: true,
        })
    }

    /// Whether some tick of the final part is further than `tolerance` from the final value.
    pub(super) fn unsettled(&self, tolerance: f64) -> Option<Loss> {
        let part = &self.values[self.final_tick..];
        let last = self.measured().last_outside(tolerance);
        let tick = last.filter(|tick| *tick >= self.final_tick)?;
        let (mut low, mut high, mut turns) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for pair in part.windows(2) {
            (low, high) = (
                low.min(pair[0]).min(pair[1]),
                high.max(pair[0]).max(pair[1]),
            );
            if (pair[0] - self.end) * (pair[1] - self.end) < 0.0 {
                turns += 1;
            }
        }
        let length_s = self.time_s((part.len() - 1) as f64);
        let last_s = seconds(length_s);
        let [begins, ends] = [part[0], part[part.len() - 1]];
        let goes_one_way = low >= begins.min(ends) && high <= begins.max(ends);
        let mut message = format!(
            "{} never settles: in the last {last_s} it still goes from {} to {}",
            self.what(),
            self.with_unit(begins),
            self.with_unit(ends),
        );
        if !goes_one_way {
            message += &format!(
                ", and is between {} and {}",
                self.with_unit(low),
                self.with_unit(high)
            );
        }
        let mut next_step =
            "What still drives it at the end, and which term of your law gives that?".to_owned();
        // a swing passes the middle twice
        if turns >= 3 {
            message = format!(
                "{} never settles: in the last {last_s} it still swings between {} and {}, about {} times a second",
                self.what(),
                self.with_unit(low),
                self.with_unit(high),
                trimmed(0.5 * f64::from(turns) / length_s, 0)
            );
            next_step = match self.asked.of {
                Fed::Position => {
                    "Damp the swing: a stronger derivative, a smaller integral, or lower gains."
                }
                Fed::Velocity => {
                    "Which term of your law follows the swing? Feedback that is too strong overcorrects."
                }
            }
            .to_owned();
        }
        if let Some((why, help)) =
            alternation::explained(self.facts, self.asked.joint, self.final_tick)
        {
            message = format!("{message}; {why}");
            next_step = help;
        } else if let Some(seen) = shape::seen(self) {
            return Some(self.loss_of(seen));
        }
        Some(Loss {
            evidence: self.evidence(message, tick),
            next_step,
            insists: true,
        })
    }

    /// What the linear loop would have done, from the start to the target.
    pub(super) fn predicted(&self) -> Option<Predicted> {
        let (prediction, target) = (self.asked.prediction?, self.asked.target?);
        let step_s = self.facts.motion.periods.step_s;
        let mut values = prediction.response(step_s, self.values.len())?;
        for value in &mut values {
            *value = self.start + (target - self.start) * *value;
        }
        let end = final_value(&values, self.asked.final_ticks);
        Some(Predicted { values, end })
    }

    /// The curve of the run, with what is drawn beside it.
    pub(super) fn curve(
        &self,
        marks: Vec<(f64, String)>,
        band: Option<(f64, f64, String)>,
    ) -> Curve {
        let what = match self.asked.of {
            Fed::Position => "position",
            Fed::Velocity => "velocity",
        };
        let title = format!("{what} of joint `{}`", self.name());
        let ticks = 0..self.values.len();
        let t_s = ticks.map(|tick| self.facts.time_s(tick)).collect();
        Curve {
            marks,
            step: Some(StepBackdrop {
                prediction: self.predicted().map(|predicted| predicted.values),
                target: self.asked.target,
                band,
            }),
            ..curve(title, self.asked.unit(), t_s, self.values.clone(), None)
        }
    }

    /// What a check found where its `finding` holds the measured value: where there is no step response it insists on saying why, else
    /// `short` says why points are lost.
    pub(super) fn finding(
        finding: Finding,
        fault: Option<Loss>,
        short: impl FnOnce() -> Loss,
    ) -> Finding {
        let is_fault = fault.is_some();
        let loss = fault.or_else(|| finding.is_lost().then(short));
        let Some(loss) = loss else {
            return finding;
        };
        Finding {
            insists: is_fault || loss.insists,
            ..finding.with(loss.evidence).advise(loss.next_step)
        }
    }
}
