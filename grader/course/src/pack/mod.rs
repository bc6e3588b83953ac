//! What course staff hand out as one archive: a lab for students, a lab for colleagues, an autograder for Gradescope.
//!
//! A pack is a list of files, made from what is named and nothing else: other labs of the folder stay where they are. What goes to
//! students is searched for the salt and for lines of the solution before it is written ([`secrets`]).

mod gradescope;
mod readme;
pub mod secrets;

use kinemark_grader::lab::Lab;
use kinemark_grader::lab::Variant;
use kinemark_grader::lab::practice::{PRACTICE_FILE, form, with_own};
use kinemark_grader::task::files::Files;

use crate::fixed_zip::ArchiveFile;
use crate::handed_out::{HANDED_OUT_FILE, HandedOut};
use crate::language::Language;
use crate::staffed_lab::{engine_id, lab_version};
use crate::student::StudentId;
use crate::working_folder::{BRIEF_FILE, WorkingFolderError, is_picture, working_folder};
use secrets::SharedLine;

pub use gradescope::{Autograder, METADATA_IDS, ROSTER_FILE, SALT_FILE, autograder};

/// The folder of labs in a pack, which is found from below it.
const LABS: &str = "labs";
/// The folder of the course staff's part, which is found beside it.
const REFERENCE: &str = "reference";
/// The folder of the solution in a pack for students.
const SOLUTION: &str = "solution";
/// More bytes than this are too many for a pack.
const MOST_BYTES: u64 = 1 << 30;
/// Folders inside each other below a lab's or a reference's.
const MOST_LEVELS: usize = 8;

/// Why there is no pack.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum PackError {
    /// The lab is not complete.
    #[error(transparent)]
    #[diagnostic(transparent)]
    WorkingFolder(#[from] WorkingFolderError),
    /// A file that cannot be read.
    #[error("{path}: {why}")]
    #[diagnostic(code(pack::unreadable), help("check the file and its permissions"))]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        why: String,
    },
    /// Nothing of the course staff's part.
    #[error("{reference} has no folder `{lab}`")]
    #[diagnostic(
        code(pack::no_reference),
        help("give the course staff's folder with --reference DIR")
    )]
    NoReference {
        /// The lab.
        lab: String,
        /// The folder that was looked into.
        reference: String,
    },
    /// The salt would go to students.
    #[error("the salt is in `{path}`, line {line}, which students would get")]
    #[diagnostic(
        code(pack::salt),
        help(
            "remove it there, and choose another salt: whoever has seen it can compute the hidden cases"
        )
    )]
    Salt {
        /// The file of the pack.
        path: String,
        /// The line, from one.
        line: usize,
    },
    /// A salt that cannot be searched for.
    #[error("the salt has {characters} characters: too few to search for, and quick to guess")]
    #[diagnostic(
        code(pack::short_salt),
        help("use a salt of at least {} characters", secrets::LEAST_SALT)
    )]
    ShortSalt {
        /// How many it has.
        characters: usize,
    },
    /// Lines of the solution would go to students.
    #[error("students would get lines of the solution:\n{}", listed(lines))]
    #[diagnostic(
        code(pack::solution),
        help("change these lines; if students may have them, add --allow-shared-lines")
    )]
    Solution {
        /// The lines.
        lines: Vec<SharedLine>,
    },
    /// More than an archive should hold.
    #[error("the pack would have more than {} MB", MOST_BYTES >> 20)]
    #[diagnostic(
        code(pack::too_large),
        help("pack a few students at a time, with --student")
    )]
    TooLarge,
    /// A program that does not run where the autograder does.
    #[error("`{path}` is not a program for Linux on x86-64")]
    #[diagnostic(
        code(pack::binary),
        help("name a kinemark that was built for Linux on x86-64 with --binary FILE")
    )]
    NotLinux {
        /// The program.
        path: String,
    },
    /// A lab whose name would be taken apart by a shell.
    #[error("`{lab}` cannot be the name of a lab in an autograder")]
    #[diagnostic(
        code(pack::lab_name),
        help("rename the lab's folder: letters, digits, `-`, `_` and `.`")
    )]
    LabName {
        /// The lab.
        lab: String,
    },
    /// A note or a table that cannot be written.
    #[error("a file of the pack cannot be made: {why}")]
    #[diagnostic(code(pack::unwritten), help("please report this"))]
    Unwritten {
        /// Why.
        why: String,
    },
}

