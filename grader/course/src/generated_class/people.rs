//! A generated class: people whose names are hard to write down, and the ways in which they hand in.

use proptest::prelude::*;

use crate::tree::sample::zip;

/// A student.
#[derive(Debug, Clone)]
pub(super) struct Student {
    pub(super) id: String,
    pub(super) name: String,
    pub(super) username: String,
    pub(super) lms_id: String,
    pub(super) way: Way,
}

/// How a student hands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// `submission.rhai`.
    Plain,
    /// As a browser saves it a second time.
    BrowserCopy,
    /// As an editor saves it.
    Text,
    /// The working folder, zipped on a Mac.
    ZippedFolder,
    /// The working folder, zipped twice.
    ZippedTwice,
    /// The working folder with a report under another name.
    Folder,
    /// What `kinemark submit` writes.
    HandIn,
}

const WAYS: [Way; 7] = [
    Way::Plain,
    Way::BrowserCopy,
    Way::Text,
    Way::ZippedFolder,
    Way::ZippedTwice,
    Way::Folder,
    Way::HandIn,
];

/// How a hand-in file begins here; what it really looks like is not of this test.
pub(super) const HAND_IN_MARK: &[u8] = b"KINEMARK ";

impl Student {
    /// What the student wrote.
    pub(super) fn submission(&self) -> Vec<u8> {
        format!("// {}\nfn control(o) {{ [0.0, 0.0] }}\n", self.id).into_bytes()
    }

    /// What has to be found.
    pub(super) fn expected(&self) -> Vec<u8> {
        match self.way {
            Way::HandIn => [HAND_IN_MARK, &self.submission()].concat(),
            _ => self.submission(),
        }
    }

    /// The files that the student hands in.
    pub(super) fn files(&self) -> Vec<(String, Vec<u8>)> {
        let one = |name: &str| vec![(name.to_owned(), self.submission())];
        match self.way {
            Way::Plain => one("submission.rhai"),
            Way::BrowserCopy => one("submission (1).rhai"),
            Way::Text => one("Lab 1 – Lösung.rhai.txt"),
            Way::HandIn => vec![("work.kinemark".to_owned(), self.expected())],
            Way::Folder => self.working_folder("last try"),
            Way::ZippedFolder => vec![("01-kinematics.zip".to_owned(), self.zipped_folder())],
            Way::ZippedTwice => {
                let twice = zip(&[("01-kinematics.zip", self.zipped_folder())]);
                vec![("Archive.zip".to_owned(), twice)]
            }
        }
    }

    /// The files as one that can be uploaded.
    pub(super) fn upload(&self) -> (String, Vec<u8>) {
        match self.files().as_slice() {
            [only] => only.clone(),
            files => ("01-kinematics.zip".to_owned(), zip(files)),
        }
    }

    fn zipped_folder(&self) -> Vec<u8> {
        let mut files = self.working_folder("out");
        files.push((
            "__MACOSX/01-kinematics/._submission.rhai".to_owned(),
            vec![0; 40],
        ));
        files.push(("01-kinematics/.DS_Store".to_owned(), vec![0; 40]));
        zip(&files)
    }

    fn working_folder(&self, report: &str) -> Vec<(String, Vec<u8>)> {
        let file = |path: String, text: &str| (format!("01-kinematics/{path}"), text.into());
        vec![
            file("brief.md".to_owned(), "# brief"),
            file("starter.rhai".to_owned(), "// the starter"),
            file(format!("{report}/grade.json"), "{}"),
            file(format!("{report}/report.json"), "{}"),
            file(format!("{report}/submission.rhai"), "// an older one"),
            file(format!("{report}/lab/01-kinematics/starter.rhai"), "// s"),
            (
                "01-kinematics/submission.rhai".to_owned(),
                self.submission(),
            ),
            file("._submission.rhai".to_owned(), "\u{0}"),
        ]
    }
}

/// Names that are written in many ways, or that spreadsheets and terminals trip over.
fn name() -> impl Strategy<Value = String> {
    let known = [
        "Renée Müller",
        "王小明",
        "محمد علي",
        "דוד כהן",
        "🤖 Robot 👩\u{200d}🔬",
        "=SUM(A1) Formula",
        "Sean O'Brien",
        "Anne-Marie de la Cruz_Vega",
        "Kim Lee",
        "Kim Lee",
        "Nguyễn Thị Ánh",
        "-rf *",
        "a/b\\c: d",
        "हिन्दी नाम",
    ];
    prop_oneof![
        4 => prop::sample::select(known.to_vec()).prop_map(str::to_owned),
        1 => Just("Maximilian ".repeat(11).trim_end().to_owned()),
        3 => "\\PC{1,24}",
    ]
}

/// A class of a dozen or so.
pub(super) fn class() -> impl Strategy<Value = Vec<Student>> {
    let person = (name(), prop::sample::select(WAYS.to_vec()));
    prop::collection::vec(person, 3..14).prop_map(|people| {
        let student = |(i, (name, way)): (usize, (String, Way))| Student {
            id: format!("s{}", 1_001_000 + i),
            username: format!("login-{}{}", (b'a' + i as u8) as char, i),
            lms_id: (41_000 + i).to_string(),
            // a name of dots and commas alone is no name to a file system
            name: match name.chars().any(char::is_alphanumeric) {
                false => "x".to_owned(),
                true => name.trim().to_owned(),
            },
            way,
        };
        people.into_iter().enumerate().map(student).collect()
    })
}

/// The roster of a class.
pub(super) fn roster(class: &[Student]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(["id", "name", "email", "lms_id", "username"])
        .unwrap();
    for student in class {
        let email = format!("{}@example.org", student.id);
        writer
            .write_record([
                &student.id,
                &student.name,
                &email,
                &student.lms_id,
                &student.username,
            ])
            .unwrap();
    }
    writer.into_inner().unwrap()
}
