//! The book: the folder that the program writes. Records, submissions, and the versions of labs and staff parts that made them, each
//! under a name that follows from its content, whole or absent; nothing in it is ever changed, so books join by copying.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use jiff::Timestamp;
use kinemark_grader::record::grade::Grade;
use kinemark_grader::task::files::Files;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::durable;
use crate::journal::{Journal, Writer};
use crate::module_sources::SourceFile;
use crate::private_files::{UNFINISHED, fill, fresh_folder, private_folder, put, sweep};
use crate::sources_archive::{packed, unpacked};

/// The format of records that this version writes.
const FORMAT: &str = "kinemark-record/1";

/// The folder of what was graded on a cluster, in the book's.
pub const RUNS: &str = "slurm";

/// The grade of one submission, under the key of everything that it follows from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Always `kinemark-record/1`.
    format: String,
    /// The key ([`Inputs::key`]).
    pub key: String,
    /// What it was made from.
    pub inputs: Inputs,
    /// The grade.
    pub grade: Grade,
}

/// Everything that a grade follows from, by digest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Inputs {
    /// The engine: its version, and a digest of its sources.
    pub engine: String,
    /// The lab's name.
    pub lab_name: String,
    /// The lab in its variant.
    pub lab: String,
    /// The robot.
    pub robot: String,
    /// The scenes.
    pub scenes: Vec<String>,
    /// The staff part with its salt; none in practice.
    pub staff: Option<String>,
    /// The student whose variant it is, if it is one.
    pub variant_of: Option<String>,
    /// The name of the submission's file, which the grade shows.
    pub file: String,
    /// The submission.
    pub submission: String,
    /// The archive of its sources, where it is a module with some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sources: Option<String>,
    /// The version of the lab's files in the book.
    pub lab_version: String,
    /// The version of the staff part's files in the book.
    pub staff_version: Option<String>,
}

impl Inputs {
    /// The key: a digest over all of them.
    pub fn key(&self) -> String {
        let mut hasher = blake3::Hasher::new_derive_key("kinemark 2026 record of a course v1");
        let mut add = |part: &str| {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part.as_bytes());
        };
        for part in [
            &self.engine,
            &self.lab_name,
            &self.lab,
            &self.robot,
            &self.file,
            &self.submission,
            &self.lab_version,
        ] {
            add(part);
        }
        for part in [&self.staff, &self.variant_of, &self.staff_version] {
            add(if part.is_some() { "some" } else { "none" });
            add(part.as_deref().unwrap_or_default());
        }
        for scene in &self.scenes {
            add(scene);
        }
        // no scene is called so, and a script has the key that it always had
        if let Some(sources) = &self.sources {
            add("sources");
            add(sources);
        }
        hasher.finalize().to_hex().to_string()
    }
}

impl Record {
    /// The record of a grade.
    pub fn new(inputs: Inputs, grade: Grade) -> Self {
        Self {
            format: FORMAT.to_owned(),
            key: inputs.key(),
            inputs,
            grade,
        }
    }
}

/// What goes wrong with a book.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("`{}`: {why}", path.display())]
pub struct BookError {
    /// The file or folder.
    pub path: PathBuf,
    /// Why, in words.
    pub why: String,
}

/// A book.
#[derive(Debug, Clone)]
pub struct Book {
    root: PathBuf,
    /// Files that were written and may not be on the disk yet: a class has hundreds, and waiting for each alone takes long.
    unsynced: Arc<Mutex<BTreeSet<PathBuf>>>,
}

impl Book {
    /// The book in `root`, which is made with the first thing that is kept in it.
    pub fn new(root: &Path) -> Self {
        Self {
            root: root.to_owned(),
            unsynced: Arc::default(),
        }
    }