fn listed(lines: &[SharedLine]) -> String {
    let shown = lines.iter().take(5).map(|line| format!("  {line}"));
    let mut shown: Vec<String> = shown.collect();
    if lines.len() > shown.len() {
        shown.push(format!("  and {} more", lines.len() - shown.len()));
    }
    shown.join("\n")
}

/// A lab, with the files that it was read from.
#[derive(Clone, Copy)]
pub struct PackedLab<'a> {
    /// The folder of labs.
    pub files: &'a dyn Files,
    /// The lab with the default numbers.
    pub lab: &'a Lab,
}

impl PackedLab<'_> {
    /// What students may have of it, in the shape of a folder of labs: the lab, its robot, scenes and meshes, its brief and starters,
    /// and the note of what was handed out.
    fn for_students(&self) -> Result<Vec<ArchiveFile>, PackError> {
        let name = &self.lab.name;
        let copies = self.lab.copies();
        let practice = format!("{name}/{PRACTICE_FILE}");
        let mut files: Vec<ArchiveFile> = copies
            .iter()
            // a copy has the form of one variant; students get all
            .filter(|(path, _)| *path != practice)
            .map(|(path, bytes)| ArchiveFile::new(format!("{LABS}/{path}"), bytes))
            .collect();
        let mut beside = vec![BRIEF_FILE.to_owned(), PRACTICE_FILE.to_owned()];
        beside.extend(Language::ALL.map(|language| language.starter().to_owned()));
        beside.extend(
            self.files
                .list(name)
                .into_iter()
                .filter(|name| is_picture(name)),
        );
        for own in beside {
            let path = format!("{name}/{own}");
            if let Some(bytes) = read(self.files, &path)? {
                files.push(ArchiveFile::new(format!("{LABS}/{path}"), bytes));
            }
        }
        let note = HandedOut::new(lab_version(self.lab), engine_id());
        let note = note.text().map_err(|error| unwritten(&error))?;
        files.push(ArchiveFile::new(
            format!("{LABS}/{name}/{HANDED_OUT_FILE}"),
            note,
        ));
        files.sort_by(|one, other| one.path.cmp(&other.path));
        Ok(files)
    }

    /// All of it: what students have, and whatever else lies in its folder.
    fn whole(&self) -> Result<Vec<ArchiveFile>, PackError> {
        let mut files = self.for_students()?;
        for (path, bytes) in all_below(self.files, &self.lab.name)? {
            let path = format!("{LABS}/{path}");
            if !files.iter().any(|known| known.path == path) {
                files.push(ArchiveFile::new(path, bytes));
            }
        }
        files.sort_by(|one, other| one.path.cmp(&other.path));
        Ok(files)
    }
}

/// The pack for students: a folder in which `kinemark grade` works at once. With `variants`, labs with a student's numbers, a folder for
/// each, called by their id. `solution` is in each folder, too: nothing before the due date ([`solution`]).
///
/// # Errors
/// [`PackError`] where the lab is not complete.
pub fn for_students(
    packed: PackedLab<'_>,
    variants: &[Lab],
    solution: &[ArchiveFile],
) -> Result<Vec<ArchiveFile>, PackError> {
    let shared = packed.for_students()?;
    let mut files = Vec::new();
    let mut add = |folder: &str, lab: &Lab| -> Result<(), PackError> {
        let inside = |path: &str| format!("{folder}/{path}");
        files.push(ArchiveFile::new(
            inside(readme::NAME),
            readme::for_students(lab, !solution.is_empty()),
        ));
        for file in solution {
            files.push(ArchiveFile::new(inside(&file.path), file.bytes.clone()));
        }
        for (name, text) in working_folder(packed.files, lab, Language::Rhai)? {
            files.push(ArchiveFile::new(inside(&name), text));
        }
        for file in &shared {
            let bytes = match with_own_practice(&file.path, &file.bytes, lab)? {
                Some(bytes) => bytes,
                None => file.bytes.clone(),
            };
            files.push(ArchiveFile::new(inside(&file.path), bytes));
        }
        refuse_too_large(&files)
    };
    if variants.is_empty() {
        add(&packed.lab.name, packed.lab)?;
    }
    for lab in variants {
        let student = lab.variant.as_ref().and_then(Variant::student);
        let student = student.and_then(|id| StudentId::new(id).ok());
        let folder = student.map_or_else(|| lab.name.clone(), |id| id.folder());
        add(&folder, lab)?;
    }
    Ok(files)
}

