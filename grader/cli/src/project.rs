//! A submission that is compiled, in the folder of its project: which module is graded, what is newer than it, how it is built, and its
//! sources.
//!
//! A project is a folder with a `Cargo.toml`, a `submission.c`, or a module called `submission.wasm`. Its submission has the path
//! `FOLDER/submission.wasm`, also where the module lies further down, because everything else of a student's folder lies beside it.

use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use kinemark_course::language::{CARGO_OUTPUT, CARGO_TARGET, Language, MODULE_FILE};
use kinemark_course::module_sources::{self, SourceFile};
use kinemark_course::selection::MOST_SUBMISSION_BYTES;
use kinemark_course::tree::{Limits, Tree};
use kinemark_course::working_folder::{FOLDER_FILE, PYTHON_FILE, SUBMISSION_FILE};

use crate::disk::plain;
use crate::error_record::ErrorCode;
use crate::failure::{self, Failure};
use crate::{interrupt, output, typed_path};

/// What a compiler says is kept up to this size, for the report \[bytes\]; all of it is shown.
const MOST_WORDS: usize = 64 << 10;
/// The errors of it that a report shows.
const MOST_ERRORS: usize = 6;
/// How compilers end after their errors.
const SUMS: [&str; 4] = [
    "error generated",
    "errors generated",
    "could not compile",
    "For more information about",
];
/// The characters of a line of it that a report shows.
const MOST_CHARACTERS: usize = 300;

/// A folder in which a submission is compiled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Project {
    folder: PathBuf,
}

/// Why there is no module to grade.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NoModule {
    /// What is wrong, in words.
    pub(crate) what: String,
    /// What to do.
    pub(crate) help: String,
}

/// The module of a project.
pub(crate) struct Module {
    /// Where it lies.
    pub(crate) path: PathBuf,
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
}

impl Module {
    /// The name of its file.
    pub(crate) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }
}

/// How a build ended that could be begun.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Built {
    /// There is a module.
    Yes,
    /// The compiler refuses the sources: what it says, as it says it.
    Refused(NoModule),
}

impl Project {
    /// The project in a folder, if it is one.
    pub(crate) fn at(folder: &Path) -> Option<Self> {
        let project = Self {
            folder: folder.to_owned(),
        };
        let is_one = project.has(MODULE_FILE) || !project.languages().is_empty();
        is_one.then_some(project)
    }

