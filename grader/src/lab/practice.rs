//! `practice.json`: what students get of the reference solution. For the default variant, for some practice variants, and in a hand-out
//! for the student's own, it has the values that the reference solution reaches in checks, and the paths of its TCP.
//!
//! There is no code in it and no signal that a task commands: `kinemark lab fill` writes paths of the TCP only, and only for tasks in
//! which the lab itself says where the TCP should go.

use std::collections::BTreeMap;

use kinemark_sim::text::{Dimension, Dimensions, Source};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::lab::Variant;
use crate::record::graded::TcpPath;
use crate::task::files::{Files, read_source};
use crate::task::problem::LoadError;
use crate::task::reporter::Reporter;

/// The file beside `lab.toml`.
pub const PRACTICE_FILE: &str = "practice.json";

/// The salt of the practice variants. It is no secret: everyone may practise on them.
pub const PRACTICE_SALT: &str = "practice";

/// Practice variants of a lab.
pub const PRACTICE_VARIANTS: u32 = 20;

/// The student of a practice variant, counted from 1.
pub fn practice_student(number: u32) -> String {
    format!("practice {number}")
}

/// What students get of the reference solution in one variant, by task.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Practice {
    tasks: BTreeMap<String, PracticeTask>,
}

/// What students get of the reference solution in a task.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PracticeTask {
    /// Values of measures by the names of the checks, in the unit of their bands.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub values: BTreeMap<String, f64>,
    /// The path of the TCP.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<TcpPath>,
}

impl PracticeTask {
    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty() && self.path.is_none()
    }
}

/// A variant with what students get of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PracticeForm {
    /// Its parameters as in a `variant.toml`; none of the default variant.
    pub parameters: BTreeMap<String, Dimension>,
    /// What students get.
    pub tasks: Practice,
}

/// The file as written.
#[derive(Serialize)]
struct FileTable<'f> {
    format: i64,
    forms: &'f [PracticeForm],
}

/// The file as read: what a form says is read only of the one that fits.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileText<'f> {
    format: i64,
    #[serde(borrow)]
    forms: Vec<FormText<'f>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FormText<'f> {
    parameters: BTreeMap<String, Dimension>,
    #[serde(borrow)]
    tasks: &'f RawValue,
}

/// The file read whole, for the place of a mistake in it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WholeFile {
    #[serde(rename = "format")]
    _format: i64,
    #[serde(rename = "forms")]
    _forms: Vec<WholeForm>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WholeForm {
    #[serde(rename = "parameters")]
    _parameters: BTreeMap<String, Dimension>,
    #[serde(rename = "tasks")]
    _tasks: Practice,
}

impl Practice {
    /// Of the tasks that say anything.
    pub fn of_tasks(tasks: impl IntoIterator<Item = (String, PracticeTask)>) -> Self {
        let tasks = tasks.into_iter().filter(|(_, task)| !task.is_empty());
        Self {
            tasks: tasks.collect(),
        }
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.tasks.is_empty()
    }

    /// Whether it has a value of some check.
    pub fn has_values(&self) -> bool {
        self.tasks.values().any(|task| !task.values.is_empty())
    }

    /// The value that the reference solution reaches in a check.
    pub fn value(&self, task: &str, check: &str) -> Option<f64> {
        self.tasks.get(task)?.values.get(check).copied()
    }

    /// The path of the reference solution's TCP in a task.
    pub fn path(&self, task: &str) -> Option<&TcpPath> {
        self.tasks.get(task)?.path.as_ref()
    }

    /// The tasks of which it says something.
    pub fn tasks(&self) -> impl Iterator<Item = (&str, &PracticeTask)> {
        self.tasks.iter().map(|(name, task)| (name.as_str(), task))
    }

    /// Without the paths, for attempts that are never compared with what students see.
    pub(crate) fn without_paths(&self) -> Self {
        let of_values = |(name, task): (&String, &PracticeTask)| {
            let values = task.values.clone();
            (name.clone(), PracticeTask { values, path: None })
        };
        Self::of_tasks(self.tasks.iter().map(of_values))
    }

    /// Reads what the lab called `name` says of the variant with these `parameters`; `stated` are those of the default variant.
    ///
    /// # Errors
    /// [`LoadError`] for a file that is not of this form.
    pub(super) fn load(
        files: &dyn Files,
        name: &str,
        (stated, parameters): (&Dimensions, &Dimensions),
    ) -> Result<Self, LoadError> {
        let Some(source) = read_source(files, &format!("{name}/{PRACTICE_FILE}"))? else {
            return Ok(Self::default());
        };
        let read = || -> Result<Self, serde_json::Error> {
            let file: FileText<'_> = serde_json::from_str(source.text())?;
            if file.format != 1 {
                return Err(serde::de::Error::custom(format!(
                    "format {} is not known, this version reads format 1",
                    file.format
                )));
            }
            let mut forms = file.forms.iter();
            match forms.find(|form| is_of(&form.parameters, stated, parameters)) {
                Some(form) => serde_json::from_str(form.tasks.get()),
                None => Ok(Self::default()),
            }
        };
        match read() {
            Ok(practice) => Ok(practice),
            Err(first) => Ok(refused(&source, first)?),
        }
    }
}

/// What is wrong with the file, where it stands in it.
fn refused(
    source: &Source,
    first: serde_json::Error,
) -> Result<Practice, crate::task::problem::LabError> {
    let whole = serde_json::from_str::<WholeFile>(source.text());
    Reporter { source }.json(&whole.err().unwrap_or(first))
}

