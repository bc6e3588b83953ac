//! The note in a pack that says which lab and which engine the course uses, so that a student's copy can be compared with them.

use serde::{Deserialize, Serialize};

/// Its name in the folder of the lab.
pub const HANDED_OUT_FILE: &str = "handed-out.json";

const FORMAT: &str = "kinemark-handed-out/1";

/// What course staff handed out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandedOut {
    /// Always `kinemark-handed-out/1`.
    format: String,
    /// The version of the lab's files ([`crate::staffed_lab::lab_version`]).
    pub lab_digest: String,
    /// The engine of course staff, as `kinemark --version` prints it.
    pub engine: String,
}

impl HandedOut {
    /// The note on a lab of this version, packed with this engine.
    pub fn new(lab_digest: String, engine: String) -> Self {
        Self {
            format: FORMAT.to_owned(),
            lab_digest,
            engine,
        }
    }

    /// It as a file.
    ///
    /// # Errors
    /// What the writer of JSON says.
    pub fn text(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Reads such a file; none where it is no note of this version, which is as good as no note.
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let note: Self = serde_json::from_slice(bytes).ok()?;
        (note.format == FORMAT).then_some(note)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_is_read_as_it_is_written() {
        let note = HandedOut::new("ab".to_owned(), "kinemark 0.1.0".to_owned());
        let text = note.text().unwrap();
        assert_eq!(HandedOut::parse(text.as_bytes()), Some(note));
        let later = text.replace("out/1", "out/2");
        assert_eq!(HandedOut::parse(later.as_bytes()), None);
        assert_eq!(HandedOut::parse(b"{"), None);
    }
}
