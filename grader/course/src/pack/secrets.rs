//! What students must not get, and where it would be in a pack: the salt, and lines of the solution.

use std::collections::BTreeSet;
use std::fmt;

use kinemark_grader::task::files::Files;

use super::{PackError, all_below};
use crate::fixed_zip::ArchiveFile;

/// Salts shorter than this are in many texts by chance.
pub const LEAST_SALT: usize = 8;
/// Shorter lines are in many programs by chance.
const LEAST_LINE: usize = 40;

/// The endings of solutions that have a folder of their own.
const SOURCES: [&str; 6] = [".rs", ".c", ".h", ".cc", ".cpp", ".zig"];
/// What a line of such a solution has that says how something is computed. The rest of it is much as in any starter: heads of functions,
/// dimensions that are read, the question which task it is.
const COMPUTES: [&str; 14] = [
    " + ", " - ", " * ", " / ", "sin(", "cos(", "tan(", "atan2(", "sqrt(", "hypot(", "lerp(",
    "quintic(", "solve(", "pow(",
];

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
        for (path, bytes) in all_below(reference, lab)? {
            let inside = path.strip_prefix(lab).unwrap_or(&path);
            if is_solution(inside.trim_start_matches('/')) {
                secrets.has_solution = true;
                secrets.add_solution(&path, &String::from_utf8_lossy(&bytes));
            }
        }
        Ok(secrets)
    }

    fn add_solution(&mut self, path: &str, text: &str) {
        for (i, line) in text.lines().enumerate() {
            let code = code(line);
            // the first line of a function is what the brief asks for
            let is_secret = match path.ends_with(".rhai") {
                true => !code.starts_with("fn "),
                false => COMPUTES.iter().any(|sign| code.contains(sign)),
            };
            if code.chars().count() < LEAST_LINE || !is_secret {
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

/// Whether a file of the course staff's folder for a lab is a solution: `solution.rhai`, `solution.c`, `rust/src/lib.rs`.
fn is_solution(path: &str) -> bool {
    match path.split_once('/') {
        None => path.starts_with("solution"),
        Some((folder, _)) => folder != "mutants" && SOURCES.iter().any(|end| path.ends_with(end)),
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
    let code = code.split_once("/*").map_or(code, |(code, _)| code).trim();
    // inside a comment of several lines
    if code == "*" || code.starts_with("* ") {
        return "";
    }
    code
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

    const IN_C: &str = "/* closed forms, as in the book of Lynch and Park, chapter 6 */\n\
        km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {\n    \
        double c = (u * u + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2); /* law of cosines */\n}\n";
    const IN_RUST: &str = "use kinemark_plugin::{Observation, Robot, Rows, Submission, export};\n\
        let cosine = (u * u + y * y - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);\n";

    #[test]
    fn solutions_in_every_language_are_secret_and_what_starters_share_is_not() {
        let reference = Copies::from_texts([
            ("01/solution.c", IN_C),
            ("01/rust/src/lib.rs", IN_RUST),
            (
                "01/mutants/in.rs",
                "let mutant = (u * u + y * y - l1 * l1) / (2.0 * l1 * l2);",
            ),
        ]);
        let secrets = Secrets::of(&reference, "01", []).unwrap();
        assert!(secrets.has_solution());
        let starter =
            |text: &str| secrets.shared_lines(&[ArchiveFile::new("labs/01/starter", text)]);
        let shared = starter(IN_C);
        let places: Vec<_> = shared
            .iter()
            .map(|line| (line.line, line.solution_line))
            .collect();
        assert_eq!(places, [(3, 3)], "{shared:?}");
        let shared = starter(IN_RUST);
        let [line] = shared.as_slice() else {
            panic!("{shared:?}");
        };
        assert_eq!(
            (line.line, line.solution.as_str()),
            (2, "01/rust/src/lib.rs")
        );
        assert!(starter("let mutant = (u * u + y * y - l1 * l1) / (2.0 * l1 * l2);").is_empty());
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
