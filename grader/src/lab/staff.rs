//! What staff have beside the lab: hidden cases, known mistakes, the reference solution. Never in what students get.

use kinemark_sim::robot::Dimension;
use kinemark_sim::source::{Source, suggest};
use toml::Spanned;

use super::draw::{Draw, Drawn, parameters};
use super::file::{DrawTable, HiddenRunsTable, HiddenTable, MutantsTable, Ranges, RangesTable};
use super::files::Files;
use super::load::{Reporter, read, tables};
use super::model::{Case, Function, FunctionTask, Given, Lab, TaskWork};
use super::problem::{LabError, LoadError};

/// The staff's part of a lab.
#[derive(Debug, Clone)]
pub struct Staff {
    /// The reference solution.
    pub solution: Source,
    /// Known mistakes, as submissions.
    pub mutants: Vec<Mutant>,
    /// Hidden cases by task.
    hidden: Vec<(String, Vec<Case>)>,
    /// Hidden runs by task.
    runs: Vec<(String, Vec<HiddenRun>)>,
    /// BLAKE3 over all of it, salt included.
    pub digest: blake3::Hash,
    /// What digests of hidden parts are keyed by.
    key: [u8; 32],
}

/// A motion task that is run again with other numbers.
#[derive(Debug, Clone)]
pub struct HiddenRun {
    /// All that students are told of it.
    pub class: String,
    /// The lab with its numbers.
    pub lab: Lab,
}

/// A known mistake: a submission that makes it, and what to tell a student who does.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// Its name, which is its file's.
    pub name: String,
    /// The tasks in which it shows.
    pub tasks: Vec<String>,
    /// The mistake in words.
    pub says: String,
    /// The submission.
    pub source: Source,
}

impl Staff {
    /// Loads the staff's part of `lab`; `None` where there is none. `salt` replaces the file's.
    ///
    /// # Errors
    /// [`LoadError`] if something in its files is wrong.
    pub fn load(
        files: &dyn Files,
        lab: &Lab,
        salt: Option<&str>,
    ) -> Result<Option<Self>, LoadError> {
        let folder = &lab.name;
        let Some(solution) = read(files, &format!("{folder}/solution.rhai"))? else {
            return Ok(None);
        };
        let mut hasher = blake3::Hasher::new();
        let mut digest = |source: &Source| {
            hasher.update(&(source.text().len() as u64).to_le_bytes());
            hasher.update(source.text().as_bytes());
        };
        digest(&solution);
        let mut hidden = Vec::new();
        let mut runs: Vec<(String, Vec<HiddenRun>)> = Vec::new();
        // without hidden.toml nothing is hidden, and nothing keyed
        let mut key = [0; 32];
        let hidden_path = format!("{folder}/hidden.toml");
        let hidden_source = read(files, &hidden_path)?;
        let has_functions = lab
            .tasks
            .iter()
            .any(|task| matches!(task.work, TaskWork::Function(_)));
        if has_functions && hidden_source.is_none() {
            return Err(LoadError::Unreadable {
                path: format!("{}/{hidden_path}", files.name()),
                why: "there is no such file, and function tasks need hidden cases".to_owned(),
            });
        }
        if let Some(source) = hidden_source {
            digest(&source);
            let table: HiddenTable = tables(&source)?;
            let report = Reporter { source: &source };
            report.format(&table.format)?;
            let own = own_salt(report, &table)?;
            let salt = salt.unwrap_or(own);
            digest(&Source::new("salt", salt));
            key = blake3::derive_key("kinemark 2026 digests of hidden parts v1", salt.as_bytes());
            for typed in &table.runs {
                let task = typed.get_ref().task.get_ref().clone();
                runs.push((task, hidden_runs(report, lab, salt, typed)?));
            }
            for draw in &table.draws {
                let at = draw.span();
                let draw = checked(report, lab, draw)?;
                let mut cases = draw.cases(salt, lab);
                if let Err(why) = expect(lab, &draw.task, &mut cases, &solution) {
                    return Ok(report.err(
                        at,
                        "staff::solution",
                        why,
                        "what is expected here is what the solution answers",
                        Some("correct `solution.rhai`, or draw other numbers".to_owned()),
                    )?);
                }
                match hidden.iter_mut().find(|(task, _)| *task == draw.task) {
                    Some((_, all)) => {
                        let all: &mut Vec<Case> = all;
                        all.extend(cases);
                    }
                    None => hidden.push((draw.task, cases)),
                }
            }
        }
        let mut mutants = Vec::new();
        if let Some(source) = read(files, &format!("{folder}/mutants.toml"))? {
            digest(&source);
            let table: MutantsTable = tables(&source)?;
            let report = Reporter { source: &source };
            report.format(&table.format)?;
            for mutant in table.mutants {
                for task in &mutant.tasks {
                    known_task(report, lab, task)?;
                }
                let name = mutant.name.get_ref().clone();
                let path = format!("{folder}/mutants/{name}.rhai");
                let Some(submission) = read(files, &path)? else {
                    return Ok(report.err(
                        mutant.name.span(),
                        "staff::no_mutant",
                        format!("there is no file `{path}`"),
                        "this mutant",
                        Some("a mutant's name is its file's name without `.rhai`".to_owned()),
                    )?);
                };
                digest(&submission);
                mutants.push(Mutant {
                    name,
                    tasks: mutant.tasks.into_iter().map(Spanned::into_inner).collect(),
                    says: mutant.says,
                    source: submission,
                });
            }
        }
        Ok(Some(Self {
            solution,
            mutants,
            hidden,
            runs,
            digest: hasher.finalize(),
            key,
        }))
    }

