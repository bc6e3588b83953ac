//! What a stop means: its verdict, and its record for people.

use crate::record::grade::Stopped;
use crate::record::verdict::Verdict;
use crate::submission::controller::{Budget, HostLimit, Stop};

/// The verdict of a task that was stopped by `stop`; `None` where the person asked to stop.
pub fn verdict(stop: &Stop) -> Option<Verdict> {
    Some(match stop {
        Stop::DidNotBuild(_) => Verdict::DidNotBuild,
        Stop::Missing { .. } => Verdict::Missed,
        Stop::Crashed(_) => Verdict::Crashed,
        Stop::OverBudget { .. } => Verdict::OverBudget,
        Stop::HostLimit(_) => Verdict::HostLimit,
        Stop::GraderFault(_) => Verdict::GraderFault,
        Stop::Interrupted => return None,
    })
}

/// Whether a stop happened in one call: not to the whole file, and not to the machine.
pub fn is_of_one_call(stop: &Stop) -> bool {
    match stop {
        Stop::Crashed(_) => true,
        Stop::OverBudget { budget, .. } => {
            !matches!(budget, Budget::SourceBytes | Budget::ExpressionDepth)
        }
        Stop::DidNotBuild(_)
        | Stop::Missing { .. }
        | Stop::HostLimit(_)
        | Stop::GraderFault(_)
        | Stop::Interrupted => false,
    }
}

/// The record of a stop, with the student's line from `source`.
pub fn record(stop: &Stop, source: &str) -> Stopped {
    let (message, help, place) = match stop {
        Stop::DidNotBuild(mistake) | Stop::Crashed(mistake) => {
            (mistake.message.clone(), mistake.help.clone(), mistake.place)
        }
        Stop::Missing { function, help } => (
            format!("the submission has no function `{function}`"),
            help.clone(),
            None,
        ),
        Stop::OverBudget {
            budget,
            limit,
            place,
        } => (
            format!("more than {limit} {}", budget.name()),
            Some(budget_help(*budget).to_owned()),
            *place,
        ),
        Stop::HostLimit(limit) => (
            match limit {
                HostLimit::Time => "this machine ran out of time for the submission".to_owned(),
                HostLimit::Memory => "this machine ran out of memory for the submission".to_owned(),
            },
            Some("nothing is decided: grade it again, on a machine that is less busy".to_owned()),
            None,
        ),
        Stop::GraderFault(message) => (
            format!("the grader failed: {message}"),
            Some("this is no fault of the submission; please report it".to_owned()),
            None,
        ),
        Stop::Interrupted => ("interrupted".to_owned(), None, None),
    };
    Stopped {
        message,
        help,
        line: place.map(|place| place.line),
        column: place.map(|place| place.column),
        source_line: place
            .and_then(|place| source.lines().nth(place.line.checked_sub(1)?))
            .map(shortened),
        tick: None,
        time_s: None,
        case: None,
    }
}

fn budget_help(budget: Budget) -> &'static str {
    match budget {
        Budget::OperationsPerCall | Budget::OperationsPerTask => {
            "look for a loop that does not end, or for work that can be done once in `init`"
        }
        Budget::CallDepth => "look for a function that calls itself without an end",
        Budget::ExpressionDepth => "take the expression apart with `let`",
        Budget::ListSize | Budget::MapSize | Budget::TextSize => {
            "keep less: what is not needed at the next call need not be kept"
        }
        Budget::SourceBytes => "a submission is one short file: leave out what is not used",
    }
}

/// A line of the submission, cut where it would fill a screen.
fn shortened(line: &str) -> String {
    const LONGEST: usize = 200;
    if line.chars().count() > LONGEST {
        let start: String = line.chars().take(LONGEST).collect();
        format!("{start}…")
    } else {
        line.to_owned()
    }
}
