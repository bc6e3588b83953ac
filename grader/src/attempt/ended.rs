//! How an attempt ended early: its verdict, and its record for people.

use kinemark_sim::diagnosis::Cause;
use kinemark_sim::run::DivergenceKind;
use kinemark_sim::text::CutLine;

use super::diverged::DivergedWords as _;
use crate::record::grade::Stopped;
use crate::record::names::Names;
use crate::record::verdict::Verdict;
use crate::submission::controller::{Budget, HostLimit, Namesake, Stop};
use crate::task::model::MotionTask;

/// How an attempt ended early.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// The tick of a motion task, or the index of the case of a function task.
    pub at: u64,
    /// The reason.
    pub why: EndReason,
    /// What the submission was doing.
    pub stage: Stage,
}

/// What a submission does when it ends early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Its file is read, and the statements outside of functions run.
    Reading,
    /// `init`, before the first tick.
    Init,
    /// A call in a tick or a case.
    Call,
}

/// Why an attempt ended early.
#[derive(Debug, Clone, PartialEq)]
pub enum EndReason {
    /// The submission was stopped.
    Stopped(Stop),
    /// A command or an answer has the wrong shape, or is not finite; in words.
    InvalidOutput(String),
    /// The simulation diverged.
    Diverged {
        /// What grew without bound.
        what: DivergenceKind,
        /// The likely cause, if one was found.
        cause: Option<Cause>,
    },
}

/// What a report may say about the end of an attempt. For hidden runs and cases that is neither a number nor the submission's words.
#[derive(Debug, Clone, Copy)]
pub enum Disclosure<'a> {
    /// Everything about a visible run.
    Run {
        /// Robot, scene and frame, for their names.
        names: Names<'a>,
        /// The task.
        task: &'a MotionTask,
    },
    /// Only the class of a hidden run.
    HiddenRun {
        /// The class.
        class: &'a str,
    },
    /// Everything about a visible case.
    Case {
        /// The case's name.
        name: &'a str,
    },
    /// Only the class of a hidden case.
    HiddenCase {
        /// The class.
        class: &'a str,
    },
}

impl EndReason {
    /// Whether one call failed, so that a run can go on with the last command.
    pub fn is_of_one_call(&self) -> bool {
        match self {
            Self::Stopped(stop) => is_of_one_call(stop),
            Self::InvalidOutput(_) => true,
            Self::Diverged { .. } => false,
        }
    }
}

impl Ended {
    /// The submission was stopped at `at`.
    pub fn stopped_by(stop: Stop, at: u64) -> Self {
        Self::because(EndReason::Stopped(stop), at)
    }

    /// The same in another stage.
    pub fn in_stage(self, stage: Stage) -> Self {
        Self { stage, ..self }
    }

    /// It ended at `at` for the reason `why`.
    pub fn because(why: EndReason, at: u64) -> Self {
        Self {
            at,
            why,
            stage: Stage::Call,
        }
    }

    /// The verdict of a task that ended this way; `None` if the user interrupted it.
    pub fn verdict(&self) -> Option<Verdict> {
        match &self.why {
            EndReason::Stopped(stop) => verdict_of(stop),
            EndReason::InvalidOutput(_) => Some(Verdict::InvalidOutput),
            EndReason::Diverged { .. } => Some(Verdict::Missed),
        }
    }

    /// What stopped the submission, if something did.
    pub fn stop(&self) -> Option<&Stop> {
        match &self.why {
            EndReason::Stopped(stop) => Some(stop),
            EndReason::InvalidOutput(_) | EndReason::Diverged { .. } => None,
        }
    }

    /// Whether the simulation diverged.
    pub fn is_diverged(&self) -> bool {
        matches!(self.why, EndReason::Diverged { .. })
    }