    /// A digest over hidden answers or runs as the record tells it: keyed by the salt, so that nobody without it can try out which
    /// hidden numbers give it.
    pub(crate) fn keyed(&self, digest: blake3::Hash) -> blake3::Hash {
        blake3::keyed_hash(&self.key, digest.as_bytes())
    }

    /// The salt of the course for `lab`: `replacing`, or that of its `hidden.toml`; `None` where there is neither.
    ///
    /// # Errors
    /// [`LoadError`] if `hidden.toml` is wrong.
    pub fn salt(
        files: &dyn Files,
        lab: &str,
        replacing: Option<&str>,
    ) -> Result<Option<String>, LoadError> {
        if let Some(salt) = replacing {
            return Ok(Some(salt.to_owned()));
        }
        let Some(source) = read(files, &format!("{lab}/hidden.toml"))? else {
            return Ok(None);
        };
        let table: HiddenTable = tables(&source)?;
        let salt = own_salt(Reporter { source: &source }, &table)?;
        Ok(Some(salt.to_owned()))
    }

    /// The hidden runs of a task.
    pub fn runs(&self, task: &str) -> Vec<&HiddenRun> {
        let of_task = self.runs.iter().filter(|(name, _)| name == task);
        of_task.flat_map(|(_, runs)| runs).collect()
    }

    /// The hidden cases of a task.
    pub fn hidden(&self, task: &str) -> &[Case] {
        let found = self.hidden.iter().find(|(name, _)| name == task);
        found.map_or(&[], |(_, cases)| cases)
    }
}

/// The salt of a `hidden.toml`, which is not empty.
fn own_salt<'t>(report: Reporter<'_>, table: &'t HiddenTable) -> Result<&'t str, LabError> {
    if table.salt.get_ref().trim().is_empty() {
        return report.err(
            table.salt.span(),
            "staff::salt",
            "the salt is empty: anyone could compute the hidden numbers".to_owned(),
            "no secret",
            Some("write a text that nobody guesses".to_owned()),
        );
    }
    Ok(table.salt.get_ref())
}

/// Refuses a class without a name: it is all that students are told.
fn named(
    report: Reporter<'_>,
    code: &'static str,
    class: &Spanned<String>,
) -> Result<(), LabError> {
    if !class.get_ref().trim().is_empty() {
        return Ok(());
    }
    let message = "the class is empty, and it is all that students are told".to_owned();
    let help = Some("say in a few words what is different, such as \"unequal links\"".to_owned());
    report.err(class.span(), code, message, "no words", help)
}

/// Refuses a range whose low end is above its high one.
fn rising(
    report: Reporter<'_>,
    code: &'static str,
    at: std::ops::Range<usize>,
    name: &str,
    ranges: &[[f64; 2]],
) -> Result<(), LabError> {
    match ranges.iter().find(|[low, high]| low > high) {
        None => Ok(()),
        Some([low, high]) => report.err(
            at,
            code,
            format!("a range of `{name}` goes from {low} down to {high}"),
            "the wrong way round",
            Some(format!("write [{high}, {low}]: a range is [low, high]")),
        ),
    }
}

/// [`rising`] for ranges by name.
fn all_rising(
    report: Reporter<'_>,
    code: &'static str,
    table: &RangesTable,
) -> Result<(), LabError> {
    let mut all = table.iter();
    all.try_for_each(|(name, at)| rising(report, code, at.span(), name, at.get_ref().all()))
}

