//! A lab that begins as a copy of another: its own name, salt, and numbers, another robot where one is named; all else stays as it was
//! typed.

use kinemark_grader::lab::new_lab::schema_line;
use kinemark_grader::lab::{Lab, Variant};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use kinemark_sim::text::Dimension;
use toml_edit::{Array, ArrayOfTables, DocumentMut};

/// Where a copy begins.
pub(crate) struct Origin<'a> {
    /// The labs.
    pub(crate) labs: &'a dyn Files,
    /// The course staff's part of them.
    pub(crate) reference: &'a dyn Files,
    /// The name of the lab that is copied.
    pub(crate) lab: &'a str,
}

/// What is to be different.
pub(crate) struct Changes<'a> {
    /// The name.
    pub(crate) name: &'a str,
    /// Another robot.
    pub(crate) robot: Option<&'a str>,
    /// Whether parameters with variants get other numbers.
    pub(crate) new_numbers: bool,
    /// The salt of hidden numbers, from which the new numbers come, too.
    pub(crate) salt: &'a str,
}

/// Files by their paths in a folder.
pub(crate) type FilesOfFolder = Vec<(String, Vec<u8>)>;

/// What is copied out of a solution in Rust: nothing, since it is a member of a workspace.
const OF_WORKSPACE: &str = "rust/";

/// The files of both halves of the copy.
///
/// # Errors
/// [`LoadError`] where the lab is not there or is broken.
pub(crate) fn copied(
    origin: &Origin<'_>,
    changes: &Changes<'_>,
) -> Result<[FilesOfFolder; 2], LoadError> {
    let lab = Lab::load(origin.labs, origin.lab)?;
    let numbers = match changes.new_numbers {
        // a variant of nobody: of a student whom no roster has
        true => Some(lab.variant_of(changes.salt, changes.name)?),
        false => None,
    };
    let mut public = all_files(origin.labs, origin.lab);
    let mut staff = all_files(origin.reference, origin.lab);
    staff.retain(|(path, _)| !path.starts_with(OF_WORKSPACE));
    for (path, bytes) in public.iter_mut().chain(&mut staff) {
        let Ok(text) = std::str::from_utf8(bytes) else {
            continue;
        };
        let text = text.replace(origin.lab, changes.name);
        let kind = path
            .strip_suffix(".toml")
            .filter(|kind| ["lab", "hidden", "mutants", "accepted"].contains(kind));
        let edited = match kind {
            None if path == "brief.md" => Some(format!("{TODO_BRIEF}{text}")),
            None => None,
            Some("lab") => of_lab(&text, changes, numbers.as_ref())
                .map(|edited| format!("{}{}{edited}", schema_line("lab"), todo(origin.lab))),
            Some(kind) => of_staff(kind, &text, changes.salt)
                .map(|edited| format!("{}{edited}", schema_line(kind))),
        };
        *bytes = edited.unwrap_or(text).into_bytes();
    }
    Ok([public, staff])
}

/// What a person has to decide in the brief.
const TODO_BRIEF: &str = "<!-- TODO: a story of your own; `kinemark lab fill` writes the numbers, the table and the plots -->\n\n";

/// What a person has to decide in lab.toml.
fn todo(origin: &str) -> String {
    format!(
        "# Begun as a copy of {origin}, whose solution everybody can read. TODO: title and summary, other cases and places, what else is\n\
         # asked for, and hints that fit it. The numbers of [parameters] are new.\n"
    )
}

/// The paths, inside the folder of a lab, of all files with what they hold.
fn all_files(files: &dyn Files, lab: &str) -> FilesOfFolder {
    let mut found = Vec::new();
    let mut folders = vec![String::new()];
    while let Some(folder) = folders.pop() {
        for name in files.list(format!("{lab}/{folder}").trim_end_matches('/')) {
            let path = format!("{folder}{name}");
            match files.bytes(&format!("{lab}/{path}")) {
                Ok(Some(bytes)) => found.push((path, bytes)),
                _ => folders.push(format!("{path}/")),
            }
        }
    }
    found.sort();
    found
}

/// The text of lab.toml with its changes; nothing where it is no TOML.
fn of_lab(text: &str, changes: &Changes<'_>, numbers: Option<&Variant>) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    if let Some(robot) = changes.robot {
        replace(document.get_mut("robot")?.as_value_mut()?, robot.into());
    }
    let drawn = numbers.into_iter().flat_map(Variant::parameters);
    for (name, drawn) in drawn {
        let typed = document
            .get_mut("parameters")?
            .get_mut(name)?
            .as_value_mut()?;
        replace(typed, value(drawn));
    }
    Some(document.to_string())
}

