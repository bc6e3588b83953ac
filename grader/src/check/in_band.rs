//! A measured value judged in a band: what most kinds of checks are. A kind says what it measures; that it has a band, and what a
//! brief, a plot and a dwell take from that, is here.
//!
//! An end of the band of a run may depend on the value that the reference solution reaches in the same variant. Such a check is judged
//! once that value is known: [`MotionCheck::at_reference`].

use std::borrow::Cow;
use std::fmt::Debug;
use std::sync::Arc;

use kinemark_sim::text::Linear;
use kinemark_sim::text::number::trimmed;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::cases::Cases;
use super::contract::{FromReference, FunctionCheck, MotionCheck};
use super::facts::MotionFacts;
use super::finding::Finding;
use super::reading::Reading;
use crate::attempt::answers::CaseFacts;
use crate::record::quantity::end_of_band;
use crate::task::model::{Band, FunctionTask};
use crate::task::problem::{LabError, problems};

/// An end of the band of a run as typed: a number, or an expression over `reference`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(transparent)]
pub(crate) struct BandEnd(Linear);

/// In a schema it is a number: what every number of a lab file may be is added there.
impl JsonSchema for BandEnd {
    fn inline_schema() -> bool {
        f64::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        f64::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        f64::json_schema(generator)
    }
}

impl From<BandEnd> for Linear {
    fn from(end: BandEnd) -> Self {
        end.0
    }
}

problems! {
    /// Ends of a band over `reference` that are in no order.
    enum EndsProblem {
        Cross:
            "lab::band", "`full` may exceed `zero`, depending on what the reference solution reaches", "this band",
            "name `reference` in both ends, and let `zero` multiply it and add to it no less than `full`";
        NotRising { full: f64, zero: f64 }:
            "lab::band", "with `at_least` more is better: a band needs `full` above `zero`, got {full} and {zero}", "this band",
            "exchange the two numbers, or remove `at_least`";
        CrossRising:
            "lab::band", "with `at_least`, `zero` may exceed `full`, depending on what the reference solution reaches", "this band",
            "name `reference` in both ends, and let `full` multiply it and add to it no less than `zero`";
        OnlyRising { full: f64, zero: f64 }:
            "lab::band", "a band needs `full` at or below `zero`, got {full} and {zero}", "this band",
            "exchange the two numbers; or, if more is better in this check, add `at_least = true`";
    }
}

/// A measure with its band.
#[derive(Debug)]
pub(crate) struct InBand<M> {
    /// What earns all points, in the value of the reference.
    full: Linear,
    /// What earns none.
    zero: Linear,
    /// Whether more is better.
    at_least: bool,
    /// Unit of the band; empty for a ratio.
    unit: &'static str,
    measure: Arc<M>,
}

/// What a kind measures of a run.
pub(crate) trait RunMeasure: Debug + Send + Sync + 'static {
    /// The measured value in its band, with evidence, next step and curve.
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding;

    /// Whether the task's dwells are chosen by its band.
    fn judges_dwells(&self) -> bool {
        false
    }

    /// The path from which it measures the distance, if it does.
    fn path(&self) -> Option<&str> {
        None
    }

    /// Whether it compares the run with that of the reference solution.
    fn compares_runs(&self) -> bool {
        false
    }
}

/// What a kind measures of answers.
pub(crate) trait AnswerMeasure: Debug + Send + Sync + 'static {
    /// The measured value in the band of `cases`, with evidence and next step.
    fn judge(&self, cases: &Cases<'_>) -> Finding;

    /// Whether a single answer within the band is a good one.
    fn is_of_single_answers(&self) -> bool {
        true
    }

    /// What earns all points and what earns none, from the two ends of the band.
    fn bounds(&self, full: String, zero: String) -> [String; 2] {
        up_to(full, zero)
    }
}

fn up_to(full: String, zero: String) -> [String; 2] {
    [format!("up to {full}"), format!("from {zero}")]
}

fn from(full: String, zero: String) -> [String; 2] {
    [format!("from {full}"), format!("up to {zero}")]
}