    /// The record of the end, with the student's line from `source`.
    pub fn record(&self, source: &str, disclosure: Disclosure<'_>) -> Stopped {
        if let Some(stop) = self.stop().filter(|stop| !is_of_one_call(stop)) {
            // it concerns the whole file or this machine, so it has no moment in the attempt
            return record_of(stop, source);
        }
        match disclosure {
            Disclosure::HiddenRun { class } => without_place(self.hidden_run_words(), class),
            Disclosure::HiddenCase { class } => without_place(self.hidden_case_words(), class),
            // no case and no tick has anything to do with it
            Disclosure::Case { .. } | Disclosure::Run { .. } if self.stage == Stage::Reading => {
                self.whole_record(source, None)
            }
            Disclosure::Case { name } => Stopped {
                case: Some(name.to_owned()),
                ..self.whole_record(source, None)
            },
            Disclosure::Run { names, task } if self.stage == Stage::Init => {
                let record = self.whole_record(source, Some((names, task)));
                Stopped {
                    message: format!("{} in `init`", record.message),
                    help: self.help_in_init().map(str::to_owned).or(record.help),
                    ..record
                }
            }
            Disclosure::Run { names, task } => Stopped {
                tick: Some(self.at),
                time_s: Some(task.periods.time_s(self.at)),
                ..self.whole_record(source, Some((names, task)))
            },
        }
    }

    /// The complete record, without its moment.
    fn whole_record(&self, source: &str, run: Option<(Names<'_>, &MotionTask)>) -> Stopped {
        let (message, help) = match &self.why {
            EndReason::Stopped(stop) => return record_of(stop, source),
            EndReason::InvalidOutput(what) => {
                let shape = || run.is_some().then(|| COMMAND_SHAPE.to_owned());
                (what.clone(), not_finite_help(what).or_else(shape))
            }
            EndReason::Diverged { what, cause } => match run {
                Some((names, task)) => {
                    let (message, help) = names.diverged(what, cause.as_ref(), task);
                    (message, Some(help))
                }
                None => ("the simulation diverged".to_owned(), None),
            },
        };
        Stopped {
            message,
            help,
            ..Stopped::default()
        }
    }

    /// What helps in `init` and nowhere else.
    fn help_in_init(&self) -> Option<&'static str> {
        let Some(Stop::OverBudget { budget, .. }) = self.stop() else {
            return None;
        };
        let is_of_operations = matches!(
            budget,
            Budget::OperationsPerCall
                | Budget::OperationsPerTask
                | Budget::InstructionsPerCall
                | Budget::InstructionsPerTask
        );
        is_of_operations.then_some(
            "look for a loop that does not end: `init` may take as many operations as a call of `control`",
        )
    }

    fn hidden_run_words(&self) -> &'static str {
        match &self.why {
            EndReason::Stopped(_) => "the submission failed in a hidden run",
            EndReason::InvalidOutput(_) => "no command, or one that is not finite, in a hidden run",
            EndReason::Diverged { .. } => "the simulation of a hidden run diverged",
        }
    }

    fn hidden_case_words(&self) -> &'static str {
        match &self.why {
            EndReason::Stopped(_) | EndReason::Diverged { .. } => {
                "the submission failed in a hidden case"
            }
            EndReason::InvalidOutput(_) => {
                "an answer of the wrong shape, or not finite, in a hidden case"
            }
        }
    }
}

/// How a command is returned.
const COMMAND_SHAPE: &str = "return one list with one number for each joint, [a, b], and no list in a list; of several solutions return one, such as `branches[0]`";

/// A record of a hidden run or case. It has neither the submission's words nor the line that fails, because a chain of comparisons
/// could reveal a hidden number through them.
fn without_place(message: &str, class: &str) -> Stopped {
    Stopped {
        message: message.to_owned(),
        case: Some(class.to_owned()),
        ..Stopped::default()
    }
}

