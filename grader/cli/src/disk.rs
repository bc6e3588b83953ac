//! Reading files that people name: a folder of labs, a submission, a robot; never more than makes sense, always as UTF-8.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use kinemark_grader::task::files::Files;
use kinemark_grader::task::files::text;
use kinemark_sim::text::Source;

use crate::error_record::ErrorCode;
use crate::failure::Failure;

/// A folder as [`Files`].
pub(crate) struct Folder {
    path: PathBuf,
}

/// Labs, robots and references are written by people; above this a file is something else.
pub(crate) const MOST_BYTES: u64 = 16 << 20;

/// Above this a file is no mesh of a link.
pub(crate) const MOST_MESH_BYTES: u64 = 256 << 20;

impl Folder {
    pub(crate) fn new(path: PathBuf) -> Self {
        Self { path }
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The file at `path`, if there is one; names in lab files stay inside the folder.
    fn inside(&self, path: &str) -> Option<PathBuf> {
        let plain = Path::new(path)
            .components()
            .all(|part| matches!(part, std::path::Component::Normal(_)));
        let full = self.path.join(path);
        (plain && full.is_file()).then_some(full)
    }
}

impl Files for Folder {
    fn name(&self) -> String {
        self.path.display().to_string()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        match self.inside(path) {
            Some(full) => bytes_of(&full, MOST_MESH_BYTES).map(Some),
            None => Ok(None),
        }
    }

    fn read(&self, path: &str) -> Result<Option<String>, String> {
        match self.inside(path) {
            Some(full) => text(bytes_of(&full, MOST_BYTES)?).map(Some),
            None => Ok(None),
        }
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path.join(folder))
            .into_iter()
            .flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort();
        names
    }
}

/// What a plain file of at most `most` bytes holds; why not, in words. A pipe, which would have to be waited for, and a device, which
/// may never end, are none.
pub(crate) fn bytes_of(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    contents(open(path).map_err(|error| plain(&error))?, most)
}

/// What an opened file of at most `most` bytes holds, if it is a plain file; why not, in words.
pub(crate) fn contents(file: File, most: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    // one byte more shows that a file is longer, without reading all of it
    plain_file(file, most)?
        .take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| plain(&error))?;
    if bytes.len() as u64 > most {
        return Err(too_large(most));
    }
    Ok(bytes)
}

/// An opened file, if it is a plain file of at most `most` bytes; why not, in words.
pub(crate) fn plain_file(file: File, most: u64) -> Result<File, String> {
    // asked of what was opened: what lies at the path may be another by now
    let there = file.metadata().map_err(|error| plain(&error))?;
    if !there.is_file() {
        return Err("it is no plain file".to_owned());
    }
    if there.len() > most {
        return Err(too_large(most));
    }
    Ok(file)
}

/// Opens a file to read, and never waits for a pipe's other end.
pub(crate) fn open(path: &Path) -> std::io::Result<File> {
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        // the same bits in every type that flags of the system are kept in
        options.custom_flags(rustix::fs::OFlags::NONBLOCK.bits() as i32);
    }
    options.open(path)
}

/// Where a path leads once every link is followed, as far as anything is there.
pub(crate) fn real(path: &Path) -> PathBuf {
    let mut missing = Vec::new();
    for there in path.ancestors() {
        let folder = if there.as_os_str().is_empty() {
            Path::new(".")
        } else {
            there
        };
        if let Ok(mut real) = folder.canonicalize() {
            real.extend(missing.iter().rev());
            return real;
        }
        // `..` has no name: what it leads to is not known
        match there.file_name() {
            Some(name) => missing.push(name),
            None => break,
        }
    }
    path.to_owned()
}

/// An operating system's message without its number.
pub(crate) fn plain(error: &std::io::Error) -> String {
    let text = error.to_string();
    match text.split_once(" (os error") {
        Some((message, _)) => message.to_lowercase(),
        None => text,
    }
}

/// Reads the text that a person named `path`, which should be `what`, of at most `most` bytes.
pub(crate) fn read(path: &Path, what: &str, most: u64) -> Result<Source, Failure> {
    source(path, what, read_bytes(path, what, most)?)
}

/// The text that the bytes of the file at `path` are.
pub(crate) fn source(path: &Path, what: &str, bytes: Vec<u8>) -> Result<Source, Failure> {
    let text = text(bytes).map_err(|why| unread(path, what, &why, "save it as UTF-8 text"))?;
    Ok(Source::new(path.display().to_string(), text))
}

