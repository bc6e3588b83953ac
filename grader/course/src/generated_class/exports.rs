//! The class as each LMS would export it: paths and bytes.

use unicode_normalization::UnicodeNormalization as _;

use super::people::{Student, Way};

/// Paths and bytes.
pub(super) type Files = Vec<(String, Vec<u8>)>;

/// How Moodle writes an export.
#[derive(Debug, Clone, Copy)]
pub(super) struct MoodleWay {
    /// A folder a person, and not all files in one.
    pub(super) folders: bool,
    /// Folders end in `_`, as before 4.1.
    pub(super) old: bool,
}

/// A name as Moodle puts it into names of files.
pub(super) fn moodle_name(name: &str) -> String {
    let spaced = name.replace('_', " ");
    let kept = spaced
        .chars()
        .filter(|c| !c.is_control() && !"&<>\"`|':\\/".contains(*c));
    let mut kept: String = kept.collect();
    while let Some(at) = kept.find("..") {
        let end = kept[at..].find(|c| c != '.').map_or(kept.len(), |n| at + n);
        kept.replace_range(at..end, "");
    }
    kept
}

pub(super) fn moodle(class: &[Student], way: MoodleWay) -> Files {
    let mut files = Vec::new();
    for (i, student) in class.iter().enumerate() {
        let prefix = format!(
            "{}_{}_assignsubmission_",
            moodle_name(&student.name),
            700 + i
        );
        if way.folders {
            let end = if way.old { "_" } else { "" };
            for (path, bytes) in student.files() {
                files.push((format!("{prefix}file{end}/{path}"), bytes));
            }
            let text = format!("{prefix}onlinetext{end}/onlinetext.html");
            files.push((text, b"<p>See my file.</p>".to_vec()));
        } else {
            let (name, bytes) = student.upload();
            files.push((format!("{prefix}file_{name}"), bytes));
        }
    }
    files
}

pub(super) fn canvas(class: &[Student]) -> Files {
    let mut files = Vec::new();
    for (i, student) in class.iter().enumerate() {
        // the sortable name: the last word first
        let sortable = match student.name.rsplit_once(' ') {
            Some((first, last)) => format!("{last}, {first}"),
            None => student.name.clone(),
        };
        let slug: String = sortable
            .to_lowercase()
            .chars()
            .filter(|c| {
                c.is_alphanumeric() && !c.is_uppercase()
                    || unicode_normalization::char::is_combining_mark(*c)
            })
            .collect();
        let late = if i % 3 == 0 { "_LATE" } else { "" };
        let (name, bytes) = student.upload();
        let prefix = format!("{slug}{late}_{}", student.lms_id);
        if i % 4 == 0 && student.way == Way::Plain {
            files.push((
                format!("{prefix}_{}_{name}", 100 + i),
                b"// an older upload".to_vec(),
            ));
            let newer = name.replace(".rhai", "-1.rhai");
            files.push((format!("{prefix}_{}_{newer}", 900 + i), bytes));
        } else {
            files.push((format!("{prefix}_{}_{name}", 500 + i), bytes));
        }
    }
    files
}

pub(super) fn gradescope(class: &[Student]) -> Files {
    let top = "assignment_1_export";
    let mut files = Vec::new();
    let mut metadata = "---\n".to_owned();
    for (i, student) in class.iter().enumerate() {
        let folder = format!("submission_{}", 900 + i);
        let quoted = |text: &str| serde_json::to_string(text).unwrap();
        metadata += &format!(
            "{folder}:\n  :submitters:\n  - :name: {}\n    :sid: {}\n    :email: {}\n  :created_at: \
             2026-11-30 18:41:{:02}.000000000 Z\n  :history: []\n",
            quoted(&student.name),
            quoted(&student.id),
            quoted(&format!("{}@example.org", student.id)),
            i,
        );
        for (path, bytes) in student.files() {
            files.push((format!("{top}/{folder}/{path}"), bytes));
        }
    }
    files.push((
        format!("{top}/submission_metadata.yml"),
        metadata.into_bytes(),
    ));
    files.push((format!("{top}/.DS_Store"), vec![0]));
    files
}

pub(super) fn repositories(class: &[Student]) -> Files {
    let mut files = Vec::new();
    for student in class {
        let folder = format!("lab1-{}", student.username);
        files.push((
            format!("{folder}/.git/HEAD"),
            b"ref: refs/heads/main\n".to_vec(),
        ));
        files.push((format!("{folder}/README.md"), b"# Lab 1\n".to_vec()));
        for (path, bytes) in student.files() {
            files.push((format!("{folder}/{path}"), bytes));
        }
    }
    files
}

pub(super) fn flat(class: &[Student]) -> Files {
    let mut files = Vec::new();
    for student in class {
        let id = &student.id;
        match student.way {
            Way::Plain => files.push((format!("{id}.rhai"), student.submission())),
            Way::HandIn => files.push((format!("{id}.kinemark"), student.expected())),
            Way::ZippedFolder => files.push((format!("{id}.zip"), student.upload().1)),
            Way::Text => files.push((format!("{id}_1.rhai.txt"), student.submission())),
            Way::ZippedTwice => files.push((format!("lab1 {id}.zip"), student.upload().1)),
            Way::Folder | Way::BrowserCopy => {
                let own = student.files().into_iter();
                files.extend(own.map(|(path, bytes)| (format!("{id}/{path}"), bytes)));
            }
        }
    }
    files
}

/// The files with names decomposed, as some systems store them.
pub(super) fn decomposed(files: Files) -> Files {
    let name = |path: String| path.nfd().collect::<String>();
    let files = files.into_iter();
    files.map(|(path, bytes)| (name(path), bytes)).collect()
}
