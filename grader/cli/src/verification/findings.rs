//! What a comparison finds: what differs, and what could not be compared.

use kinemark_report::visible::{shortened, visible};
use serde::Serialize;

/// Values of a record that are longer are cut where they are shown.
const MOST_SHOWN: usize = 300;

/// How a comparison ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Outcome {
    /// All was compared, and is the same.
    Same,
    /// Something differs.
    Differs,
    /// What could be compared is the same, and something could not.
    PartlyCompared,
}

/// What a difference is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Subject {
    Mode,
    Engine,
    /// The lab's own file, or what it says of the reference solution.
    Lab,
    Robot,
    Scene,
    Variant,
    Submission,
    /// The course staff's part.
    Reference,
    /// A run, or answers.
    Run,
    /// A value of the record.
    Record,
    File,
}

/// One thing that is not as recorded.
#[derive(Debug, Serialize)]
pub(super) struct Difference {
    pub(super) kind: Subject,
    pub(super) what: String,
    pub(super) task: Option<String>,
    /// The first simulated second that differs.
    pub(super) second: Option<usize>,
    /// The first signal of that second that differs.
    pub(super) signal: Option<&'static str>,
    pub(super) recorded: String,
    pub(super) now: String,
}

/// One thing that could not be compared.
#[derive(Debug, Serialize)]
pub(super) struct NotCompared {
    pub(super) what: String,
    pub(super) why: String,
}

/// All of them. Texts of a report are made visible here, whoever prints them.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) differences: Vec<Difference>,
    pub(super) not_compared: Vec<NotCompared>,
}

impl Difference {
    /// One that has no moment.
    pub(super) fn of(kind: Subject, what: &str, recorded: &str, now: &str) -> Self {
        Self {
            kind,
            what: shown(what),
            task: None,
            second: None,
            signal: None,
            recorded: shown(recorded),
            now: shown(now),
        }
    }

    /// One of a task.
    pub(super) fn in_task(self, task: &str) -> Self {
        let task = Some(shown(task));
        Self { task, ..self }
    }
}

fn shown(text: &str) -> String {
    shortened(text, MOST_SHOWN)
}

impl Findings {
    pub(super) fn differ(&mut self, difference: Difference) {
        self.differences.push(difference);
    }

    /// Adds a difference where there is one.
    pub(super) fn compare(&mut self, kind: Subject, what: &str, recorded: &str, now: &str) {
        if recorded != now {
            self.differ(Difference::of(kind, what, recorded, now));
        }
    }

    pub(super) fn leave_out(&mut self, what: &str, why: &str) {
        let [what, why] = [what, why].map(|text| visible(text).into_owned());
        self.not_compared.push(NotCompared { what, why });
    }

    /// Whether this was left out of the comparison.
    pub(super) fn leaves_out(&self, what: &str) -> bool {
        self.not_compared
            .iter()
            .any(|left_out| left_out.what == what)
    }

    pub(super) fn outcome(&self) -> Outcome {
        match (self.differences.is_empty(), self.not_compared.is_empty()) {
            (false, _) => Outcome::Differs,
            (true, false) => Outcome::PartlyCompared,
            (true, true) => Outcome::Same,
        }
    }
}
