//! A submission as it is graded: the name of its file, and its program.

use kinemark_sim::text::Source;
use serde::{Deserialize, Serialize};

use crate::record::grade::Part;

/// The code of a submission, in one of the forms that run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Program {
    /// The text of a script.
    Script(String),
    /// The bytes of a WebAssembly module.
    Module(Vec<u8>),
    /// The text of a file in Python.
    Python(String),
}

impl Program {
    /// The text in which positions count lines; empty for a module.
    pub fn text(&self) -> &str {
        match self {
            Self::Script(text) | Self::Python(text) => text,
            Self::Module(_) => "",
        }
    }

    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Script(text) | Self::Python(text) => text.as_bytes(),
            Self::Module(bytes) => bytes,
        }
    }
}

/// A submission to grade.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Submission {
    name: String,
    program: Program,
    sources: Option<Vec<Part>>,
}

impl Submission {
    /// The first bytes of every WebAssembly module.
    pub const MODULE_MAGIC: &[u8] = b"\0asm";

    /// A compiled module without sources; `name` is that of its file.
    pub fn module(name: &str, bytes: &[u8]) -> Self {
        Self {
            name: name.to_owned(),
            program: Program::Module(bytes.to_owned()),
            sources: Some(Vec::new()),
        }
    }

    /// The same module with the sources that were handed in beside it, each by its name and its text, in any order; of a script
    /// nothing changes.
    #[must_use]
    pub fn with_sources<'s>(self, sources: impl IntoIterator<Item = (&'s str, &'s [u8])>) -> Self {
        let part = |(name, text): (&str, &[u8])| Part {
            name: name.to_owned(),
            digest: blake3::hash(text).to_hex().to_string(),
        };
        let sources = self.sources.map(|_| {
            let mut parts: Vec<Part> = sources.into_iter().map(part).collect();
            parts.sort_by(|one, other| one.name.cmp(&other.name));
            parts
        });
        Self { sources, ..self }
    }

    /// The sources beside a module, which say what it was made from as far as its author says; none for a script.
    pub fn sources(&self) -> Option<&[Part]> {
        self.sources.as_deref()
    }

    /// The name of its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text of a script or of a file in Python; empty for a module.
    pub fn text(&self) -> &str {
        self.program.text()
    }

    /// Its code.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The identity of its code.
    pub fn digest(&self) -> blake3::Hash {
        blake3::hash(self.program.bytes())
    }
}

impl From<Source> for Submission {
    fn from(script: Source) -> Self {
        Self::from(&script)
    }
}

impl From<&Source> for Submission {
    fn from(script: &Source) -> Self {
        let text = script.text().to_owned();
        Self {
            name: script.name().to_owned(),
            program: match is_python(script.name(), script.text()) {
                true => Program::Python(text),
                false => Program::Script(text),
            },
            sources: None,
        }
    }
}

/// Whether a file is in Python: by its name, or where that says nothing, as of standard input, by its text.
fn is_python(name: &str, text: &str) -> bool {
    let is_script_name = name.to_lowercase().contains(".rhai");
    is_python_name(name) || !is_script_name && reads_as_python(text)
}

/// Whether a text without a name is in Python.
pub fn reads_as_python(text: &str) -> bool {
    text.lines().any(is_python_line)
}

/// Whether a line can be nothing but the beginning of a statement of Python at the left margin.
fn is_python_line(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let is_name = |word: &str| {
        let mut letters = word.chars();
        letters
            .next()
            .is_some_and(|c| c.is_alphabetic() || c == '_')
            && letters.all(|c| c.is_alphanumeric() || c == '_' || c == '.')
    };
    match words.as_slice() {
        ["def", head, ..] => head.contains('(') && line.trim_end().ends_with(':'),
        ["from", module, "import", ..] => is_name(module),
        ["import", module] | ["import", module, "as", _] => is_name(module),
        _ => false,
    }
}

/// Whether a file is in Python by its name, whatever a browser or an LMS added to it: `submission.py`, `lab1 (1).py`, `lab1.py-1.txt`.
fn is_python_name(name: &str) -> bool {
    let name = name.to_lowercase();
    let name = name.strip_suffix(".txt").unwrap_or(&name);
    let mark = name.rsplit_once(".py").map(|(_, mark)| mark);
    mark.is_some_and(|mark| mark.is_empty() || mark.starts_with([' ', '(', '-']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn python_is_known_by_the_name_of_its_file() {
        for name in [
            "submission.py",
            "Lab 1.PY",
            "a.py.txt",
            "a.py (1).txt",
            "a.py-1.txt",
        ] {
            assert!(is_python_name(name), "{name}");
        }
        for name in [
            "submission.rhai",
            "python.rhai",
            "a.pyi",
            "a.pyc",
            "py",
            "a.python.txt",
        ] {
            assert!(!is_python_name(name), "{name}");
        }
        for text in [
            "import numpy as np\n",
            "# mine\n\nfrom math import sin, cos\n",
            "def fk(robot, q):\n    return [1, 2]\n",
            "import math\r\n",
        ] {
            assert!(is_python("-", text), "{text}");
            assert!(is_python("submission.txt", text), "{text}");
            assert!(!is_python("submission.rhai", text), "{text}");
        }
        for text in [
            "fn fk(robot, q) {\n    [1, 2]\n}\n",
            "// import what is needed\nlet a = 1;\n",
            "import \"crypto\" as c;\n",
            "",
        ] {
            assert!(!is_python("-", text), "{text}");
        }
        let python = Submission::from(Source::new("a.py", "x = 1\n"));
        assert_eq!(python.program(), &Program::Python("x = 1\n".to_owned()));
        assert_eq!(python.text(), "x = 1\n");
    }
}
