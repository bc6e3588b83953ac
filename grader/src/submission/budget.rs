//! What a script has used up, and what it printed and plotted.

use std::cell::{Cell, RefCell};

use rhai::Position;

use super::mistake::Problem;
use crate::controller::{Budget, Budgets, Place};

/// A built-in that walks over elements costs one operation for this many of them, which takes it about as long.
const ELEMENTS_PER_OPERATION: usize = 8;

/// Counts one task; shared by the engine and all built-ins.
#[derive(Debug)]
pub(super) struct Meter {
    budgets: Budgets,
    /// Operations of the calls before this one.
    spent: Cell<u64>,
    /// What this call may use.
    allowed: Cell<u64>,
    /// What the engine counted in this call.
    counted: Cell<u64>,
    /// What built-ins charged in this call beyond that.
    charged: Cell<u64>,
    /// The budget that ran out first.
    exhausted: Cell<Option<Budget>>,
    /// Where a built-in or an operator was last called.
    position: Cell<Position>,
    log: RefCell<Vec<String>>,
    log_lines: Cell<u64>,
    plots: RefCell<Vec<(String, f64)>>,
    plot_samples: Cell<u64>,
}

impl Meter {
    pub(super) fn new(budgets: Budgets) -> Self {
        Self {
            budgets,
            spent: Cell::new(0),
            allowed: Cell::new(0),
            counted: Cell::new(0),
            charged: Cell::new(0),
            exhausted: Cell::new(None),
            position: Cell::new(Position::NONE),
            log: RefCell::default(),
            log_lines: Cell::new(0),
            plots: RefCell::default(),
            plot_samples: Cell::new(0),
        }
    }

    /// Begins a call.
    pub(super) fn start(&self) {
        let left = self
            .budgets
            .operations_per_task
            .saturating_sub(self.spent.get());
        self.allowed.set(left.min(self.budgets.operations_per_call));
        self.counted.set(0);
        self.charged.set(0);
        self.exhausted.set(None);
        self.position.set(Position::NONE);
    }

    /// Ends a call and returns the operations it used.
    pub(super) fn finish(&self) -> u64 {
        let used = self.counted.get().saturating_add(self.charged.get());
        self.spent.set(self.spent.get().saturating_add(used));
        used
    }

    /// Takes over the engine's count; false if that is more than the call may use.
    pub(super) fn count(&self, counted: u64) -> bool {
        self.counted.set(counted);
        let used = counted.saturating_add(self.charged.get());
        let within = used <= self.allowed.get();
        if !within {
            self.note(self.operations_budget());
        }
        within
    }

    /// Charges a built-in for walking over `elements`.
    pub(super) fn charge(&self, elements: usize) -> Result<(), Problem> {
        if elements < ELEMENTS_PER_OPERATION {
            return Ok(());
        }
        let cost = (elements / ELEMENTS_PER_OPERATION) as u64;
        self.charged.set(self.charged.get().saturating_add(cost));
        if self.count(self.counted.get()) {
            Ok(())
        } else {
            Err(Problem::Exhausted(self.operations_budget()))
        }
    }

    /// Refuses a list, vector or matrix of more than the budget's elements, and charges for making it.
    pub(super) fn list(&self, elements: usize) -> Result<(), Problem> {
        self.charge(elements)?;
        self.within(Budget::ListSize, elements)
    }

    /// Refuses a text of more than the budget's bytes, and charges for making it.
    pub(super) fn text(&self, bytes: usize) -> Result<(), Problem> {
        self.charge(bytes)?;
        self.within(Budget::TextSize, bytes)
    }

    /// Refuses `amount` of something beyond its budget.
    pub(super) fn within(&self, budget: Budget, amount: usize) -> Result<(), Problem> {
        if amount as u64 <= self.limit(budget) {
            Ok(())
        } else {
            Err(self.exhaust(budget))
        }
    }

    /// Adds a line to the log.
    pub(super) fn print(&self, line: String) -> Result<(), Problem> {
        self.log_lines.set(self.log_lines.get() + 1);
        if self.log_lines.get() > self.budgets.log_lines {
            return Err(self.exhaust(Budget::LogLines));
        }
        self.log.borrow_mut().push(line);
        Ok(())
    }

    /// Adds a value to a signal.
    pub(super) fn plot(&self, name: String, value: f64) -> Result<(), Problem> {
        self.plot_samples.set(self.plot_samples.get() + 1);
        if self.plot_samples.get() > self.budgets.plot_samples {
            return Err(self.exhaust(Budget::PlotSamples));
        }
        self.plots.borrow_mut().push((name, value));
        Ok(())
    }

    /// Hands over what was printed and plotted since the last time.
    pub(super) fn take_output(&self) -> (Vec<String>, Vec<(String, f64)>) {
        (self.log.take(), self.plots.take())
    }

    /// The budget that ran out in this call.
    pub(super) fn exhausted(&self) -> Option<Budget> {
        self.exhausted.get()
    }

    /// Remembers where a built-in is called, because the engine counts some operations without a place.
    pub(super) fn at(&self, position: Position) {
        self.position.set(position);
    }

    /// Where a built-in was last called.
    pub(super) fn last_place(&self) -> Option<Place> {
        place(self.position.get())
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
            Budget::LogLines => budgets.log_lines,
            Budget::PlotSamples => budgets.plot_samples,
            Budget::SourceBytes => budgets.source_bytes,
        }
    }

    fn exhaust(&self, budget: Budget) -> Problem {
        self.note(budget);
        Problem::Exhausted(budget)
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

/// The engine's position as a place in the file.
pub(super) fn place(position: Position) -> Option<Place> {
    Some(Place {
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
        assert!(meter.count(5));
        assert!(!meter.count(6));
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