    /// Its folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// A fresh folder for the scripts and logs of a run on a cluster, by its whole path; its name begins with `prefix`.
    ///
    /// # Errors
    /// A full disk.
    pub fn begin_run(&self, prefix: &str) -> Result<PathBuf, BookError> {
        let runs = self.root.join(RUNS);
        let begun = private_folder(&runs)
            .and_then(|()| runs.canonicalize())
            .and_then(|whole| fresh_folder(&whole, prefix));
        match begun {
            Ok(fresh) => Ok(fresh.keep()),
            Err(error) => Err(BookError {
                path: runs,
                why: error.to_string(),
            }),
        }
    }

    /// What happened.
    pub fn journal(&self) -> Journal {
        Journal::new(self.root.join("journal"))
    }

    /// Begins a file of the journal for one command, and removes what commands that were killed a day ago or longer left unfinished.
    ///
    /// # Errors
    /// A folder that cannot be written to.
    pub fn begin(&self, at: Timestamp, by: &str) -> io::Result<Writer> {
        let writer = self.journal().begin(at, by)?;
        // what cannot be removed is in nobody's way
        let _ = sweep(&self.root, Some(at.into()));
        Ok(writer)
    }

    /// Writes a file, whole or not at all; [`Book::sync`] waits until it is on the disk.
    pub(crate) fn put(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if put(path, bytes)? {
            let mut unsynced = self.unsynced.lock().unwrap_or_else(PoisonError::into_inner);
            unsynced.insert(path.to_owned());
        }
        Ok(())
    }

    /// Waits until everything that was kept is on the disk: before a command reports it as kept.
    ///
    /// # Errors
    /// A disk that fails.
    pub fn sync(&self) -> Result<(), BookError> {
        let mut unsynced = self.unsynced.lock().unwrap_or_else(PoisonError::into_inner);
        let files = std::mem::take(&mut *unsynced);
        // with the folders above them, as far as the book goes
        let folders = files.iter().flat_map(|file| {
            let above = file.ancestors().skip(1);
            above.take_while(|folder| folder.starts_with(&self.root))
        });
        let folders: BTreeSet<&Path> = folders.collect();
        let wait = |path: &Path, waited: io::Result<()>| match waited {
            // it was removed since
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            other => other.map_err(|error| BookError {
                path: path.to_owned(),
                why: error.to_string(),
            }),
        };
        for file in &files {
            wait(file, durable::sync_file(file))?;
        }
        for folder in folders {
            wait(folder, durable::sync_folder(folder))?;
        }
        Ok(())
    }

    /// Where the record of a key is, or would be.
    pub fn record_path(&self, key: &str) -> PathBuf {
        let shelf = key.get(..2).unwrap_or("--");
        self.root
            .join("records")
            .join(shelf)
            .join(format!("{key}.json"))
    }

    /// Whether there is a record of this key: one that a loss of power cut short is none.
    pub fn has_record(&self, key: &str) -> bool {
        // where a record was cut may look like its end: only all of it says that it is whole
        let bytes = std::fs::read(self.record_path(key));
        bytes.is_ok_and(|bytes| serde_json::from_slice::<IgnoredAny>(&bytes).is_ok())
    }

    /// Keeps a record.
    ///
    /// # Errors
    /// A full disk; there is then no such record.
    pub fn put_record(&self, record: &Record) -> Result<(), BookError> {
        let path = self.record_path(&record.key);
        let json = serde_json::to_vec(record);
        let written = json
            .map_err(io::Error::other)
            .and_then(|json| self.put(&path, &json));
        written.map_err(|error| BookError {
            path,
            why: error.to_string(),
        })
    }

