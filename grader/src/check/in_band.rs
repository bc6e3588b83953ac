//! A measured value judged in a band: what most kinds of checks are. A kind says what it measures; that it has a band, and what a
//! brief, a plot and a dwell take from that, is here.

use std::fmt::Debug;

use super::cases::Cases;
use super::contract::{FunctionCheck, MotionCheck};
use super::facts::MotionFacts;
use super::finding::Finding;
use super::reading::Reading;
use crate::attempt::answers::CaseFacts;
use crate::record::quantity::with_unit;
use crate::task::model::{Band, Function};
use crate::task::problem::LabError;

/// A measure with its band.
#[derive(Debug)]
pub(crate) struct InBand<M> {
    band: Band,
    /// Unit of the band; empty for a ratio.
    unit: &'static str,
    measure: M,
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

    /// As [`MotionCheck::follows_one_path`].
    fn follows_one_path(&self) -> bool {
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

impl<T> Reading<'_, T> {
    /// `measure` in the band `[full, zero]` of values in `unit`.
    pub(super) fn in_band<M>(
        &self,
        [full, zero]: [f64; 2],
        unit: &'static str,
        measure: M,
    ) -> Result<InBand<M>, LabError> {
        Ok(InBand {
            band: self.report.band(full, zero, self.at.clone())?,
            unit,
            measure,
        })
    }
}

impl<M> InBand<M> {
    /// Both ends of the band, with their unit.
    fn ends(&self) -> (String, String) {
        let Band { full, zero } = self.band;
        (with_unit(full, self.unit), with_unit(zero, self.unit))
    }
}

impl<M: RunMeasure> MotionCheck for InBand<M> {
    fn bounds(&self) -> [String; 2] {
        let (full, zero) = self.ends();
        up_to(full, zero)
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        self.measure.judge(facts, self.band)
    }

    fn dwell_band(&self) -> Option<Band> {
        self.measure.judges_dwells().then_some(self.band)
    }

    fn path_band(&self, path: &str) -> Option<Band> {
        (self.measure.path() == Some(path)).then_some(self.band)
    }

    fn follows_one_path(&self) -> bool {
        self.measure.follows_one_path()
    }
}

impl<M: AnswerMeasure> FunctionCheck for InBand<M> {
    fn bounds(&self) -> [String; 2] {
        let (full, zero) = self.ends();
        self.measure.bounds(full, zero)
    }

    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let (band, unit) = (self.band, self.unit);
        self.measure.judge(&Cases {
            function,
            cases,
            band,
            unit,
        })
    }

    fn answer_band(&self) -> Option<Band> {
        self.measure.is_of_single_answers().then_some(self.band)
    }
}