    /// The project whose submission lies at `path`, which need not exist; none for a script and any other file.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        if path.file_name()? != MODULE_FILE {
            // the module where cargo leaves it, named as it is
            let folder = path.parent()?;
            let above = above_cargo(folder)?;
            return path.extension()?.eq("wasm").then(|| Self::at(&above))?;
        }
        let folder = path.parent()?;
        Self::at(above_cargo(folder).as_deref().unwrap_or(folder))
    }

    /// The path of the submission of a folder that somebody named, where it is a project and nothing else in it may be meant.
    pub(crate) fn submission_in(folder: &Path) -> Option<PathBuf> {
        let project = Self::at(folder).filter(Self::is_of_one_submission)?;
        let entries = std::fs::read_dir(folder).ok()?;
        let mut names = entries.flatten().map(|entry| entry.file_name());
        let is_other = |name: std::ffi::OsString| {
            let name = name.to_string_lossy().to_lowercase();
            [".rhai", ".py", ".kinemark", ".zip"]
                .iter()
                .any(|ending| name.ends_with(ending))
        };
        (!names.any(is_other)).then(|| project.submission())
    }

    /// The path of its submission.
    pub(crate) fn submission(&self) -> PathBuf {
        self.folder.join(MODULE_FILE)
    }

    /// Its folder, as it was named.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    fn has(&self, name: &str) -> bool {
        // a link is something there, too: whoever reads it refuses it
        self.folder.join(name).symlink_metadata().is_ok()
    }

    /// The languages whose projects it is: one, or none where another program builds it.
    fn languages(&self) -> Vec<Language> {
        let of_project = |language: &Language| {
            let file = language.project_file();
            file.is_some_and(|file| self.has(file))
        };
        Language::ALL.into_iter().filter(of_project).collect()
    }

    /// Whether its files say how it is built.
    pub(crate) fn can_be_built(&self) -> bool {
        self.languages().len() == 1
    }

    /// Whether a module was built, wherever it lies.
    pub(crate) fn is_built(&self) -> bool {
        !self.modules().is_empty()
    }

    /// Whether there is anything that may be graded: a module, or sources of one.
    pub(crate) fn is_there(&self) -> bool {
        self.is_built() || self.can_be_built()
    }

    /// The modules that may be meant: the one in the folder, and those where cargo leaves them.
    pub(crate) fn modules(&self) -> Vec<PathBuf> {
        let mut modules = Vec::new();
        if self.has(MODULE_FILE) {
            modules.push(self.submission());
        }
        if self.languages().contains(&Language::Rust) {
            let entries = std::fs::read_dir(self.folder.join(CARGO_OUTPUT));
            let paths = entries
                .into_iter()
                .flatten()
                .flatten()
                .map(|entry| entry.path());
            let is_module =
                |path: &PathBuf| path.extension().is_some_and(|ending| ending == "wasm");
            let mut of_cargo: Vec<PathBuf> = paths.filter(is_module).collect();
            of_cargo.sort();
            modules.extend(of_cargo);
        }
        modules
    }

    /// The module of the submission at `path`: that file, or where there is none the one that cargo left.
    ///
    /// # Errors
    /// Exit code 2 for a link and for a module that is no file; else, inside, why there is none or not one alone.
    pub(crate) fn module(&self, path: &Path) -> Result<Result<Module, NoModule>, Failure> {
        let modules = match path.symlink_metadata() {
            Ok(_) => vec![path.to_owned()],
            Err(_) => self.modules(),
        };
        let mut found = different(modules)?;
        Ok(match found.len() {
            0 => Err(NoModule {
                what: format!("there is no module yet in `{}`", self.shown()),
                help: self.how_to_build(),
            }),
            1 => Ok(found.swap_remove(0)),
            _ => Err(several(&found)),
        })
    }

    /// Refuses a folder in which the module beside the sources is another than the one that cargo left: nobody can say which one counts.
    ///
    /// # Errors
    /// Exit code 2.
    pub(crate) fn refuse_several(&self) -> Result<(), Failure> {
        let found = different(self.modules())?;
        if found.len() > 1 {
            let NoModule { what, help } = several(&found);
            return Err(Failure::usage(what, &help));
        }
        Ok(())
    }

    fn shown(&self) -> String {
        match self.folder.as_os_str().is_empty() {
            true => ".".to_owned(),
            false => output::path(&self.folder),
        }
    }

    /// What to do to get a module.
    fn how_to_build(&self) -> String {
        let lines: Vec<String> = self
            .languages()
            .into_iter()
            .filter_map(Language::build_line)
            .collect();
        match lines.as_slice() {
            [] => format!("build it, so that `{MODULE_FILE}` is there"),
            lines => format!(
                "build it in that folder with `{}`, or grade with --build",
                lines.join("` or `")
            ),
        }
    }

    /// Its sources, as they are kept with a report. A folder that only has a module is none of a project: what else lies there may be
    /// anything.
    pub(crate) fn sources(&self) -> Vec<SourceFile> {
        if !self.is_of_one_submission() {
            return Vec::new();
        }
        let Ok(tree) = Tree::open(&self.folder_or_here(), &Limits::default()) else {
            return Vec::new();
        };
        let entries = tree
            .entries()
            .iter()
            .map(|entry| (entry.path.clone(), entry));
        module_sources::sources(entries, |entry, most| tree.bytes(entry, most).ok())
    }

    /// Whether its files say that the folder is of a submission and nothing else.
    fn is_of_one_submission(&self) -> bool {
        !self.languages().is_empty() || self.has(FOLDER_FILE)
    }

    /// Whether a source was saved after the module was built, as far as the times of files say: good for a note, and for nothing else.
    pub(crate) fn is_stale(&self, module: &Module) -> bool {
        let saved = |path: &Path| path.metadata().and_then(|file| file.modified()).ok();
        let Some(built) = saved(&module.path) else {
            return false;
        };
        let Ok(tree) = Tree::open(&self.folder_or_here(), &Limits::default()) else {
            return false;
        };
        let mut sources = tree
            .entries()
            .iter()
            .filter(|entry| module_sources::may_be_program(&entry.path));
        sources
            .any(|entry| saved(&self.folder.join(&entry.path)).is_some_and(|saved| saved > built))
    }

    /// What to say where a source is newer than the module.
    pub(crate) fn warn_if_stale(&self, module: &Module) {
        if self.is_stale(module) {
            let module = output::path(&module.path);
            let message = format!(
                "the sources are newer than the module `{module}`, which is what is graded"
            );
            failure::warn_in_words(&message, &self.how_to_build());
        }
    }

    /// Builds it: runs the compiler, and whatever the project's author has it run.
    ///
    /// # Errors
    /// Exit code 2 where nothing says how it is built, 4 where this machine lacks what builds it.
    pub(crate) fn build(&self) -> Result<Built, Failure> {
        let languages = self.languages();
        let [language] = languages.as_slice() else {
            let files: Vec<&str> = Language::ALL
                .iter()
                .filter_map(|language| language.project_file())
                .collect();
            let there = if languages.is_empty() {
                "none of"
            } else {
                "more than one of"
            };
            return Err(Failure::usage(
                format!(
                    "it is not clear how `{}` is built: it has {there} {}",
                    self.shown(),
                    files.join(" and ")
                ),
                "build it yourself, then grade without --build",
            ));
        };
        let line = language.build_line().unwrap_or_default();
        failure::note_in_words(&format!("building `{}`: {line}", self.shown()));
        let run = self.run(*language)?;
        if run.is_good && self.is_built() {
            return Ok(Built::Yes);
        }
        if interrupt::asked() {
            return Err(Failure::interrupted());
        }
        if let Some(missing) = lacks(&run.words) {
            let toolchain = language.toolchain().unwrap_or_default();
            return Err(Failure::fault(
                format!("this machine cannot build {}: {missing}", language.name()),
                toolchain,
            )
            .coded(ErrorCode::NoCompiler));
        }
        let what = match run.is_good {
            true => format!("`{line}` left no module"),
            false => format!("the build fails: `{line}` ends with {}", run.ended),
        };
        let help = match errors(&run.words).as_slice() {
            [] => "look at the sources, and build again".to_owned(),
            errors => format!("correct what the compiler reports: {}", errors.join("; ")),
        };
        Ok(Built::Refused(NoModule { what, help }))
    }

    fn folder_or_here(&self) -> PathBuf {
        match self.folder.as_os_str().is_empty() {
            true => PathBuf::from("."),
            false => self.folder.clone(),
        }
    }

    fn run(&self, language: Language) -> Result<Run, Failure> {
        let Some((program, arguments)) = language.build().and_then(<[_]>::split_first) else {
            return Err(Failure::usage(
                "a script is not built".to_owned(),
                "grade it without --build",
            ));
        };
        let mut command = Command::new(program);
        command.args(arguments).current_dir(self.folder_or_here());
        if language == Language::Rust {
            // where the module is looked for, whatever the settings of this machine say
            command.args(["--target-dir", CARGO_TARGET]);
        }
        // standard output is for the grade
        command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command.env_remove("KINEMARK_SALT");
        let missing = |error: std::io::Error| {
            let why = match error.kind() {
                std::io::ErrorKind::NotFound => "there is no such program here".to_owned(),
                _ => plain(&error),
            };
            Failure::fault(
                format!("`{program}` cannot be run: {why}"),
                language.toolchain().unwrap_or_default(),
            )
            .coded(ErrorCode::NoCompiler)
        };
        let mut child = command.spawn().map_err(missing)?;
        let words = child.stderr.take().map(shown_and_kept).unwrap_or_default();
        let ended = child.wait().map_err(missing)?;
        Ok(Run {
            is_good: ended.success(),
            ended: match ended.code() {
                Some(code) => format!("exit code {code}"),
                None => "a signal".to_owned(),
            },
            words,
        })
    }
}

