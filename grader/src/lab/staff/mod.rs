//! What staff have beside the lab: hidden cases, known mistakes, the reference solution. Never in what students get.

mod draws;
mod hidden_runs;
pub(crate) mod sound;

use kinemark_sim::source::{Source, suggest};
use toml::Spanned;

use super::file::{HiddenTable, MutantsTable, RangesTable};
use super::files::Files;
use super::load::{Reporter, read, tables};
use super::model::{Case, Lab, TaskWork};
use super::problem::{LabError, LoadError};
use draws::{checked, expect};
use hidden_runs::hidden_runs;
use sound::{Whose, refuse_unbuilt};

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
        let Some(solution) = own(files, &format!("{folder}/solution.rhai"))? else {
            return Ok(None);
        };
        refuse_unbuilt(lab, None, Whose::Solution, &solution)?;
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
        let hidden_source = own(files, &hidden_path)?;
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
        if let Some(source) = own(files, &format!("{folder}/mutants.toml"))? {
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
                let Some(submission) = own(files, &path)? else {
                    return Ok(report.err(
                        mutant.name.span(),
                        "staff::no_mutant",
                        format!("there is no file `{}/{path}`", files.name()),
                        "this mutant",
                        Some("a mutant's name is its file's name without `.rhai`".to_owned()),
                    )?);
                };
                digest(&submission);
                let mutant = Mutant {
                    name,
                    tasks: mutant.tasks.into_iter().map(Spanned::into_inner).collect(),
                    says: mutant.says,
                    source: submission,
                };
                let task = mutant.tasks.first().map(String::as_str);
                refuse_unbuilt(lab, task, Whose::Mutant(&mutant), &mutant.source)?;
                mutants.push(mutant);
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
        let Some(source) = own(files, &format!("{lab}/hidden.toml"))? else {
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

/// Reads a file of the staff's: its name begins with their folder, so that it can be opened from where one stands.
fn own(files: &dyn Files, path: &str) -> Result<Option<Source>, LoadError> {
    let source = read(files, path)?;
    Ok(source.map(|source| Source::new(format!("{}/{path}", files.name()), source.text())))
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
