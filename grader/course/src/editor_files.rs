//! What helps to write in a student's folder: the page on the language, its functions for editors, a task that grades, the extension
//! that colours the language.
//!
//! Editors that do not know these files ignore them, and so does Kinemark.

use kinemark_grader::submission::rhai::DEFINITIONS;

use crate::language::Language;

/// What grades in an editor, and lists what went wrong.
const TASKS: (&str, &str) = (".vscode/tasks.json", include_str!("editor/tasks.json"));

/// What only scripts need: the extension that colours them, the definitions that language servers of Rhai read, the page for people.
const OF_SCRIPTS: [(&str, &str); 3] = [
    (
        ".vscode/extensions.json",
        include_str!("editor/extensions.json"),
    ),
    ("editor/kinemark.d.rhai", DEFINITIONS),
    (
        "script-language.md",
        include_str!("../../../docs/script-language.md"),
    ),
];

/// What only Python needs: the types of what Kinemark gives, which editors and type checkers read, and the page for people.
const OF_PYTHON: [(&str, &str); 3] = [
    ("kinemark.pyi", include_str!("editor/kinemark.pyi")),
    // the name by which Pyright, and VS Code with it, finds what needs no import
    ("__builtins__.pyi", include_str!("editor/builtins.pyi")),
    ("python.md", include_str!("../../../docs/python.md")),
];

/// The files by their path in the folder of a submission in `language`.
pub(crate) fn editor_files(language: Language) -> Vec<(String, String)> {
    let (path, tasks) = TASKS;
    let own = |(path, text): (&str, &str)| (path.to_owned(), text.to_owned());
    if language.build().is_some() {
        let building = tasks.replace(r#"["grade", "#, r#"["grade", "--build", "#);
        return vec![(path.to_owned(), building)];
    }
    if language == Language::Python {
        let [types, builtins, page] = OF_PYTHON;
        return [TASKS, types, builtins, page].map(own).to_vec();
    }
    let [extensions, definitions, page] = OF_SCRIPTS;
    [extensions, TASKS, definitions, page].map(own).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission_name::NameKind;

    #[test]
    fn no_file_of_an_editor_is_taken_for_a_submission() {
        for (path, _) in Language::ALL.into_iter().flat_map(editor_files) {
            let name = path.rsplit('/').next().expect("a name");
            assert_eq!(NameKind::of(name), NameKind::Other, "{path}");
        }
    }

    #[test]
    fn editors_read_their_files_as_json() {
        for (path, text) in Language::ALL.into_iter().flat_map(editor_files) {
            if path.ends_with(".json") {
                let value: serde_json::Value = serde_json::from_str(&text).expect(&path);
                assert!(value.is_object(), "{path}");
            }
        }
    }

    #[test]
    fn what_is_compiled_is_built_by_the_task_that_grades() {
        let grades = |language| {
            let files = editor_files(language);
            let (_, tasks) = files
                .iter()
                .find(|(path, _)| path == TASKS.0)
                .expect("tasks");
            let tasks: serde_json::Value = serde_json::from_str(tasks).expect("JSON");
            tasks["tasks"][0]["args"].clone()
        };
        assert_eq!(
            grades(Language::Rhai),
            serde_json::json!(["grade", "--format", "short"])
        );
        for language in [Language::Rust, Language::C] {
            let built = serde_json::json!(["grade", "--build", "--format", "short"]);
            assert_eq!(grades(language), built);
        }
    }
}
