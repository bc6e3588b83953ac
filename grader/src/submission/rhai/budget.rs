//! The meter of a script: used budgets, and printed and plotted output.

use std::cell::{Cell, RefCell};

use rhai::Position;

use super::copies;
use super::mistake::Problem;
use crate::submission::controller::{Budget, Budgets, Said, SourcePosition};
use crate::submission::output::Output;

/// A built-in that processes elements is charged one operation for this many of them, which takes about as long.
const ELEMENTS_PER_OPERATION: usize = 8;

/// What the engine only looks at is charged one operation for this many, after the first ones, which are free.
const PARTS_PER_OPERATION: usize = 16;
const FREE_PARTS: usize = 64;

/// Copies of vectors are charged this often, in operations.
const COPIES_EVERY: u64 = 64;

/// The most operations of one round of a loop: what is longer ago belongs to code before the loop.
const RECENT: u64 = 500;

/// Counts one task; shared by the engine and all built-ins.
#[derive(Debug)]
pub(super) struct Meter {
    budgets: Budgets,
    /// Operations of the calls before this one.
    spent: Cell<u64>,
    /// Operations that this call may use.
    allowed: Cell<u64>,
    /// The engine's count, which continues from call to call, and [`Self::more`].
    counted: Cell<u64>,
    /// The same when this call began.
    counted_before: Cell<u64>,
    /// Operations that are counted here because the engine does not see them.
    more: Cell<u64>,
    /// Operations charged by built-ins in this call, in addition to the engine's count.
    charged: Cell<u64>,
    /// The budget that ran out first.
    exhausted: Cell<Option<Budget>>,
    /// Position of the last call of a built-in or an operator.
    position: Cell<Position>,
    /// The engine's count at that call.
    counted_there: Cell<u64>,
    /// Origin of the first NaN of this call.
    not_a_number: RefCell<Option<String>>,
    output: RefCell<Output>,
}

impl Meter {
    pub(super) fn new(budgets: Budgets) -> Self {
        Self {
            output: RefCell::new(Output::new(&budgets)),
            budgets,
            spent: Cell::new(0),
            allowed: Cell::new(0),
            counted: Cell::new(0),
            counted_before: Cell::new(0),
            more: Cell::new(0),
            charged: Cell::new(0),
            exhausted: Cell::new(None),
            position: Cell::new(Position::NONE),
            counted_there: Cell::new(0),
            not_a_number: RefCell::default(),
        }
    }

    /// Begins a call.
    pub(super) fn start(&self) {
        let left = self
            .budgets
            .operations_per_task
            .saturating_sub(self.spent.get());
        self.allowed.set(left.min(self.budgets.operations_per_call));
        self.counted_before.set(self.counted.get());
        self.charged.set(0);
        // discard copies by another script on this thread, or by this one between calls
        copies::take();
        self.exhausted.set(None);
        self.not_a_number.take();
        self.position.set(Position::NONE);
    }

    /// Ends a call and returns the operations it used.
    pub(super) fn finish(&self) -> u64 {
        let used = self.used();
        self.spent.set(self.spent.get().saturating_add(used));
        used
    }

    /// Updates the engine's count; false if the call has used more than it may.
    pub(super) fn count(&self, by_the_engine: u64) -> bool {
        self.advance(by_the_engine + self.more.get())
    }

    /// Counts one operation that the engine does not see.
    pub(super) fn count_one(&self) -> Result<(), Problem> {
        self.more.set(self.more.get() + 1);
        self.within_operations(self.counted.get() + 1)
    }

    /// Updates the count; false if the call has used more than it may.
    fn advance(&self, counted: u64) -> bool {
        self.counted.set(counted);
        if (counted - self.counted_before.get()).is_multiple_of(COPIES_EVERY) {
            // a copy of a vector takes about as long as an operation; the few that every call makes are free
            let copies = copies::take().saturating_sub(COPIES_EVERY as usize);
            self.charged.set(self.charged.get() + copies as u64);
        }
        let within = self.used() <= self.allowed.get();
        if !within {
            self.note(self.operations_budget());
        }
        within
    }

    /// Operations of this call.
    fn used(&self) -> u64 {
        (self.counted.get() - self.counted_before.get()).saturating_add(self.charged.get())
    }

    /// Charges a built-in a number of operations.
    pub(super) fn operations(&self, cost: u64) -> Result<(), Problem> {
        self.charged.set(self.charged.get().saturating_add(cost));
        self.within_operations(self.counted.get())
    }

    fn within_operations(&self, counted: u64) -> Result<(), Problem> {
        if self.advance(counted) {
            Ok(())
        } else {
            Err(Problem::Exhausted)
        }
    }

    /// Takes back operations that the engine has counted for what no script says.
    pub(super) fn uncount(&self, operations: u64) {
        let before = self.counted_before.get();
        self.counted_before.set(before.saturating_add(operations));
    }

    /// Charges for what the engine does with each of `parts` in less time than with an element: comparing, looking, stepping over it.
    pub(super) fn glance(&self, parts: usize) -> Result<(), Problem> {
        if parts < FREE_PARTS {
            return Ok(());
        }
        self.operations((parts / PARTS_PER_OPERATION) as u64)
    }

    /// Charges a built-in for walking over `elements`.
    pub(super) fn charge(&self, elements: usize) -> Result<(), Problem> {
        if elements < ELEMENTS_PER_OPERATION {
            return Ok(());
        }
        self.operations((elements / ELEMENTS_PER_OPERATION) as u64)
    }