/// Reads modules; of those with the same bytes the first.
fn different(paths: Vec<PathBuf>) -> Result<Vec<Module>, Failure> {
    let mut found: Vec<Module> = Vec::new();
    for path in paths {
        let bytes = typed_path::bytes(&path, "a module", MOST_SUBMISSION_BYTES)?;
        if found.iter().all(|known| known.bytes != bytes) {
            found.push(Module { path, bytes });
        }
    }
    Ok(found)
}

fn several(found: &[Module]) -> NoModule {
    let paths: Vec<String> = found
        .iter()
        .map(|module| format!("`{}`", output::path(&module.path)))
        .collect();
    NoModule {
        what: format!("{} different modules may be the submission: {}", found.len(), paths.join(", ")),
        help: "name the one that counts, or remove the other: a copy stays as it is when the project is built again".to_owned(),
    }
}

/// A compiler that ran.
struct Run {
    is_good: bool,
    /// How it ended, in words.
    ended: String,
    /// What it said.
    words: String,
}

/// Shows what a compiler says as it says it, and keeps the beginning.
fn shown_and_kept(mut from: impl Read) -> String {
    let (mut kept, mut part) = (Vec::new(), [0; 4096]);
    loop {
        match from.read(&mut part) {
            Ok(0) => break,
            Ok(count) => {
                let part = &part[..count];
                // a terminal that is gone is no reason to stop building
                let _ = std::io::stderr().write_all(part);
                let room = MOST_WORDS.saturating_sub(kept.len());
                kept.extend_from_slice(&part[..count.min(room)]);
            }
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(_) => break,
        }
    }
    String::from_utf8_lossy(&kept).into_owned()
}

