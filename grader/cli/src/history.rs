//! What earlier grades in a student's folder earned: a small file beside the submission, which no report and no hand-in has. It shows what
//! a change brought, check by check; no grade depends on it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use kinemark_course::working_folder::FOLDER_FILE;
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::quantity::{difference_of_points, points};
use kinemark_grader::record::run_figures::RunFigures;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::visible::visible;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::{beneath, output};

/// The name of the file.
const HISTORY_FILE: &str = ".kinemark-history.json";
/// The format that this version reads and writes.
const FORMAT: &str = "kinemark-history/1";
/// Entries that are kept: a long evening.
const MOST_ENTRIES: usize = 200;
const MOST_BYTES: u64 = 4 << 20;
/// Smaller differences are shown as none.
const SHOWN: f64 = 0.005;

/// The grades of a folder.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct History {
    format: String,
    /// The best so far by lab; older entries go.
    best: BTreeMap<String, f64>,
    /// The least figures of runs with full points, by lab and `TASK/FIGURE`.
    #[serde(default)]
    figures: BTreeMap<String, BTreeMap<String, f64>>,
    /// Oldest first.
    entries: Vec<Entry>,
    #[serde(skip)]
    path: PathBuf,
}

/// A grade.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    lab: String,
    /// Digests of the lab and of the submission.
    lab_digest: String,
    submission: String,
    points: f64,
    max_points: f64,
    /// Points by `TASK/CHECK`.
    checks: BTreeMap<String, f64>,
}

impl Entry {
    fn of(grade: &Grade) -> Self {
        let checks = grade.tasks.iter().flat_map(|task| {
            let checks = task.checks.iter();
            checks.map(|check| (format!("{}/{}", task.name, check.name), check.points))
        });
        Self {
            lab: grade.lab.name.clone(),
            lab_digest: grade.lab.digest.clone(),
            submission: grade.submission.digest.clone(),
            points: grade.points,
            max_points: grade.max_points,
            checks: checks.collect(),
        }
    }
}

impl History {
    /// That of the folder that `kinemark new` made for `submission`; none elsewhere. A file that cannot be read is begun again, and the
    /// second value says so.
    pub(crate) fn beside(submission: &Path) -> Option<(Self, Option<String>)> {
        if !submission.with_file_name(FOLDER_FILE).is_file() {
            return None;
        }
        let path = submission.with_file_name(HISTORY_FILE);
        let read = match path.symlink_metadata() {
            Ok(_) => read(&path),
            Err(_) => Ok(Self::empty()),
        };
        let (history, note) = match read {
            Ok(history) => (history, None),
            Err(why) => {
                let shown = output::path(&path);
                let note = format!("`{shown}` cannot be read, so it begins again: {why}");
                (Self::empty(), Some(note))
            }
        };
        Some((Self { path, ..history }, note))
    }

    fn empty() -> Self {
        Self {
            format: FORMAT.to_owned(),
            best: BTreeMap::new(),
            figures: BTreeMap::new(),
            entries: Vec::new(),
            path: PathBuf::new(),
        }
    }

    /// The best points for `lab`.
    pub(crate) fn best(&self, lab: &str) -> Option<f64> {
        self.best.get(lab).copied()
    }

    /// What the last change brought, in words: total and checks. Nothing for the first grade, for the same submission, and for another
    /// version of the lab.
    pub(crate) fn change(&self, grade: &Grade) -> Option<String> {
        let now = Entry::of(grade);
        let before = self.entries.last()?;
        if before.lab_digest != now.lab_digest || before.submission == now.submission {
            return None;
        }
        let moved = now.checks.iter().filter_map(|(name, points)| {
            let change = difference_of_points(*before.checks.get(name)?, *points);
            (change.abs() >= SHOWN).then_some((name, change))
        });
        let total = difference_of_points(before.points, now.points);
        let mut words = match total {
            none if none.abs() < SHOWN => "since the last grade: the same points".to_owned(),
            change => format!(
                "since the last grade: {} to {} of {} points ({})",
                points(before.points),
                points(now.points),
                points(now.max_points),
                signed(change)
            ),
        };
        for (name, change) in moved {
            let _ = write!(words, "; {name} {}", signed(change));
        }
        words.push('\n');
        if let Some(best) = self
            .best(&now.lab)
            .filter(|best| *best > now.points + SHOWN)
        {
            let _ = writeln!(words, "your best so far: {}", points(best));
        }
        Some(words)
    }

    /// What the runs took where nothing is left to earn, in words, each beside the least so far.
    pub(crate) fn beyond(&self, grade: &Grade) -> Option<String> {
        if grade.verdict != Verdict::Passed {
            return None;
        }
        let best = self.figures.get(&grade.lab.name);
        let mut words = String::new();
        for task in &grade.tasks {
            let figures = task.figures.iter().flat_map(|figures| figures.named());
            let shown = figures.map(|(name, title, value, unit)| {
                let best = best.and_then(|best| best.get(&format!("{}/{name}", task.name)));
                let shown = RunFigures::shown(value, unit);
                // what reads the same is the same
                let other = best.map(|best| (*best, RunFigures::shown(*best, unit)));
                match other.filter(|(_, words)| *words != shown) {
                    Some((best, _)) if value < best => format!("{title} {shown} (your best yet)"),
                    Some((_, words)) => format!("{title} {shown} (your best: {words})"),
                    None => format!("{title} {shown}"),
                }
            });
            let shown: Vec<String> = shown.collect();
            if !shown.is_empty() {
                let _ = writeln!(words, "  {}: {}", task.name, shown.join(", "));
            }
        }
        let next = "`kinemark` in the folder above lists the labs and what is next.";
        Some(match words.is_empty() {
            true => format!("full marks. {next}\n"),
            false => format!("full marks. {next}\nWorth no points, lower is better:\n{words}"),
        })
    }

    /// Adds a grade.
    pub(crate) fn add(&mut self, grade: &Grade) {
        let entry = Entry::of(grade);
        let best = self.best.entry(entry.lab.clone()).or_insert(entry.points);
        *best = best.max(entry.points);
        let least = self.figures.entry(entry.lab.clone()).or_default();
        for task in &grade.tasks {
            let figures = task.figures.iter().flat_map(|figures| figures.named());
            for (name, _, value, _) in figures {
                let figure = format!("{}/{name}", task.name);
                let known = least.entry(figure).or_insert(value);
                *known = known.min(value);
            }
        }
        if self.entries.last() != Some(&entry) {
            self.entries.push(entry);
        }
        let surplus = self.entries.len().saturating_sub(MOST_ENTRIES);
        self.entries.drain(..surplus);
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Exit code 4 where it cannot be written.
    pub(crate) fn write(&self) -> Result<(), Failure> {
        let text = output::json(self)?;
        let help = "the grade and its report stand: only the comparison with the next one is lost";
        output::write_file(&self.path, text.as_bytes(), help)
    }
}

fn signed(points_changed: f64) -> String {
    let sign = if points_changed < 0.0 { "-" } else { "+" };
    format!("{sign}{}", points(points_changed.abs()))
}

fn read(path: &Path) -> Result<History, String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let bytes = beneath::bytes(folder, HISTORY_FILE, MOST_BYTES).map_err(|why| why.to_string())?;
    let read: serde_json::Result<History> = serde_json::from_slice(&bytes);
    let read = read.map_err(|error| visible(&error.to_string()).into_owned())?;
    if read.format == FORMAT {
        Ok(read)
    } else {
        let format = visible(&read.format);
        Err(format!("its format is `{format}`, not `{FORMAT}`"))
    }
}