    /// Refuses a list, vector or matrix of more than the budget's elements, and charges for making it.
    pub(super) fn list(&self, elements: usize) -> Result<(), Problem> {
        self.within(Budget::ListSize, elements)?;
        self.charge(elements)
    }

    /// Refuses a text of more than the budget's bytes, and charges for making it.
    pub(super) fn text(&self, bytes: usize) -> Result<(), Problem> {
        self.within(Budget::TextSize, bytes)?;
        self.charge(bytes)
    }

    /// Refuses `amount` of something beyond its budget.
    pub(super) fn within(&self, budget: Budget, amount: usize) -> Result<(), Problem> {
        if amount as u64 <= self.limit(budget) {
            Ok(())
        } else {
            Err(self.exhaust(budget))
        }
    }

    /// Adds a line to the log, printed by the built-in that is called now.
    pub(super) fn print(&self, text: String) {
        let line = self.last_place().map(|place| place.line);
        self.output.borrow_mut().print(text, line);
    }

    /// Adds a value to a signal.
    pub(super) fn plot(&self, name: String, value: f64) {
        self.output.borrow_mut().plot(name, value);
    }

    /// Remembers the first NaN of a call.
    pub(super) fn note_not_a_number(&self, words: impl FnOnce() -> String) {
        let mut noted = self.not_a_number.borrow_mut();
        if noted.is_none() {
            let place = self.last_place();
            let line = place.map_or_else(String::new, |place| format!("line {}: ", place.line));
            *noted = Some(format!("{line}{}", words()));
        }
    }

    /// Adds the likely origin of a NaN answer to the log.
    pub(super) fn log_not_a_number(&self) {
        if let Some(note) = self.not_a_number.take() {
            self.output.borrow_mut().note(note);
        }
    }

    /// Takes the output since the last time.
    pub(super) fn take_output(&self) -> Said {
        self.output.borrow_mut().take()
    }

    /// The budget that ran out in this call.
    pub(super) fn exhausted(&self) -> Option<Budget> {
        self.exhausted.get()
    }

    /// Remembers the position of a built-in's call, because the engine counts some operations without a position.
    pub(super) fn at(&self, position: Position) {
        self.position.set(position);
        self.counted_there.set(self.counted.get());
    }

    /// Position of the last call of a built-in.
    pub(super) fn last_place(&self) -> Option<SourcePosition> {
        place(self.position.get())
    }

    /// The same if it was called a moment ago: a loop without built-ins can have run since then, in another function.
    pub(super) fn recent_place(&self) -> Option<SourcePosition> {
        let since = self.counted.get().saturating_sub(self.counted_there.get());
        self.last_place().filter(|_| since <= RECENT)
    }

    pub(super) fn limit(&self, budget: Budget) -> u64 {
        let budgets = &self.budgets;
        match budget {
            Budget::OperationsPerCall => budgets.operations_per_call,
            Budget::OperationsPerTask => budgets.operations_per_task,
            Budget::CallDepth => budgets.call_depth,
            Budget::ExpressionDepth => budgets.expression_depth,
            Budget::ListSize => budgets.list_size,
            Budget::TextSize => budgets.text_size,
            Budget::MapSize => budgets.map_size,
            Budget::SourceBytes => budgets.source_bytes,
            Budget::InstructionsPerCall => budgets.instructions_per_call,
            Budget::InstructionsPerTask => budgets.instructions_per_task,
            Budget::ModuleBytes => budgets.module_bytes,
            Budget::InstructionsToRead => budgets.python_instructions_to_read(),
        }
    }

    fn exhaust(&self, budget: Budget) -> Problem {
        self.note(budget);
        Problem::Exhausted
    }

    fn note(&self, budget: Budget) {
        if self.exhausted.get().is_none() {
            self.exhausted.set(Some(budget));
        }
    }

    /// Which of the two budgets of operations bounds this call.
    fn operations_budget(&self) -> Budget {
        if self.allowed.get() < self.budgets.operations_per_call {
            Budget::OperationsPerTask
        } else {
            Budget::OperationsPerCall
        }
    }
}

/// The engine's position as one in the submission.
pub(super) fn place(position: Position) -> Option<SourcePosition> {
    Some(SourcePosition {
        line: position.line()?,
        column: position.position().unwrap_or(1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meter(per_call: u64, per_task: u64) -> Meter {
        let meter = Meter::new(Budgets {
            operations_per_call: per_call,
            operations_per_task: per_task,
            ..Budgets::default()
        });
        meter.start();
        meter
    }

    #[test]
    fn the_smaller_of_the_two_operation_budgets_is_named() {
        let meter = meter(10, 15);
        assert!(meter.count(10));
        assert_eq!(meter.finish(), 10);
        meter.start();
        // the engine's own count goes on
        assert!(meter.count(15));
        assert!(!meter.count(16));
        assert_eq!(meter.exhausted(), Some(Budget::OperationsPerTask));
    }

    #[test]
    fn charges_and_counts_add_up() {
        let meter = meter(10, 1000);
        assert!(meter.charge(40).is_ok());
        assert!(meter.count(5));
        assert!(!meter.count(6));
        assert_eq!(meter.exhausted(), Some(Budget::OperationsPerCall));
    }
}
