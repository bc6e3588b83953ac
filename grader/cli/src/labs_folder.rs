//! Where labs are found: in the folder given, in a `labs` folder here or above, or in the copy inside the binary.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::load::lab_names;
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use rust_embed::Embed;

use crate::disk::Folder;
use crate::environment;
use crate::failure::Failure;
use crate::output;

/// Which folder the labs come from.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct LabsFolderArgs {
    /// Folder of the labs [default: a `labs` folder here or above, else the built-in labs] [env: KINEMARK_LABS]
    #[arg(
        long,
        value_name = "DIR",
        default_value = environment::labs(),
        hide_default_value = true
    )]
    pub(crate) labs: Option<PathBuf>,
}

/// The labs as they were when the binary was built.
#[derive(Embed)]
#[folder = "../../labs"]
struct Embedded;

/// The labs built in, as [`Files`].
struct BuiltIn;

impl Files for BuiltIn {
    fn name(&self) -> String {
        "the labs built in".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(Embedded::get(path).map(|file| file.data.into_owned()))
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let prefix = if folder.is_empty() {
            String::new()
        } else {
            format!("{folder}/")
        };
        let mut names: Vec<String> = Embedded::iter()
            .filter_map(|path| {
                let inside = path.strip_prefix(prefix.as_str())?;
                Some(inside.split('/').next()?.to_owned())
            })
            .collect();
        names.sort();
        names.dedup();
        names
    }
}

/// The labs: those of `--labs`, else of a `labs` folder here or above, else those built in.
pub(crate) fn open(args: &LabsFolderArgs) -> Result<(Box<dyn Files>, Option<PathBuf>), Failure> {
    open_from(args, Path::new("."))
}

/// The same with `from` as here: a course has its labs wherever a command runs.
pub(crate) fn open_from(
    args: &LabsFolderArgs,
    from: &Path,
) -> Result<(Box<dyn Files>, Option<PathBuf>), Failure> {
    if let Some(given) = &args.labs {
        if !given.is_dir() {
            return Err(Failure::usage(
                format!("`{}` is not a directory", given.display()),
                "give the folder that holds the labs, such as `--labs course/labs`",
            ));
        }
        return Ok((Box::new(Folder::new(given.clone())), Some(given.clone())));
    }
    match found_upwards(from) {
        Some(found) => Ok((Box::new(Folder::new(found.clone())), Some(found))),
        None => Ok((Box::new(BuiltIn), None)),
    }
}

/// The labs built in.
pub(crate) fn built_in() -> impl Files {
    BuiltIn
}

/// A text that every lab has: `starter.rhai` or `brief.md`.
pub(crate) fn text(files: &dyn Files, lab: &str, name: &str) -> Result<String, Failure> {
    match files.read(&format!("{lab}/{name}")) {
        Ok(Some(text)) => Ok(text),
        Ok(None) => Err(Failure::broken(
            format!("lab `{lab}` has no {name}"),
            "a lab needs a starter.rhai and a brief.md beside its lab.toml",
        )),
        Err(why) => Err(Failure::broken(format!("{lab}/{name}: {why}"), UNREAD_HELP)),
    }
}

/// The name of the lab that is meant by what was typed: that name, or the only lab that begins with it.
///
/// # Errors
/// Exit code 2 where several labs begin with it, and where it is the folder of a lab.
pub(crate) fn full_name(files: &dyn Files, typed: &str) -> Result<String, Failure> {
    let names = lab_names(files);
    if typed.is_empty() || names.iter().any(|name| name == typed) {
        return Ok(typed.to_owned());
    }
    let begin: Vec<&String> = names
        .iter()
        .filter(|name| name.starts_with(typed))
        .collect();
    match &begin[..] {
        [one] => Ok((*one).clone()),
        // whoever loads it says which labs there are
        [] => typed_folder(typed).map_or_else(|| Ok(typed.to_owned()), Err),
        several => {
            let names: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
            Err(Failure::usage(
                format!("`{typed}` may be {}", names.join(" or ")),
                "type enough of the name that one lab is left",
            ))
        }
    }
}

/// What to do where the folder of a lab was typed in place of its name.
fn typed_folder(typed: &str) -> Option<Failure> {
    let folder = Path::new(typed);
    if !folder.join("lab.toml").is_file() {
        return None;
    }
    let folder = folder.canonicalize().ok()?;
    let name = folder.file_name()?.to_str()?;
    let here = std::env::current_dir().ok()?.canonicalize().ok()?;
    let labs = match relative(folder.parent()?, &here) {
        labs if labs.as_os_str().is_empty() => PathBuf::from("."),
        labs => labs,
    };
    let labs = output::path(&labs);
    Some(Failure::usage(
        format!("`{typed}` is the folder of a lab, and a lab is given by its name"),
        &format!("type `{name} --labs {labs}` in place of it"),
    ))
}

/// Whether a folder is one of labs, which has a robots folder or the folder of a lab in it: another project's `labs` is none. Labs whose
/// robots are rows of joints need no robots folder.
pub(crate) fn is_labs(folder: &Path) -> bool {
    let has_lab = || {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries
            .map(|entry| entry.path().join("lab.toml"))
            .any(|file| file.is_file())
    };
    folder.join("robots").is_dir() || has_lab()
}

/// A `labs` folder in `from` or above.
fn found_upwards(from: &Path) -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    let from = here.join(from).canonicalize().ok()?;
    from.ancestors()
        .map(|folder| folder.join("labs"))
        .find(|labs| is_labs(labs))
        .map(|labs| relative(&labs, &here))
}

/// `path` as seen from `here` where it lies above: messages name `../labs`, not the machine's folders.
pub(crate) fn relative(path: &Path, here: &Path) -> PathBuf {
    for (up, above) in here.ancestors().enumerate() {
        if let Ok(inside) = path.strip_prefix(above) {
            let mut seen = PathBuf::new();
            for _ in 0..up {
                seen.push("..");
            }
            // an empty path would leave a `/` behind
            seen.extend(inside.components());
            return seen;
        }
    }
    path.to_owned()
}
