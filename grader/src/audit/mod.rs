//! Proves a lab: the starter must miss, the reference solution must have full marks with any hidden cases, and every mutant must lose
//! points and be named.
//!
//! An [`Audit`] collects rows. A lab with several forms, such as variants, is audited form by form: each call takes the lab in one form
//! and the name of that form.

mod hidden_losses;
mod practice_file;
mod rubric;
mod staff_code;
mod variants;

use kinemark_sim::text::Source;
use serde::Serialize;

use self::hidden_losses::{hidden_losses, lines_of};
use crate::judge::grade;
use crate::lab::Lab;
use crate::lab::TaskWork;
use crate::lab::brief::{BEGIN, END, has_place_for_grading, with_numbers};
use crate::lab::staff::{Mutant, Staff};
use crate::record::grade::{Evidence, Grade, HiddenClass, Outcome, Stopped, TaskGrade};
use crate::record::graded::GradedRun;
use crate::record::quantity::points;
use crate::record::verdict::Verdict;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;

pub use self::hidden_losses::LostDraw;
pub use self::practice_file::{PracticeError, practice_forms};
pub use self::rubric::{Accepted, Doubt, Rubric, zeros};
pub use self::staff_code::staff_code;
pub use self::variants::{RelativeBand, VariantMargin, Variants};

/// The share of a lab's points that a starter may earn, for a warm-up task that it solves.
pub const MOST_STARTER_SHARE: f64 = 0.1;
/// Least number of mutants of a lab.
pub const LEAST_MUTANTS: usize = 6;
/// The share of a function task's cases in which a mutant must give a wrong answer.
pub const LEAST_SHARE: f64 = 0.3;

/// The parts of a lab that were tried, and their problems.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Audit {
    /// The lab.
    pub lab: String,
    /// Maximum points.
    pub max_points: f64,
    /// One row for each part that was tried, in order.
    pub rows: Vec<Row>,
    /// The margin of the reference solution in every band, over the variants that were tried; empty if none were.
    pub rooms: Vec<VariantMargin>,
}

/// The part of a lab that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tried {
    /// The brief.
    Brief,
    /// The starter.
    Starter,
    /// The reference solution.
    Reference,
    /// The file with what students get of the reference solution.
    Practice,
    /// The number of mutants.
    Mutants,
    /// A mutant in one task.
    Mutant,
    /// The rubric itself, by one rule.
    Rubric,
}

impl Tried {
    /// Its word in tables and records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brief => "brief",
            Self::Starter => "starter",
            Self::Reference => "reference",
            Self::Practice => "practice",
            Self::Mutants => "mutants",
            Self::Mutant => "mutant",
            Self::Rubric => "rubric",
        }
    }
}

/// The result for one part of a lab.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The part.
    pub tried: Tried,
    /// The form of the lab or the name of the mutant; empty if there is only one.
    pub name: String,
    /// The task, if the row is about one.
    pub task: Option<String>,
    /// Points earned, if something was graded.
    pub points: Option<f64>,
    /// Maximum points.
    pub max_points: Option<f64>,
    /// The problem; `null` if there is none.
    pub problem: Option<String>,
    /// What to do about the problem.
    pub help: Option<String>,
    /// The hidden cases and runs in which points were lost, if that is the problem.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hidden: Vec<LostDraw>,
}

/// What is wrong with a part of a lab.
struct Problem {
    what: String,
    help: String,
    /// The hidden cases and runs in which it shows.
    hidden: Vec<LostDraw>,
}

impl<H: Into<String>> From<(String, H)> for Problem {
    fn from((what, help): (String, H)) -> Self {
        Self {
            what,
            help: help.into(),
            hidden: Vec::new(),
        }
    }
}

impl Audit {
    /// An audit without rows.
    pub fn new(lab: &Lab) -> Self {
        Self {
            lab: lab.name.clone(),
            max_points: lab.tasks.iter().map(|task| task.max_points()).sum(),
            rows: Vec::new(),
            rooms: Vec::new(),
        }
    }