/// Whether a form with `parameters` is of the variant with the parameters `wanted`.
fn is_of(
    parameters: &BTreeMap<String, Dimension>,
    stated: &Dimensions,
    wanted: &Dimensions,
) -> bool {
    let is_stated = |name: &String| stated.get(name).is_some();
    let is_same = |(name, value): (&str, &Dimension)| {
        let own = parameters.get(name).or_else(|| stated.get(name));
        own == Some(value)
    };
    parameters.keys().all(is_stated) && wanted.iter().all(is_same)
}

/// The form of a variant; of the default variant where there is none.
pub fn form(variant: Option<&Variant>, tasks: Practice) -> PracticeForm {
    let parameters = variant.map_or_else(BTreeMap::new, |variant| {
        let pairs = variant.parameters();
        pairs
            .map(|(name, value)| (name.to_owned(), value.clone()))
            .collect()
    });
    PracticeForm { parameters, tasks }
}

/// The text of a `practice.json`; nothing where no form says anything.
///
/// # Errors
/// A value that JSON has no number for.
pub fn file_text(forms: &[PracticeForm]) -> Result<String, serde_json::Error> {
    if forms.iter().all(|form| form.tasks.is_empty()) {
        return Ok(String::new());
    }
    let text = serde_json::to_string(&FileTable { format: 1, forms })?;
    // a line for a form and for a path keeps differences of versions readable
    let text = text
        .replace(",{\"parameters\"", ",\n{\"parameters\"")
        .replace("\"points_m\":[[", "\"points_m\":\n[[");
    Ok(text + "\n")
}

/// The text of a `practice.json` with one form more, a student's own.
///
/// # Errors
/// A text that is no such file, or a value that JSON has no number for.
pub fn with_own(text: &str, own: &PracticeForm) -> Result<String, serde_json::Error> {
    #[derive(Serialize, Deserialize)]
    struct Forms<'f> {
        format: i64,
        #[serde(borrow)]
        forms: Vec<&'f RawValue>,
    }
    let own = serde_json::value::to_raw_value(own)?;
    let mut all: Forms<'_> = serde_json::from_str(text)?;
    all.forms.push(&own);
    Ok(serde_json::to_string(&all)? + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::copies::Copies;

    fn dimensions(pairs: &[(&str, f64)]) -> Dimensions {
        let pairs = pairs.iter();
        Dimensions::from_pairs(
            pairs.map(|(name, value)| ((*name).to_owned(), Dimension::Number(*value))),
        )
    }

    fn practice(value: f64) -> Practice {
        let task = PracticeTask {
            values: [("rise".to_owned(), value)].into(),
            path: Some(TcpPath {
                period_s: 0.1,
                points_m: vec![[0.0, 0.5, value]],
            }),
        };
        Practice::of_tasks([
            ("pid".to_owned(), task),
            ("empty".to_owned(), PracticeTask::default()),
        ])
    }

    fn file() -> String {
        let of = |kp: Option<f64>, tasks| PracticeForm {
            parameters: kp
                .map(|kp| ("kp".to_owned(), Dimension::Number(kp)))
                .into_iter()
                .collect(),
            tasks,
        };
        file_text(&[of(None, practice(0.1)), of(Some(7.0), practice(0.3))]).unwrap()
    }

    fn load(text: &str, kp: f64) -> Result<Practice, LoadError> {
        let files = Copies::from_texts([("lab/practice.json", text)]);
        let stated = dimensions(&[("kp", 5.0), ("step", 1.0)]);
        let wanted = dimensions(&[("kp", kp), ("step", 1.0)]);
        Practice::load(&files, "lab", (&stated, &wanted))
    }

    #[test]
    fn what_is_written_is_read_again_for_its_variant_alone() {
        assert_eq!(load(&file(), 5.0).unwrap(), practice(0.1));
        assert_eq!(load(&file(), 7.0).unwrap(), practice(0.3));
        let other = load(&file(), 8.0).unwrap();
        assert!(other.is_empty());
        let own = load(&file(), 7.0).unwrap();
        assert_eq!(own.value("pid", "rise"), Some(0.3));
        assert_eq!(own.value("pid", "settling"), None);
        assert_eq!(own.path("pid").unwrap().points_m, [[0.0, 0.5, 0.3]]);
        assert_eq!(own.without_paths().path("pid"), None);
        assert!(own.path("empty").is_none());
    }

    #[test]
    fn a_students_own_form_is_added() {
        let own = PracticeForm {
            parameters: [("kp".to_owned(), Dimension::Number(8.0))].into(),
            tasks: practice(0.4),
        };
        let text = with_own(&file(), &own).unwrap();
        for (kp, value) in [(5.0, 0.1), (7.0, 0.3), (8.0, 0.4)] {
            assert_eq!(load(&text, kp).unwrap(), practice(value));
        }
    }

    #[test]
    fn a_mistake_is_refused_at_its_line() {
        for (from, to, kp, line, words) in [
            (
                "\"format\":1",
                "\"format\":2",
                7.0,
                1,
                "format 2 is not known",
            ),
            ("period_s", "perod_s", 5.0, 1, "unknown key `perod_s`"),
            (
                "[[0.0,0.5,0.3]]",
                "[[0.0,0.5]]",
                7.0,
                4,
                "array of length 3",
            ),
        ] {
            let LoadError::Lab(error) = load(&file().replacen(from, to, 1), kp).unwrap_err() else {
                panic!("a place in the file: {to}");
            };
            let message = error.to_string();
            assert!(message.contains(words), "{to}: {message}");
            assert_eq!(error.line_and_column().0, line, "{to}");
        }
    }
}
