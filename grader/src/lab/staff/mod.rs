//! What staff have beside the lab: hidden cases, known mistakes, the reference solution. Never in what students get.

mod draws;
mod hidden_runs;

use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::text::{Dimension, Source, Spanned};

use super::file::{HiddenTable, MutantTable, MutantsTable, RangesTable, SaysTable};
use super::load::tables;
use super::model::Lab;
use crate::lab::TaskWork;
use crate::task::files::{Files, read_source};
use crate::task::model::Case;
use crate::task::problem::{LabError, LoadError, near, problems};
use crate::task::reporter::Reporter;
use draws::{checked, drawn};
use hidden_runs::{RunsOfTable, hidden_runs};

problems! {
    /// What is wrong with the staff's files, whatever they hide.
    enum HiddenProblem {
        NoMutant { path: String }:
            "staff::no_mutant", "there is no file `{path}`", "this mutant", "a mutant's name is its file's name without `.rhai`";
        Twice { name: String }:
            "lab::duplicate", "mutant `{name}` is defined twice", "the second one", "give each its own name";
        SaysNothing { name: String }:
            "staff::no_mutant", "mutant `{name}` says nothing", "no words", "write what the student reads";
        NoWordsFor { name: String, task: String }:
            "staff::no_mutant", "mutant `{name}` says nothing in task `{task}`", "no words for it", format!("add {task} = \"...\", or one text for all");
        WordsForOther { name: String, task: String, known: Vec<String> }:
            "staff::no_mutant", "mutant `{name}` has words for task `{task}`, which is none of its tasks", "words for another task",
            near(task, "tasks", known);
        NoTask { name: String }:
            "staff::unknown_task", "mutant `{name}` names no task", "no task", "such as tasks = [\"move\"]";
        EmptySalt:
            "staff::salt", "the salt is empty: anyone could compute the hidden numbers", "no secret",
            "write a string that nobody can guess";
        EmptyClass:
            "staff::class", "the class is empty, and it is all that students see of it", "no words",
            "say in a few words what is different, such as \"unequal links\"";
        Falling { name: String, low: f64, high: f64 }:
            "staff::range", "a range of `{name}` goes from {low} down to {high}", "the wrong way round",
            format!("write [{high}, {low}]: a range is [low, high]");
        UnknownTask { lab: String, task: String, known: Vec<String> }:
            "staff::unknown_task", "lab `{lab}` has no task `{task}`", "not a task of this lab", near(task, "tasks", known);
    }
}

/// The staff's part of a lab. Loading it runs none of its code: [`crate::audit::staff_code`] tries that.
#[derive(Debug, Clone)]
pub struct Staff {
    /// The reference solution.
    pub solution: Source,
    /// Known mistakes, as submissions.
    pub mutants: Vec<Mutant>,
    /// `hidden.toml`, where there is one.
    pub hidden_source: Option<Source>,
    /// Hidden cases, draw by draw.
    pub draws: Vec<HiddenCases>,
    /// Hidden runs by task.
    runs: Vec<(String, RunsOfTable)>,
    /// BLAKE3 over all of it, salt included.
    pub digest: blake3::Hash,
    /// What digests of hidden parts are keyed by.
    key: [u8; 32],
}

/// Whether the two ends of every range are tried as well as the numbers drawn from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ends {
    Tried,
    NotTried,
}

impl Ends {
    /// The ends to try: of each range the first number, then the second.
    fn to_try(self) -> &'static [usize] {
        match self {
            Self::Tried => &[0, 1],
            Self::NotTried => &[],
        }
    }
}

/// The hidden cases of one draw.
#[derive(Debug, Clone)]
pub struct HiddenCases {
    /// The task.
    pub task: String,
    /// Bytes of the draw in `hidden.toml`.
    pub at: Range<usize>,
    /// The cases; what a function of the lab's own is expected to answer is not in them, because the reference solution says it.
    pub cases: Vec<Case>,
}