    /// The number of rows with a problem.
    pub fn problems(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.problem.is_some())
    }

    fn add(
        &mut self,
        (tried, name): (Tried, &str),
        task: Option<&str>,
        earned: Option<(f64, f64)>,
        problem: Option<impl Into<Problem>>,
    ) {
        let (mut what, mut help, mut hidden) = (None, None, Vec::new());
        if let Some(problem) = problem.map(Into::into) {
            (what, help) = (Some(problem.what), Some(problem.help));
            hidden = problem.hidden;
        }
        self.rows.push(Row {
            tried,
            name: name.to_owned(),
            task: task.map(str::to_owned),
            points: earned.map(|earned| earned.0),
            max_points: earned.map(|earned| earned.1),
            problem: what,
            help,
            hidden,
        });
    }

    /// Checks the brief: it exists, its numbers can be computed for every variant, its formulas can be drawn (`formula` is what is wrong
    /// with one, in words), and it marks the position of the table of points.
    pub fn brief(&mut self, lab: &Lab, brief: Option<&str>, formula: Option<&str>) {
        let problem = match brief.map(|brief| (brief, with_numbers(brief, lab))) {
            None => Some((
                "there is no brief.md".to_owned(),
                "write the brief next to lab.toml: `kinemark new` copies it for students",
            )),
            Some((_, Err(why))) => Some((
                format!("brief.md: {why}"),
                "a mark is `<!-- = expression -->`, right after the number that it computes",
            )),
            Some((_, Ok(_))) if let Some(why) = formula => Some((
                format!("brief.md: {why}"),
                "a formula is LaTeX between `$` and `$`, or `$$` and `$$`; a dollar sign is `\\$`",
            )),
            Some((brief, Ok(_))) if !has_place_for_grading(brief) => Some((
                format!(
                    "brief.md has no place for the table of points: `{BEGIN}` with `{END}` after it"
                ),
                "write the two marks, each on a line, where the table should be",
            )),
            Some((_, Ok(_))) => None,
        };
        self.add((Tried::Brief, ""), None, None, problem);
    }

    /// Tries the starter: it must run, earn almost nothing, and be diagnosed with no mistake.
    pub fn starter(&mut self, lab: &Lab, staff: &Staff, starter: &Source) -> Option<Grade> {
        let GradedRun { grade, .. } = graded(lab, staff, starter)?;
        let failed = grade
            .tasks
            .iter()
            .find(|task| !matches!(task.verdict, Verdict::Passed | Verdict::Missed));
        let most = MOST_STARTER_SHARE * grade.max_points;
        let named = grade.tasks.iter().find(|task| !task.diagnoses.is_empty());
        let problem = if let Some(task) = failed {
            let help = "a starter runs as it is, and misses";
            let problem = stop_problem(lab, staff, task, starter, help);
            let what = format!("task `{}`: {}", task.name, problem.what);
            Some(Problem { what, ..problem })
        } else if grade.points > most {
            let what = format!(
                "{} points for nothing done, and at most {} may be",
                points(grade.points),
                points(most)
            );
            let help = "let the checks that it passes need one that it fails";
            Some(Problem::from((what, help)))
        } else {
            named.map(|task| {
                let what = format!(
                    "task `{}` is diagnosed with the mistake `{}`",
                    task.name, task.diagnoses[0].mistake
                );
                Problem::from((
                    what,
                    "a starter makes no mistake yet: change it or the mutant",
                ))
            })
        };
        let earned = Some((grade.points, grade.max_points));
        self.add((Tried::Starter, ""), None, earned, problem);
        Some(grade)
    }

    /// Looks into the starter of a compiled language, which is not built here: it should define what the tasks call. `defines` says
    /// whether it defines a function of this name.
    pub fn compiled_starter(&mut self, lab: &Lab, file: &str, defines: &dyn Fn(&str) -> bool) {
        let missing = lab.tasks.iter().find_map(|task| {
            let function = match &task.work {
                TaskWork::Function(function, _) => function.name(),
                TaskWork::Motion(..) => "control",
            };
            (!defines(function)).then_some((function, &task.name))
        });
        let problem = missing.map(|(function, task)| {
            let what = format!("{file} does not define `{function}`, which task `{task}` calls");
            let help = "write every function that the tasks call, as the starter in Rhai does; or remove the file: students then get \
                        one with these functions";
            (what, help)
        });
        self.add((Tried::Starter, file), None, None, problem);
    }

    /// Tries the reference solution in the form `form` of the lab.
    pub fn reference(&mut self, lab: &Lab, staff: &Staff, form: &str) -> Option<GradedRun> {
        let run = graded(lab, staff, &staff.solution)?;
        let grade = &run.grade;
        let lost = grade
            .tasks
            .iter()
            .find(|task| task.verdict != Verdict::Passed);
        // points may be lost because of it
        let unresolved = grade.tasks.iter().find_map(unresolved_problem);
        let problem = unresolved.or_else(|| lost.map(|task| reference_problem(lab, staff, task)));
        let earned = Some((grade.points, grade.max_points));
        self.add((Tried::Reference, form), None, earned, problem);
        Some(run)
    }

    /// Tries every mutant in each of its tasks: it must lose points, show in enough cases, and be named.
    pub fn mutants(&mut self, lab: &Lab, staff: &Staff) -> Vec<Grade> {
        let count = staff.mutants.len();
        let few = (count < LEAST_MUTANTS).then(|| {
            let what = format!("{count} mutants, and a lab needs at least {LEAST_MUTANTS}");
            (what, "add what students really do wrong to mutants.toml")
        });
        self.add((Tried::Mutants, ""), None, None, few);
        let mutants = staff.mutants.iter();
        mutants
            .filter_map(|mutant| self.mutant(lab, staff, mutant))
            .collect()
    }

    /// Tries one mutant; its grade in its own tasks.
    pub fn mutant(&mut self, lab: &Lab, staff: &Staff, mutant: &Mutant) -> Option<Grade> {
        // run only the tasks of the mutant
        let mut part = lab.clone();
        part.tasks.retain(|task| mutant.tasks.contains(&task.name));
        let GradedRun { grade, .. } = graded(&part, staff, &mutant.source)?;
        for task in &grade.tasks {
            let earned = Some((task.points, task.max_points));
            let problem = mutant_problem(lab, staff, task, mutant);
            self.add(
                (Tried::Mutant, &mutant.name),
                Some(&task.name),
                earned,
                problem,
            );
        }
        Some(grade)
    }
}

