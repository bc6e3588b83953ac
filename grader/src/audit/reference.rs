//! The reference solution in one form of the lab: it has full marks, or each check in which it has not is a problem with its numbers.

use kinemark_sim::text::Source;
use kinemark_sim::text::number::seconds;

use super::form::{Form, Found};
use super::hidden_losses::{LostDraw, hidden_losses, lines_of};
use super::row::{Problem, Row, Tried};
use crate::judge::{Examined, SolutionEnd, solution_end};
use crate::lab::{Lab, Staff};
use crate::record::grade::{CheckGrade, Evidence, Grade, HiddenClass, Outcome, Stopped, TaskGrade};
use crate::record::verdict::Verdict;

impl Form<'_> {
    /// Tries the reference solution, with the rows under `name`.
    pub fn reference(&self, name: &str) -> Found {
        let (Some(grade), problems) = self.solved() else {
            return Found::default();
        };
        let earned = Some((grade.points, grade.max_points));
        Found {
            rows: Row::all((Tried::Reference, name), earned, problems),
            grade: Some(grade),
        }
    }

    /// The grade of the reference solution, and what is wrong with it.
    pub(super) fn solved(&self) -> (Option<Grade>, Vec<Problem>) {
        let Some(Examined { graded, .. }) = self.examined(&self.staff.solution) else {
            return (None, Vec::new());
        };
        let grade = graded.grade;
        // points may be lost because of it
        let unresolved: Vec<Problem> = grade.tasks.iter().filter_map(unresolved_problem).collect();
        let problems = if unresolved.is_empty() {
            let lost = grade.tasks.iter();
            let lost = lost.filter(|task| task.verdict != Verdict::Passed);
            lost.flat_map(|task| reference_problems(self.lab, self.staff, task))
                .collect()
        } else {
            unresolved
        };
        (Some(grade), problems)
    }
}

/// What is wrong where the reference solution does not pass `task`: how it was stopped, or a problem for each check that lost points.
fn reference_problems(lab: &Lab, staff: &Staff, task: &TaskGrade) -> Vec<Problem> {
    let name = &task.name;
    if let (Verdict::GraderFault, Some(end)) = (task.verdict, solution_end(lab, staff, name)) {
        return vec![end_problem(staff, name, &end)];
    }
    if task.stopped.is_some() {
        let help = "mend the solution: it runs, and has full marks";
        let problem = stop_problem(lab, staff, task, &staff.solution, help);
        let what = format!("task `{name}`: {}", problem.what);
        return vec![Problem { what, ..problem }];
    }
    let hidden = hidden_losses(lab, staff, name, &staff.solution);
    let is_judged = |check: &&CheckGrade| check.outcome != Outcome::NotJudged;
    // what was not judged follows from what was lost
    let lost = task.checks.iter().filter(is_judged);
    let lost = lost.filter(|check| check.outcome != Outcome::Full);
    let problems = lost.map(|check| {
        let is_its = |loss: &&LostDraw| loss.check.as_ref() == Some(&check.name);
        let hidden: Vec<LostDraw> = hidden.iter().filter(is_its).cloned().collect();
        let (loss, lines) = (loss_of(task, check), lines_of(&hidden));
        Problem {
            what: format!("task `{name}` loses points: {loss}{lines}"),
            help: mending(task),
            key: format!("{name}/{}", check.name),
            task: Some(name.clone()),
            check: Some(check.name.clone()),
            shows_in: Vec::new(),
            hidden,
        }
    });
    problems.collect()
}

/// What is wrong where the reference solution stops in a run, so that nobody can be compared with it.
fn end_problem(staff: &Staff, task: &str, end: &SolutionEnd) -> Problem {
    let SolutionEnd { run, stopped } = end;
    let at = stopped
        .time_s
        .map_or_else(String::new, |time_s| format!(" at {}", seconds(time_s)));
    let place = place_of(stopped, &staff.solution);
    let what = format!(
        "task `{task}`: in {run} the reference solution stops{at}: {}{place}",
        stopped.message
    );
    let help = stopped.help.clone().unwrap_or_else(|| {
        "mend the solution, or the numbers of this run: a goal or a path may be out of reach with them".to_owned()
    });
    Problem {
        key: format!("{task}: stops in a run"),
        task: Some(task.to_owned()),
        ..Problem::from((what, help))
    }
}

