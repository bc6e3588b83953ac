//! The form of a case: `tests/attacks/NAME/case.toml`, files beside it, and what it must come to.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::testbed::root;

/// A case, as `case.toml` has it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    #[serde(skip)]
    pub(crate) name: String,
    #[serde(skip)]
    pub(crate) folder: PathBuf,
    /// What is tried, in a sentence.
    pub(crate) what: String,
    /// Of which kind it is.
    pub(crate) kind: Kind,
    /// The lab that the submission is handed in for.
    #[serde(default = "lab_1")]
    pub(crate) lab: String,
    /// What it must come to where it has no steps that run something; then it is graded with the course staff's part.
    pub(crate) expect: Option<Expect>,
    /// What a worker sends instead of what it is asked for: `tests/src/hostile_worker` runs such a case.
    pub(crate) lie: Option<Lie>,
    /// What is done in turn.
    #[serde(default, rename = "step")]
    pub(crate) steps: Vec<Step>,
}

/// What is attacked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Kind {
    /// Time: work that is not counted, or far more than its count.
    Cpu,
    /// Memory of a worker or the grader.
    Memory,
    /// Depth of calls, of expressions, of values.
    Stack,
    /// Floods of lines, signals and files.
    Output,
    /// Numbers that are none, and shapes that are not expected.
    Numbers,
    /// What is only possible in a compiled module.
    Module,
    /// Names, links, pipes, and bytes that are no text.
    Files,
    /// Files that course staff get from others: labs, robots, scenes, meshes, logs, archives.
    Inputs,
    /// What a page, a terminal or a table makes of a submission's words.
    Words,
    /// Servers: `view` and `watch`.
    Server,
    /// Hidden cases, the reference, the salt, other files.
    Leak,
    /// Reports that were changed.
    Report,
    /// Messages of a worker that nobody sealed, or that got around its own code.
    Frames,
}

/// What a worker sends, again and again until it ends.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Lie {
    /// In place of which message.
    pub(crate) at: At,
    /// Bytes as they are.
    hex: Option<String>,
    /// A message of these bytes, then `repeat_hex` so many `times`, then `after_hex`; its length is put before it.
    frame: Option<String>,
    repeat_hex: Option<String>,
    #[serde(default)]
    times: usize,
    after_hex: Option<String>,
    /// Whether it does not wait to be asked again.
    #[serde(default)]
    pub(crate) forever: bool,
    /// Whether it says nothing more.
    #[serde(default)]
    pub(crate) silent: bool,
    /// What it says on its standard error before it ends.
    pub(crate) says: Option<String>,
    /// The signal that ends or stops it, without `SIG`.
    pub(crate) signal: Option<String>,
    /// The code with which it exits.
    pub(crate) exit: Option<i32>,
}

/// A message of a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum At {
    /// The first one: which layers are on.
    Ready,
    /// That a submission is open.
    Open,
    /// The answer to a call.
    Call,
}

impl Lie {
    /// The bytes that are sent.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut bytes = of_hex(&self.hex);
        if self.frame.is_some() {
            let frame = [
                of_hex(&self.frame),
                of_hex(&self.repeat_hex).repeat(self.times),
                of_hex(&self.after_hex),
            ]
            .concat();
            let length = u32::try_from(frame.len()).expect("a length");
            bytes.extend(length.to_le_bytes());
            bytes.extend(frame);
        }
        bytes
    }
}