/// The errors in what a compiler says, each with its place: clang has both on a line, rustc the place on the next.
fn errors(words: &str) -> Vec<String> {
    let lines: Vec<&str> = words
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let at = |i: usize| lines.get(i + 1).and_then(|next| next.strip_prefix("--> "));
    let is_sum = |line: &str| SUMS.iter().any(|sum| line.contains(sum));
    let found = lines
        .iter()
        .enumerate()
        .filter(|(_, line)| line.contains("error") && !is_sum(line));
    let mut errors: Vec<String> = found
        .map(|(i, line)| {
            at(i).map_or_else(|| (*line).to_owned(), |place| format!("{place}: {line}"))
        })
        .take(MOST_ERRORS)
        .collect();
    if errors.is_empty() {
        errors.extend(
            lines
                .iter()
                .take(MOST_ERRORS)
                .map(|line| (*line).to_owned()),
        );
    }
    for line in &mut errors {
        *line = line.chars().take(MOST_CHARACTERS).collect();
    }
    errors
}

/// What this machine lacks, where that is what the compiler says; its words are those of clang and rustc.
fn lacks(words: &str) -> Option<&'static str> {
    const SAID: [(&str, &str); 5] = [
        (
            "target may not be installed",
            "Rust's standard library for wasm32-unknown-unknown is not installed",
        ),
        ("wasm-ld", "clang finds no linker for WebAssembly (wasm-ld)"),
        (
            "No available targets are compatible with triple \"wasm32\"",
            "this clang has no WebAssembly",
        ),
        (
            "unable to create target: 'No available targets",
            "this clang has no WebAssembly",
        ),
        (
            "linker `rust-lld` not found",
            "Rust's linker is not installed",
        ),
    ];
    let is_unresolved = words.contains("wasm-ld: error");
    SAID.iter()
        .find(|(said, _)| words.contains(said) && !is_unresolved)
        .map(|(_, lacks)| *lacks)
}

/// The folder above the one where cargo leaves modules, if `folder` is that.
fn above_cargo(folder: &Path) -> Option<PathBuf> {
    let output = Path::new(CARGO_OUTPUT);
    folder.ends_with(output).then(|| {
        let above = output.components().count();
        folder
            .ancestors()
            .nth(above)
            .unwrap_or(Path::new(""))
            .to_owned()
    })
}

