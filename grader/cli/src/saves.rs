//! Which saves concern a grade: those of the submission, or of the sources that it is built from, of the variant beside it, and of the lab and the staff's part where they
//! come from folders.

use std::path::{Component, Path, PathBuf};
use std::sync::mpsc::Sender;

use kinemark_course::module_sources::may_be_program;
use kinemark_grader::lab::variant::VARIANT_FILE;
use notify::{EventKind, RecursiveMode, Watcher as _};

use crate::commands::grade;
use crate::disk::{self, plain};
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::project::Project;
use crate::{labs_folder, staff_folder};

/// What a watched grade reacts to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WatchEvent {
    /// Something that is graded with may be another.
    Saved,
    /// Ctrl-C.
    Stop,
}

/// Listens as long as it lives.
pub(crate) struct Saves {
    _watcher: notify::RecommendedWatcher,
}

impl Saves {
    /// Starts to send an event to `events` for every save that concerns the grade.
    pub(crate) fn listen(
        request: &grade::Request<'_>,
        events: Sender<WatchEvent>,
    ) -> Result<Self, Failure> {
        let concerns = Concerns::of(request)?;
        let trees = concerns.trees.iter().chain(&concerns.project);
        let trees: Vec<PathBuf> = trees.cloned().collect();
        // folders and not files: editors put another file in a file's place
        let folders = concerns.files.iter().map(|file| parent(file).to_owned());
        let mut folders: Vec<PathBuf> = folders.collect();
        folders.sort();
        folders.dedup();
        let mut watcher =
            notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
                let saved = match event {
                    Ok(event) => concerns.event(&event),
                    // what was missed is not known: better once too often
                    Err(_) => true,
                };
                if saved {
                    // the other side being gone is the end
                    let _ = events.send(WatchEvent::Saved);
                }
            })
            .map_err(|error| unheard(&error))?;
        let all = folders
            .iter()
            .map(|folder| (folder, RecursiveMode::NonRecursive));
        let all = all.chain(trees.iter().map(|tree| (tree, RecursiveMode::Recursive)));
        for (folder, how) in all {
            watcher
                .watch(folder, how)
                .map_err(|error| unheard(&error))?;
        }
        Ok(Self { _watcher: watcher })
    }
}

fn unheard(error: &notify::Error) -> Failure {
    let why = match &error.kind {
        notify::ErrorKind::Io(error) => plain(error),
        notify::ErrorKind::MaxFilesWatch => "too many files are watched already".to_owned(),
        other => format!("{other:?}"),
    };
    Failure::fault(
        format!("cannot watch files: {why}"),
        "use `kinemark grade` after each change",
    )
}

/// What a grade rests on.
#[derive(Debug)]
struct Concerns {
    /// Files that count: the submission, and the variant beside it or given.
    files: Vec<PathBuf>,
    /// Folders in which everything counts.
    trees: Vec<PathBuf>,
    /// The folder of a project that is built, in which sources count. What is built from them does not: it would be built for ever.
    project: Option<PathBuf>,
    /// The report, which is written by ourselves.
    out: PathBuf,
}

impl Concerns {
    fn of(request: &grade::Request<'_>) -> Result<Self, Failure> {
        let args = request.args;
        let mut files = vec![real(&request.submission.with_file_name(VARIANT_FILE))?];
        let built = request.built()?;
        if built.is_none() {
            files.push(real(&request.submission)?);
            let modules = Project::of(&request.submission).map(|project| project.modules());
            for module in modules.into_iter().flatten() {
                files.push(real(&module)?);
            }
        }
        if let Some(variant) = &args.from.variant.variant {
            files.push(real(variant)?);
        }
        let (_, labs) = labs_folder::open(&args.from.labs_folder)?;
        let mut trees = Vec::new();
        // any other text names no folder of the labs; grading says so
        let mut parts = Path::new(&request.lab).components();
        let is_name = matches!(
            (parts.next(), parts.next()),
            (Some(Component::Normal(_)), None)
        );
        if let (Some(labs), true) = (&labs, is_name) {
            let parts = ["robots", "scenes", &request.lab];
            trees.extend(parts.map(|part| labs.join(part)));
            if let Some(reference) = staff_folder::open(&args.from.staff, Some(labs))? {
                trees.push(reference.path().join(&request.lab));
            }
        }
        // where links lead, as events name it; what is not there cannot be listened to
        let trees = trees
            .into_iter()
            .filter_map(|tree| tree.canonicalize().ok());
        Ok(Self {
            files,
            trees: trees.collect(),
            project: built.and_then(|project| disk::real(project.folder()).canonicalize().ok()),
            out: disk::real(&request.out),
        })
    }

    /// Whether something happened to what a grade rests on.
    fn event(&self, event: &notify::Event) -> bool {
        // grading reads these files itself
        if matches!(event.kind, EventKind::Access(_)) {
            return false;
        }
        event.need_rescan() || event.paths.iter().any(|path| self.path(path))
    }

