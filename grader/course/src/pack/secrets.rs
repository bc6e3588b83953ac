//! What students must not get, and where it would be in a pack: the salt, and lines of the solution.

use std::collections::BTreeSet;
use std::fmt;

use kinemark_grader::task::files::Files;

use super::{PackError, read};
use crate::fixed_zip::ArchiveFile;

/// Salts shorter than this are in many texts by chance.
pub const LEAST_SALT: usize = 8;
/// Shorter lines are in many programs by chance.
const LEAST_LINE: usize = 40;

/// What students must not get.
#[derive(Debug, Clone, Default)]
pub struct Secrets {
    salts: Vec<String>,
    has_solution: bool,
    lines: Vec<SecretLine>,
}

/// A line of the solution, without its comment and without spaces.
#[derive(Debug, Clone)]
struct SecretLine {
    path: String,
    line: usize,
    packed: String,
    shown: String,
}

/// A line of a pack that is one of the solution.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SharedLine {
    /// The file of the pack.
    pub path: String,
    /// Its line, from one.
    pub line: usize,
    /// The file of the solution.
    pub solution: String,
    /// Its line, from one.
    pub solution_line: usize,
    /// The line.
    pub text: String,
}

impl fmt::Display for SharedLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}:{} is {}:{}: {}",
            self.path, self.line, self.solution, self.solution_line, self.text
        )
    }
}

impl Secrets {
    /// The secrets of a lab: these salts, and the solutions in the course staff's folder.
    ///
    /// # Errors
    /// A solution that cannot be read, or a salt too short to search for.
    pub fn of(
        reference: &dyn Files,
        lab: &str,
        salts: impl IntoIterator<Item = String>,
    ) -> Result<Self, PackError> {
        let mut secrets = Self::default();
        for salt in salts {
            let characters = salt.trim().chars().count();
            if characters < LEAST_SALT {
                return Err(PackError::ShortSalt { characters });
            }
            secrets.salts.push(salt);
        }
        for name in reference.list(lab) {
            if !name.starts_with("solution") {
                continue;
            }
            let path = format!("{lab}/{name}");
            let Some(bytes) = read(reference, &path)? else {
                continue;
            };
            secrets.has_solution = true;
            secrets.add_solution(&path, &String::from_utf8_lossy(&bytes));
        }
        Ok(secrets)
    }

    fn add_solution(&mut self, path: &str, text: &str) {
        for (i, line) in text.lines().enumerate() {
            let code = code(line);
            // the first line of a function is what the brief asks for
            if code.chars().count() < LEAST_LINE || code.starts_with("fn ") {
                continue;
            }
            self.lines.push(SecretLine {
                path: path.to_owned(),
                line: i + 1,
                packed: without_spaces(code),
                shown: code.to_owned(),
            });
        }
    }

    /// Whether there was a solution to search for.
    pub fn has_solution(&self) -> bool {
        self.has_solution
    }

    /// Refuses files that hold a salt.
    ///
    /// # Errors
    /// [`PackError::Salt`] with the first place.
    pub fn refuse_salts(&self, files: &[ArchiveFile]) -> Result<(), PackError> {
        for file in distinct(files) {
            for salt in &self.salts {
                let found = position(&file.bytes, salt.trim().as_bytes());
                let named = file.path.contains(salt.trim());
                let Some(at) = found.or(named.then_some(0)) else {
                    continue;
                };
                let before = &file.bytes[..at];
                return Err(PackError::Salt {
                    path: file.path.clone(),
                    line: 1 + before.iter().filter(|byte| **byte == b'\n').count(),
                });
            }
        }
        Ok(())
    }

    /// Lines of the files that are lines of the solution, however they are spaced.
    pub fn shared_lines(&self, files: &[ArchiveFile]) -> Vec<SharedLine> {
        let mut shared = Vec::new();
        for file in distinct(files) {
            let text = String::from_utf8_lossy(&file.bytes);
            for (i, line) in text.lines().enumerate() {
                let packed = without_spaces(line);
                let secret = self
                    .lines
                    .iter()
                    .find(|secret| packed.contains(&secret.packed));
                if let Some(secret) = secret {
                    shared.push(SharedLine {
                        path: file.path.clone(),
                        line: i + 1,
                        solution: secret.path.clone(),
                        solution_line: secret.line,
                        text: secret.shown.clone(),
                    });
                }
            }
        }
        shared
    }
}

/// Files of which no other before them has the same bytes: in a pack for a class most are there once a student.
fn distinct(files: &[ArchiveFile]) -> impl Iterator<Item = &ArchiveFile> {
    let mut seen = BTreeSet::new();
    files
        .iter()
        .filter(move |file| seen.insert(*blake3::hash(&file.bytes).as_bytes()))
}

fn position(bytes: &[u8], part: &[u8]) -> Option<usize> {
    bytes.windows(part.len()).position(|window| window == part)
}

/// A line without its comment and the spaces around it.
fn code(line: &str) -> &str {
    let code = line.split_once("//").map_or(line, |(code, _)| code);
    code.trim()
}

fn without_spaces(text: &str) -> String {
    text.split_whitespace().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::lab::copies::Copies;

    const SOLUTION: &str = "// closed forms, as in the book of Lynch and Park, chapter 6\n\
        fn inverse_kinematics(robot, position_of_the_hand) {\n    \
        let c = (u * u + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2);  // law of cosines\n}\n";

    fn secrets() -> Secrets {
        let reference =
            Copies::from_texts([("01/solution.rhai", SOLUTION), ("01/mutants.toml", "x")]);
        Secrets::of(&reference, "01", ["our secret".to_owned()]).unwrap()
    }

    fn file(text: &str) -> [ArchiveFile; 1] {
        [ArchiveFile::new("labs/01/brief.md", text)]
    }

    #[test]
    fn a_salt_is_found_with_its_line() {
        let error = secrets()
            .refuse_salts(&file("a\nb our secret c"))
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "the salt is in `labs/01/brief.md`, line 2, which students would get"
        );
        assert!(secrets().refuse_salts(&file("nothing secret")).is_ok());
        let named = [ArchiveFile::new("labs/our secret.svg", "")];
        assert!(secrets().refuse_salts(&named).is_err());
    }

    #[test]
    fn a_line_of_the_solution_is_found_however_it_is_spaced() {
        for text in [
            "x\n    let c=(u*u + y*y - l1*l1 - l2*l2)/(2*l1*l2); // mine",
            "\n<code>let c = (u * u + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2);</code>",
        ] {
            let shared = secrets().shared_lines(&file(text));
            let [line] = shared.as_slice() else {
                panic!("{shared:?}");
            };
            assert_eq!((line.line, line.solution_line), (2, 3));
            assert!(
                line.to_string()
                    .starts_with("labs/01/brief.md:2 is 01/solution.rhai:3: let c")
            );
        }
    }

    #[test]
    fn comments_and_what_a_brief_asks_for_are_no_secrets() {
        for text in [
            "// closed forms, as in the book of Lynch and Park, chapter 6",
            "fn inverse_kinematics(robot, position_of_the_hand) {",
            "let c = 1;",
        ] {
            assert!(secrets().shared_lines(&file(text)).is_empty(), "{text}");
        }
    }

    #[test]
    fn a_salt_of_a_few_letters_is_refused() {
        let error = Secrets::of(&Copies::default(), "01", ["sea".to_owned()]).unwrap_err();
        assert!(matches!(error, PackError::ShortSalt { characters: 3 }));
    }
}
