//! Runs a case, and holds it to what every case must do: an exit code that is documented, no panic, little memory, no control characters,
//! nothing of the environment or the salt, no process that is left.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;
use wait4::Wait4 as _;

use crate::case::{Case, Expect, Kind, Step};
use crate::folder::{filled, lay_out, make};
use crate::hidden::hidden_number_in;
use crate::served::ask;
use crate::testbed::{TestBed, binary};

/// What a case took.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Spent {
    pub(crate) cpu_s: f64,
    pub(crate) memory_mb: u64,
}

/// The most memory that one process of a case may take \[MB\].
const MOST_MEMORY_MB: u64 = 256;

/// No file of a report is as large as this.
const LARGEST_BYTES: u64 = 16 << 20;

/// What is in the environment of every command and must not come out of it: the course's salt, and another secret.
pub(crate) const SALT: &str = "salt-of-the-attacked-course";
const SECRET: &str = "secret-of-the-environment";

/// What a command did.
struct Ran {
    code: Option<i32>,
    stdout: String,
    stderr: String,
    spent: Spent,
}

/// Runs a case to its end.
pub(crate) fn run(case: &Case) -> Spent {
    assert!(case.what.len() > 10, "say what is tried");
    let bed = TestBed::new();
    lay_out(case, &bed);
    let mut most = Spent::default();
    for step in &case.steps {
        make(step, &bed);
        most = most.with(done(step, &bed));
    }
    if let Some(expect) = &case.expect {
        let step = graded(case, expect, &bed);
        most = most.with(done(&step, &bed));
        holds_no_hidden_number(case, &bed);
        // once more as a person reads it: other words, and pages
        if matches!(case.kind, Kind::Words | Kind::Module | Kind::Leak) {
            most = most.with(done(&as_text(&step), &bed));
            holds_no_hidden_number(case, &bed);
        }
    }
    most
}

impl Spent {
    fn with(self, other: Self) -> Self {
        Self {
            cpu_s: self.cpu_s + other.cpu_s,
            memory_mb: self.memory_mb.max(other.memory_mb),
        }
    }
}

/// The step of a case that is only handed in: it is graded as course staff grade it.
fn graded(case: &Case, expect: &Expect, bed: &TestBed) -> Step {
    let names = ["submission.rhai", "submission.py", "submission.wasm"];
    let submission = names.into_iter().find(|name| bed.path(name).exists());
    let words = [
        "grade",
        &case.lab,
        submission.expect("a submission"),
        "--labs={root}/labs",
        "--reference={root}/reference",
        "--out=out",
        "--json",
    ];
    let passed = expect.verdict.as_deref() == Some("passed");
    Step {
        run: words.map(str::to_owned).to_vec(),
        exit: Some(i32::from(!passed)),
        expect: expect.clone(),
        ..Step::default()
    }
}

/// The same for a person.
fn as_text(step: &Step) -> Step {
    let words = step.run.iter().filter(|word| *word != "--json");
    Step {
        run: words.cloned().collect(),
        exit: step.exit,
        expect: Expect {
            verdict: None,
            line: None,
            tasks: BTreeMap::new(),
            says: Vec::new(),
            ..step.expect.clone()
        },
        ..Step::default()
    }
}

/// What was written and printed has no number of a hidden case or run in it.
fn holds_no_hidden_number(case: &Case, bed: &TestBed) {
    for (name, bytes) in written_below(&bed.path("")) {
        if let Some(number) = hidden_number_in(&case.lab, &bytes) {
            panic!("the hidden number {number} is in {name}");
        }
    }
}

/// Does what a step says, and holds it to what it must come to.
fn done(step: &Step, bed: &TestBed) -> Spent {
    if !step.serve.is_empty() {
        ask(step, bed);
        return Spent::default();
    }
    if !step.runs() {
        return Spent::default();
    }
    let expect = &step.expect;
    let ran = command(step, bed);
    let shown = format!("{:?}: {}\n{}", ran.code, ran.stdout, ran.stderr);
    assert_eq!(ran.code, Some(step.exit.unwrap_or(0)), "{shown}");
    assert!(!ran.stderr.contains("panicked at"), "{shown}");
    let most = step.memory_mb.unwrap_or(MOST_MEMORY_MB);
    assert!(ran.spent.memory_mb < most, "{:?} {shown}", ran.spent);
    for words in &expect.says {
        assert!(shown.contains(words.as_str()), "no `{words}` in {shown}");
    }
    is_harmless(&ran.stdout, "standard output");
    is_harmless(&ran.stderr, "standard error");
    for secret in expect
        .never
        .iter()
        .map(String::as_str)
        .chain([SALT, SECRET])
    {
        assert!(!shown.contains(secret), "`{secret}` in {shown}");
    }
    for (name, bytes) in written_below(&bed.path("out")) {
        let text = String::from_utf8_lossy(&bytes);
        for secret in expect
            .never
            .iter()
            .map(String::as_str)
            .chain([SALT, SECRET])
        {
            assert!(!text.contains(secret), "`{secret}` in {name}");
        }
        let is_page = [".html", ".svg"].iter().any(|end| name.ends_with(end));
        for words in expect.never_in_pages.iter().filter(|_| is_page) {
            assert!(!text.contains(words.as_str()), "`{words}` in {name}");
        }
    }
    if expect.verdict.is_some() || expect.line.is_some() || !expect.tasks.is_empty() {
        verdicts(expect, &ran.stdout);
    }
    ran.spent
}