/// The grade of a submission of the course staff, which runs in this process.
fn graded(lab: &Lab, staff: &Staff, submission: &Source) -> Option<GradedRun> {
    // nobody can interrupt this host
    grade(
        lab,
        Some(staff),
        &Submission::from(submission),
        &mut InProcess,
    )
    .ok()
}

/// The grade of a submission that answers zeros.
pub fn grade_of_zeros(lab: &Lab, staff: &Staff) -> Option<Grade> {
    let source = Source::new("zeros.rhai", zeros(lab));
    graded(lab, staff, &source).map(|run| run.grade)
}

/// What is wrong where the reference solution does not pass `task`.
fn reference_problem(lab: &Lab, staff: &Staff, task: &TaskGrade) -> Problem {
    let name = &task.name;
    if task.stopped.is_some() {
        let help = "mend the solution: it runs, and has full marks";
        let problem = stop_problem(lab, staff, task, &staff.solution, help);
        let what = format!("task `{name}`: {}", problem.what);
        return Problem { what, ..problem };
    }
    let hidden = hidden_losses(lab, staff, name, &staff.solution);
    let (loss, lines) = (loss_of(task), lines_of(&hidden));
    Problem {
        what: format!("task `{name}` loses points: {loss}{lines}"),
        help: mending(task),
        hidden,
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
    Some(Problem::from((what, help)))
}

/// What is wrong where a submission of the course staff was stopped in `task`: in a hidden case or run, with its numbers and its line.
fn stop_problem(
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
        hidden,
    }
}

fn mutant_problem(lab: &Lab, staff: &Staff, task: &TaskGrade, mutant: &Mutant) -> Option<Problem> {
    if task.verdict == Verdict::Passed {
        let what = "loses no point".to_owned();
        return Some((what, "narrow the band, or add cases in which it shows").into());
    }
    if !matches!(task.verdict, Verdict::Missed | Verdict::InvalidOutput) {
        let help = "a mutant runs to its end, and is wrong";
        return Some(stop_problem(lab, staff, task, &mutant.source, help));
    }
    shown_and_named(task, mutant).map(Into::into)
}

/// What is wrong where a mutant that ran to its end shows in too few cases, or is not named.
fn shown_and_named(task: &TaskGrade, mutant: &Mutant) -> Option<(String, &'static str)> {
    let hidden = |of: fn(&HiddenClass) -> u32| -> usize {
        task.hidden.iter().map(|class| of(class) as usize).sum()
    };
    let total = task.cases.len() + hidden(|class| class.total);
    let good = task.cases.iter().filter(|case| case.good).count() + hidden(|class| class.good);
    let wrong = total - good;
    if total > 0 && (wrong as f64) < LEAST_SHARE * total as f64 {
        let what = format!("shows in {wrong} of {total} cases only");
        return Some((
            what,
            "add cases in which it shows, or leave the task out of it",
        ));
    }
    match task.diagnoses.as_slice() {
        [found] if found.mistake == mutant.name => None,
        [other, ..] => Some((
            format!("is diagnosed as `{}`", other.mistake),
            "two mistakes with the same results are one: leave one out",
        )),
        [] => Some((
            "is not named".to_owned(),
            "it differs too little from the solution, or does the same as another mistake: see docs/lab-format.md, how diagnoses are decided",
        )),
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
fn place_of(stopped: &Stopped, source: &Source) -> String {
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

/// Why a task lost points, in the words of its checks.
fn loss_of(task: &TaskGrade) -> String {
    let lost = task
        .checks
        .iter()
        .find(|check| check.outcome != Outcome::Full);
    // what hidden cases and runs cost is listed by itself
    let is_of_hidden = |fact: &Evidence| {
        let of_all_runs = fact.signal == "control" && fact.tick.is_none() && fact.run.is_none();
        let class = |class: &HiddenClass| fact.case.as_ref() == Some(&class.class);
        of_all_runs || task.hidden.iter().any(class)
    };
    lost.map_or_else(String::new, |check| {
        let mut evidence = check.evidence.iter();
        let why = evidence.find(|fact| !is_of_hidden(fact));
        let why = why.map(|fact| &fact.message);
        match why {
            Some(why) => format!("{} ({why})", check.title),
            None => check.title.clone(),
        }
    })
}

/// Whether a lab has tasks whose hidden cases depend on the salt.
pub fn depends_on_salt(lab: &Lab) -> bool {
    let is_function = |work: &TaskWork| matches!(work, TaskWork::Function(..));
    lab.tasks.iter().any(|task| is_function(&task.work))
}
