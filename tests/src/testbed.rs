//! Where tests run the binary: a folder of their own that goes away, and a fresh build of the same profile.

use std::io::{BufRead as _, BufReader, Read, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use kinemark_grader::judge;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::host::InProcess;
use kinemark_grader::task::files::Files;
use kinemark_sim::text::Source;

/// The checkout.
pub(crate) fn root() -> PathBuf {
    // the gate's, where it cannot be read by the user of the test
    let named = std::env::var_os("KINEMARK_CHECKOUT");
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    named.map_or_else(|| PathBuf::from(here), PathBuf::from)
}

/// A call of cargo in the checkout, and the target folder in which it builds: this test's own.
pub(crate) fn cargo() -> (Command, PathBuf) {
    // target/<folder>/deps/system-<hash>: the build of another profile lies beside this one's
    let here = std::env::current_exe().expect("this test's path");
    let target = here.ancestors().nth(3).expect("the target folder");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(root());
    // the environment that cargo sets for a test must not reach the build of another package
    for (name, _) in std::env::vars_os() {
        let name = name.to_string_lossy();
        let kept = [
            "CARGO_HOME",
            "CARGO_INCREMENTAL",
            "CARGO_NET_OFFLINE",
            "CARGO_TARGET_DIR",
        ];
        if name.starts_with("CARGO_") && !kept.contains(&name.as_ref()) {
            cargo.env_remove(name.as_ref());
        }
    }
    (cargo, target.to_owned())
}

/// Builds the binary in `profile` (as `--profile` names it) and returns its path.
pub(crate) fn build(profile: &str) -> PathBuf {
    build_of(&["--package", "kinemark"], profile)
}

/// Builds the targets `what` in `profile`, the binary among them, whose path it returns.
fn build_of(what: &[&str], profile: &str) -> PathBuf {
    let (mut cargo, target) = cargo();
    cargo.args(["build", "--quiet", "--locked"]).args(what);
    cargo.args(["--profile", profile]);
    cargo.arg("--target-dir").arg(&target);
    assert!(
        cargo.status().expect("cargo runs").success(),
        "the binary builds"
    );
    let folder = if profile == "dev" { "debug" } else { profile };
    let name = format!("kinemark{}", std::env::consts::EXE_SUFFIX);
    target.join(folder).join(name)
}

/// The binary in the profile of the tests.
pub(crate) fn binary() -> &'static Path {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(|| {
        if let Some(built) = std::env::var_os("KINEMARK_BINARY") {
            return built.into();
        }
        let here = std::env::current_exe().expect("this test's path");
        let folder = here.ancestors().nth(2).and_then(Path::file_name);
        let folder = folder.expect("the profile's folder").to_string_lossy();
        // with the tests beside it, dependencies have the features they were built with a moment ago; alone it would need
        // most of them once more
        let what = ["--workspace", "--bins", "--tests"];
        build_of(&what, if folder == "debug" { "dev" } else { &folder })
    })
}

/// What `grade` says beside its output of labs and the course staff's part that lie where it runs.
pub(crate) const OWN_LABS: &str =
    "note: using the labs in `labs` and the course staff's part in `reference`\n";

/// What a command did.
#[derive(Debug)]
pub(crate) struct CommandResult {
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    pub(crate) code: Option<i32>,
}

impl From<Output> for CommandResult {
    fn from(output: Output) -> Self {
        Self {
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
            code: output.status.code(),
        }
    }
}

/// A folder of a test's own.
pub(crate) struct TestBed {
    folder: PathBuf,
    /// What goes away, with everything in it.
    _all: tempfile::TempDir,
}

impl TestBed {
    pub(crate) fn new() -> Self {
        Self::named("")
    }

    /// One whose folder has a name; what is beside it is the test's, too.
    pub(crate) fn named(name: &str) -> Self {
        let all = tempfile::tempdir().expect("a temporary folder");
        let folder = all.path().join(name);
        std::fs::create_dir_all(&folder).expect("a folder");
        Self { folder, _all: all }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("folder");
        std::fs::write(path, bytes).expect("file");
    }

    /// A command that runs the binary in this folder, without colours and without what the environment says of Kinemark. Where a
    /// submission is graded, labs in this folder are named: found beside the submission they might have been handed in with it.
    pub(crate) fn command(&self, args: &[&str]) -> Command {
        let mut command = self.plain_command(args);
        let grades = matches!(args.first(), Some(&"grade" | &"watch"));
        if grades && !args.contains(&"--labs") && self.path("labs/robots").is_dir() {
            command.args(["--labs", "labs"]);
        }
        command
    }

