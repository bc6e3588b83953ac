//! Moodle's "Download all submissions": `<full name>_<participant>_assignsubmission_file` as folders or in front of file names.
//!
//! Moodle before 4.1 ends the folders in `_`. Online text is in folders of its own, beside those of the same person. A team has its
//! group's name and number, or no number where it is the team of those in no group. Of names Moodle keeps neither `_` nor
//! ``&<>"`|':\/``. Sources: mod/assign/classes/downloader.php and feedback/file/importziplib.php of Moodle.

use std::collections::BTreeMap;

use super::level::{Level, levels};
use super::{Confidence, Hint, Layout, PersonFile, PersonFiles, PersonProblem, count_of, flat};
use crate::tree::Tree;

pub(super) const LAYOUT: Layout = Layout {
    name: "moodle",
    recognise,
    people,
};

/// What stands between the person and the kind of submission.
const MARK: &str = "_assignsubmission_";

/// The kind of submission that is files.
const FILE: &str = "file";

/// What Moodle puts in place of names where they are hidden; other languages have other words, but then everybody has the same.
const PARTICIPANT: &str = "Participant";

/// A name that Moodle wrote.
#[derive(Debug, PartialEq, Eq)]
struct MoodleName<'n> {
    /// The person or the group with the number, as it begins all their names.
    whose: &'n str,
    name: &'n str,
    number: Option<&'n str>,
    /// `file`, `onlinetext` or another plugin.
    kind: &'n str,
    /// The file's own name, where it is joined to this one.
    rest: &'n str,
}

impl<'n> MoodleName<'n> {
    fn parse(text: &'n str) -> Option<Self> {
        let (whose, after) = text.split_once(MARK)?;
        let (kind, rest) = after.split_once('_').unwrap_or((after, ""));
        let is_kind = !kind.is_empty() && kind.bytes().all(|b| b.is_ascii_lowercase());
        if !is_kind || whose.is_empty() {
            return None;
        }
        let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let (name, number) = match whose.rsplit_once('_') {
            Some((name, number)) if is_number(number) => (name, Some(number)),
            _ => (whose, None),
        };
        Some(Self {
            whose,
            name,
            number,
            kind,
            rest,
        })
    }
}

fn recognise(tree: &Tree) -> Confidence {
    let Some((level, found)) = level(tree) else {
        return Confidence::No;
    };
    let all = level.folders.len() + level.files.len();
    let count = count_of(found, all, "name");
    Confidence::Certain(format!("{count} with `{MARK}`"))
}

/// The first level with a name that Moodle wrote, and how many there are.
fn level(tree: &Tree) -> Option<(Level, usize)> {
    levels(tree).into_iter().find_map(|level| {
        let folders = level.folders.iter();
        let folders = folders.filter(|folder| MoodleName::parse(&folder.name).is_some());
        let files = level.entries(tree);
        let files = files.filter(|(_, entry)| MoodleName::parse(entry.name()).is_some());
        let found = folders.count() + files.count();
        (found > 0).then_some((level, found))
    })
}

fn people(tree: &Tree) -> Vec<PersonFiles> {
    let Some((level, _)) = level(tree) else {
        return Vec::new();
    };
    let mut people: BTreeMap<String, PersonFiles> = BTreeMap::new();
    let mut other = flat::Items::default();
    for folder in &level.folders {
        match MoodleName::parse(&folder.name) {
            Some(name) => add(&mut people, &name, &folder.path, folder.files(tree)),
            None => other.folders.push(folder),
        }
    }
    for (entry, file) in level.entries(tree) {
        match MoodleName::parse(file.name()) {
            Some(name) => {
                let path = name.rest.to_owned();
                let label = file.path[..file.path.len() - name.rest.len()].to_owned();
                add(&mut people, &name, &label, vec![PersonFile { path, entry }]);
            }
            None => other.files.push(entry),
        }
    }
    let mut people: Vec<PersonFiles> = people.into_values().collect();
    hide_common_name(&mut people);
    people.extend(flat::people_among(tree, &other));
    people
}

/// Adds files to the person or the group that `name` names.
fn add(
    people: &mut BTreeMap<String, PersonFiles>,
    name: &MoodleName<'_>,
    label: &str,
    files: Vec<PersonFile>,
) {
    let person = people
        .entry(name.whose.to_owned())
        .or_insert_with(|| PersonFiles {
            label: label.to_owned(),
            hints: hints(name),
            lms_number: name.number.map(str::to_owned),
            ..PersonFiles::default()
        });
    if name.kind == FILE {
        // their files are what people look for, and not a text beside them
        person.label = label.to_owned();
    }
    person.files.extend(files.into_iter().map(|mut file| {
        if name.kind != FILE {
            file.path = format!("{}/{}", name.kind, file.path);
        }
        file
    }));
    person.files.sort_by(|one, other| one.path.cmp(&other.path));
}

/// What a name may say: a site can put the username in place of the full name, and a team has a group's.
fn hints(name: &MoodleName<'_>) -> Vec<Hint> {
    let text = || name.name.to_owned();
    vec![
        Hint::Name(text()),
        Hint::Username(text()),
        Hint::Group(text()),
        Hint::PathName(text()),
    ]
}

/// Takes the names away where they are no names: a blind assignment has one word for everybody.
fn hide_common_name(people: &mut [PersonFiles]) {
    let Some(first) = people.first().and_then(|person| person.hints.first()) else {
        return;
    };
    let first = first.clone();
    let is_common = people
        .iter()
        .all(|person| person.hints.first() == Some(&first) && person.lms_number.is_some());
    // two of one name can be two people; everybody of one name is nobody's name
    if !is_common || (first.text() != PARTICIPANT && people.len() < 3) {
        return;
    }
    for person in people {
        person.hints.clear();
        let number = person.lms_number.as_deref().unwrap_or("?");
        person.problems.push(PersonProblem {
            what: format!("the export hides names: participant {number}"),
            help: "reveal student identities in Moodle and export again".to_owned(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str) -> Option<(&str, Option<&str>, &str, &str)> {
        let name = MoodleName::parse(text)?;
        Some((name.name, name.number, name.kind, name.rest))
    }

    #[test]
    fn names_of_all_versions_are_read() {
        for (text, expected) in [
            (
                "Ana Lima_12_assignsubmission_file_",
                ("Ana Lima", Some("12"), "file", ""),
            ),
            (
                "Ana Lima_12_assignsubmission_file",
                ("Ana Lima", Some("12"), "file", ""),
            ),
            (
                "Ana Lima_12_assignsubmission_file_my_work.rhai",
                ("Ana Lima", Some("12"), "file", "my_work.rhai"),
            ),
            (
                "Ana Lima_12_assignsubmission_onlinetext_onlinetext.html",
                ("Ana Lima", Some("12"), "onlinetext", "onlinetext.html"),
            ),
            (
                "Default group_assignsubmission_file",
                ("Default group", None, "file", ""),
            ),
        ] {
            assert_eq!(parts(text), Some(expected), "{text}");
        }
        for text in [
            "Ana Lima_12",
            "_assignsubmission_file_",
            "a_assignsubmission_",
        ] {
            assert_eq!(parts(text), None, "{text}");
        }
    }
}