/// The files below a folder, without links and without what is so large that only the attacker can have made it.
fn written_below(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut written = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let (path, is) = (entry.path(), entry.file_type().expect("a type"));
        if is.is_dir() {
            written.extend(written_below(&path));
        } else if is.is_file() && entry.metadata().expect("a size").len() < LARGEST_BYTES {
            let bytes = std::fs::read(&path).expect("a file");
            written.push((path.display().to_string(), bytes));
        }
    }
    written
}

fn verdicts(expect: &Expect, record: &str) {
    let record: Value = serde_json::from_str(record).expect("a record");
    if let Some(verdict) = &expect.verdict {
        assert_eq!(record["verdict"], verdict.as_str(), "{record:#}");
    }
    let tasks = record["tasks"].as_array().expect("tasks");
    if let Some(line) = expect.line {
        let lines = tasks.iter().map(|task| &task["stopped"]["line"]);
        let stopped: Vec<&Value> = lines.filter(|line| !line.is_null()).collect();
        assert_eq!(stopped.first(), Some(&&Value::from(line)), "{record:#}");
    }
    for (name, verdict) in &expect.tasks {
        let task = tasks.iter().find(|task| task["name"] == name.as_str());
        let task = task.unwrap_or_else(|| panic!("no task `{name}` in {record:#}"));
        assert_eq!(task["verdict"], verdict.as_str(), "{name}: {task:#}");
    }
}

/// Nothing that a terminal takes for a command, and nothing that turns text around.
fn is_harmless(text: &str, of: &str) {
    let harmful = |c: &char| {
        (c.is_control() && !"\n\t".contains(*c))
            || ('\u{202a}'..='\u{202e}').contains(c)
            || ('\u{2066}'..='\u{2069}').contains(c)
            || matches!(c, '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{feff}')
    };
    if let Some(found) = text.chars().find(harmful) {
        panic!("{found:?} in {of}: {text:?}");
    }
}

fn command(step: &Step, bed: &TestBed) -> Ran {
    let (out, err) = (bed.path("stdout.txt"), bed.path("stderr.txt"));
    let file = |path: &Path| std::fs::File::create(path).expect("a file");
    let mut command = Command::new(binary());
    command
        .current_dir(bed.path(""))
        .args(step.run.iter().map(|word| filled(word)))
        .env("NO_COLOR", "1")
        .env("KINEMARK_SALT", SALT)
        .env("SOME_TOKEN", SECRET)
        .envs(&step.environment)
        .stdin(Stdio::piped())
        .stdout(file(&out))
        .stderr(file(&err));
    let mut child = command.spawn().expect("the binary runs");
    let id = child.id();
    if let Some(mut input) = child.stdin.take() {
        let text = step.stdin.as_deref().unwrap_or_default();
        // a command need not read it
        let _ = input.write_all(text.as_bytes());
    }
    let used = child.wait4().expect("it ends");
    let read = |path: &Path| {
        let bytes = std::fs::read(path).expect("what it printed");
        String::from_utf8_lossy(&bytes).into_owned()
    };
    assert_eq!(workers_of(id), 0, "workers are left");
    Ran {
        code: used.status.code(),
        stdout: read(&out),
        stderr: read(&err),
        spent: Spent {
            cpu_s: (used.rusage.utime + used.rusage.stime).as_secs_f64(),
            memory_mb: used.rusage.maxrss >> 20,
        },
    }
}

/// How many workers of a process still run; none can be seen where there is no `/proc`.
fn workers_of(parent: u32) -> usize {
    let Ok(processes) = std::fs::read_dir("/proc") else {
        return 0;
    };
    let wanted = format!("--parent={parent}\0");
    let lines = processes.flatten().filter_map(|process| {
        let line = std::fs::read(process.path().join("cmdline")).ok()?;
        Some(String::from_utf8_lossy(&line).into_owned())
    });
    lines.filter(|line| line.contains(&wanted)).count()
}