/// The verdict of a task that was stopped by `stop`; `None` if the user interrupted it.
fn verdict_of(stop: &Stop) -> Option<Verdict> {
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

/// Whether a stop concerns one call, and not the whole file or the machine.
fn is_of_one_call(stop: &Stop) -> bool {
    match stop {
        Stop::Crashed(_) => true,
        Stop::OverBudget { budget, .. } => !matches!(
            budget,
            Budget::SourceBytes | Budget::ExpressionDepth | Budget::ModuleBytes
        ),
        Stop::DidNotBuild(_)
        | Stop::Missing { .. }
        | Stop::HostLimit(_)
        | Stop::GraderFault(_)
        | Stop::Interrupted => false,
    }
}

/// The record of a stop, with the student's line from `source`.
pub fn record_of(stop: &Stop, source: &str) -> Stopped {
    let (message, help, place) = match stop {
        Stop::DidNotBuild(mistake) | Stop::Crashed(mistake) => {
            (mistake.message.clone(), mistake.help.clone(), mistake.place)
        }
        Stop::Missing {
            function,
            help,
            namesake,
        } => (
            missing_words(function, *namesake),
            help.clone(),
            namesake.and_then(|namesake| namesake.place),
        ),
        Stop::OverBudget {
            budget,
            limit,
            place,
            function,
        } => (
            {
                let within = function
                    .as_ref()
                    .map_or_else(String::new, |name| format!(", in the function `{name}`"));
                match budget {
                    Budget::TextSize => {
                        format!("a string of more than {limit} characters{within}")
                    }
                    budget => format!("more than {limit} {}{within}", budget.name()),
                }
            },
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
            Some("this is not the submission's fault; please report it".to_owned()),
            None,
        ),
        Stop::Interrupted => ("interrupted".to_owned(), None, None),
    };
    let further = match stop {
        Stop::DidNotBuild(mistake) | Stop::Crashed(mistake) => mistake.further.clone(),
        _ => Vec::new(),
    };
    let line = place.and_then(|place| source.lines().nth(place.line.checked_sub(1)?));
    let quoted = line
        .zip(place)
        .map(|(line, place)| quoted(line, place.column));
    let column = place.map(|place| place.column);
    Stopped {
        message,
        help,
        further,
        line: place.map(|place| place.line),
        column,
        source_column: quoted
            .as_ref()
            .map(|(_, at)| *at)
            .filter(|at| Some(*at) != column),
        source_line: quoted.map(|(text, _)| text),
        ..Stopped::default()
    }
}

/// The words for a missing function, `function` with its parameters.
fn missing_words(function: &str, namesake: Option<Namesake>) -> String {
    let Some(namesake) = namesake else {
        return format!("the submission has no function `{function}`");
    };
    let name = function.split('(').next().unwrap_or(function);
    let parameters = match namesake.parameters {
        0 => "no parameters".to_owned(),
        1 => "1 parameter".to_owned(),
        count => format!("{count} parameters"),
    };
    format!(
        "`{name}` has {parameters}, the lab calls it with {}",
        namesake.wanted
    )
}

fn budget_help(budget: Budget) -> &'static str {
    match budget {
        Budget::OperationsPerCall | Budget::OperationsPerTask => {
            "look for a loop that does not end, or for work that can be done once in `init`"
        }
        Budget::InstructionsPerCall | Budget::InstructionsPerTask => {
            "look for a loop that does not end, for a value that grows and grows, or for work that can be done once in `init`"
        }
        Budget::InstructionsToRead => {
            "look for a loop outside of functions that does not end, or make the file shorter"
        }
        Budget::CallDepth => "look for a function that calls itself endlessly",
        Budget::ExpressionDepth => "take the expression apart with `let`",
        Budget::TextSize => "shorten the string: does a loop append to it?",
        Budget::ListSize | Budget::MapSize => {
            "keep less: what is not needed at the next call need not be kept"
        }
        Budget::SourceBytes => "a submission is one short file: leave out what is not used",
        Budget::ModuleBytes => {
            "build it optimised and without debug information: -O2 and -Wl,--strip-debug in C, `--release` in Rust"
        }
    }
}

