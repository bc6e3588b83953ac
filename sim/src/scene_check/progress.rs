//! How far a check is, and how much work each of its stages may be: counted, so that it ends at the same point on every machine.

use crate::engine::WorkBudget;

/// The stages of a check, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Overlaps at the start.
    Overlaps,
    /// Bodies that do not stay where they start.
    Settling,
    /// Via points, and the lines between them.
    Via,
}

/// How far a check is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// The stage.
    pub stage: Stage,
    /// How many of its parts are done: physics steps, or via points and lines.
    pub done: u64,
    /// How many parts it has.
    pub of: u64,
}

/// Whoever wants to know how far a check is.
pub(super) type Watch<'a> = &'a mut dyn FnMut(Progress);

/// What the stages may cost.
#[derive(Debug, Clone)]
pub(super) struct Budgets {
    pub(super) overlaps: WorkBudget,
    pub(super) settling: WorkBudget,
    pub(super) via: WorkBudget,
}

impl Default for Budgets {
    /// About ten seconds for every thousand million units.
    fn default() -> Self {
        Self {
            overlaps: WorkBudget::new(1_000_000_000),
            settling: WorkBudget::new(2_000_000_000),
            via: WorkBudget::new(1_000_000_000),
        }
    }
}
