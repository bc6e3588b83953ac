//! Work, counted: what a step or a look costs, in units that are the same on every machine. What costs too much ends at the same point
//! everywhere, whatever a clock says.
//!
//! A unit is about ten nanoseconds on a processor of 2024. The costs are measured ones, rounded, so that a bound on the work is a bound
//! on the time.

/// A look at a pair of boxes, or at a ray and a box.
pub(crate) const LOOK: u64 = 1;
/// A dynamic body in a step of the engine.
pub(super) const BODY: u64 = 50;
/// A pair of shapes that are near each other in a step of the engine.
pub(super) const PAIR: u64 = 30;
/// A patch at which a pair touches, or soon may: its points and their constraints.
pub(super) const PATCH: u64 = 100;
/// A visit of a point while impulses are settled.
pub(super) const VISIT: u64 = 5;
/// A pair of shapes whose contact is looked at without a step.
pub(super) const CONTACT: u64 = 100;
/// A hull with so many vertices makes a pair cost as much again: each is looked at for each support point.
pub(super) const HULL_VERTICES: usize = 256;
/// An amount of work that may be done.
#[derive(Debug, Clone)]
pub struct WorkBudget {
    left: u64,
}

impl WorkBudget {
    /// So many units.
    pub fn new(units: u64) -> Self {
        Self { left: units }
    }

    /// Takes `units` from it; what is more than is left leaves nothing.
    pub fn spend(&mut self, units: u64) {
        self.left = self.left.saturating_sub(units);
    }

    /// Whether nothing is left.
    pub fn is_spent(&self) -> bool {
        self.left == 0
    }
}
