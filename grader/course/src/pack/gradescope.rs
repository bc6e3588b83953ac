//! The archive that Gradescope takes as an autograder: `setup.sh` and `run_autograder` at the top, kinemark, the lab, and the course
//! staff's part.

use kinemark_grader::task::files::Files;

use super::{PackError, PackedLab, readme, refuse_too_large, staff_part, unwritten};
use crate::fixed_zip::ArchiveFile;
use crate::gradescope_results::FAILED;
use crate::roster::Roster;

/// The file that holds the course's salt, where it has one of its own.
pub const SALT_FILE: &str = "salt";
/// The file that maps Gradescope's students to the course's ids.
pub const ROSTER_FILE: &str = "roster.csv";
/// The columns of that file: no names.
pub const METADATA_IDS: [&str; 4] = ["id", "email", "username", "lms_id"];

const SETUP: &str = include_str!("setup.sh");
const RUN: &str = include_str!("run_autograder.sh");

/// What an autograder is made of besides the lab.
#[derive(Clone, Copy)]
pub struct Autograder<'a> {
    /// The course staff's folder.
    pub reference: &'a dyn Files,
    /// The course's salt, where it has one of its own.
    pub salt: Option<&'a str>,
    /// Who takes the course, where each student has a variant of their own.
    pub roster: Option<&'a Roster>,
    /// Whether students see points of hidden cases at each upload.
    pub hidden_at_upload: bool,
    /// The name of the program's file, and its bytes.
    pub binary: (&'a str, &'a [u8]),
}

/// The archive's files.
///
/// # Errors
/// [`PackError`] where the course staff's part is missing, a file cannot be read, or the program is for another system.
pub fn autograder(
    packed: PackedLab<'_>,
    with: Autograder<'_>,
) -> Result<Vec<ArchiveFile>, PackError> {
    let (path, binary) = with.binary;
    if !is_linux_x86_64(binary) {
        return Err(PackError::NotLinux {
            path: path.to_owned(),
        });
    }
    let lab = &packed.lab.name;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if lab.starts_with('-') || !lab.chars().all(plain) {
        return Err(PackError::LabName { lab: lab.clone() });
    }
    let options = if with.hidden_at_upload {
        " --hidden-at-upload"
    } else {
        ""
    };
    let script = |text: &str| {
        text.replace("@LAB@", lab)
            .replace("@OPTIONS@", options)
            .replace("@FAILED@", FAILED)
    };
    let readme = readme::for_gradescope(packed.lab, with.hidden_at_upload, with.roster.is_some());
    let mut files = vec![
        ArchiveFile::executable("setup.sh", script(SETUP)),
        ArchiveFile::executable("run_autograder", script(RUN)),
        ArchiveFile::new(readme::NAME, readme),
    ];
    files.extend(packed.whole()?);
    files.extend(staff_part(with.reference, lab)?);
    if let Some(salt) = with.salt {
        files.push(ArchiveFile::new(SALT_FILE, format!("{salt}\n")));
    }
    if let Some(roster) = with.roster {
        files.push(ArchiveFile::new(ROSTER_FILE, ids(roster)?));
    }
    files.push(ArchiveFile::executable("kinemark", binary));
    refuse_too_large(&files)?;
    Ok(files)
}

/// The roster without names: what finds an id from what Gradescope knows.
fn ids(roster: &Roster) -> Result<Vec<u8>, PackError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let mut written = table.write_record(METADATA_IDS);
    for person in roster.people() {
        written = written.and_then(|()| {
            table.write_record([
                person.id.as_str(),
                &person.email,
                &person.username,
                &person.lms_id,
            ])
        });
    }
    written.map_err(|error| unwritten(&error))?;
    table.into_inner().map_err(|error| unwritten(&error))
}

/// Whether these are the bytes of a program for Linux on x86-64.
fn is_linux_x86_64(bytes: &[u8]) -> bool {
    // an ELF header: 64 bits, little-endian; the machine, 62, is at byte 18
    bytes.starts_with(b"\x7fELF\x02\x01") && bytes.get(18..20) == Some(&[62, 0])
}