    fn plain_command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(binary());
        command
            .current_dir(&self.folder)
            .args(args)
            .env("NO_COLOR", "1")
            .env_remove("KINEMARK_SALT")
            .env_remove("KINEMARK_LABS")
            .env_remove("KINEMARK_REFERENCE");
        command
    }

    pub(crate) fn run(&self, args: &[&str]) -> CommandResult {
        self.command(args).output().expect("the binary runs").into()
    }

    /// Runs the binary in `folder`, a folder of this one, with these words alone.
    pub(crate) fn run_in(&self, folder: &Path, args: &[&str]) -> CommandResult {
        let mut command = self.plain_command(args);
        let ran = command.current_dir(folder).output();
        ran.expect("the binary runs").into()
    }

    /// The course, and a submission of lab 1 that loses points in the move.
    pub(crate) fn a_little_off() -> Self {
        let bed = Self::new();
        bed.copy_labs();
        let submission = root().join("tests/submissions/01-kinematics/four-millimetres-off");
        std::fs::copy(
            submission.join("submission.rhai"),
            bed.path("submission.rhai"),
        )
        .expect("copied");
        bed
    }

    /// Copies the labs and the course staff's reference into this folder, to be changed there.
    pub(crate) fn copy_labs(&self) {
        for folder in ["labs", "reference"] {
            copy(&root().join(folder), &self.path(folder));
        }
    }

    /// Replaces `from` by `to` in a file, once.
    pub(crate) fn edit(&self, name: &str, from: &str, to: &str) {
        let path = self.path(name);
        let text = std::fs::read_to_string(&path).expect("file");
        assert!(text.contains(from), "{name} has no {from:?}");
        std::fs::write(path, text.replacen(from, to, 1)).expect("file");
    }
}

/// Far above what anything here takes: the end of a test that would hang.
const LONGEST: Duration = Duration::from_secs(300);

/// Waits until something is so.
pub(crate) fn until(mut is_so: impl FnMut() -> bool) {
    let look = Duration::from_millis(1);
    let mut waited = Duration::ZERO;
    while !is_so() {
        assert!(waited < LONGEST, "it never was so");
        std::thread::sleep(look);
        waited += look;
    }
}

/// A command that serves a report, as long as this lives.
pub(crate) struct Serving {
    child: Child,
    lines: Receiver<String>,
    /// Such as `127.0.0.1:4711`.
    pub(crate) host: String,
    /// What every address begins with: `/`, and what nobody can guess.
    pub(crate) root: String,
}

/// What a server answered.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) code: u16,
    /// The lines before the content, in lower case.
    pub(crate) head: String,
    pub(crate) body: String,
}

impl Serving {
    /// Starts a command and waits for the line with its address; returns the lines before it, too.
    pub(crate) fn start(bed: &TestBed, args: &[&str]) -> (Self, Vec<String>) {
        Self::start_with(bed, args, &[])
    }

