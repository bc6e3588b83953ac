//! The one import of a kind's file: what a table is read with, and what a judgement is made of.

pub(super) use kinemark_sim::text::number::{list, metres, seconds, trimmed};
pub(super) use kinemark_sim::trace::Trace;
pub(super) use schemars::JsonSchema;
pub(super) use serde::Deserialize;

pub(super) use super::cases::{
    CaseScore, Cases, WrongAnswer, distinct_texts, no_answer, without_answer,
};
pub(super) use super::contract::{FunctionCheck, MotionCheck};
pub(super) use super::dwell::Dwell;
pub(super) use super::facts::MotionFacts;
pub(super) use super::finding::{Finding, curve, measure};
pub(super) use super::in_band::{AnswerMeasure, BandEnd, InBand, RunMeasure};
pub(super) use super::reading::{At, FunctionReading, MotionReading};
pub(super) use super::registry::{FunctionTable, MotionTable, lacks_goals};
pub(super) use super::signal::{Statistic, greatest};
pub(super) use crate::attempt::answers::{Answered, CaseError, CaseFacts};
pub(super) use crate::record::grade::Evidence;
pub(super) use crate::record::graded::Curve;
pub(super) use crate::record::quantity::with_unit;
pub(super) use crate::task::joint_units::JointUnits;
pub(super) use crate::task::model::{Band, Function, MotionTask, Rows};
pub(super) use crate::task::problem::{LabError, near, problems};