/// Lets the solution answer the cases of a free function: what it says is what is expected, entry by entry as in visible cases.
fn expect(lab: &Lab, task: &str, cases: &mut [Case], solution: &Source) -> Result<(), String> {
    let mut tasks = lab.tasks.iter();
    let Some(task) = tasks.find(|known| known.name == task) else {
        return Ok(());
    };
    let TaskWork::Function(FunctionTask {
        function: function @ Function::Free(_),
        cases: visible,
        ..
    }) = &task.work
    else {
        return Ok(());
    };
    let Some(Given::Values {
        expected: names, ..
    }) = visible.first().map(|case| &case.given)
    else {
        return Ok(());
    };
    let answers = crate::grading::answers(lab, task, function, cases, solution)?;
    for (case, answer) in cases.iter_mut().zip(answers) {
        if let Given::Values { expected, .. } = &mut case.given {
            *expected = crate::answer::named_entries(&answer, names)
                .map_err(|what| format!("`{}` of the solution returned {what}", function.name()))?;
        }
    }
    Ok(())
}

/// The runs of one `[[runs]]` table, each a lab of its own.
fn hidden_runs(
    report: Reporter<'_>,
    lab: &Lab,
    salt: &str,
    spanned: &Spanned<HiddenRunsTable>,
) -> Result<Vec<HiddenRun>, LabError> {
    let table = spanned.get_ref();
    let refuse = |message: String, help: &str| {
        let help = Some(help.to_owned());
        report.err(spanned.span(), "staff::runs", message, "these runs", help)
    };
    let TaskWork::Motion(_) = known_task(report, lab, &table.task)? else {
        return refuse(
            format!("task `{}` is no motion task", table.task.get_ref()),
            "hidden cases of function tasks are [[draws]]",
        );
    };
    if table.count == 0 || table.count > MOST_RUNS {
        return refuse(
            format!(
                "there are 1 to {MOST_RUNS} hidden runs of a class, got {}",
                table.count
            ),
            "change `count`",
        );
    }
    let task = lab
        .tasks
        .iter()
        .find(|task| task.name == *table.task.get_ref());
    let mut checks = task.into_iter().flat_map(|task| &task.checks);
    if let Some(check) = checks.find(|check| check.kind.follows_one_path()) {
        return refuse(
            format!(
                "check `{}` compares with one path, and every run has its own",
                check.name
            ),
            "judge the task by goals or a path of its own instead",
        );
    }
    named(report, "staff::runs", &table.class)?;
    let ranges = table.parameters.get_ref();
    if ranges.is_empty() {
        return report.err(
            table.parameters.span(),
            "staff::runs",
            "a hidden run without other numbers is the visible run again".to_owned(),
            "nothing is drawn",
            Some("give parameters, such as { can_y = [0.95, 1.05] }".to_owned()),
        );
    }
    all_rising(report, "staff::runs", ranges)?;
    for (name, ranges) in ranges {
        let fits = match (lab.parameters.get(name), ranges.get_ref()) {
            (Some(Dimension::Number(_)), Ranges::One(_)) => true,
            (Some(Dimension::List(base)), Ranges::Each(each)) => base.len() == each.len(),
            (Some(Dimension::List(_) | Dimension::Number(_)), _) => false,
            (None, _) => {
                return refuse(
                    format!("lab `{}` has no parameter `{name}`", lab.name),
                    &suggest(name, "parameters", lab.parameters.names()),
                );
            }
        };
        if !fits {
            return refuse(
                format!("the ranges of `{name}` do not fit its shape"),
                "give [low, high] for one number, and a list of such ranges for a list",
            );
        }
    }
    let with = |parameters: Vec<(String, Dimension)>| {
        lab.with_parameters(&parameters).or_else(|error| {
            report.err(
                spanned.span(),
                "staff::runs",
                error.to_string(),
                "these runs",
                Some("change the ranges of `parameters`".to_owned()),
            )
        })
    };
    // what can be loaded at both ends can be loaded between: expressions are monotone in practice
    for end in [0, 1] {
        let all = ranges.iter();
        with(
            all.map(|(name, ranges)| (name.clone(), ranges.get_ref().end(end)))
                .collect(),
        )?;
    }
    let class = table.class.get_ref();
    (0..table.count)
        .map(|number| {
            let drawn = parameters(salt, table.task.get_ref(), class, number, ranges);
            Ok(HiddenRun {
                class: class.clone(),
                lab: with(drawn)?,
            })
        })
        .collect()
}

/// A run costs about as much as the visible one; a class of students is to be graded in minutes.
const MOST_RUNS: u32 = 20;

fn known_task<'l>(
    report: Reporter<'_>,
    lab: &'l Lab,
    task: &Spanned<String>,
) -> Result<&'l TaskWork, LabError> {
    match lab.tasks.iter().find(|t| t.name == *task.get_ref()) {
        Some(found) => Ok(&found.work),
        None => report.err(
            task.span(),
            "staff::unknown_task",
            format!("lab `{}` has no task `{}`", lab.name, task.get_ref()),
            "not a task of this lab",
            Some(suggest(
                task.get_ref(),
                "tasks",
                lab.tasks.iter().map(|task| task.name.as_str()),
            )),
        ),
    }
}