    /// The record of this key; `None` where there is none, or one that a failing disk has damaged: it is graded again.
    ///
    /// # Errors
    /// A record of another version, or a file that cannot be read.
    pub fn record(&self, key: &str) -> Result<Option<Record>, BookError> {
        #[derive(Deserialize)]
        struct Format {
            format: String,
        }
        let path = self.record_path(key);
        let error = |why: String| BookError {
            path: path.clone(),
            why,
        };
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(missing) if missing.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(unread) => return Err(error(unread.to_string())),
        };
        let Ok(Format { format }) = serde_json::from_slice(&bytes) else {
            return Ok(None);
        };
        if format != FORMAT {
            return Err(error(format!(
                "its format is `{format}`, and this version reads `{FORMAT}`"
            )));
        }
        let record: Record = match serde_json::from_slice(&bytes) {
            Ok(record) => record,
            Err(_) => return Ok(None),
        };
        Ok((record.key == key && record.inputs.key() == key).then_some(record))
    }

    /// Keys of all records, sorted.
    ///
    /// # Errors
    /// A folder that cannot be listed.
    pub fn record_keys(&self) -> io::Result<Vec<String>> {
        let mut keys = Vec::new();
        let shelves = match std::fs::read_dir(self.root.join("records")) {
            Ok(shelves) => shelves,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(keys),
            Err(error) => return Err(error),
        };
        for shelf in shelves {
            let shelf = shelf?;
            if !shelf.file_type()?.is_dir() {
                continue;
            }
            for record in std::fs::read_dir(shelf.path())? {
                let name = record?.file_name().into_string().unwrap_or_default();
                // whatever else is there, such as the copy that a synchronised folder made of a conflict, is no record
                if let Some(key) = name
                    .strip_suffix(".json")
                    .filter(|name| is_digest(name, 64))
                {
                    keys.push(key.to_owned());
                }
            }
        }
        keys.sort();
        Ok(keys)
    }

    /// Keeps a submission, and gives its digest.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_submission(&self, bytes: &[u8]) -> Result<String, BookError> {
        let digest = blake3::hash(bytes).to_hex().to_string();
        let path = self.submission_path(&digest);
        self.put(&path, bytes).map_err(|error| BookError {
            path,
            why: error.to_string(),
        })?;
        Ok(digest)
    }

    /// Keeps the sources of a module, and gives the digest of their archive; none where there are none.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_sources(&self, sources: &[SourceFile]) -> Result<Option<String>, BookError> {
        if sources.is_empty() {
            return Ok(None);
        }
        let bytes = packed(sources).map_err(|error| BookError {
            path: self.root.clone(),
            why: error.to_string(),
        })?;
        self.put_submission(&bytes).map(Some)
    }

    /// The sources whose archive has this digest.
    ///
    /// # Errors
    /// As [`Book::submission`].
    pub fn sources(&self, digest: Option<&str>) -> Result<Vec<SourceFile>, BookError> {
        let Some(digest) = digest else {
            return Ok(Vec::new());
        };
        let bytes = self.submission(digest)?;
        unpacked(&bytes).map_err(|error| BookError {
            path: self.submission_path(digest),
            why: error.to_string(),
        })
    }

    pub(crate) fn submission_path(&self, digest: &str) -> PathBuf {
        let shelf = digest.get(..2).unwrap_or("--");
        self.root.join("submissions").join(shelf).join(digest)
    }

    /// The submission of this digest.
    ///
    /// # Errors
    /// None there, or one whose bytes are others by now.
    pub fn submission(&self, digest: &str) -> Result<Vec<u8>, BookError> {
        let path = self.submission_path(digest);
        let read = std::fs::read(&path).map_err(|error| error.to_string());
        let read = read.and_then(|bytes| {
            if blake3::hash(&bytes).to_hex().as_str() == digest {
                Ok(bytes)
            } else {
                Err("its bytes are not those that were handed in".to_owned())
            }
        });
        read.map_err(|why| BookError {
            path,
            why: format!("{why}; reading what the LMS exported once more restores it"),
        })
    }

    /// Keeps the files of a lab, and gives their version.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_lab(&self, files: &[(String, Vec<u8>)]) -> Result<String, BookError> {
        self.put_version("labs", files)
    }

    /// Keeps the files of a staff part, its salt among them, and gives their version.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_staff(&self, files: &[(String, Vec<u8>)]) -> Result<String, BookError> {
        self.put_version("staff", files)
    }

    /// The files of a version of a lab, in the shape of a folder of labs.
    pub fn lab(&self, version: &str) -> impl Files + use<> {
        Version(self.root.join("labs").join(version))
    }

    /// The files of a version of a staff part.
    pub fn staff(&self, version: &str) -> impl Files + use<> {
        Version(self.root.join("staff").join(version))
    }

    fn put_version(&self, kind: &str, files: &[(String, Vec<u8>)]) -> Result<String, BookError> {
        let version = version_of(files);
        let path = self.root.join(kind).join(&version);
        if path.is_dir() {
            return Ok(version);
        }
        let written = || -> io::Result<()> {
            let kind = self.root.join(kind);
            private_folder(&kind)?;
            let fresh = fresh_folder(&kind, UNFINISHED)?;
            fill(fresh.path(), files)?;
            match std::fs::rename(fresh.path(), &path) {
                // somebody else was first with the same files
                Err(_) if path.is_dir() => {}
                renamed => renamed?,
            }
            durable::sync_folder(&kind)
        };
        written().map_err(|error| BookError {
            path: path.clone(),
            why: error.to_string(),
        })?;
        Ok(version)
    }
}