/// What is wrong where the simulation of the reference solution's run in `task` is not accurate.
fn unresolved_problem(task: &TaskGrade) -> Option<Problem> {
    // a run that diverged has its own words
    let event = task.first_unresolved().filter(|_| task.stopped.is_none())?;
    let what = format!(
        "the simulation of task `{}` is not accurate from {} s on: {}",
        task.name, event.time_s, event.message
    );
    let help =
        "shorten the physics step or the servo period of the task, or lower the servo's gains";
    Some(Problem {
        key: format!("{}: not accurate", task.name),
        task: Some(task.name.clone()),
        ..Problem::from((what, help))
    })
}

/// What is wrong where a submission of the course staff was stopped in `task`: in a hidden case or run, with its numbers and its line.
pub(super) fn stop_problem(
    lab: &Lab,
    staff: &Staff,
    task: &TaskGrade,
    source: &Source,
    help: &str,
) -> Problem {
    let stopped = task.stopped.as_ref();
    let place = stopped.map_or_else(String::new, |stopped| place_of(stopped, source));
    let mut what = format!("{}{place}", stop_of(task));
    let mut hidden = Vec::new();
    let class = stopped.and_then(|stopped| stopped.case.as_ref());
    if task.hidden.iter().any(|known| Some(&known.class) == class) {
        hidden = hidden_losses(lab, staff, &task.name, source);
        hidden.retain(|lost| lost.check.is_none());
        what += &lines_of(&hidden);
    }
    Problem {
        what,
        help: help.to_owned(),
        key: format!(
            "{}: {} {:?}",
            task.name,
            task.verdict.name(),
            stopped.and_then(|stopped| stopped.line)
        ),
        task: Some(task.name.clone()),
        check: None,
        shows_in: Vec::new(),
        hidden,
    }
}

/// Why a task was stopped, or its verdict.
fn stop_of(task: &TaskGrade) -> String {
    match &task.stopped {
        Some(stopped) => format!("{}: {}", task.verdict.name(), stopped.message),
        None => task.verdict.name().to_owned(),
    }
}

/// The position at which a submission of the course staff stopped: file, line and column, and below them the line with a caret.
pub(super) fn place_of(stopped: &Stopped, source: &Source) -> String {
    let (Some(line), Some(text)) = (stopped.line, &stopped.source_line) else {
        return String::new();
    };
    let column = stopped.column.unwrap_or(1);
    let before = stopped.column_in_source_line().unwrap_or(1);
    let indent = " ".repeat(before.saturating_sub(1));
    format!(
        "\n    {}:{line}:{column}\n    {text}\n    {indent}^",
        source.name()
    )
}

/// What may be wrong where the reference solution loses points in `task`.
fn mending(task: &TaskGrade) -> String {
    let places = "the band, or the solution";
    let class = task.hidden.iter().find(|class| class.good < class.total);
    if let Some(class) = class {
        let class = &class.class;
        return format!(
            "mend what is wrong: the class \"{class}\" in hidden.toml, a visible case in lab.toml, {places}"
        );
    }
    if task.cases.iter().any(|case| !case.good) {
        return format!("mend what is wrong: a visible case in lab.toml, {places}");
    }
    "widen the band, or mend the solution".to_owned()
}

/// Why `check` of `task` lost points, in its words and with its number.
fn loss_of(task: &TaskGrade, check: &CheckGrade) -> String {
    // what hidden cases and runs cost is listed by itself
    let is_of_hidden = |fact: &Evidence| {
        let of_all_runs = fact.signal == "control" && fact.tick.is_none() && fact.run.is_none();
        let class = |class: &HiddenClass| fact.case.as_ref() == Some(&class.class);
        of_all_runs || task.hidden.iter().any(class)
    };
    let mut evidence = check.evidence.iter();
    let why = evidence.find(|fact| !is_of_hidden(fact));
    match why {
        Some(why) => format!("{} ({})", check.title, why.message),
        None => check.title.clone(),
    }
}
