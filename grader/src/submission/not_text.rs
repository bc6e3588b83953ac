//! A file that is neither a script nor a module: it does not build, and its first bytes, the place of the first byte that is no text, or
//! the language that it is written in say why.

use super::controller::{Controller, Failed, Mistake, Opening, SourcePosition, Stop};
use super::host::Host;

/// Files that are handed in instead of a submission, by their first bytes.
const OTHERS: [(&[u8], &str, &str); 14] = [
    (b"PK\x03\x04", "a ZIP archive", SCRIPT),
    (b"Rar!", "a RAR archive", SCRIPT),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", SCRIPT),
    (b"\x1f\x8b", "a gzip archive", SCRIPT),
    (b"%PDF", "a PDF", SCRIPT),
    (b"{\\rtf", "a document in RTF", SCRIPT),
    (b"\xff\xfe", "text in UTF-16", SCRIPT),
    (b"\xfe\xff", "text in UTF-16", SCRIPT),
    (b"\x7fELF", "a program for Linux", MODULE),
    (b"MZ", "a program for Windows", MODULE),
    (b"\xcf\xfa\xed\xfe", "a program for macOS", MODULE),
    (b"\xca\xfe\xba\xbe", "a program for macOS or Java", MODULE),
    (b"!<arch>\n", "a library", MODULE),
    (
        b"(module",
        "WebAssembly in text form",
        "make a module of it: wat2wasm",
    ),
];
const SCRIPT: &str = "hand in the script itself, saved as UTF-8 text";
const MODULE: &str =
    "build it for WebAssembly, as docs/plugin.md says, and hand in submission.wasm";

/// The language of a file that has to be built before it can be handed in.
fn to_be_built(text: &str) -> Option<(&'static str, SourcePosition)> {
    let mut lines = (1..).zip(text.lines());
    lines.find_map(|(line, text)| {
        let written = text.trim_start();
        // neither can begin a line of a script
        let language = if written.starts_with("#include") {
            "C"
        } else if written.starts_with("use kinemark_plugin") || written.starts_with("#![no_std]") {
            "Rust"
        } else {
            return None;
        };
        let column = text.chars().count() - written.chars().count() + 1;
        Some((language, SourcePosition { line, column }))
    })
}

/// A text that holds a program and is none, and what to hand in instead.
fn wrapped(text: &str) -> Option<(&'static str, &'static str)> {
    let begin = text.trim_start().get(..14).unwrap_or_default();
    let begin = begin.to_ascii_lowercase();
    if begin.starts_with("<!doctype html") || begin.starts_with("<html") {
        return Some((
            "a web page",
            "hand in the file itself: the page that shows it was saved in its place",
        ));
    }
    let is_notebook =
        begin.starts_with('{') && text.contains("\"cells\"") && text.contains("\"nbformat\"");
    is_notebook.then_some((
        "a Jupyter notebook",
        "save its code as a script (in Jupyter: File, Save and Export Notebook As, Executable Script), and hand in that",
    ))
}

/// How bytes begin that stand for a submission that is not there; no script begins so.
const ABSENT: &[u8] = b"\0no submission\n";

/// The bytes of a submission that is not there, as reports keep them: `what` is wrong, in a line, and what to do about it.
pub fn absent(what: &str, help: &str) -> Vec<u8> {
    let line = |text: &str| text.replace('\n', " ");
    [ABSENT, line(what).as_bytes(), b"\n", line(help).as_bytes()].concat()
}

/// A submission that no host can open.
#[derive(Debug, Clone, PartialEq)]
pub struct NotText {
    /// What of it can be shown: bytes that cannot be read are U+FFFD.
    pub shown: String,
    mistake: Mistake,
}