/// The submission of the folder in which a command runs, or of one in it: the script, the file in Python, or the module of a project.
///
/// # Errors
/// Exit code 2 where there are two: nobody can say which one counts.
pub(crate) fn submission_of_folder(folder: &Path) -> Result<Option<PathBuf>, Failure> {
    let (rhai, python) = (folder.join(SUBMISSION_FILE), folder.join(PYTHON_FILE));
    let is_there = |path: &Path| path.symlink_metadata().is_ok();
    let script = match (is_there(&rhai), is_there(&python)) {
        (true, true) => {
            return Err(Failure::usage(
                format!(
                    "both `{}` and `{}` are there, and only one of them can be graded",
                    output::path(&rhai),
                    output::path(&python)
                ),
                &format!(
                    "name the one that counts, such as `kinemark grade LAB {PYTHON_FILE}`, or remove the other"
                ),
            ));
        }
        (false, true) => python,
        _ => rhai,
    };
    let project = Project::at(folder);
    let has_script = is_there(&script);
    match project {
        Some(project) if has_script && project.is_built() => Err(Failure::usage(
            format!(
                "both `{}` and a module are there, and only one of them can be graded",
                output::path(&script)
            ),
            &format!(
                "name the one that counts, such as `kinemark grade LAB {MODULE_FILE}`, or remove the other"
            ),
        )),
        _ if has_script => Ok(Some(script)),
        Some(project) => Ok(Some(project.submission())),
        None => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_compilers_have_their_places() {
        let clang = "submission.c:7:14: error: expected ';' after expression\n    7 |     a = 1\n1 error generated.\n";
        assert_eq!(
            errors(clang),
            ["submission.c:7:14: error: expected ';' after expression"]
        );
        let rustc = "   Compiling submission v0.1.0\nerror[E0308]: mismatched types\n  --> src/lib.rs:3:5\n   |\n";
        assert_eq!(
            errors(rustc),
            ["src/lib.rs:3:5: error[E0308]: mismatched types"]
        );
        assert_eq!(errors("no such thing\n"), ["no such thing"]);
        assert!(errors("\n").is_empty());
    }

    #[test]
    fn what_a_machine_lacks_is_no_mistake_of_the_sources() {
        let no_linker =
            "clang: error: unable to execute command: Executable \"wasm-ld\" doesn't exist!";
        assert!(lacks(no_linker).is_some());
        assert!(lacks("error[E0463]: can't find crate for `core`\n  = note: the `wasm32-unknown-unknown` target may not be installed").is_some());
        assert_eq!(
            lacks("wasm-ld: error: submission.o: undefined symbol: gain"),
            None
        );
        assert_eq!(lacks("submission.c:1:1: error: x"), None);
    }

    #[test]
    fn a_project_is_known_by_its_files_and_its_module_by_its_place() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("Übung");
        std::fs::create_dir_all(folder.join(CARGO_OUTPUT)).unwrap();
        assert_eq!(Project::at(&folder), None);
        std::fs::write(folder.join("Cargo.toml"), "").unwrap();
        let project = Project::at(&folder).unwrap();
        let module = || project.module(&project.submission()).unwrap();
        assert!(module().is_err_and(|none| none.help.contains("cargo build --release")));
        assert_eq!(
            Project::submission_in(&folder),
            Some(folder.join(MODULE_FILE))
        );
        let of_cargo = folder.join(CARGO_OUTPUT).join("arm.wasm");
        std::fs::write(&of_cargo, "1").unwrap();
        assert_eq!(module().unwrap().path, of_cargo);
        assert_eq!(Project::of(&of_cargo), Some(project.clone()));
        assert_eq!(Project::of(&project.submission()), Some(project.clone()));
        // the same bytes twice are one module, and others are for a person
        std::fs::write(project.submission(), "1").unwrap();
        assert!(project.refuse_several().is_ok());
        std::fs::write(project.submission(), "2").unwrap();
        assert!(project.refuse_several().is_err());
        assert_eq!(module().unwrap().bytes, b"2", "it was named");
        std::fs::write(folder.join(SUBMISSION_FILE), "").unwrap();
        assert!(submission_of_folder(&folder).is_err());
        assert_eq!(Project::submission_in(&folder), None);
        assert_eq!(Project::of(&folder.join("other.wasm")), None);
    }
}