    fn path(&self, path: &Path) -> bool {
        if self.files.iter().any(|file| file == path) {
            return true;
        }
        let in_project = self
            .project
            .as_ref()
            .and_then(|folder| path.strip_prefix(folder).ok());
        if let Some(inside) = in_project {
            let names = inside
                .components()
                .map(|part| part.as_os_str().to_string_lossy());
            let names: Vec<_> = names.collect();
            let is_source = may_be_program(&names.join("/"))
                && !names.last().is_some_and(|name| name.ends_with('~'));
            if is_source && !path.starts_with(&self.out) {
                return true;
            }
        }
        let inside = self
            .trees
            .iter()
            .find_map(|tree| path.strip_prefix(tree).ok());
        // what editors put beside a file while it is open
        let is_passing = |part: Component<'_>| {
            let name = part.as_os_str().as_encoded_bytes();
            name.starts_with(b".") || name.ends_with(b"~")
        };
        inside.is_some_and(|inside| {
            !path.starts_with(&self.out) && !inside.components().any(is_passing)
        })
    }
}

/// A file that may be there, by the folder that links lead to: as events name it.
fn real(file: &Path) -> Result<PathBuf, Failure> {
    let folder = parent(file).canonicalize().ok();
    match (folder, file.file_name()) {
        (Some(folder), Some(name)) => Ok(folder.join(name)),
        _ => Err(Failure::usage(
            format!("there is no file `{}`", file.display()),
            "check the path",
        )
        .coded(ErrorCode::NoFile)),
    }
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder for the report that is not there, nor the one above it: what is written there is our own.
    #[test]
    fn a_report_below_the_lab_is_no_save_of_it() {
        use clap::Parser as _;
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().canonicalize().unwrap();
        std::fs::create_dir_all(folder.join("labs/one")).unwrap();
        std::fs::write(folder.join("mine.rhai"), "").unwrap();
        let path = |name: &str| folder.join(name).display().to_string();
        for out in ["labs/one/reports/first/out", "labs/one/out"] {
            let args = [
                "kinemark",
                "grade",
                "one",
                &path("mine.rhai"),
                "--out",
                &path(out),
                "--labs",
                &path("labs"),
            ];
            let args = crate::command_line::CommandLine::try_parse_from(args).unwrap();
            let Some(crate::command_line::Command::Grade(args)) = args.command else {
                panic!("{args:?}")
            };
            let concerns = Concerns::of(&args.filled().unwrap()).unwrap();
            assert!(
                !concerns.path(&folder.join(out).join("report.html")),
                "{out}"
            );
            assert!(concerns.path(&folder.join("labs/one/lab.toml")));
        }
    }

    #[test]
    fn saves_of_what_is_graded_with_count_and_others_do_not() {
        let concerns = Concerns {
            files: vec!["/course/mine.rhai".into(), "/course/variant.toml".into()],
            project: None,
            trees: vec!["/labs/one".into(), "/labs/robots".into()],
            out: "/labs/one/out".into(),
        };
        for path in [
            "/course/mine.rhai",
            "/course/variant.toml",
            "/labs/one/lab.toml",
            "/labs/robots/a/b.stl",
        ] {
            assert!(concerns.path(Path::new(path)), "{path}");
        }
        for path in [
            "/course/mine.rhai~",
            "/course/out/mine.rhai",
            "/course",
            "/labs/two/lab.toml",
            "/labs/one/.lab.toml.swp",
            "/labs/one/lab.toml~",
            "/labs/one/out/report.html",
            "/labs/one/.kinemark-x/report/report.html",
        ] {
            assert!(!concerns.path(Path::new(path)), "{path}");
        }
        let read = notify::Event::new(EventKind::Access(notify::event::AccessKind::Any))
            .add_path("/course/mine.rhai".into());
        assert!(!concerns.event(&read));
        let written = notify::Event::new(EventKind::Modify(notify::event::ModifyKind::Any))
            .add_path("/course/mine.rhai".into());
        assert!(concerns.event(&written));
    }

    #[test]
    fn sources_of_a_project_count_and_what_is_built_from_them_does_not() {
        let concerns = Concerns {
            files: Vec::new(),
            project: Some("/student".into()),
            trees: Vec::new(),
            out: "/student/reports".into(),
        };
        for path in ["submission.c", "src/lib.rs", "Cargo.toml", "include/arm.h"] {
            assert!(concerns.path(&Path::new("/student").join(path)), "{path}");
        }
        for path in [
            "submission.wasm",
            "target/wasm32-unknown-unknown/release/submission.wasm",
            "target/debug/build/x.rs",
            "out/report.html",
            "reports/lab/01/starter.rs",
            ".kinemark-history.json",
            "Cargo.lock",
            "submission.c~",
            ".submission.c.swp",
            "README.md",
        ] {
            assert!(!concerns.path(&Path::new("/student").join(path)), "{path}");
        }
    }
}