/// A motion task that is run again with other numbers.
#[derive(Debug, Clone)]
pub struct HiddenRun {
    /// All that students get to know about it.
    pub class: String,
    /// Its number within its table, from one.
    pub number: u32,
    /// The parameters that were drawn.
    pub drawn: Vec<(String, Dimension)>,
    /// The lab with its numbers.
    pub lab: Lab,
}

/// A submission that makes a common mistake, and what to tell a student who makes it.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// Its name, which is its file's.
    pub name: String,
    /// The tasks in which it shows.
    pub tasks: Vec<String>,
    /// The mistake in words; of one that has words for each task, those for the first.
    pub says: String,
    /// Words for single tasks, by their names, where they are not the same for all.
    pub says_in: BTreeMap<String, String>,
    /// Whether students who make it read these words; else it only has to lose points.
    pub is_named: bool,
    /// The submission.
    pub source: Source,
}

impl Mutant {
    /// The mistake in words, for a task.
    pub fn words(&self, task: &str) -> &str {
        self.says_in.get(task).unwrap_or(&self.says)
    }
}

/// What `hidden.toml` adds.
#[derive(Default)]
struct Hidden {
    source: Option<Source>,
    draws: Vec<HiddenCases>,
    runs: Vec<(String, RunsOfTable)>,
    /// Without `hidden.toml` nothing is hidden, and nothing keyed.
    key: [u8; 32],
}

/// Hashes the files of the staff's part one after another.
struct Digest(blake3::Hasher);

impl Digest {
    fn add(&mut self, source: &Source) {
        self.0.update(&(source.text().len() as u64).to_le_bytes());
        self.0.update(source.text().as_bytes());
    }
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
        Self::load_with(files, lab, salt, Ends::Tried)
    }

    /// The same for a variant of a lab that has been loaded, one of many: of its ranges only the numbers drawn are tried.
    ///
    /// # Errors
    /// As [`Staff::load`].
    pub fn load_for_student(
        files: &dyn Files,
        lab: &Lab,
        salt: Option<&str>,
    ) -> Result<Option<Self>, LoadError> {
        Self::load_with(files, lab, salt, Ends::NotTried)
    }

    fn load_with(
        files: &dyn Files,
        lab: &Lab,
        salt: Option<&str>,
        ends: Ends,
    ) -> Result<Option<Self>, LoadError> {
        let Some(solution) = own(files, &format!("{}/solution.rhai", lab.name))? else {
            return Ok(None);
        };
        let mut digest = Digest(blake3::Hasher::new());
        digest.add(&solution);
        let hidden = hidden(files, lab, (salt, ends), &mut digest)?;
        let mutants = mutants(files, lab, &mut digest)?;
        Ok(Some(Self {
            solution,
            mutants,
            hidden_source: hidden.source,
            draws: hidden.draws,
            runs: hidden.runs,
            digest: digest.0.finalize(),
            key: hidden.key,
        }))
    }

    /// A digest over hidden answers or runs as the record has it: keyed by the salt, so that nobody without it can try out which
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
        let Some(source) = own(files, &format!("{lab}/hidden.toml"))? else {
            return Ok(None);
        };
        let table: HiddenTable = tables(&source)?;
        let salt = own_salt(Reporter { source: &source }, &table)?;
        Ok(Some(salt.to_owned()))
    }

    /// The solution and the mutants with nothing hidden: for a lab that shows what is hidden in this one.
    pub(crate) fn without_hidden(&self) -> Self {
        Self {
            solution: self.solution.clone(),
            mutants: self.mutants.clone(),
            hidden_source: None,
            draws: Vec::new(),
            runs: Vec::new(),
            digest: self.digest,
            key: self.key,
        }
    }

    /// What hidden runs of a task would be at the ends of the ranges that they are drawn from: every number at the first, then at the
    /// last. Empty where the part was loaded for a grade.
    pub fn runs_at_ends(&self, task: &str) -> Vec<&HiddenRun> {
        let of_task = self.runs.iter().filter(|(name, _)| name == task);
        of_task.flat_map(|(_, of_table)| &of_table.ends).collect()
    }

    /// The hidden runs of a task.
    pub fn runs(&self, task: &str) -> Vec<&HiddenRun> {
        let of_task = self.runs.iter().filter(|(name, _)| name == task);
        of_task.flat_map(|(_, of_table)| &of_table.runs).collect()
    }

    /// The hidden cases of a task.
    pub fn hidden(&self, task: &str) -> impl Iterator<Item = &Case> {
        self.draws_of(task).flat_map(|draw| &draw.cases)
    }

    /// The draws of hidden cases of a task.
    pub fn draws_of(&self, task: &str) -> impl Iterator<Item = &HiddenCases> {
        self.draws.iter().filter(move |draw| draw.task == task)
    }
}

