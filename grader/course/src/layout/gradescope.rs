//! Gradescope's "Export Submissions": folders `submission_<id>` and `submission_metadata.yml`, which says whose they are.
//!
//! The file is YAML of Ruby: keys are symbols (`:submitters:`), times can be objects. It gives each submission its submitters (`:name`,
//! `:sid`, `:email`), the time, and earlier submissions, whose files are not in the export. Assignments of pages have files in place
//! of folders.

use std::collections::{BTreeMap, BTreeSet};

use jiff::Timestamp;
use serde::Deserialize;

use super::level::{Level, LevelFolder, levels};
use super::{Confidence, Hint, Layout, PersonFile, PersonFiles, PersonProblem, flat};
use crate::course_text::decoded;
use crate::tree::Tree;

pub(super) const LAYOUT: Layout = Layout {
    name: "gradescope",
    recognise,
    people,
};

/// The file that says whose the submissions are.
const METADATA: &str = "submission_metadata.yml";

/// How the folder of a submission begins.
const FOLDER: &str = "submission_";

/// The metadata has the output of every test of every attempt; above this it is something else [bytes].
const MOST_METADATA_BYTES: u64 = 256 << 20;

/// What the metadata says of one submission.
#[derive(Debug, Deserialize)]
struct Submission {
    #[serde(rename = ":submitters", default)]
    submitters: Option<Vec<Submitter>>,
    #[serde(rename = ":created_at", default)]
    created_at: Option<RubyTime>,
    #[serde(rename = ":history", default)]
    history: Option<Vec<Earlier>>,
}

/// One of those who handed in together.
#[derive(Debug, Clone, Deserialize)]
struct Submitter {
    #[serde(rename = ":name", default)]
    name: Option<String>,
    #[serde(rename = ":sid", default)]
    sid: Option<String>,
    #[serde(rename = ":email", default)]
    email: Option<String>,
}

/// An earlier submission of the same people.
#[derive(Debug, Deserialize)]
struct Earlier {
    #[serde(rename = ":created_at", default)]
    created_at: Option<RubyTime>,
}

/// A time as Ruby writes it: text, or an object that has the time in UTC.
#[derive(Debug)]
struct RubyTime(Option<Timestamp>);

impl<'de> Deserialize<'de> for RubyTime {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RubyTimeVisitor)
    }
}

struct RubyTimeVisitor;

impl<'de> serde::de::Visitor<'de> for RubyTimeVisitor {
    type Value = RubyTime;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a time")
    }

    fn visit_str<E>(self, text: &str) -> Result<RubyTime, E> {
        Ok(RubyTime(instant(text)))
    }

    fn visit_unit<E>(self) -> Result<RubyTime, E> {
        Ok(RubyTime(None))
    }

    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<RubyTime, A::Error> {
        let mut utc = None;
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "utc" => utc = map.next_value::<Option<String>>()?,
                _ => drop(map.next_value::<serde::de::IgnoredAny>()?),
            }
        }
        Ok(RubyTime(utc.as_deref().and_then(instant)))
    }
}

/// A point in time with its offset: `2026-11-30 18:41:12.345678000 Z`, `2026-11-30T18:41:12-08:00`.
fn instant(text: &str) -> Option<Timestamp> {
    let text = text.trim();
    // Ruby puts a space before the offset
    let joined = match text.rsplit_once(' ') {
        Some((time, zone)) if zone.starts_with(['Z', '+', '-', 'U']) => {
            format!("{}{}", time.trim_end(), zone.replace("UTC", "Z"))
        }
        _ => text.to_owned(),
    };
    joined.parse().ok()
}

fn recognise(tree: &Tree) -> Confidence {
    match level(tree) {
        Some((_, Some(_))) => Confidence::Certain(format!("it has {METADATA}")),
        Some((level, None)) => {
            let folders = level.folders.len();
            Confidence::Likely(format!("folders `{FOLDER}...`: {folders}"))
        }
        None => Confidence::No,
    }
}

/// The first level with the metadata, or with nothing but folders of submissions; and the number of the metadata's entry.
fn level(tree: &Tree) -> Option<(Level, Option<usize>)> {
    levels(tree).into_iter().find_map(|level| {
        let metadata = level
            .entries(tree)
            .find(|(_, entry)| entry.name() == METADATA)
            .map(|(i, _)| i);
        let are_submissions = !level.folders.is_empty() && level.folders.iter().all(is_submission);
        (metadata.is_some() || are_submissions).then_some((level, metadata))
    })
}

fn is_submission(folder: &LevelFolder) -> bool {
    let id = folder.name.strip_prefix(FOLDER);
    id.is_some_and(|id| !id.is_empty() && id.bytes().all(|b| b.is_ascii_digit()))
}