/// One step: something is made, or the program is run, or a server is asked.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Step {
    /// A file to write: `text`, then `repeat` so many `times`, then `after`; or the bytes of `hex`; or a copy of a file of the checkout.
    pub(crate) file: Option<String>,
    pub(crate) text: Option<String>,
    pub(crate) repeat: Option<String>,
    #[serde(default)]
    pub(crate) times: usize,
    pub(crate) after: Option<String>,
    pub(crate) hex: Option<String>,
    pub(crate) repeat_hex: Option<String>,
    /// A file to write more of the same kind to.
    pub(crate) append: Option<String>,
    pub(crate) copy: Option<String>,
    /// A named pipe.
    pub(crate) pipe: Option<String>,
    /// A symbolic link, and where it leads; `{root}` is the checkout.
    pub(crate) link: Option<String>,
    /// Another name of a file.
    pub(crate) hard_link: Option<String>,
    pub(crate) to: Option<String>,
    /// A file or folder to take away.
    pub(crate) delete: Option<String>,
    /// A file in which `from` becomes `to`, everywhere.
    pub(crate) edit: Option<String>,
    pub(crate) from: Option<String>,
    /// An archive to pack: its name, of `entries` with their text.
    pub(crate) zip: Option<String>,
    #[serde(default)]
    pub(crate) entries: BTreeMap<String, String>,

    /// The words of a command; `{root}` is the checkout.
    #[serde(default)]
    pub(crate) run: Vec<String>,
    /// What it reads from its standard input.
    pub(crate) stdin: Option<String>,
    /// Variables of its environment.
    #[serde(default)]
    pub(crate) environment: BTreeMap<String, String>,
    /// The exit code it must have.
    pub(crate) exit: Option<i32>,
    /// The most memory of all its processes, where it may be more than usual \[MB\].
    pub(crate) memory_mb: Option<u64>,

    /// The words of a command that serves; `ask` and `answer` follow.
    #[serde(default)]
    pub(crate) serve: Vec<String>,
    #[serde(default)]
    pub(crate) ask: Vec<Ask>,
    /// Clients that have come before whoever asks, and stay.
    #[serde(default)]
    pub(crate) wait: Vec<Waiting>,

    #[serde(default)]
    pub(crate) expect: Expect,
}

impl Step {
    /// Whether it starts the program.
    pub(crate) fn runs(&self) -> bool {
        !self.run.is_empty() || !self.serve.is_empty()
    }
}

/// What a grade or a command must come to.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expect {
    /// The verdict of the whole grade.
    pub(crate) verdict: Option<String>,
    /// The verdicts of its tasks.
    #[serde(default)]
    pub(crate) tasks: BTreeMap<String, String>,
    /// The line of the submission at which the first task that stops does so: that of the attack, and not of what prepares it.
    pub(crate) line: Option<u64>,
    /// What is said, each somewhere in the output.
    #[serde(default)]
    pub(crate) says: Vec<String>,
    /// What stands nowhere: not in the output, and in no file of the report.
    #[serde(default)]
    pub(crate) never: Vec<String>,
    /// What stands in no page or drawing of the report as it is.
    #[serde(default)]
    pub(crate) never_in_pages: Vec<String>,
}

/// A request to a server, and what its answer must be.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Ask {
    /// The request without its end; `{host}` and `{path}` are those of the address that was printed.
    pub(crate) send: String,
    /// Whether each byte is sent by itself.
    #[serde(default)]
    pub(crate) by_byte: bool,
    /// The code of the answer; 0 where the connection is closed without one.
    pub(crate) code: u16,
    #[serde(default)]
    pub(crate) says: Vec<String>,
    #[serde(default)]
    pub(crate) never: Vec<String>,
}

/// Clients of a server that read nothing.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Waiting {
    /// How many.
    pub(crate) clients: usize,
    /// What each of them sends, and no more; places as in [`Ask`].
    #[serde(default)]
    pub(crate) send: String,
}

fn lab_1() -> String {
    "01-kinematics".to_owned()
}

/// All cases, by their names.
pub(crate) fn all_cases() -> Vec<(String, Case)> {
    let folder = root().join("tests/attacks");
    let mut names: Vec<String> = Vec::new();
    for entry in std::fs::read_dir(&folder).expect("tests/attacks") {
        let entry = entry.expect("an entry");
        if entry.path().is_dir() {
            names.push(entry.file_name().into_string().expect("UTF-8"));
        }
    }
    names.sort();
    names
        .into_iter()
        .map(|name| (name.clone(), read(&folder.join(&name), name)))
        .collect()
}

fn read(folder: &Path, name: String) -> Case {
    let path = folder.join("case.toml");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let case: Case = toml::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let runs = case.steps.iter().any(Step::runs);
    assert!(
        runs != case.expect.is_some(),
        "{}: either steps that run something, or `expect`",
        path.display()
    );
    Case {
        name,
        folder: folder.to_owned(),
        ..case
    }
}

/// The bytes that hexadecimal digits stand for.
pub(crate) fn of_hex(digits: &Option<String>) -> Vec<u8> {
    let digits = digits.iter().flat_map(|text| text.bytes());
    let digits: Vec<u8> = digits.filter(u8::is_ascii_hexdigit).collect();
    let (pairs, _) = digits.as_chunks::<2>();
    let pairs = pairs.iter().map(|pair| std::str::from_utf8(pair));
    pairs
        .map(|pair| u8::from_str_radix(pair.expect("ASCII"), 16).expect("a byte"))
        .collect()
}
