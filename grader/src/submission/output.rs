//! What a submission prints and plots in a task, up to its budgets.

use super::controller::{Budgets, PrintedLine, Said};

/// Longest name of a signal in characters, so that it fits a legend, and fifty thousand of them fit in memory.
pub(super) const LONGEST_SIGNAL_NAME: usize = 64;

/// Whether a signal can have this name.
pub(super) fn is_signal_name(name: &str) -> bool {
    !name.is_empty() && name.chars().count() <= LONGEST_SIGNAL_NAME
}

/// The output of one task. Above the budgets it only adds a note, once: printing must not end the run.
#[derive(Debug, Default)]
pub(super) struct Output {
    most_lines: u64,
    most_samples: u64,
    lines: u64,
    samples: u64,
    said: Said,
}

impl Output {
    pub(super) fn new(budgets: &Budgets) -> Self {
        Self {
            most_lines: budgets.log_lines,
            most_samples: budgets.plot_samples,
            ..Self::default()
        }
    }

    /// Adds a line to the log, with the line of the script that printed it.
    pub(super) fn print(&mut self, text: String, line: Option<usize>) {
        self.lines = self.lines.saturating_add(1);
        let most = self.most_lines;
        if self.lines <= most {
            self.said.log.push(PrintedLine { text, line });
        } else if self.lines == most + 1 {
            self.note(format!(
                "more than {most} lines are printed: the rest is not kept"
            ));
        }
    }

    /// Adds a line that the host has to say, which counts for no budget.
    pub(super) fn note(&mut self, text: String) {
        self.said.log.push(PrintedLine { text, line: None });
    }

    /// Adds a value to a signal.
    pub(super) fn plot(&mut self, name: String, value: f64) {
        self.samples = self.samples.saturating_add(1);
        let most = self.most_samples;
        if self.samples <= most {
            self.said.plots.push((name, value));
        } else if self.samples == most + 1 {
            self.note(format!(
                "more than {most} values are plotted: the rest is not kept"
            ));
        }
    }

    /// Takes the output since the last time.
    pub(super) fn take(&mut self) -> Said {
        std::mem::take(&mut self.said)
    }
}
