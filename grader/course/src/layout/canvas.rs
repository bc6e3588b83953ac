//! Canvas's "Download Submissions": `<name>[_LATE]_<user id>_<attachment id>_<file name>`, all in one folder.
//!
//! The name is the sortable name in lower case with nothing but letters, digits and `_`; it may be empty. An anonymous assignment
//! has `anon_<anonymous id>` in its place. A text is `..._text.html`, an address `..._link.html`. A file handed in again under its
//! name is called `name-1.rhai`, and so on. Source: lib/content_zipper.rb of Canvas.

use std::collections::BTreeMap;

use unicode_normalization::char::is_combining_mark;

use super::level::{Level, levels};
use super::{Confidence, Hint, Layout, PersonFile, PersonFiles, PersonProblem, count_of, flat};
use crate::tree::Tree;

pub(super) const LAYOUT: Layout = Layout {
    name: "canvas",
    recognise,
    people,
};

/// A name that Canvas wrote.
#[derive(Debug, PartialEq, Eq)]
struct CanvasName<'n> {
    /// What begins all names of this person.
    whose: &'n str,
    slug: &'n str,
    late: bool,
    user: User<'n>,
    /// The number of the upload; none for a text or an address.
    attachment: Option<u64>,
    /// The file's own name.
    file: &'n str,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum User<'n> {
    Id(&'n str),
    Anonymous(&'n str),
}

impl<'n> CanvasName<'n> {
    fn parse(text: &'n str) -> Option<Self> {
        // the first pair of numbers is the user's and the file's: Canvas takes them out of names
        let cuts = std::iter::once(0).chain(text.match_indices('_').map(|(at, _)| at + 1));
        for at in cuts {
            let before = text[..at].strip_suffix('_').unwrap_or(&text[..at]);
            let (before, late) = match before.strip_suffix("LATE") {
                Some("") => ("", true),
                Some(slug) if slug.ends_with('_') => (&slug[..slug.len() - 1], true),
                _ => (before, false),
            };
            if !is_slug(before) {
                return None;
            }
            if let Some((user, attachment, file)) = numbers(&text[at..])
                // a name may be a number, too, but something stands before an id
                && (at > 0 || matches!(user, User::Anonymous(_)))
            {
                let end = text.len() - after_user(&text[at..], user).len();
                return Some(Self {
                    whose: &text[..end],
                    slug: before,
                    late,
                    user,
                    attachment,
                    file,
                });
            }
        }
        None
    }
}

/// Whether Canvas writes a name so: no capitals, nothing but word characters.
fn is_slug(text: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || is_combining_mark(c);
    text.chars().all(|c| is_word(c) && !c.is_uppercase())
}

/// What follows the user in a name that begins with the user.
fn after_user<'n>(text: &'n str, user: User<'_>) -> &'n str {
    let length = match user {
        User::Id(id) => id.len(),
        User::Anonymous(id) => "anon_".len() + id.len(),
    };
    &text[length..]
}

/// The user, the upload and the file's name of a text that begins with the user.
fn numbers(text: &str) -> Option<(User<'_>, Option<u64>, &str)> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let (user, rest) = match text.strip_prefix("anon_") {
        Some(anonymous) => {
            let (id, rest) = anonymous.split_once('_')?;
            let is_id = !id.is_empty() && id.bytes().all(|b| b.is_ascii_alphanumeric());
            (is_id.then_some(User::Anonymous(id))?, rest)
        }
        None => {
            let (id, rest) = text.split_once('_')?;
            (is_number(id).then_some(User::Id(id))?, rest)
        }
    };
    if matches!(rest, "text.html" | "link.html") {
        return Some((user, None, rest));
    }
    let (attachment, file) = rest.split_once('_')?;
    if !is_number(attachment) || file.is_empty() {
        return None;
    }
    Some((user, Some(attachment.parse().ok()?), file))
}

fn recognise(tree: &Tree) -> Confidence {
    let Some((level, found)) = level(tree) else {
        return Confidence::No;
    };
    let count = count_of(found, level.files.len(), "file");
    Confidence::Likely(format!("{count} with a user id and an attachment id"))
}

/// The first level on which most files are named as Canvas does, and how many are.
fn level(tree: &Tree) -> Option<(Level, usize)> {
    levels(tree).into_iter().find_map(|level| {
        let files = level.entries(tree);
        let found = files.filter(|(_, entry)| CanvasName::parse(entry.name()).is_some());
        let found = found.count();
        let others = level.files.len() + level.folders.len() - found;
        (found > others).then_some((level, found))
    })
}

fn people(tree: &Tree) -> Vec<PersonFiles> {
    let Some((level, _)) = level(tree) else {
        return Vec::new();
    };
    let mut people: BTreeMap<&str, Vec<(CanvasName<'_>, usize)>> = BTreeMap::new();
    let mut other = flat::Items {
        folders: level.folders.iter().collect(),
        ..flat::Items::default()
    };
    for (entry, file) in level.entries(tree) {
        match CanvasName::parse(file.name()) {
            Some(name) => people.entry(name.whose).or_default().push((name, entry)),
            None => other.files.push(entry),
        }
    }
    let folder = level.path.as_str();
    let mut people: Vec<PersonFiles> = people
        .into_values()
        .map(|uploads| person(folder, &uploads))
        .collect();
    people.extend(flat::people_among(tree, &other));
    people
}

/// The person whose uploads these are; of several uploads of one name the latest counts.
fn person(folder: &str, uploads: &[(CanvasName<'_>, usize)]) -> PersonFiles {
    let mut latest: BTreeMap<String, (Option<u64>, PersonFile)> = BTreeMap::new();
    for (name, entry) in uploads {
        let file = PersonFile {
            path: name.file.to_owned(),
            entry: *entry,
        };
        let upload = (name.attachment, file);
        let known = latest.entry(without_count(name.file));
        let kept = known.or_insert_with(|| upload.clone());
        if name.attachment > kept.0 {
            *kept = upload;
        }
    }
    let mut files: Vec<PersonFile> = latest.into_values().map(|(_, file)| file).collect();
    files.sort_by(|one, other| one.path.cmp(&other.path));
    let (name, _) = &uploads[0];
    let mut person = PersonFiles {
        label: match folder {
            "" => name.whose.to_owned(),
            folder => format!("{folder}/{}", name.whose),
        },
        files,
        marked_late: Some(name.late),
        ..PersonFiles::default()
    };
    match name.user {
        User::Id(id) => {
            person.lms_number = Some(id.to_owned());
            person.hints.push(Hint::LmsId(id.to_owned()));
            if !name.slug.is_empty() {
                person.hints.push(Hint::Slug(name.slug.to_owned()));
                // a group's hand-in has its name, and the user id of one of its members
                person.hints.push(Hint::Group(name.slug.to_owned()));
            }
        }
        User::Anonymous(id) => {
            person.lms_number = Some(id.to_owned());
            person.problems.push(PersonProblem {
                what: format!("the export hides names: anonymous user {id}"),
                help: "end anonymous grading in Canvas and export again".to_owned(),
            });
        }
    }
    person
}

/// A file's name without the count that Canvas adds to a name that is taken.
fn without_count(name: &str) -> String {
    // Canvas adds it before all endings: `a-1.rhai.txt`
    let (stem, endings) = match name.find('.') {
        Some(at) if at > 0 => name.split_at(at),
        _ => (name, ""),
    };
    let stem = match stem.rsplit_once('-') {
        Some((stem, count))
            if !stem.is_empty()
                && !count.is_empty()
                && count.bytes().all(|b| b.is_ascii_digit()) =>
        {
            stem
        }
        _ => stem,
    };
    format!("{stem}{endings}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str) -> Option<(&str, bool, User<'_>, Option<u64>, &str)> {
        let name = CanvasName::parse(text)?;
        Some((name.slug, name.late, name.user, name.attachment, name.file))
    }

    #[test]
    fn names_of_all_kinds_are_read() {
        use User::{Anonymous, Id};
        for (text, expected) in [
            (
                "limaana_41_990_submission.rhai",
                ("limaana", false, Id("41"), Some(990), "submission.rhai"),
            ),
            (
                "limaana_LATE_41_990_my_2_file-1.rhai",
                ("limaana", true, Id("41"), Some(990), "my_2_file-1.rhai"),
            ),
            ("7_41_990_x", ("7", false, Id("41"), Some(990), "x")),
            ("_41_990_x", ("", false, Id("41"), Some(990), "x")),
            (
                "a_b_41_990_1_2_x",
                ("a_b", false, Id("41"), Some(990), "1_2_x"),
            ),
            (
                "limaana_41_text.html",
                ("limaana", false, Id("41"), None, "text.html"),
            ),
            (
                "anon_Xy1Z2_990_x.rhai",
                ("", false, Anonymous("Xy1Z2"), Some(990), "x.rhai"),
            ),
            (
                "LATE_anon_Xy1Z2_990_x.rhai",
                ("", true, Anonymous("Xy1Z2"), Some(990), "x.rhai"),
            ),
            (
                "王小明_41_990_x.rhai",
                ("王小明", false, Id("41"), Some(990), "x.rhai"),
            ),
        ] {
            assert_eq!(parts(text), Some(expected), "{text}");
        }
        for text in [
            "Ana_41_990_x",
            "s1.rhai",
            "s1_2.rhai",
            "lima ana_41_990_x",
            "limaana_41_x",
            "41_990_x",
            "",
        ] {
            assert_eq!(parts(text), None, "{text}");
        }
    }

    #[test]
    fn all_names_of_a_person_begin_alike() {
        let whose = |text| CanvasName::parse(text).unwrap().whose;
        assert_eq!(whose("limaana_LATE_41_990_a"), "limaana_LATE_41");
        assert_eq!(whose("limaana_41_text.html"), "limaana_41");
        assert_eq!(whose("anon_Xy1Z2_990_x"), "anon_Xy1Z2");
    }

    #[test]
    fn a_count_before_the_endings_is_no_part_of_the_name() {
        assert_eq!(
            without_count("submission-12.rhai.txt"),
            "submission.rhai.txt"
        );
        assert_eq!(without_count("submission.rhai"), "submission.rhai");
        assert_eq!(without_count("-1.rhai"), "-1.rhai");
        assert_eq!(without_count("part-b.rhai"), "part-b.rhai");
    }
}