fn unread(path: &Path, what: &str, why: &str, help: &str) -> Failure {
    let shown = path.display();
    Failure::usage(format!("`{shown}` cannot be read as {what}: {why}"), help)
}

/// Reads the file that a person named `path`, which should be `what`, of at most `most` bytes.
pub(crate) fn read_bytes(path: &Path, what: &str, most: u64) -> Result<Vec<u8>, Failure> {
    refuse_unlike(path, what)?;
    read_of(path, what, most, bytes_of(path, most))
}

/// Refuses what is no plain file, before it is opened.
pub(crate) fn refuse_unlike(path: &Path, what: &str) -> Result<(), Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::usage(
            format!("`{shown}` is a folder, not {what}"),
            "name the file itself",
        ));
    }
    if !path.exists() {
        return Err(
            Failure::usage(format!("there is no file `{shown}`"), &near_in_folder(path))
                .coded(ErrorCode::NoFile),
        );
    }
    if !path.is_file() {
        return Err(Failure::usage(
            format!("`{shown}` is a pipe or a device, not {what}"),
            "save it to a file first",
        ));
    }
    Ok(())
}

/// What was read of the file at `path`, or why not, for people.
pub(crate) fn read_of(
    path: &Path,
    what: &str,
    most: u64,
    bytes: Result<Vec<u8>, String>,
) -> Result<Vec<u8>, Failure> {
    bytes.map_err(|why| {
        if why == too_large(most) {
            let is_module = path.extension().is_some_and(|ending| ending == "wasm");
            let help = match is_module {
                true => "build it optimised: `--release` in Rust, -O2 in C".to_owned(),
                false => format!("{what} has at most {most} bytes: is it the right file?"),
            };
            return unread(path, what, &why, &help);
        }
        unread(path, what, &why, "check the file and its permissions")
    })
}

/// Refuses a variant, a lab or a robot in place of a submission.
pub(crate) fn refuse_toml(path: &Path) -> Result<(), Failure> {
    let is_toml = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    if is_toml && path.is_file() {
        return Err(Failure::usage(
            format!(
                "`{}` is a TOML file, not a submission (.rhai)",
                path.display()
            ),
            "name the program, such as submission.rhai",
        ));
    }
    Ok(())
}

fn too_large(most: u64) -> String {
    format!("more than {most} bytes")
}

/// What lies near a path that does not exist.
fn near_in_folder(path: &Path) -> String {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let wanted = path.file_name().unwrap_or_default().to_string_lossy();
    let names = Folder::new(folder.to_owned()).list("");
    let near = kinemark_sim::text::nearest(&wanted, names.iter().map(String::as_str));
    match near {
        Some(near) => format!("did you mean `{}`?", folder.join(near).display()),
        None if folder.is_dir() => "check the path".to_owned(),
        None => format!("there is no folder `{}` either", folder.display()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_a_size() {
        let bed = tempfile::tempdir().unwrap();
        let file = bed.path().join("file");
        std::fs::write(&file, "four").unwrap();
        assert_eq!(bytes_of(&file, 4).unwrap(), b"four");
        assert_eq!(bytes_of(&file, 3).unwrap_err(), "more than 3 bytes");
        assert!(bytes_of(bed.path(), 9).is_err());
    }

    /// A pipe that nobody writes to, and a device that never ends.
    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_refused_at_once() {
        let bed = tempfile::tempdir().unwrap();
        let pipe = bed.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        assert_eq!(bytes_of(&pipe, 9).unwrap_err(), "it is no plain file");
        let endless = Path::new("/dev/zero");
        assert_eq!(bytes_of(endless, 9).unwrap_err(), "it is no plain file");
    }

    #[test]
    fn a_path_is_real_as_far_as_it_is_there() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().canonicalize().unwrap();
        assert_eq!(real(&folder.join("a/b/out")), folder.join("a/b/out"));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&folder, folder.join("link")).unwrap();
            assert_eq!(real(&folder.join("link/a/out")), folder.join("a/out"));
        }
        let here = std::env::current_dir().unwrap().canonicalize().unwrap();
        assert_eq!(real(Path::new("no-such/out")), here.join("no-such/out"));
    }
}