impl NotText {
    /// What is wrong with the bytes of a file; `None` where they may be a script.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        if let Some(lines) = bytes.strip_prefix(ABSENT) {
            let lines = String::from_utf8_lossy(lines);
            let (what, help) = lines.split_once('\n').unwrap_or((&lines, ""));
            return Some(Self {
                shown: String::new(),
                mistake: Mistake {
                    message: what.to_owned(),
                    place: None,
                    help: Some(help.to_owned()),
                    further: Vec::new(),
                },
            });
        }
        // two letters may begin any name
        let is_text = std::str::from_utf8(bytes);
        let mut others = OTHERS.iter();
        let other = others
            .find(|(first, ..)| bytes.starts_with(first) && (first.len() > 2 || is_text.is_err()));
        let valid = match is_text {
            Ok(text) if let Some((what, help)) = wrapped(text) => {
                return Some(Self {
                    shown: text.to_owned(),
                    mistake: Mistake {
                        message: format!("the file is {what}, not a submission"),
                        place: None,
                        help: Some(help.to_owned()),
                        further: Vec::new(),
                    },
                });
            }
            Ok(text) if other.is_none() => {
                let (language, place) = to_be_built(text)?;
                return Some(Self {
                    shown: text.to_owned(),
                    mistake: Mistake {
                        message: format!("the file is source code in {language}, not a submission"),
                        place: Some(place),
                        help: Some(MODULE.to_owned()),
                        further: Vec::new(),
                    },
                });
            }
            // an archive may be UTF-8 by chance
            Ok(_) => 0,
            Err(error) => error.valid_up_to(),
        };
        let mistake = match other {
            Some((_, what, help)) => Mistake {
                message: format!("the file is {what}, not a submission"),
                place: None,
                help: Some((*help).to_owned()),
                further: Vec::new(),
            },
            None => {
                let before = String::from_utf8_lossy(&bytes[..valid]);
                let line = before.matches('\n').count() + 1;
                let column = before
                    .rsplit('\n')
                    .next()
                    .unwrap_or_default()
                    .chars()
                    .count()
                    + 1;
                Mistake {
                    message: format!("the file is not UTF-8 text: byte 0x{:02x}", bytes[valid]),
                    place: Some(SourcePosition { line, column }),
                    help: Some(
                        "save it as UTF-8: an editor on Windows may have saved it as Windows-1252"
                            .to_owned(),
                    ),
                    further: Vec::new(),
                }
            }
        };
        Some(Self {
            shown: String::from_utf8_lossy(bytes).into_owned(),
            mistake,
        })
    }
}

impl Host for NotText {
    fn open(&mut self, _: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
        Err(Stop::DidNotBuild(self.mistake.clone()).into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_byte_that_is_no_text_has_its_place() {
        assert_eq!(NotText::of("// Straße\n".as_bytes()), None);
        let latin = NotText::of(b"let a = 1;\n// Stra\xdfe\n").expect("not UTF-8");
        let place = latin.mistake.place.expect("a place");
        assert_eq!((place.line, place.column), (2, 8));
        assert!(latin.mistake.message.contains("byte 0xdf"));
        assert!(latin.shown.contains('\u{fffd}'));
    }

    #[test]
    fn what_is_not_there_says_why_again() {
        let bytes = absent("`a` is a link\nto b", "copy the file itself");
        let found = NotText::of(&bytes).expect("no script");
        assert_eq!(found.mistake.message, "`a` is a link to b");
        assert_eq!(found.mistake.help.as_deref(), Some("copy the file itself"));
        assert_eq!(found.shown, "");
    }

    #[test]
    fn source_code_has_the_place_that_shows_its_language() {
        let c = NotText::of(b"// mine\n  #include \"kinemark.h\"\n").expect("no script");
        assert_eq!(c.mistake.place, Some(SourcePosition { line: 2, column: 3 }));
        for script in [
            "{ let cells = 1; }",
            "let a = \"<html>\";",
            "MZ(1);",
            "let use_kinemark_plugin = 1; // #include",
            "#{}",
        ] {
            assert_eq!(NotText::of(script.as_bytes()), None);
        }
    }

    #[test]
    fn other_files_are_named() {
        for (bytes, what) in [
            (&b"PK\x03\x04rest"[..], "a ZIP archive"),
            (b"%PDF-1.7", "a PDF"),
            (b"\x7fELF\x02\x01", "for Linux"),
            (b"MZ\x90\x00", "for Windows"),
            (b"(module (memory 1))", "text form"),
            (b"// mine\n  #include \"kinemark.h\"\n", "in C"),
            (b"use kinemark_plugin::*;\n", "in Rust"),
            (b"\n<!DOCTYPE html>\n<pre>fn control</pre>", "a web page"),
            (
                b"{\n \"cells\": [],\n \"nbformat\": 4\n}",
                "a Jupyter notebook",
            ),
            (b"{\\rtf1\\ansi fn control", "in RTF"),
            (b"\xff\xfel\0e\0t\0", "UTF-16"),
        ] {
            let found = NotText::of(bytes).expect("no script");
            assert!(
                found.mistake.message.contains(what),
                "{}",
                found.mistake.message
            );
        }
    }
}