/// What is quoted of a line of the submission, and where `column` is in that, both from one.
fn quoted(line: &str, column: usize) -> (String, usize) {
    let before = column.saturating_sub(1);
    let at = line.char_indices().nth(before);
    let at = at.map_or(line.len(), |(at, _)| at);
    let cut = CutLine::around(line, &[at]);
    let text = cut.text(str::to_owned);
    // a column behind the end of the line stays there
    let beyond = before.saturating_sub(line[..at].chars().count());
    let before = cut.before(at, str::to_owned).chars().count();
    (text, before + beyond + 1)
}

/// A hint on the origin of numbers that are not finite.
fn not_finite_help(message: &str) -> Option<String> {
    let shown = message.contains("NaN") || message.contains("infinity");
    shown.then(|| {
        "NaN comes from `acos` or `sqrt` of a number outside their range and from 0 / 0, infinity from a division by zero".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission::controller::{Mistake, SourcePosition};

    #[test]
    fn a_function_with_other_parameters_is_shown_where_it_is() {
        let stop = Stop::Missing {
            function: "control(observation)".into(),
            help: Some("write fn control(observation)".into()),
            namesake: Some(Namesake {
                parameters: 2,
                wanted: 1,
                place: Some(SourcePosition { line: 2, column: 4 }),
            }),
        };
        let record = record_of(&stop, "\nfn control(q, qd) { 1 }");
        assert_eq!(
            record.message,
            "`control` has 2 parameters, the lab calls it with 1"
        );
        assert_eq!(
            record.source_line.as_deref(),
            Some("fn control(q, qd) { 1 }")
        );
        assert_eq!(
            missing_words("init(robot, task)", None),
            "the submission has no function `init(robot, task)`"
        );
    }

    #[test]
    fn a_long_line_is_quoted_around_its_column() {
        let place = |column| {
            let place = Some(SourcePosition { line: 1, column });
            let mistake = Mistake {
                message: "no".to_owned(),
                place,
                help: None,
                further: Vec::new(),
            };
            let line = format!("{}x{}", "ä".repeat(5_000), "b".repeat(5_000));
            record_of(&Stop::Crashed(mistake), &line)
        };
        let stopped = place(5_001);
        assert_eq!((stopped.line, stopped.column), (Some(1), Some(5_001)));
        let quoted = stopped.source_line.clone().unwrap();
        let at = stopped.column_in_source_line().unwrap();
        assert_eq!(quoted.chars().nth(at - 1), Some('x'));
        assert!(quoted.chars().count() <= 162, "{quoted}");
        // at the beginning of a line nothing is left out before it
        let stopped = place(3);
        assert_eq!((stopped.source_column, stopped.column), (None, Some(3)));
        assert!(stopped.source_line.unwrap().ends_with("ä…"));
        let short = record_of(&missing_at(9), "fn control() {}");
        assert_eq!(short.source_line.as_deref(), Some("fn control() {}"));
        assert_eq!(short.column_in_source_line(), Some(9));
    }

    fn missing_at(column: usize) -> Stop {
        Stop::Missing {
            function: "control(observation)".into(),
            help: None,
            namesake: Some(Namesake {
                parameters: 0,
                wanted: 1,
                place: Some(SourcePosition { line: 1, column }),
            }),
        }
    }

    #[test]
    fn a_string_that_grows_is_reported_as_a_string() {
        let stop = Stop::OverBudget {
            budget: Budget::TextSize,
            limit: 4000,
            place: None,
            function: None,
        };
        let record = record_of(&stop, "");
        assert_eq!(record.message, "a string of more than 4000 characters");
        assert_eq!(
            record.help.as_deref(),
            Some("shorten the string: does a loop append to it?")
        );
    }
}
