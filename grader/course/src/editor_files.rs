//! What helps to write in a student's folder: the page on the language, its functions for editors, a task that grades, the extension
//! that colours the language.
//!
//! Editors that do not know these files ignore them, and so does Kinemark.

use kinemark_grader::submission::rhai::DEFINITIONS;

/// The files by their path in the folder: for VS Code, the definitions that language servers of Rhai read, and the page for people.
pub(crate) const EDITOR_FILES: [(&str, &str); 4] = [
    (
        ".vscode/extensions.json",
        include_str!("editor/extensions.json"),
    ),
    (".vscode/tasks.json", include_str!("editor/tasks.json")),
    ("editor/kinemark.d.rhai", DEFINITIONS),
    (
        "script-language.md",
        include_str!("../../../docs/script-language.md"),
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission_name::NameKind;

    #[test]
    fn no_file_of_an_editor_is_taken_for_a_submission() {
        for (path, _) in EDITOR_FILES {
            let name = path.rsplit('/').next().expect("a name");
            assert_eq!(NameKind::of(name), NameKind::Other, "{path}");
        }
    }

    #[test]
    fn editors_read_their_files_as_json() {
        for (path, text) in EDITOR_FILES {
            if path.ends_with(".json") {
                let value: serde_json::Value = serde_json::from_str(text).expect(path);
                assert!(value.is_object(), "{path}");
            }
        }
    }
}
