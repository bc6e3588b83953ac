//! What is kept of a mutant's whole run, for comparisons with many submissions: little enough to keep those of all mutants.

use std::cmp::Ordering;

use kinemark_sim::trace::Trace;

use super::settled::Settled;
use crate::attempt::{Attempt, Ended};
use crate::task::model::MotionTask;

/// An arm that moves less than this, or is commanded nothing, shows no mistake that differs from others \[rad or m\].
const STILL: f64 = 0.01;

/// What comparisons need of a mutant's whole run.
#[derive(Debug, Clone, PartialEq)]
pub struct MutantRun {
    /// Joint positions at every control tick, one after the other.
    q: Vec<f64>,
    joints: usize,
    ended: Option<Ended>,
    /// Whether it does not move, or commands nothing.
    pub(super) is_still: bool,
    settled: Settled,
}

impl MutantRun {
    /// Of a run of `motion`.
    pub fn of(motion: &MotionTask, run: &Attempt<Trace>) -> Self {
        let trace = &run.recorded;
        let every = motion.periods.ticks_per_control.get() as usize;
        let ticks = (0..trace.len()).step_by(every);
        let settled = match motion.goals.is_empty() {
            true => Settled::default(),
            false => Settled::of(motion, trace),
        };
        Self {
            q: ticks.flat_map(|tick| trace.q.at(tick)).copied().collect(),
            joints: trace.q.width(),
            ended: run.ended.clone(),
            is_still: is_still(run),
            settled,
        }
    }

    pub(super) fn positions(&self) -> Positions<'_> {
        Positions::Row(&self.q, self.joints)
    }

    /// How it ended early, if it did.
    pub fn ended(&self) -> Option<&Ended> {
        self.ended.as_ref()
    }
}

impl AsRef<Settled> for MutantRun {
    fn as_ref(&self) -> &Settled {
        &self.settled
    }
}

/// Joint positions at control ticks.
#[derive(Clone, Copy)]
pub(super) enum Positions<'a> {
    /// Of a trace; and the ticks between two of its control ticks.
    Trace(&'a Trace, usize),
    /// One after the other; and the numbers of each.
    Row(&'a [f64], usize),
}

impl Positions<'_> {
    pub(super) fn count(self) -> usize {
        match self {
            Self::Trace(trace, every) => trace.len().div_ceil(every),
            Self::Row(q, joints) => q.len() / joints.max(1),
        }
    }

    pub(super) fn at(&self, row: usize) -> &[f64] {
        match self {
            Self::Trace(trace, every) => trace.q.at(row * every),
            Self::Row(q, joints) => &q[row * joints..(row + 1) * joints],
        }
    }
}

/// Whether an arm did not move from its start, or was commanded nothing.
pub(super) fn is_still(run: &Attempt<Trace>) -> bool {
    let trace = &run.recorded;
    if trace.is_empty() {
        return true;
    }
    let start = trace.q.at(0);
    let moved = (0..trace.len()).any(|tick| {
        let pairs = trace.q.at(tick).iter().zip(start);
        pairs.map(|(q, start)| (q - start).abs()).any(|moved| {
            // NaN counts as moved
            moved.partial_cmp(&STILL) != Some(Ordering::Less)
        })
    });
    let commanded =
        (0..trace.len()).any(|tick| trace.command.at(tick).iter().any(|c| c.abs() > 0.0));
    !(moved && commanded)
}
