//! What the name of a file says: a hand-in file, a submission, a script, an archive; and what browsers and LMSs add to names.

/// The ending of the one file that `kinemark submit` writes.
const HAND_IN_ENDING: &str = ".kinemark";

/// The ending of the functions' names that editors read: nobody's work.
const DEFINITIONS_ENDING: &str = ".d.rhai";

/// The endings of what is graded as it is.
const SCRIPT_ENDINGS: [&str; 2] = [".rhai", ".py"];

/// The name, without endings, that a submission has.
const SUBMISSION: &str = "submission";

/// The name, without endings, of what students begin with.
const STARTER: &str = "starter";

/// Words that systems add to the name of a copy, in front of a number or not.
const COPY_WORDS: [&str; 6] = ["copy", "kopie", "copie", "copia", "kopia", "コピー"];

/// What a name says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NameKind {
    /// A hand-in file.
    HandIn,
    /// `submission.rhai`, `submission.py`, `submission.wasm`, `submission.rhai.txt`, or a copy that a browser or an LMS renamed.
    Submission,
    /// `submission.txt`, as some LMSs rename what they do not know.
    SubmissionText,
    /// Any other script or module.
    Script,
    /// `starter.rhai`: what students begin with.
    Starter,
    /// A ZIP archive.
    Archive,
    /// Anything else.
    Other,
}

impl NameKind {
    /// What a file of this name, without folders, is.
    pub(crate) fn of(name: &str) -> Self {
        let name = name.trim().to_lowercase();
        let (stem, text) = match strip_ending(&name, ".txt") {
            Some(stem) => (stem, true),
            None => (name.as_str(), false),
        };
        if strip_ending(stem, HAND_IN_ENDING).is_some() {
            return Self::HandIn;
        }
        if stem.ends_with(DEFINITIONS_ENDING) {
            return Self::Other;
        }
        let script = SCRIPT_ENDINGS
            .iter()
            .find_map(|ending| strip_ending(stem, ending));
        let script = script.or_else(|| match text {
            false => strip_ending(stem, ".wasm"),
            true => None,
        });
        match script {
            Some(stem) => match stem.trim() {
                SUBMISSION => Self::Submission,
                STARTER => Self::Starter,
                _ => Self::Script,
            },
            None if text && stem.trim() == SUBMISSION => Self::SubmissionText,
            None if strip_ending(&name, ".zip").is_some() => Self::Archive,
            None => Self::Other,
        }
    }

    /// Whether a file of this kind may be what somebody handed in.
    pub(crate) fn may_be_handed_in(self) -> bool {
        self != Self::Other
    }
}

/// What stands before an ending, without what was added to the name of a copy, before or behind the ending.
fn strip_ending<'n>(name: &'n str, ending: &str) -> Option<&'n str> {
    let stem = without_copy_mark(name).strip_suffix(ending)?;
    Some(without_copy_mark(stem))
}

/// A name of a file without its ending and without what was added to it as a copy.
pub(crate) fn stem(name: &str) -> &str {
    let lower = |stem: &str| stem.to_ascii_lowercase();
    let mut stem = name;
    // `a.rhai.txt` has two endings
    for _ in 0..2 {
        match stem.rsplit_once('.') {
            Some((before, ending)) if !before.is_empty() && is_ending(ending) => {
                let was_text = lower(ending) == "txt";
                stem = without_bracketed_count(before);
                let mut endings = SCRIPT_ENDINGS.iter();
                if !was_text || !endings.any(|ending| lower(stem).ends_with(ending)) {
                    break;
                }
            }
            _ => break,
        }
    }
    without_bracketed_count(stem)
}

/// Whether what follows a dot is an ending and no part of an id: short, with a letter.
fn is_ending(text: &str) -> bool {
    let text = without_bracketed_count(text);
    text.len() <= 8
        && text.bytes().all(|b| b.is_ascii_alphanumeric())
        && text.bytes().any(|b| b.is_ascii_alphabetic())
}

/// A name without the ` (1)` of a browser.
fn without_bracketed_count(name: &str) -> &str {
    let inner = name
        .strip_suffix(')')
        .and_then(|name| name.rsplit_once('('));
    match inner {
        Some((before, count)) if is_count(count) && !before.trim().is_empty() => before.trim_end(),
        _ => name,
    }
}

/// A name without what a browser, a desktop or Canvas adds to a copy: ` (1)`, ` - Copy`, ` copy 2`, `-1`.
fn without_copy_mark(name: &str) -> &str {
    let plain = without_bracketed_count(name);
    let plain = match plain.rsplit_once([' ', '-']) {
        Some((before, count)) if is_count(count) && !before.is_empty() => before,
        _ => plain,
    };
    for word in COPY_WORDS {
        if let Some(before) = plain.strip_suffix(word) {
            let bare = before.trim_end_matches([' ', '-', '_']);
            if bare.len() < before.len() && !bare.is_empty() {
                return bare;
            }
        }
    }
    plain.trim_end()
}

fn is_count(text: &str) -> bool {
    (1..=3).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn submissions_are_known_under_the_names_that_browsers_and_systems_give_them() {
        for name in [
            "submission.rhai",
            "Submission.RHAI",
            "submission.wasm",
            "submission.py",
            "submission (1).py",
            "submission.py.txt",
            "submission.rhai.txt",
            "submission (1).rhai",
            "submission(2).rhai",
            "submission-1.rhai",
            "submission - Copy.rhai",
            "submission - Copy (2).rhai",
            "submission copy 2.rhai",
            "submission - Kopie.rhai",
            "submission.rhai (1).txt",
            "submission.rhai-1.txt",
        ] {
            assert_eq!(NameKind::of(name), NameKind::Submission, "{name}");
        }
    }

    #[test]
    fn other_names_are_what_they_say() {
        for (name, kind) in [
            ("s1.kinemark", NameKind::HandIn),
            ("s1 (1).kinemark", NameKind::HandIn),
            ("s1.kinemark.txt", NameKind::HandIn),
            ("submission.txt", NameKind::SubmissionText),
            ("lab1.rhai", NameKind::Script),
            ("submission_final.rhai", NameKind::Script),
            ("lab 1 – Lösung.rhai.txt", NameKind::Script),
            ("controller.wasm", NameKind::Script),
            ("lab1.py", NameKind::Script),
            ("starter.py", NameKind::Starter),
            ("kinemark.pyi", NameKind::Other),
            ("starter.rhai", NameKind::Starter),
            ("starter (1).rhai", NameKind::Starter),
            ("work.ZIP", NameKind::Archive),
            ("work (1).zip", NameKind::Archive),
            ("submission.m", NameKind::Other),
            ("submission.wasm.txt", NameKind::Other),
            ("notes.txt", NameKind::Other),
            ("submission", NameKind::Other),
            ("rhai", NameKind::Other),
            ("", NameKind::Other),
        ] {
            assert_eq!(NameKind::of(name), kind, "{name}");
        }
    }

    #[test]
    fn a_stem_keeps_what_may_be_an_id() {
        for (name, expected) in [
            ("s1000.rhai", "s1000"),
            ("s1000 (1).rhai", "s1000"),
            ("s1000.rhai.txt", "s1000"),
            ("s1000.py.txt", "s1000"),
            ("s1000.rhai (1).txt", "s1000"),
            ("s-1000-2.zip", "s-1000-2"),
            ("20.1234", "20.1234"),
            ("ana.lima", "ana"),
            ("s1000", "s1000"),
            (".rhai", ".rhai"),
        ] {
            assert_eq!(stem(name), expected, "{name}");
        }
    }
}
