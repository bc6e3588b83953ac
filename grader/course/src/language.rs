//! The languages that submissions are written in: what each begins with in a lab, the file that a student edits, and how it is built.

/// A language of submissions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Language {
    /// A script, which is graded as it is.
    Rhai,
    /// A file in Python, which is graded as it is.
    Python,
    /// Rust, compiled with the crate `kinemark-plugin`.
    Rust,
    /// C, compiled with `kinemark.h`.
    C,
}

/// The module that is graded, in the folder of a compiled submission.
pub const MODULE_FILE: &str = "submission.wasm";

/// The folder in that of a Rust project where cargo leaves the module.
pub const CARGO_OUTPUT: &str = "target/wasm32-unknown-unknown/release";

/// The folder of everything that cargo writes.
pub const CARGO_TARGET: &str = "target";

/// The compiler of C and its arguments, in the folder of a project.
const BUILD_C: &[&str] = &[
    "clang",
    "--target=wasm32",
    "-O2",
    "-Wall",
    "-mbulk-memory",
    "-nostdlib",
    "-Wl,--no-entry,--stack-first",
    "-o",
    MODULE_FILE,
    "submission.c",
];

/// Cargo and its arguments, in the folder of a project.
const BUILD_RUST: &[&str] = &[
    "cargo",
    "build",
    "--release",
    "--target",
    "wasm32-unknown-unknown",
];

impl Language {
    /// All of them, scripts first.
    pub const ALL: [Self; 4] = [Self::Rhai, Self::Python, Self::Rust, Self::C];

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rhai => "Rhai",
            Self::Python => "Python",
            Self::Rust => "Rust",
            Self::C => "C",
        }
    }

    /// What students begin with, in the folder of a lab. A lab has one for scripts, and may have others.
    pub fn starter(self) -> &'static str {
        match self {
            Self::Rhai => "starter.rhai",
            Self::Python => "starter.py",
            Self::Rust => "starter.rs",
            Self::C => "starter.c",
        }
    }

    /// What a student edits, in their folder.
    pub fn source(self) -> &'static str {
        match self {
            Self::Rhai => "submission.rhai",
            Self::Python => "submission.py",
            Self::Rust => "src/lib.rs",
            Self::C => "submission.c",
        }
    }

    /// The file by which a folder is known as a project of this language; none for what is graded as it is, which is no project.
    pub fn project_file(self) -> Option<&'static str> {
        match self {
            Self::Rhai | Self::Python => None,
            Self::Rust => Some("Cargo.toml"),
            Self::C => Some(self.source()),
        }
    }

    /// The program that builds a project of this language and its arguments, run in the project's folder; none for what is graded as it is.
    pub fn build(self) -> Option<&'static [&'static str]> {
        match self {
            Self::Rhai | Self::Python => None,
            Self::Rust => Some(BUILD_RUST),
            Self::C => Some(BUILD_C),
        }
    }

    /// The line that builds a project, for a terminal; none for a script.
    pub fn build_line(self) -> Option<String> {
        Some(self.build()?.join(" "))
    }

    /// Whether the text of a source in this language defines the function that a task calls `name`, as far as its words say.
    pub fn defines(self, source: &str, name: &str) -> bool {
        let head = match self {
            Self::Rhai | Self::Rust => format!("fn {name}"),
            Self::Python => format!("def {name}"),
            Self::C => format!("km_{name}"),
        };
        let mut rest = source.split(&head).skip(1);
        rest.any(|rest| rest.trim_start().starts_with('('))
    }

    /// How to get the program that builds it; none for a script.
    pub fn toolchain(self) -> Option<&'static str> {
        match self {
            Self::Rhai | Self::Python => None,
            Self::Rust => Some(
                "install Rust from https://rustup.rs, then run `rustup target add wasm32-unknown-unknown` once",
            ),
            Self::C => Some(
                "install clang and its linker for WebAssembly: `apt install clang lld` on Debian and Ubuntu, `dnf install clang lld` on \
                 Fedora, `brew install llvm lld` on macOS (that of Xcode cannot build WebAssembly), `winget install LLVM.LLVM` on Windows",
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_is_known_by_its_head() {
        let c = "km_u32  km_jacobian (const km_robot *robot) {";
        assert!(Language::C.defines(c, "jacobian"));
        assert!(!Language::C.defines(c, "jacob"));
        let rust = "fn control_all() {}\n    fn control(&mut self) {}";
        assert!(Language::Rust.defines(rust, "control"));
        let python = "def control (observation):\n    pass\n";
        assert!(Language::Python.defines(python, "control"));
        assert!(!Language::Python.defines(python, "observation"));
        assert!(!Language::Rust.defines(rust, "con"));
    }

    /// Wherever a line is printed that builds a submission, it is the one that `--build` runs.
    #[test]
    fn every_place_that_shows_a_build_line_shows_this_one() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        let text = |path: &str| std::fs::read_to_string(format!("{root}/{path}")).unwrap();
        let labs = std::fs::read_dir(format!("{root}/labs")).unwrap();
        let labs = labs.map(|lab| lab.unwrap().file_name().into_string().unwrap());
        let labs: Vec<String> = labs
            .filter(|lab| lab.starts_with(|c: char| c.is_ascii_digit()))
            .collect();
        assert!(labs.len() >= 5, "{labs:?}");
        for language in [Language::Rust, Language::C] {
            let line = language.build_line().unwrap();
            let begin = format!("{} ", line.split("wasm32").next().unwrap());
            let begin = begin.trim_end();
            let mut places = vec!["docs/plugin.md".to_owned()];
            places.push(match language {
                Language::C => "grader/plugin/c/kinemark.h".to_owned(),
                _ => "grader/plugin/rust/README.md".to_owned(),
            });
            let starters = labs.iter();
            places.extend(starters.map(|lab| format!("labs/{lab}/{}", language.starter())));
            for place in places {
                let text = text(&place);
                assert!(text.contains(&line), "{place} does not show `{line}`");
                let others = text.matches(begin).count() - text.matches(&line).count();
                assert_eq!(others, 0, "{place} shows another line, too");
            }
        }
    }
}