/// Whether a name is a digest of so many digits.
pub(crate) fn is_digest(name: &str, digits: usize) -> bool {
    let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
    name.len() == digits && name.bytes().all(is_digit)
}

/// The version of files: a digest of their paths and bytes, whatever their order.
pub fn version_of(files: &[(String, Vec<u8>)]) -> String {
    let mut sorted: Vec<&(String, Vec<u8>)> = files.iter().collect();
    sorted.sort();
    let mut hasher = blake3::Hasher::new();
    for (path, bytes) in sorted {
        hasher.update(&(path.len() as u64).to_le_bytes());
        hasher.update(path.as_bytes());
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    }
    hasher.finalize().to_hex().to_string()
}

/// A version in the book, as files.
struct Version(PathBuf);

impl Files for Version {
    fn name(&self) -> String {
        self.0.display().to_string()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let plain = |part| matches!(part, std::path::Component::Normal(_));
        if !Path::new(path).components().all(plain) {
            return Ok(None);
        }
        match std::fs::read(self.0.join(path)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.join(folder)).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort();
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs() -> Inputs {
        let text = str::to_owned;
        Inputs {
            engine: text("kinemark 0.1.0+aa"),
            lab_name: text("01"),
            lab: text("l"),
            robot: text("r"),
            scenes: vec![text("s")],
            staff: Some(text("t")),
            variant_of: None,
            file: text("f"),
            submission: text("u"),
            sources: None,
            lab_version: text("v"),
            staff_version: Some(text("w")),
        }
    }

    #[test]
    fn every_input_changes_the_key() {
        let one = inputs().key();
        let text = str::to_owned;
        for other in [
            Inputs {
                engine: text("x"),
                ..inputs()
            },
            Inputs {
                lab_name: text("x"),
                ..inputs()
            },
            Inputs {
                lab: text("x"),
                ..inputs()
            },
            Inputs {
                robot: text("x"),
                ..inputs()
            },
            Inputs {
                scenes: Vec::new(),
                ..inputs()
            },
            Inputs {
                staff: None,
                ..inputs()
            },
            Inputs {
                variant_of: Some(String::new()),
                ..inputs()
            },
            Inputs {
                file: text("x"),
                ..inputs()
            },
            Inputs {
                submission: text("x"),
                ..inputs()
            },
            Inputs {
                sources: None,
                lab_version: text("x"),
                ..inputs()
            },
            Inputs {
                staff_version: None,
                ..inputs()
            },
        ] {
            assert_ne!(other.key(), one, "{other:?}");
        }
        assert_eq!(inputs().key(), one);
    }

    #[test]
    fn what_is_kept_is_given_back_and_a_damaged_submission_is_not() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let digest = book.put_submission(b"let a = 1;").unwrap();
        assert_eq!(book.submission(&digest).unwrap(), b"let a = 1;");
        std::fs::write(book.submission_path(&digest), "let a = 2;").unwrap();
        let error = book.submission(&digest).unwrap_err();
        assert!(error.to_string().contains("not those that were handed in"));
        assert!(book.submission("ffff").is_err());
    }