impl<T> Reading<'_, T> {
    /// `measure` in the band `[full, zero]` of values in `unit`. `full` does not exceed `zero` whatever the reference reaches from 0 up.
    pub(super) fn in_band<M>(
        &self,
        [full, zero]: [impl Into<Linear>; 2],
        unit: &'static str,
        measure: M,
    ) -> Result<InBand<M>, LabError> {
        let (full, zero): (Linear, Linear) = (full.into(), zero.into());
        if full.is_of_later() || zero.is_of_later() {
            if full.plus > zero.plus || full.times > zero.times {
                return self.refuse(EndsProblem::Cross);
            }
        } else {
            self.report.band(full.plus, zero.plus, self.at.clone())?;
        }
        Ok(InBand {
            full,
            zero,
            at_least: false,
            unit,
            measure: Arc::new(measure),
        })
    }

    /// The same where the lab says whether more is better.
    pub(super) fn in_band_either<M>(
        &self,
        at_least: bool,
        [full, zero]: [BandEnd; 2],
        unit: &'static str,
        measure: M,
    ) -> Result<InBand<M>, LabError> {
        let (full, zero): (Linear, Linear) = (full.into(), zero.into());
        let is_of_reference = full.is_of_later() || zero.is_of_later();
        if !at_least {
            if !is_of_reference && full.plus > zero.plus {
                let (full, zero) = (full.plus, zero.plus);
                return self.refuse(EndsProblem::OnlyRising { full, zero });
            }
            return self.in_band([full, zero], unit, measure);
        }
        if is_of_reference {
            if zero.plus > full.plus || zero.times > full.times {
                return self.refuse(EndsProblem::CrossRising);
            }
        } else if !(zero.plus < full.plus && full.plus.is_finite() && zero.plus.is_finite()) {
            let (full, zero) = (full.plus, zero.plus);
            return self.refuse(EndsProblem::NotRising { full, zero });
        }
        Ok(InBand {
            full,
            zero,
            at_least,
            unit,
            measure: Arc::new(measure),
        })
    }
}

impl<M> InBand<M> {
    /// The band where it depends on no reference; else one of no width, in which nothing but the measured value is of use.
    fn numbers(&self) -> Band {
        if self.is_of_reference() {
            return Band::default();
        }
        Band {
            full: self.full.plus,
            zero: self.zero.plus,
        }
    }

    fn is_of_reference(&self) -> bool {
        self.full.is_of_later() || self.zero.is_of_later()
    }

    /// An end of the band in words.
    fn end(&self, end: Linear) -> String {
        if !end.is_of_later() {
            return end_of_band(end.plus, self.unit);
        }
        let times = trimmed(end.times, 4);
        let mut words = match times.as_str() {
            "1" => "the reference".to_owned(),
            _ => format!("{times} × the reference"),
        };
        if end.plus.abs() > 0.0 {
            let sign = if end.plus < 0.0 { "−" } else { "+" };
            words += &format!(" {sign} {}", end_of_band(end.plus.abs(), self.unit));
        }
        words
    }

    /// Both ends of the band, with their unit.
    fn ends(&self) -> (String, String) {
        (self.end(self.full), self.end(self.zero))
    }
}

impl<M: RunMeasure> MotionCheck for InBand<M> {
    fn bounds(&self) -> [String; 2] {
        let (full, zero) = self.ends();
        if self.at_least {
            from(full, zero)
        } else {
            up_to(full, zero)
        }
    }

    fn band(&self) -> Option<(Band, &'static str)> {
        (!self.is_of_reference()).then(|| (self.numbers(), self.unit))
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        self.measure.judge(facts, self.numbers())
    }

    fn dwell_band(&self) -> Option<Band> {
        let has_band = self.measure.judges_dwells() && !self.is_of_reference();
        has_band.then(|| self.numbers())
    }

    fn path_band(&self, path: &str) -> Option<Band> {
        let has_band = self.measure.path() == Some(path) && !self.is_of_reference();
        has_band.then(|| self.numbers())
    }

    fn reference_use(&self) -> FromReference {
        if self.measure.compares_runs() {
            FromReference::Run
        } else if self.is_of_reference() {
            FromReference::Value
        } else {
            FromReference::Nothing
        }
    }

    fn at_reference(&self, value: f64) -> Option<Arc<dyn MotionCheck>> {
        let [full, zero] = [self.full.at(value), self.zero.at(value)];
        let in_order = if self.at_least {
            zero < full
        } else {
            full <= zero
        };
        let is_band = full.is_finite() && zero.is_finite() && in_order;
        is_band.then(|| {
            let fixed: Arc<dyn MotionCheck> = Arc::new(Self {
                full: Linear::constant(full),
                zero: Linear::constant(zero),
                at_least: self.at_least,
                unit: self.unit,
                measure: Arc::clone(&self.measure),
            });
            fixed
        })
    }
}

impl<M: AnswerMeasure> FunctionCheck for InBand<M> {
    fn bounds(&self) -> [String; 2] {
        let (full, zero) = self.ends();
        self.measure.bounds(full, zero)
    }

    fn band(&self) -> Option<(Band, &'static str)> {
        Some((self.numbers(), self.unit))
    }

    fn judge(&self, task: &FunctionTask, cases: &[CaseFacts<'_>]) -> Finding {
        let (band, unit) = (self.numbers(), self.unit);
        self.measure.judge(&Cases {
            task,
            cases,
            band,
            unit,
        })
    }

    fn answer_band(&self) -> Option<Band> {
        self.measure.is_of_single_answers().then(|| self.numbers())
    }
}