    /// The same with these variables of the environment.
    pub(crate) fn start_with(
        bed: &TestBed,
        args: &[&str],
        environment: &[(&str, &str)],
    ) -> (Self, Vec<String>) {
        let mut command = bed.command(args);
        command.envs(environment.iter().copied());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the binary runs");
        let (sender, lines) = channel();
        let outputs: [Box<dyn Read + Send>; 2] = [
            Box::new(child.stdout.take().expect("standard output")),
            Box::new(child.stderr.take().expect("standard error")),
        ];
        for output in outputs {
            let sender = sender.clone();
            std::thread::spawn(move || {
                for line in BufReader::new(output).lines().map_while(Result::ok) {
                    if sender.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        let mut serving = Self {
            child,
            lines,
            host: String::new(),
            root: String::new(),
        };
        let mut before = Vec::new();
        loop {
            let line = serving.line();
            let address = line
                .split_once(" is open at http://")
                .or_else(|| line.split_once("\"address\":\"http://"));
            if let Some((_, address)) = address {
                let address = address.split('"').next().unwrap_or_default();
                let (host, root) = address.split_once('/').expect("a path");
                serving.host = host.to_owned();
                serving.root = format!("/{}", root.trim_end_matches('/'));
                before.extend(line.starts_with('{').then_some(line));
                return (serving, before);
            }
            before.push(line);
        }
    }

    /// The next line that it prints.
    pub(crate) fn line(&self) -> String {
        self.lines.recv_timeout(LONGEST).expect("another line")
    }

    /// The next line with `words` in it.
    pub(crate) fn line_with(&self, words: &str) -> String {
        loop {
            let line = self.line();
            if line.contains(words) {
                return line;
            }
        }
    }

    /// Waits for a line with each of these words, in any order: two outputs are read here, and what is written to both at once can come
    /// either way.
    pub(crate) fn lines_with(&self, all: &[&str]) {
        let mut wanted = all.to_vec();
        while !wanted.is_empty() {
            let line = self.line();
            wanted.retain(|words| !line.contains(words));
        }
    }

    /// Asks for a path, seen from the address that was printed.
    pub(crate) fn get(&self, path: &str) -> Answer {
        self.get_from(&self.root, path)
    }

    /// Asks for a path of another address.
    pub(crate) fn get_from(&self, root: &str, path: &str) -> Answer {
        let host = &self.host;
        self.ask(&format!("GET {root}{path} HTTP/1.1\r\nHost: {host}\r\n"))
    }

    /// Sends a request, given without its end.
    pub(crate) fn ask(&self, request: &str) -> Answer {
        let mut stream = TcpStream::connect(&self.host).expect("a connection");
        stream.set_read_timeout(Some(LONGEST)).expect("a socket");
        let request = format!("{request}Connection: close\r\n\r\n");
        stream.write_all(request.as_bytes()).expect("sent");
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("an answer");
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (head, body) = text.split_once("\r\n\r\n").expect("a head");
        let code = head.split(' ').nth(1).and_then(|code| code.parse().ok());
        Answer {
            code: code.expect("a code"),
            head: head.to_ascii_lowercase(),
            body: body.to_owned(),
        }
    }

    /// Presses Ctrl-C and returns the exit code.
    #[cfg(unix)]
    pub(crate) fn stop(mut self) -> Option<i32> {
        let id = self.child.id().to_string();
        let sent = Command::new("kill").args(["-INT", &id]).status();
        assert!(sent.expect("kill runs").success());
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        // it may have ended by itself
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Copies a folder with everything in it.
pub(crate) fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("folder");
    for entry in std::fs::read_dir(from).expect("folder") {
        let entry = entry.expect("entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).expect("copy");
        }
    }
}

/// All files below `folder`, by path relative to it, in order.
pub(crate) fn files_below(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(next) = waiting.pop() {
        for entry in std::fs::read_dir(next).expect("folder") {
            let path = entry.expect("entry").path();
            if path.is_dir() {
                waiting.push(path);
            } else {
                let name = path
                    .strip_prefix(folder)
                    .expect("below")
                    .to_string_lossy()
                    .replace('\\', "/");
                files.push((name, std::fs::read(&path).expect("file")));
            }
        }
    }
    files.sort();
    files
}

/// The names of all files below a folder that others are writing into.
pub(crate) fn names_below(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.path().is_dir() {
            names.extend(names_below(&entry.path()));
        } else {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names
}

/// A folder of the checkout as the grader reads it.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Files for Folder {
    fn name(&self) -> String {
        self.0.display().to_string()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let path = self.0.join(path);
        if !path.is_file() {
            return Ok(None);
        }
        std::fs::read(path)
            .map(Some)
            .map_err(|error| error.to_string())
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.join(folder)).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort();
        names
    }
}

/// A lab of the checkout.
pub(crate) fn lab(name: &str) -> Lab {
    Lab::load(&Folder(root().join("labs")), name).unwrap_or_else(|error| panic!("{error:?}"))
}

/// The course staff's part of a lab of the checkout, with a salt of its own if given.
pub(crate) fn staff(lab: &Lab, salt: Option<&str>) -> Staff {
    let staff = Staff::load(&Folder(root().join("reference")), lab, salt);
    staff
        .unwrap_or_else(|error| panic!("{error:?}"))
        .expect("a reference")
}

/// Grades a text in this process.
pub(crate) fn grade(lab: &Lab, staff: Option<&Staff>, name: &str, text: &str) -> GradedRun {
    judge::grade(lab, staff, &Source::new(name, text).into(), &mut InProcess)
        .expect("not interrupted")
}