    #[test]
    fn a_version_is_kept_once_and_read_as_files() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let files = vec![
            ("01/lab.toml".to_owned(), b"x".to_vec()),
            ("robots/r.toml".to_owned(), b"y".to_vec()),
        ];
        let version = book.put_lab(&files).unwrap();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            let folders = [
                bed.path().join("labs").join(&version),
                book.begin_run("run-").unwrap(),
            ];
            for folder in folders {
                let mode = folder.metadata().unwrap().permissions().mode();
                assert_eq!(mode & 0o777, 0o700, "{}", folder.display());
            }
        }
        let turned: Vec<_> = files.iter().rev().cloned().collect();
        assert_eq!(book.put_lab(&turned).unwrap(), version);
        let lab = book.lab(&version);
        assert_eq!(lab.read("01/lab.toml").unwrap().as_deref(), Some("x"));
        assert_eq!(lab.read("01/none").unwrap(), None);
        assert_eq!(lab.read("../../journal").unwrap(), None);
        assert_eq!(lab.list(""), ["01", "robots"]);
    }

    #[test]
    fn a_record_that_was_cut_short_and_a_copy_of_one_are_none() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let record = Record::new(inputs(), kinemark_grader::record::sample::graded().grade);
        book.put_record(&record).unwrap();
        let path = book.record_path(&record.key);
        for copy in [
            format!("{} (conflicted copy).json", record.key),
            format!("{}.sync-conflict-20261127.json", record.key),
            ".nfs0001".to_owned(),
        ] {
            std::fs::copy(&path, path.with_file_name(copy)).unwrap();
        }
        assert_eq!(book.record_keys().unwrap(), [record.key.as_str()]);
        let whole = std::fs::read(&path).unwrap();
        for length in [0, 1, whole.len() / 2] {
            assert!(book.has_record(&record.key));
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(!book.has_record(&record.key), "{length}");
            assert_eq!(book.record(&record.key).unwrap(), None);
            book.put_record(&record).unwrap();
            assert_eq!(book.record(&record.key).unwrap().as_ref(), Some(&record));
        }
    }

    #[cfg(unix)]
    #[test]
    fn what_was_kept_is_waited_for_once_whoever_kept_it() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(&bed.path().join("book"));
        let waiting = |book: &Book| book.unsynced.lock().unwrap().len();
        let [kept, gone] = ["kept", "gone"].map(|text| {
            let digest = book.clone().put_submission(text.as_bytes()).unwrap();
            book.submission_path(&digest)
        });
        book.put_submission(b"kept").unwrap();
        assert_eq!(waiting(&book), 2);
        // another command removes a person
        std::fs::remove_file(&gone).unwrap();
        book.sync().unwrap();
        assert_eq!(waiting(&book), 0);
        book.put_submission(b"kept").unwrap();
        assert_eq!(waiting(&book), 0, "it is there already");
        assert!(kept.is_file() && !gone.exists());
    }

    #[test]
    fn only_the_owner_reads_the_book() {
        use std::os::unix::fs::PermissionsExt as _;
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(&bed.path().join("book"));
        let digest = book.put_submission(b"x").unwrap();
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
        assert_eq!(mode(book.root()), 0o700);
        assert_eq!(mode(&book.submission_path(&digest)), 0o600);
    }
}
