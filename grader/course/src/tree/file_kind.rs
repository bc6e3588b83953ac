//! What a file is by its first bytes, whatever its name says.

/// First bytes, and what begins with them.
const KINDS: &[(&[u8], &str)] = &[
    (b"PK\x03\x04", "a ZIP archive"),
    (b"PK\x05\x06", "an empty ZIP archive"),
    (b"PK\x07\x08", "a ZIP archive in parts"),
    (b"Rar!\x1a\x07", "a RAR archive"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"\x1f\x8b", "a gzip file"),
    (b"BZh", "a bzip2 file"),
    (b"\xfd7zXZ\x00", "an xz file"),
    (b"\x28\xb5\x2f\xfd", "a Zstandard file"),
    (b"%PDF-", "a PDF"),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "an old Office document",
    ),
    (b"{\\rtf", "a rich text document"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"\x7fELF", "a program for Linux"),
    (b"MZ\x90", "a program for Windows"),
    (b"\x00asm", "a WebAssembly module"),
    (b"MATLAB 5.0 MAT-file", "a MATLAB data file"),
    (b"SQLite format 3\x00", "a database"),
];

/// Names of the first file in an archive that is a document.
const DOCUMENTS: &[(&[u8], &str)] = &[
    (
        b"[Content_Types].xml",
        "an Office document (docx, xlsx or pptx)",
    ),
    (b"_rels/.rels", "an Office document (docx, xlsx or pptx)"),
    (b"mimetypeapplication/vnd.oasis", "an OpenDocument file"),
];

/// How many first bytes are enough for [`file_kind`].
pub(crate) const ENOUGH_BYTES: usize = 512;

/// What begins with these bytes, with its article; `None` for text and for what is not known.
pub fn file_kind(start: &[u8]) -> Option<&'static str> {
    if start.starts_with(b"PK\x03\x04") {
        // the name of the first file stands after a header of 30 bytes
        let name = start.get(30..).unwrap_or_default();
        let document = DOCUMENTS.iter().find(|(first, _)| name.starts_with(first));
        if let Some((_, kind)) = document {
            return Some(kind);
        }
    }
    if start.get(257..262) == Some(b"ustar") {
        return Some("a tar archive");
    }
    let known = KINDS.iter().find(|(first, _)| start.starts_with(first));
    known.map(|(_, kind)| *kind).or_else(|| markup(start))
}

/// Pages that a browser saved in place of a file.
fn markup(start: &[u8]) -> Option<&'static str> {
    let text = start.trim_ascii_start();
    let begins = |with: &[u8]| {
        let first = text.get(..with.len());
        first.is_some_and(|first| first.eq_ignore_ascii_case(with))
    };
    (begins(b"<!doctype html") || begins(b"<html")).then_some("a web page")
}

/// Whether these bytes begin an archive that is read.
pub(super) fn is_zip(start: &[u8]) -> bool {
    start.starts_with(b"PK\x03\x04") || start.starts_with(b"PK\x05\x06")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_known_by_their_bytes() {
        assert_eq!(file_kind(b"Rar!\x1a\x07\x01\x00"), Some("a RAR archive"));
        assert_eq!(file_kind(b"%PDF-1.7"), Some("a PDF"));
        assert_eq!(file_kind(b"\n <HTML><head>"), Some("a web page"));
        assert_eq!(file_kind(b"fn control(o) { [0.0] }"), None);
        assert_eq!(file_kind(b""), None);
        let mut word = b"PK\x03\x04".to_vec();
        word.resize(30, 0);
        word.extend(b"[Content_Types].xml");
        assert_eq!(
            file_kind(&word),
            Some("an Office document (docx, xlsx or pptx)")
        );
        let mut tar = vec![b'x'; 257];
        tar.extend(b"ustar");
        assert_eq!(file_kind(&tar), Some("a tar archive"));
    }
}