fn checked(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<DrawTable>,
) -> Result<Draw, LabError> {
    let table = spanned.get_ref();
    let refuse = |message: String, help: &str| {
        report.err(
            spanned.span(),
            "staff::draw",
            message,
            "this draw",
            Some(help.to_owned()),
        )
    };
    let TaskWork::Function(task) = known_task(report, lab, &table.task)? else {
        return refuse(
            format!("task `{}` is no function task", table.task.get_ref()),
            "hidden cases are drawn for function tasks",
        );
    };
    if table.count == 0 || table.count > 1000 {
        return refuse(
            format!("a draw has 1 to 1000 cases, got {}", table.count),
            "change `count`",
        );
    }
    let code = "staff::draw";
    named(report, code, &table.class)?;
    all_rising(report, code, &table.dimensions)?;
    if let Some(given) = &table.given {
        all_rising(report, code, given)?;
    }
    if let Some(at) = &table.position_m {
        rising(report, code, at.span(), "position_m", at.get_ref())?;
    }
    if let Some(at) = &table.q_rad {
        rising(report, code, at.span(), "q_rad", at.get_ref())?;
    }
    let joints = lab.robot.n();
    let q_ranges = match &table.q_rad {
        Some(ranges) if ranges.get_ref().len() != joints => {
            return refuse(
                format!(
                    "`q_rad` has {} ranges for {joints} joints",
                    ranges.get_ref().len()
                ),
                "give one [low, high] per joint that moves",
            );
        }
        Some(ranges) => Some(ranges.get_ref().clone()),
        None => None,
    };
    let free = matches!(task.function, Function::Free(_));
    if free != table.given.is_some() || (free && !table.dimensions.is_empty()) {
        return refuse(
            format!(
                "a draw for `{}` {} `given`",
                task.function.name(),
                if free { "is of" } else { "has no" }
            ),
            "a function of the lab's own is drawn by `given`, and nothing else is",
        );
    }
    let position_m = table.position_m.as_ref().map(|at| *at.get_ref());
    let what = match (&task.function, q_ranges, position_m) {
        (Function::Free(_), None, None) => {
            let ranges: Vec<(String, Ranges)> = table
                .given
                .iter()
                .flatten()
                .map(|(name, ranges)| (name.clone(), ranges.get_ref().clone()))
                .collect();
            let drawn: Vec<&str> = ranges.iter().map(|(name, _)| name.as_str()).collect();
            let of_cases: Vec<&str> = match task.cases.first().map(|case| &case.given) {
                Some(Given::Values { given, .. }) => {
                    given.iter().map(|(name, _)| name.as_str()).collect()
                }
                _ => Vec::new(),
            };
            if drawn != of_cases {
                return refuse(
                    format!(
                        "this draw gives {}, the visible cases give {}",
                        drawn.join(", "),
                        of_cases.join(", ")
                    ),
                    "give the same names",
                );
            }
            Drawn::Values(ranges)
        }
        (Function::ForwardKinematics | Function::Jacobian(_), Some(q), None) => Drawn::Q(q),
        (Function::InverseKinematics, Some(q), None) => {
            Drawn::PositionOf(q, table.branches.unwrap_or(2))
        }
        (Function::InverseKinematics, None, Some(position)) => match table.branches {
            Some(branches) => Drawn::Position(position, branches),
            None => {
                return refuse(
                    "a draw of positions must say how many `branches` reach them".to_owned(),
                    "write `branches = 0` for positions out of reach",
                );
            }
        },
        _ => {
            return refuse(
                "a draw is of `q_rad`, or for `inverse_kinematics` of `position_m`".to_owned(),
                "give one of the two",
            );
        }
    };
    let dimensions: Vec<(String, Ranges)> = table
        .dimensions
        .iter()
        .map(|(name, ranges)| (name.clone(), ranges.get_ref().clone()))
        .collect();
    // what can be built at the low ends can be built between: expressions are monotone in practice, and both ends are tried
    for end in [0, 1] {
        let changed: Vec<(String, Dimension)> = dimensions
            .iter()
            .map(|(name, ranges)| (name.clone(), ranges.end(end)))
            .collect();
        if let Err(error) = lab.robot_file.build(&changed) {
            return refuse(error.to_string(), "change the ranges of `dimensions`");
        }
    }
    Ok(Draw {
        task: table.task.get_ref().clone(),
        class: table.class.get_ref().clone(),
        count: table.count,
        what,
        dimensions,
    })
}
