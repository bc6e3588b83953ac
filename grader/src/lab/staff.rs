//! What staff have beside the lab: hidden cases, known mistakes, the reference solution. Never in what students get.

use kinemark_sim::robot::Dimension;
use kinemark_sim::source::{Source, suggest};
use toml::Spanned;

use super::draw::{Draw, Drawn, parameters};
use super::file::{DrawTable, HiddenRunsTable, HiddenTable, MutantsTable, Ranges};
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
            let salt = salt.unwrap_or(&table.salt);
            digest(&Source::new("salt", salt));
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
        }))
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
        Ok(Some(table.salt))
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
    for (name, ranges) in &table.parameters {
        let fits = match (lab.parameters.get(name), ranges) {
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
        let all = table.parameters.iter();
        with(
            all.map(|(name, ranges)| (name.clone(), ranges.end(end)))
                .collect(),
        )?;
    }
    let class = table.class.get_ref();
    (0..table.count)
        .map(|number| {
            let drawn = parameters(salt, table.task.get_ref(), class, number, &table.parameters);
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
    let what = match (&task.function, q_ranges, table.position_m) {
        (Function::Free(_), None, None) => {
            let ranges: Vec<(String, Ranges)> = table
                .given
                .iter()
                .flatten()
                .map(|(name, ranges)| (name.clone(), ranges.clone()))
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
        .map(|(name, ranges)| (name.clone(), ranges.clone()))
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
