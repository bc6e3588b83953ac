//! The zip of feedback files: a folder a participant, named as in Moodle's export of submissions, which is how the import knows whose
//! the files are.

use std::io::{Cursor, Write as _};

use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipWriter};

use crate::release::feedback::Feedback;
use crate::release::{Material, ReleaseError, Row};

/// Bytes of a name: with the rest of the folder's name it stays below the 255 that file systems take.
const MOST_BYTES: usize = 180;

/// The folder of a participant: `Full name_12_assignsubmission_file_`. The import goes by the number in the second part.
pub(super) fn folder(full_name: &str, participant: &str) -> String {
    let mut name = String::new();
    for c in full_name.chars() {
        let c = match c {
            // it stands between the parts
            '_' => ' ',
            c => c,
        };
        let is_plain = !c.is_control() && !r#"&<>"`|':\/*?"#.contains(c) && !is_direction(c);
        if is_plain && name.len() + c.len_utf8() <= MOST_BYTES {
            name.push(c);
        }
    }
    let name = name.trim().trim_start_matches(['.', '~']).trim_start();
    // as Moodle calls people whose names are hidden
    let name = if name.is_empty() { "Participant" } else { name };
    format!("{name}_{participant}_assignsubmission_file_")
}

/// Whether a character turns the direction of what stands after it.
fn is_direction(c: char) -> bool {
    matches!(c, '\u{200E}' | '\u{200F}' | '\u{061C}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

/// The zip: `feedback.txt` and `feedback.html` in the folder of everybody who has a grade. The same grades give the same bytes.
pub(super) fn of<'a>(
    material: &Material<'a>,
    folders: impl Iterator<Item = (String, &'a Row<'a>)>,
) -> Result<Vec<u8>, ReleaseError> {
    let error = |why: &dyn std::fmt::Display| ReleaseError::Archive {
        why: why.to_string(),
    };
    // no clock
    let options = SimpleFileOptions::default()
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (folder, row) in folders {
        let Some(feedback) = Feedback::of(material, row) else {
            continue;
        };
        for (name, text) in [
            ("feedback.txt", feedback.text()),
            ("feedback.html", feedback.page()),
        ] {
            zip.start_file(format!("{folder}/{name}"), options)
                .map_err(|why| error(&why))?;
            zip.write_all(text.as_bytes()).map_err(|why| error(&why))?;
        }
    }
    let bytes = zip.finish().map_err(|why| error(&why))?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_the_parts_that_the_import_reads() {
        for (name, folder_name) in [
            ("Ada Lovelace", "Ada Lovelace_12_assignsubmission_file_"),
            ("a_b_99_c", "a b 99 c_12_assignsubmission_file_"),
            ("../\"x\"\n", "x_12_assignsubmission_file_"),
            ("\u{202E}محمد", "محمد_12_assignsubmission_file_"),
            ("", "Participant_12_assignsubmission_file_"),
        ] {
            assert_eq!(folder(name, "12"), folder_name, "{name:?}");
        }
        assert!(folder(&"語".repeat(120), "1234567").len() < 255);
    }
}