/// Reads `hidden.toml`, and draws what it hides.
fn hidden(
    files: &dyn Files,
    lab: &Lab,
    (salt, ends): (Option<&str>, Ends),
    digest: &mut Digest,
) -> Result<Hidden, LoadError> {
    let path = format!("{}/hidden.toml", lab.name);
    let Some(source) = own(files, &path)? else {
        let is_function = |work: &TaskWork| matches!(work, TaskWork::Function(..));
        if lab.tasks.iter().any(|task| is_function(&task.work)) {
            return Err(LoadError::Unreadable {
                path: format!("{}/{path}", files.name()),
                why: "there is no such file, and function tasks need hidden cases".to_owned(),
            });
        }
        return Ok(Hidden::default());
    };
    digest.add(&source);
    let table: HiddenTable = tables(&source)?;
    let report = Reporter { source: &source };
    let own = own_salt(report, &table)?;
    let salt = salt.unwrap_or(own);
    digest.add(&Source::new("salt", salt));
    let mut runs = Vec::new();
    for typed in &table.runs {
        let task = typed.get_ref().task.get_ref().clone();
        runs.push((task, hidden_runs(report, lab, (salt, ends), typed)?));
    }
    let mut draws = Vec::new();
    for typed in &table.draws {
        let draw = checked(report, lab, typed, ends)?;
        let task = lab.tasks.iter().find(|task| task.name == draw.task);
        let seen = task.map_or(lab, |task| lab.of_task(task));
        draws.push(HiddenCases {
            at: typed.span(),
            cases: drawn(report, typed, draw.cases(salt, seen))?,
            task: draw.task,
        });
    }
    Ok(Hidden {
        key: blake3::derive_key("kinemark 2026 digests of hidden parts v1", salt.as_bytes()),
        source: Some(source),
        draws,
        runs,
    })
}

/// Reads `mutants.toml` and the submissions that it names.
fn mutants(files: &dyn Files, lab: &Lab, digest: &mut Digest) -> Result<Vec<Mutant>, LoadError> {
    let Some(source) = own(files, &format!("{}/mutants.toml", lab.name))? else {
        return Ok(Vec::new());
    };
    digest.add(&source);
    let table: MutantsTable = tables(&source)?;
    let report = Reporter { source: &source };
    let mut mutants: Vec<Mutant> = Vec::new();
    for table in table.mutants {
        if mutants.iter().any(|m| m.name == *table.name.get_ref()) {
            let name = table.name.get_ref().clone();
            return Ok(report.refuse_at(&table.name, HiddenProblem::Twice { name })?);
        }
        mutants.push(mutant(files, lab, report, table, digest)?);
    }
    Ok(mutants)
}

fn mutant(
    files: &dyn Files,
    lab: &Lab,
    report: Reporter<'_>,
    table: MutantTable,
    digest: &mut Digest,
) -> Result<Mutant, LoadError> {
    let name = table.name.get_ref().clone();
    for task in table.tasks.get_ref() {
        known_task(report, lab, task)?;
    }
    if table.tasks.get_ref().is_empty() {
        return Ok(report.refuse_at(&table.tasks, HiddenProblem::NoTask { name })?);
    }
    let (says, says_in) = words(report, &table)?;
    let path = format!("{}/mutants/{name}.rhai", lab.name);
    let Some(source) = own(files, &path)? else {
        let path = format!("{}/{path}", files.name());
        return Ok(report.refuse_at(&table.name, HiddenProblem::NoMutant { path })?);
    };
    digest.add(&source);
    Ok(Mutant {
        name,
        tasks: (table.tasks.into_inner().into_iter())
            .map(Spanned::into_inner)
            .collect(),
        says,
        says_in,
        is_named: table.named.unwrap_or(true),
        source,
    })
}

