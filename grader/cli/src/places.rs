//! Where labs and the staff's part are found: a folder given, a folder found upwards, or the copy inside the binary.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::Files;
use rust_embed::Embed;

use crate::args::{PlaceArgs, StaffArgs};
use crate::disk::Folder;
use crate::failure::Failure;

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
pub(crate) fn labs(args: &PlaceArgs) -> Result<(Box<dyn Files>, Option<PathBuf>), Failure> {
    if let Some(given) = &args.labs {
        if !given.is_dir() {
            return Err(Failure::usage(
                format!("`{}` is not a folder", given.display()),
                "give the folder that holds the labs, such as `--labs course/labs`",
            ));
        }
        return Ok((Box::new(Folder::new(given.clone())), Some(given.clone())));
    }
    match found_upwards() {
        Some(found) => Ok((Box::new(Folder::new(found.clone())), Some(found))),
        None => Ok((Box::new(BuiltIn), None)),
    }
}

/// A `labs` folder with a robots folder in it, here or above: another project's `labs` is none.
fn found_upwards() -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    here.ancestors()
        .map(|folder| folder.join("labs"))
        .find(|labs| labs.join("robots").is_dir())
        .map(|labs| relative(&labs, &here))
}

/// `path` as seen from `here` where it lies above: messages name `../labs`, not the machine's folders.
fn relative(path: &Path, here: &Path) -> PathBuf {
    for (up, above) in here.ancestors().enumerate() {
        if let Ok(inside) = path.strip_prefix(above) {
            let mut seen = PathBuf::new();
            for _ in 0..up {
                seen.push("..");
            }
            seen.push(inside);
            return seen;
        }
    }
    path.to_owned()
}

/// The staff's part: that of `--reference`, else a `reference` folder beside the labs folder; `None` in practice.
pub(crate) fn reference(args: &StaffArgs, labs: Option<&Path>) -> Result<Option<Folder>, Failure> {
    if args.practice {
        return Ok(None);
    }
    if let Some(given) = &args.reference {
        if !given.is_dir() {
            return Err(Failure::usage(
                format!("`{}` is not a folder", given.display()),
                "give the staff's folder, or leave it out to practise",
            ));
        }
        return Ok(Some(Folder::new(given.clone())));
    }
    let beside = labs.map(|labs| {
        let parent = labs
            .parent()
            .filter(|parent| !parent.as_os_str().is_empty());
        parent.unwrap_or(Path::new(".")).join("reference")
    });
    let beside = beside.filter(|folder| folder.is_dir());
    Ok(beside.map(|folder| {
        let plain = folder.strip_prefix(".").map(Path::to_owned);
        Folder::new(plain.unwrap_or(folder))
    }))
}