/// The bytes of `practice.json` with what `lab`, a student's variant, says of the reference solution; `None` of another file.
fn with_own_practice(path: &str, bytes: &[u8], lab: &Lab) -> Result<Option<Vec<u8>>, PackError> {
    let is_practice = path == format!("{LABS}/{}/{PRACTICE_FILE}", lab.name);
    if !is_practice || lab.variant.is_none() || lab.practice.is_empty() {
        return Ok(None);
    }
    let own = form(lab.variant.as_ref(), lab.practice.clone());
    let text =
        with_own(&String::from_utf8_lossy(bytes), &own).map_err(|error| unwritten(&error))?;
    Ok(Some(text.into_bytes()))
}

/// The pack for course staff: the lab and all of the course staff's part, with the course's salt where it has one of its own.
///
/// # Errors
/// [`PackError`] where there is no such part, or a file cannot be read.
pub fn for_staff(
    packed: PackedLab<'_>,
    reference: &dyn Files,
    salt: Option<&str>,
) -> Result<Vec<ArchiveFile>, PackError> {
    let name = &packed.lab.name;
    let mut inside = vec![ArchiveFile::new(
        readme::NAME,
        readme::for_staff(packed.lab, salt.is_some()),
    )];
    inside.extend(packed.whole()?);
    inside.extend(staff_part(reference, name)?);
    if let Some(salt) = salt {
        inside.push(ArchiveFile::new(SALT_FILE, format!("{salt}\n")));
    }
    for file in &mut inside {
        file.path = format!("{name}-staff/{}", file.path);
    }
    refuse_too_large(&inside)?;
    Ok(inside)
}

/// The solution in each language, in the folder that students find it in after the due date.
///
/// # Errors
/// [`PackError`] where there is none, or it cannot be read.
pub fn solution(reference: &dyn Files, lab: &str) -> Result<Vec<ArchiveFile>, PackError> {
    let mut files = Vec::new();
    for name in reference.list(lab) {
        if !name.starts_with("solution.") {
            continue;
        }
        if let Some(bytes) = read(reference, &format!("{lab}/{name}"))? {
            files.push(ArchiveFile::new(format!("{SOLUTION}/{name}"), bytes));
        }
    }
    if files.is_empty() {
        return Err(PackError::NoReference {
            lab: lab.to_owned(),
            reference: format!("`{}`", reference.name()),
        });
    }
    Ok(files)
}

/// Everything of the course staff's part of a lab.
fn staff_part(reference: &dyn Files, lab: &str) -> Result<Vec<ArchiveFile>, PackError> {
    let files = all_below(reference, lab)?;
    if files.is_empty() {
        return Err(PackError::NoReference {
            lab: lab.to_owned(),
            reference: format!("`{}`", reference.name()),
        });
    }
    let files = files.into_iter();
    Ok(files
        .map(|(path, bytes)| ArchiveFile::new(format!("{REFERENCE}/{path}"), bytes))
        .collect())
}

/// Every file below a folder, by path; what editors and systems leave there does not count.
fn all_below(files: &dyn Files, folder: &str) -> Result<Vec<(String, Vec<u8>)>, PackError> {
    let mut found = Vec::new();
    let mut open = vec![(folder.to_owned(), 0)];
    while let Some((folder, level)) = open.pop() {
        for name in files.list(&folder) {
            if name.starts_with('.') || name.ends_with('~') {
                continue;
            }
            let path = format!("{folder}/{name}");
            match read(files, &path)? {
                Some(bytes) => found.push((path, bytes)),
                // a folder, or a link that leads nowhere, in which nothing lies
                None if level < MOST_LEVELS => open.push((path, level + 1)),
                None => {}
            }
        }
    }
    found.sort();
    Ok(found)
}

fn read(files: &dyn Files, path: &str) -> Result<Option<Vec<u8>>, PackError> {
    files.bytes(path).map_err(|why| PackError::Unreadable {
        path: format!("{}/{path}", files.name()),
        why,
    })
}

fn refuse_too_large(files: &[ArchiveFile]) -> Result<(), PackError> {
    let bytes: u64 = files.iter().map(|file| file.bytes.len() as u64).sum();
    if bytes > MOST_BYTES {
        return Err(PackError::TooLarge);
    }
    Ok(())
}

fn unwritten(error: &dyn std::fmt::Display) -> PackError {
    PackError::Unwritten {
        why: error.to_string(),
    }
}

#[cfg(test)]
mod tests;