/// What a mutant says, in general and in single tasks.
fn words(
    report: Reporter<'_>,
    table: &MutantTable,
) -> Result<(String, BTreeMap<String, String>), LabError> {
    let name = || table.name.get_ref().clone();
    let tasks = table.tasks.get_ref().iter().map(Spanned::get_ref);
    let (says, each) = match table.says.get_ref() {
        SaysTable::All(says) => (says.clone(), BTreeMap::new()),
        SaysTable::Each(each) => {
            if let Some(task) = tasks.clone().find(|task| !each.contains_key(*task)) {
                let (name, task) = (name(), task.clone());
                return report.refuse_at(&table.says, HiddenProblem::NoWordsFor { name, task });
            }
            let known: Vec<String> = tasks.clone().cloned().collect();
            if let Some(task) = each.keys().find(|task| !known.contains(task)) {
                let (name, task) = (name(), task.clone());
                let problem = HiddenProblem::WordsForOther { name, task, known };
                return report.refuse_at(&table.says, problem);
            }
            let first = tasks.clone().next().and_then(|task| each.get(task));
            (first.cloned().unwrap_or_default(), each.clone())
        }
    };
    if std::iter::once(&says)
        .chain(each.values())
        .any(|words| words.trim().is_empty())
    {
        return report.refuse_at(&table.says, HiddenProblem::SaysNothing { name: name() });
    }
    Ok((says, each))
}

/// Reads a file of the staff's: its name begins with their folder, so that it can be opened from where one stands.
pub(crate) fn own(files: &dyn Files, path: &str) -> Result<Option<Source>, LoadError> {
    let source = read_source(files, path)?;
    Ok(source.map(|source| Source::new(format!("{}/{path}", files.name()), source.text())))
}

/// The salt of a `hidden.toml`, which is not empty.
fn own_salt<'t>(report: Reporter<'_>, table: &'t HiddenTable) -> Result<&'t str, LabError> {
    if table.salt.get_ref().trim().is_empty() {
        return report.refuse_at(&table.salt, HiddenProblem::EmptySalt);
    }
    Ok(table.salt.get_ref())
}

/// Refuses a class without a name: it is all that students see of it.
fn named(report: Reporter<'_>, class: &Spanned<String>) -> Result<(), LabError> {
    if !class.get_ref().trim().is_empty() {
        return Ok(());
    }
    report.refuse_at(class, HiddenProblem::EmptyClass)
}

/// Refuses a range of `name`, typed `at`, whose low end is above its high one.
fn rising<T>(
    report: Reporter<'_>,
    name: &str,
    at: &Spanned<T>,
    ranges: &[[f64; 2]],
) -> Result<(), LabError> {
    match ranges.iter().find(|[low, high]| low > high) {
        None => Ok(()),
        Some(&[low, high]) => {
            let name = name.to_owned();
            report.refuse_at(at, HiddenProblem::Falling { name, low, high })
        }
    }
}

/// [`rising`] for ranges by name.
fn all_rising(report: Reporter<'_>, table: &RangesTable) -> Result<(), LabError> {
    let mut all = table.iter();
    all.try_for_each(|(name, at)| rising(report, name.get_ref(), at, at.get_ref().all()))
}

fn known_task<'l>(
    report: Reporter<'_>,
    lab: &'l Lab,
    task: &Spanned<String>,
) -> Result<&'l TaskWork, LabError> {
    match lab.tasks.iter().find(|t| t.name == *task.get_ref()) {
        Some(found) => Ok(&found.work),
        None => {
            let problem = HiddenProblem::UnknownTask {
                lab: lab.name.clone(),
                task: task.get_ref().clone(),
                known: lab.tasks.iter().map(|task| task.name.clone()).collect(),
            };
            report.refuse_at(task, problem)
        }
    }
}
