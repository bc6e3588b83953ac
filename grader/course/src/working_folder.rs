//! What a student begins a lab with: the starter, the brief with their numbers, its pictures, their variant, and files for editors.

use kinemark_grader::lab::brief::{with_grading, with_numbers, without_marks};
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::lab::{Lab, TaskWork};
use kinemark_grader::submission::rhai::code_parts;
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use kinemark_grader::task::model::Function;
use kinemark_report::brief_page::{Brief, brief_page};
use kinemark_report::replay::{ArmShows, LiveArm};
use kinemark_sim::text::Source;
use serde::{Deserialize, Serialize};

use crate::course_text::{TextError, tables};
use crate::editor_files::editor_files;
use crate::language::Language;
use crate::plugin_project::project_files;
use crate::plugin_starter::plugin_starter;

/// The file that a student works in, where it is a script.
pub const SUBMISSION_FILE: &str = "submission.rhai";
/// The file that a student works in, where it is in Python.
pub const PYTHON_FILE: &str = "submission.py";
/// The brief as text, which links the pictures beside it.
pub const BRIEF_FILE: &str = "brief.md";
/// The brief as a page.
pub const BRIEF_PAGE: &str = "brief.html";
/// The starter in the folder of a lab.
pub const STARTER_FILE: &str = "starter.rhai";

/// The file that says which lab a folder is for.
pub const FOLDER_FILE: &str = "kinemark.toml";

/// What [`FOLDER_FILE`] says: which lab, and whose numbers. No grade depends on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FolderFile {
    /// The lab.
    pub lab: String,
    /// The id of the student whose variant is beside it; none with the lab's default numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
}

impl FolderFile {
    fn of(lab: &Lab) -> Self {
        let variant = lab.variant.as_ref();
        Self {
            lab: lab.name.clone(),
            variant: variant.map(|variant| variant.student().unwrap_or("practice").to_owned()),
        }
    }

    /// Reads such a file.
    ///
    /// # Errors
    /// The mistake with its place.
    pub fn parse(source: &Source) -> Result<Self, TextError> {
        tables(source)
    }

    fn text(&self) -> String {
        let variant = self.variant.as_ref();
        let variant = variant.map(|id| format!("variant = {}\n", toml::Value::from(id.as_str())));
        format!(
            "# Which lab this folder is for: `kinemark grade`, `watch`, `hint` and `submit` need no names here.\nlab = {}\n{}",
            toml::Value::from(self.lab.as_str()),
            variant.unwrap_or_default()
        )
    }
}

/// Why there is no such folder.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum WorkingFolderError {
    /// A file that every lab has.
    #[error("lab `{lab}` has no {name}")]
    #[diagnostic(
        code(lab::incomplete),
        help("a lab needs a {STARTER_FILE} and a {BRIEF_FILE} beside its lab.toml")
    )]
    Missing {
        /// The lab.
        lab: String,
        /// The file.
        name: &'static str,
    },
    /// A file that is not text.
    #[error("{path}: {why}")]
    #[diagnostic(code(lab::unreadable), help("{UNREAD_HELP}"))]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        why: String,
    },
    /// A mark of the brief.
    #[error("{BRIEF_FILE}: {why}")]
    #[diagnostic(
        code(lab::brief),
        help("a mark is `<!-- = expression -->` after the number it computes")
    )]
    Brief {
        /// What is wrong, in words.
        why: String,
    },
}

/// The files of such a folder by name, the submission in `language` first, the page of the brief second; `lab` was read from `files`.
///
/// # Errors
/// [`WorkingFolderError`] where the lab is not complete.
pub fn working_folder(
    files: &dyn Files,
    lab: &Lab,
    language: Language,
) -> Result<Vec<(String, String)>, WorkingFolderError> {
    let brief = required(files, lab, BRIEF_FILE)?;
    let brief = with_numbers(&with_grading(&brief, lab), lab)
        .map_err(|why| WorkingFolderError::Brief { why })?;
    let brief = without_marks(&brief);
    let parts = |program: &str| {
        let parts = code_parts(program).into_iter();
        parts.map(|(part, at)| (part.name(), at)).collect()
    };
    let page = brief_page(&Brief {
        title: &lab.title,
        text: &brief,
        parts: &parts,
        python_first: language == Language::Python,
        arm: LiveArm::of(&lab.robot, &lab.frame, arm_shows(lab)),
    });
    let mut written = vec![
        (language.source().to_owned(), starter(files, lab, language)?),
        (BRIEF_PAGE.to_owned(), page),
        (BRIEF_FILE.to_owned(), brief),
    ];
    written.push((FOLDER_FILE.to_owned(), FolderFile::of(lab).text()));
    if let Some(variant) = &lab.variant {
        written.push((VARIANT_FILE.to_owned(), variant.text()));
    }
    for name in files.list(&lab.name) {
        if is_picture(&name)
            && let Some(picture) = text(files, &lab.name, &name)?
        {
            written.push((name, picture));
        }
    }
    written.extend(project_files(lab, language));
    written.extend(editor_files(language));
    Ok(written)
}

/// What a submission in `language` begins with: the lab's own starter, or where it has none in a language that is no script, its functions.
fn starter(files: &dyn Files, lab: &Lab, language: Language) -> Result<String, WorkingFolderError> {
    let own = text(files, &lab.name, language.starter())?;
    own.or_else(|| plugin_starter(lab, language))
        .ok_or_else(|| WorkingFolderError::Missing {
            lab: lab.name.clone(),
            name: language.starter(),
        })
}

/// What the arm of a brief shows from the start: what the lab asks for.
fn arm_shows(lab: &Lab) -> ArmShows {
    let functions = lab.tasks.iter().filter_map(|task| match &task.work {
        TaskWork::Function(task, _) => Some(&task.function),
        TaskWork::Motion(..) => None,
    });
    let functions: Vec<&Function> = functions.collect();
    let asks_for = |is: fn(&Function) -> bool| functions.iter().any(|function| is(function));
    ArmShows {
        branches: asks_for(|function| matches!(function, Function::InverseKinematics(_))),
        jacobian: asks_for(|function| matches!(function, Function::Jacobian(_))),
    }
}

/// Whether a file of a lab's folder is a picture of its brief.
pub fn is_picture(name: &str) -> bool {
    name.ends_with(".svg") && !name.starts_with('.')
}

fn required(
    files: &dyn Files,
    lab: &Lab,
    name: &'static str,
) -> Result<String, WorkingFolderError> {
    text(files, &lab.name, name)?.ok_or_else(|| WorkingFolderError::Missing {
        lab: lab.name.clone(),
        name,
    })
}

fn text(files: &dyn Files, lab: &str, name: &str) -> Result<Option<String>, WorkingFolderError> {
    let path = format!("{lab}/{name}");
    files
        .read(&path)
        .map_err(|why| WorkingFolderError::Unreadable { path, why })
}
