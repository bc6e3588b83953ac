//! Ids of students: one spelling each, and when two spellings would be one person to a reader or to a file system.

use std::fmt;

use kinemark_grader::lab::variant::student_id;
use serde::{Deserialize, Serialize};
use unicode_normalization::UnicodeNormalization as _;

/// The most bytes of a folder's name: with what is put before and behind it, it stays below the 255 that file systems take.
const LONGEST_FOLDER: usize = 120;
/// What stands before the digest of a long id.
const DIGEST: &str = "~~~";
/// How many digits of it.
const DIGIT_COUNT: usize = 32;

/// A student's id as the course writes it, in Unicode's normal form C: `é` typed in two ways is one id.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct StudentId(String);

impl StudentId {
    /// Takes an id as typed; spaces around it do not count.
    ///
    /// # Errors
    /// Why it cannot be one, in words.
    pub fn new(typed: &str) -> Result<Self, String> {
        let id: String = typed.trim().nfc().collect();
        student_id(&id)?;
        Ok(Self(id))
    }

    /// The id.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// What it has in common with every id that differs from it only in case or in how it is composed.
    pub fn folded(&self) -> String {
        folded(&self.0)
    }

    /// Its name as a folder: letters, digits, `-`, `_` and `.` as they are, everything else as `~` and its number, so that two ids
    /// never share a folder and none leads out of it. A name that would be too long for a file system is its beginning, `~~~`, which
    /// no other name has in it, and a digest of the id.
    pub fn folder(&self) -> String {
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        let mut name = String::new();
        for (at, c) in self.0.chars().enumerate() {
            // a dot in front would hide the folder, or lead out of it
            if plain(c) || (c == '.' && at > 0) {
                name.push(c);
            } else {
                name += &format!("~{:x}~", u32::from(c));
            }
        }
        if name.len() > LONGEST_FOLDER {
            let digest = blake3::hash(self.0.as_bytes()).to_hex();
            // every character of it is ASCII
            name.truncate(LONGEST_FOLDER - DIGEST.len() - DIGIT_COUNT);
            name += DIGEST;
            name += &digest[..DIGIT_COUNT];
        }
        name
    }
}

/// A text as it is compared where case and composition do not count.
pub fn folded(text: &str) -> String {
    // compatibility forms too: full-width digits and ligatures look like plain ones
    let lower: String = text.trim().nfkc().collect::<String>().to_lowercase();
    lower.nfkc().collect()
}

impl TryFrom<String> for StudentId {
    type Error = String;

    fn try_from(typed: String) -> Result<Self, String> {
        Self::new(&typed)
    }
}

impl From<StudentId> for String {
    fn from(id: StudentId) -> Self {
        id.0
    }
}

impl fmt::Display for StudentId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_id_typed_in_two_ways_is_one() {
        let composed = StudentId::new("Ren\u{e9}e").unwrap();
        let decomposed = StudentId::new(" Rene\u{301}e ").unwrap();
        assert_eq!(composed, decomposed);
        assert!(StudentId::new("  ").is_err());
        assert!(StudentId::new("a\u{7}b").is_err());
    }

    #[test]
    fn ids_that_look_alike_fold_to_one() {
        let folded = |id: &str| StudentId::new(id).unwrap().folded();
        assert_eq!(folded("S1000"), folded("s1000"));
        assert_eq!(folded("\u{ff53}1000"), folded("s1000"));
        assert_ne!(folded("s1000"), folded("s1001"));
    }

    #[test]
    fn folders_are_plain_and_each_id_has_its_own() {
        let folder = |id: &str| StudentId::new(id).unwrap().folder();
        assert_eq!(folder("s100.1-a_b"), "s100.1-a_b");
        assert_eq!(folder("../x"), "~2e~.~2f~x");
        assert_eq!(folder("~2f~"), "~7e~2f~7e~");
        assert_ne!(folder("a/b"), folder("a~2f~b"));
    }

    #[test]
    fn a_long_id_has_a_folder_that_file_systems_take() {
        let folder = |id: &str| StudentId::new(id).unwrap().folder();
        let long = |last: &str| folder(&format!("{}{last}", "李".repeat(99)));
        assert_eq!(long("a").len(), LONGEST_FOLDER);
        assert_ne!(long("a"), long("b"));
        assert!(long("a").starts_with("~674e~~674e~") && long("a").contains(DIGEST));
        assert_eq!(folder(&"a".repeat(100)), "a".repeat(100));
    }
}