/// The text of a file of the course staff's part with its changes; nothing where it is no TOML.
fn of_staff(kind: &str, text: &str, salt: &str) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    match kind {
        "hidden" => replace(document.get_mut("salt")?.as_value_mut()?, salt.into()),
        "accepted" => {
            let accepted = document.get_mut("accepted")?.as_array_of_tables_mut()?;
            // this salt is nobody's but the author's
            ArrayOfTables::retain(accepted, |table| {
                table.get("rule").and_then(|rule| rule.as_str()) != Some("salt")
            });
        }
        _ => {}
    }
    Some(document.to_string())
}

/// Puts `new` in the place of a value; the space and the comment around it stay.
fn replace(typed: &mut toml_edit::Value, new: toml_edit::Value) {
    let decor = typed.decor().clone();
    *typed = new;
    *typed.decor_mut() = decor;
}

fn value(dimension: &Dimension) -> toml_edit::Value {
    match dimension {
        Dimension::Number(number) => (*number).into(),
        Dimension::List(numbers) => numbers.iter().copied().collect::<Array>().into(),
        Dimension::Text(text) => text.as_str().into(),
    }
}

#[cfg(test)]
mod tests {
    use kinemark_grader::lab::copies::Copies;

    use super::*;
    use crate::labs_folder::built_in;

    #[test]
    fn a_copy_has_its_own_name_salt_and_numbers_and_nothing_else_changes() {
        let reference = Copies::from_texts([
            ("01-kinematics/solution.rhai", "// of 01-kinematics\n"),
            (
                "01-kinematics/hidden.toml",
                "# cases\nformat = 1\nsalt = \"known\"  # to all\n",
            ),
            (
                "01-kinematics/accepted.toml",
                "format = 1\n\n[[accepted]]\nrule = \"salt\"\nof = \"salt\"\nbecause = \"x\"\n\n[[accepted]]\nrule = \"free\"\nof = \"a\"\nbecause = \"y\"\n",
            ),
            ("01-kinematics/mutants/degrees.rhai", "x\n"),
            ("01-kinematics/rust/Cargo.toml", "[package]\n"),
        ]);
        let labs = built_in();
        let origin = Origin {
            labs: &labs,
            reference: &reference,
            lab: "01-kinematics",
        };
        let changes = Changes {
            name: "10-reach",
            robot: Some("puma560"),
            new_numbers: true,
            salt: "of a test",
        };
        let [public, staff] = copied(&origin, &changes).expect("a copy");
        let text = |files: &FilesOfFolder, path: &str| {
            let found = files.iter().find(|(known, _)| known == path);
            let (_, bytes) = found.unwrap_or_else(|| panic!("no {path}"));
            String::from_utf8(bytes.clone()).expect("text")
        };
        let paths: Vec<&str> = staff.iter().map(|(path, _)| path.as_str()).collect();
        assert_eq!(
            paths,
            [
                "accepted.toml",
                "hidden.toml",
                "mutants/degrees.rhai",
                "solution.rhai"
            ]
        );
        assert_eq!(text(&staff, "solution.rhai"), "// of 10-reach\n");
        assert_eq!(
            text(&staff, "hidden.toml"),
            "#:schema ../schema/hidden.schema.json\n# cases\nformat = 1\nsalt = \"of a test\"  # to all\n"
        );
        let accepted = text(&staff, "accepted.toml");
        assert!(
            !accepted.contains("\"salt\"") && accepted.contains("rule = \"free\""),
            "{accepted}"
        );

        let lab = text(&public, "lab.toml");
        let before = labs
            .read("01-kinematics/lab.toml")
            .expect("read")
            .expect("a lab");
        let differs = |a: &str, b: &str| -> Vec<String> {
            let lines: Vec<&str> = b.lines().collect();
            let other = a.lines().filter(|line| !lines.contains(line));
            other.map(str::to_owned).collect()
        };
        let new = differs(&lab, &before);
        // the schema, two lines of TODO, the name, the robot, both places
        assert_eq!(new.len(), 7, "{new:#?}");
        assert_eq!(differs(&before, &lab).len(), 4);
        assert!(new.contains(&"name = \"10-reach\"".to_owned()), "{new:#?}");
        assert!(new.contains(&"robot = \"puma560\"".to_owned()), "{new:#?}");
        let place = new
            .iter()
            .find(|line| line.starts_with("right = "))
            .expect("a place");
        assert!(
            place.ends_with("# the first place of \"move\": x, y [m]"),
            "{place}"
        );
        let brief = text(&public, "brief.md");
        assert!(brief.contains("kinemark new 10-reach"));
    }
}
