//! `kinemark new`: a folder with a lab's starter and brief (as text and as a page), for a script or as a project that is compiled, and
//! nothing of it overwritten.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::durable::{self, Readers};
use kinemark_course::language::Language;
use kinemark_course::working_folder::working_folder;
use kinemark_report::visible::visible;
use serde::Serialize;

use crate::chosen_variant::{self, Chosen, LabArgs};
use crate::error_record::ErrorCode;
use crate::failure::{BROKEN, Failure};
use crate::unfinished::UnfinishedFolder;
use crate::{interrupt, output};

/// Start a lab: writes its starter and its brief into a folder
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark new 01-kinematics\n  cd 01-kinematics\n  kinemark grade\n\n  \
    kinemark new 01-kinematics --lang python\n  kinemark new 01-kinematics --lang c\n\n\
    With --lang rust and --lang c the folder is a project with everything that it needs to build; its README.md has the commands. \
    See docs/plugin.md."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// Folder to write to [default: the lab's name]
    pub(crate) dir: Option<PathBuf>,
    /// The language to write it in; Rust and C are compiled to WebAssembly
    #[arg(long, value_enum, default_value = "rhai")]
    pub(crate) lang: Lang,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) from: LabArgs,
}

/// A language, as `--lang` names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Lang {
    /// A script, graded as it is.
    Rhai,
    /// A file in Python, graded as it is.
    Python,
    /// A crate.
    Rust,
    /// A file with a header.
    C,
}

impl From<Lang> for Language {
    fn from(lang: Lang) -> Self {
        match lang {
            Lang::Rhai => Self::Rhai,
            Lang::Python => Self::Python,
            Lang::Rust => Self::Rust,
            Lang::C => Self::C,
        }
    }
}

#[derive(Serialize)]
struct Written {
    lab: String,
    files: Vec<PathBuf>,
}

/// Writes the folder.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let Chosen { lab, files, .. } = chosen_variant::choose(&args.lab, &args.from, None)?;
    let dir = args.dir.clone().unwrap_or_else(|| PathBuf::from(&lab.name));
    if dir.exists() && !dir.is_dir() {
        return Err(Failure::usage(
            format!("`{}` is a file", dir.display()),
            "name a folder: it is made where there is none",
        ));
    }
    let language = Language::from(args.lang);
    let written = working_folder(files.as_ref(), &lab, language)
        .map_err(|error| Failure::diagnostic(BROKEN, error))?;
    let written: Vec<(PathBuf, String)> = written
        .into_iter()
        .map(|(name, text)| (dir.join(name), text))
        .collect();
    if let Some((there, _)) = written.iter().find(|(path, _)| path.exists()) {
        return Err(Failure::usage(
            format!("`{}` already exists", there.display()),
            "name another folder, or move your work away first: nothing is overwritten",
        )
        .coded(ErrorCode::Exists));
    }
    put_in_place(&dir, &written)?;
    let paths: Vec<PathBuf> = written.into_iter().map(|(path, _)| path).collect();
    if args.json {
        output::print_formatted(&Written {
            lab: lab.name,
            files: paths,
        })?;
    } else {
        output::print(&format!(
            "{}\nRead {}, then edit {} and run in that folder:\n  cd {}\n{}  kinemark grade\n",
            visible(&lab.title),
            output::path(&paths[1]),
            output::path(&paths[0]),
            output::path(&dir),
            language
                .build_line()
                .map(|build| format!("  {build}\n"))
                .unwrap_or_default()
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes all files in a temporary folder inside `dir`, then renames each to its place: a part of them would stand in the way of the
/// next try.
fn put_in_place(dir: &Path, files: &[(PathBuf, String)]) -> Result<(), Failure> {
    let help = "free some space, or choose another folder";
    let failed = |path: &Path, error| output::unwritten(path, &error, help);
    // Ctrl-C waits for the few renames
    interrupt::listen();
    let is_new = !dir.exists();
    std::fs::create_dir_all(dir).map_err(|error| failed(dir, error))?;
    let placed = rename_in(dir, files);
    if let Err((there, path, error)) = placed {
        // a file that cannot be removed either is not worth a second message
        for (path, _) in &files[..there] {
            let _ = std::fs::remove_file(path);
        }
        // folders that hold nothing, the inner ones first
        for (path, _) in files {
            let above = path.ancestors().skip(1);
            for inner in above.take_while(|inner| *inner != dir) {
                let _ = std::fs::remove_dir(inner);
            }
        }
        if is_new {
            let _ = std::fs::remove_dir(dir);
        }
        return Err(failed(&path, error));
    }
    Ok(())
}

/// The renames; of a failure how many files stand in their place, which one fails, and why.
fn rename_in(
    dir: &Path,
    files: &[(PathBuf, String)],
) -> Result<(), (usize, PathBuf, std::io::Error)> {
    let none = |error| (0, dir.to_owned(), error);
    let unfinished = UnfinishedFolder::in_folder(dir).map_err(none)?;
    let beside = |at: usize| unfinished.path().join(at.to_string());
    for (at, (path, text)) in files.iter().enumerate() {
        std::fs::write(beside(at), text).map_err(|error| (0, path.clone(), error))?;
    }
    durable::sync_tree(unfinished.path()).map_err(none)?;
    for (at, (path, _)) in files.iter().enumerate() {
        let folder = durable::parent(path);
        durable::make_folder(folder, Readers::Umask)
            .and_then(|()| std::fs::rename(beside(at), path))
            .and_then(|()| durable::sync_folder(folder))
            .map_err(|error| (at, path.clone(), error))?;
    }
    Ok(())
}
