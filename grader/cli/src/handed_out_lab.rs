//! Whether the lab and the engine on a student's machine are those that the course handed out.

use kinemark_course::handed_out::{HANDED_OUT_FILE, HandedOut};
use kinemark_course::staffed_lab::{engine_id, lab_version};
use kinemark_grader::lab::Lab;
use kinemark_grader::task::files::Files;
use kinemark_report::visible::visible;
use serde::Serialize;

use crate::labs_folder;

/// Something to look at.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct Warning {
    /// Which, for programs.
    kind: &'static str,
    /// What, in words.
    pub(crate) message: String,
    /// What to do about it.
    pub(crate) help: String,
}

impl Warning {
    pub(crate) fn new(
        kind: &'static str,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self {
            kind,
            message: message.into(),
            help: help.into(),
        }
    }
}

/// What differs from the note that the course put beside the lab, and without one, where `built_in` asks for it, from the lab that is
/// built in; `lab` has the default numbers.
pub(crate) fn warnings(files: &dyn Files, lab: &Lab, built_in: bool) -> Vec<Warning> {
    let (name, shown) = (&lab.name, files.name());
    let path = format!("{name}/{HANDED_OUT_FILE}");
    let note = files.bytes(&path).ok().flatten();
    let Some(note) = note.and_then(|bytes| HandedOut::parse(&bytes)) else {
        let differs = built_in.then(|| of_built_in(name, &lab_version(lab), &shown));
        return differs.flatten().into_iter().collect();
    };
    let mut warnings = Vec::new();
    if note.lab_digest != lab_version(lab) {
        warnings.push(Warning::new(
            "lab-changed",
            format!("lab `{name}` in `{shown}` was changed after your course handed it out"),
            "unpack the archive that your course gave you once more, and copy your submission there",
        ));
    }
    let own = engine_id();
    if note.engine != own {
        warnings.push(Warning::new(
            "other-engine",
            format!(
                "your course uses {}, and this is {own}",
                visible(&note.engine)
            ),
            "points may differ between the two: use the version of your course",
        ));
    }
    warnings
}

/// Whether the lab of a folder is another than the one built in; which of the two is older nobody can say.
fn of_built_in(name: &str, version: &str, folder: &str) -> Option<Warning> {
    let built_in = Lab::load(&labs_folder::built_in(), name).ok()?;
    (lab_version(&built_in) != version).then(|| {
        Warning::new(
            "other-lab",
            format!("lab `{name}` in `{folder}` is not the one that is built into this kinemark"),
            "one of the two is older: ask your course which it uses. Without a folder `labs` here or above, the built-in one is used",
        )
    })
}