fn people(tree: &Tree) -> Vec<PersonFiles> {
    let Some((level, metadata)) = level(tree) else {
        return Vec::new();
    };
    let (submissions, problem) = match submissions(tree, metadata) {
        Ok(submissions) => (submissions, None),
        Err(problem) => (BTreeMap::new(), Some(problem)),
    };
    let mut people = Vec::new();
    let mut other = flat::Items::default();
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut named =
        |name: &str, label: &str, files: Vec<PersonFile>| match submissions.get_key_value(name) {
            Some((name, submission)) => {
                seen.insert(name);
                people.extend(people_of(label, &files, submission));
                true
            }
            None => false,
        };
    let mut unnamed = Vec::new();
    for folder in &level.folders {
        let files = folder.files(tree);
        if named(&folder.name, &folder.path, files) {
            continue;
        }
        match is_submission(folder) {
            true => unnamed.push(unknown(folder, tree, problem.as_ref())),
            false => other.folders.push(folder),
        }
    }
    for (entry, file) in level.entries(tree) {
        let path = file.name().to_owned();
        let one = vec![PersonFile { path, entry }];
        if !named(file.name(), &file.path, one) && Some(entry) != metadata {
            other.files.push(entry);
        }
    }
    let missing = submissions
        .iter()
        .filter(|(name, _)| !seen.contains(name.as_str()));
    let missing: Vec<PersonFiles> = missing
        .flat_map(|(name, submission)| people_of(name, &[], submission))
        .map(without_files)
        .collect();
    people.extend(missing);
    people.extend(unnamed);
    people.extend(flat::people_among(tree, &other));
    people
}

/// The submissions that the metadata names, by folder or file.
fn submissions(
    tree: &Tree,
    metadata: Option<usize>,
) -> Result<BTreeMap<String, Submission>, PersonProblem> {
    let refuse = |what: String| PersonProblem {
        what,
        help: format!("export the submissions again, with {METADATA} at the top"),
    };
    let Some(entry) = metadata.map(|i| &tree.entries()[i]) else {
        return Err(refuse(format!("{METADATA} is not in the export")));
    };
    let bytes = tree.bytes(entry, MOST_METADATA_BYTES);
    let bytes = bytes.map_err(|problem| refuse(format!("{METADATA}: {problem}")))?;
    // what the tests of a whole class print is far beyond a file of settings
    let options = serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_events: 100_000_000,
            max_nodes: 100_000_000,
            max_total_scalar_bytes: 1 << 30,
            max_aliases: 10_000_000,
            max_anchors: 10_000_000,
            max_recorded_anchor_events: 100_000_000,
            max_recorded_anchor_bytes: 1 << 30,
        },
    };
    serde_saphyr::from_str_with_options(&decoded(&bytes), options)
        .map_err(|why| refuse(format!("{METADATA} cannot be read: {why}")))
}

/// Everybody who handed in a submission, each with its files.
fn people_of(label: &str, files: &[PersonFile], submission: &Submission) -> Vec<PersonFiles> {
    let submitted_at = submission.created_at.as_ref().and_then(|time| time.0);
    let history = submission.history.as_deref().unwrap_or_default();
    let earlier = |earlier: &&Earlier| match (&earlier.created_at, submitted_at) {
        (Some(RubyTime(Some(at))), Some(submitted_at)) => *at < submitted_at,
        _ => false,
    };
    let attempt = history.iter().filter(earlier).count() + 1;
    let person = |label: String| PersonFiles {
        label,
        files: files.to_vec(),
        submitted_at,
        attempt: submitted_at.and(u32::try_from(attempt).ok()),
        ..PersonFiles::default()
    };
    let submitters = submission.submitters.as_deref().unwrap_or_default();
    if submitters.is_empty() {
        let mut nobody = person(label.to_owned());
        nobody.problems.push(PersonProblem {
            what: format!("{METADATA} names no submitter of it"),
            help: "assign it to a student in Gradescope and export again".to_owned(),
        });
        return vec![nobody];
    }
    let mut people = Vec::new();
    for (i, submitter) in submitters.iter().enumerate() {
        let mut person = person(match submitters.len() {
            1 => label.to_owned(),
            _ => format!("{label} ({})", i + 1),
        });
        let given = |text: &Option<String>| {
            let text = text.as_deref().unwrap_or_default().trim();
            (!text.is_empty()).then(|| text.to_owned())
        };
        person.hints.extend(given(&submitter.sid).map(Hint::Id));
        person
            .hints
            .extend(given(&submitter.email).map(Hint::Email));
        person.hints.extend(given(&submitter.name).map(Hint::Name));
        people.push(person);
    }
    people
}

/// A folder that the metadata does not name.
fn unknown(folder: &LevelFolder, tree: &Tree, problem: Option<&PersonProblem>) -> PersonFiles {
    let unnamed = || PersonProblem {
        what: format!("{METADATA} does not name it"),
        help: "export the submissions again".to_owned(),
    };
    PersonFiles {
        label: folder.path.clone(),
        files: folder.files(tree),
        problems: vec![problem.cloned().unwrap_or_else(unnamed)],
        ..PersonFiles::default()
    }
}

/// A submission whose files are not there.
fn without_files(mut person: PersonFiles) -> PersonFiles {
    person.problems.push(PersonProblem {
        what: format!("{METADATA} names it, and its files are not in the export"),
        help: "export the submissions again".to_owned(),
    });
    person
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_ruby_are_points_in_time() {
        let expected = Some(jiff::Timestamp::from_second(1_796_064_072).unwrap());
        for text in [
            "2026-11-30 18:41:12.000000000 Z",
            "2026-11-30 18:41:12 UTC",
            "2026-11-30T10:41:12-08:00",
            "2026-11-30 10:41:12.000000 -08:00",
        ] {
            assert_eq!(instant(text), expected, "{text}");
        }
        // without an offset nobody knows when it was
        assert_eq!(instant("2026-11-30 18:41:12"), None);
    }
}
