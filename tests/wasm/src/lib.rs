//! The grader as a WebAssembly module: a host hands files in byte by byte and takes a record or a digest out.
//!
//! No memory is shared with the host, so that nothing here is unsafe; nothing is asked of it either, neither clock nor file.
//! `tests/wasm/run.mjs` is such a host.

#![cfg_attr(
    target_family = "wasm",
    expect(unsafe_code, reason = "a name for a host is an unsafe attribute")
)]

#[path = "../../../sim/tests/contact_run.rs"]
mod contact_run;
#[path = "../../../sim/tests/contact_scenes.rs"]
mod contact_scenes;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use kinemark_grader::judge;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::submission::handed_in::Submission;
use kinemark_grader::submission::host::InProcess;
use kinemark_grader::task::files::Files;
use kinemark_sim::format::RobotFile;
use kinemark_sim::text::Source;

/// Digest of the run with contact, as committed.
pub const CONTACT_DIGEST: &str = contact_run::DIGEST;

/// Digest of the run with contact of the course's arm, `robot_toml`, as hexadecimal text.
///
/// # Errors
/// What is wrong with the robot.
pub fn contact_digest(robot_toml: &str) -> Result<String, String> {
    let source = Source::new("rrbot.toml", robot_toml);
    let file = RobotFile::parse(source).map_err(|error| error.to_string())?;
    let robot = file.build(&[]).map_err(|error| error.to_string())?;
    Ok(contact_run::digest(&robot, |_| {}))
}

/// A script that is handed in.
const SCRIPT: &str = "submission.rhai";
/// A module that is handed in.
const MODULE: &str = "submission.wasm";

/// Files by path, of which `labs/`, `reference/` and the submission count.
type Handed = BTreeMap<String, Vec<u8>>;

/// Grades what was handed in; returns the record as `kinemark grade --json` prints it.
fn record(files: &Handed, lab: &str) -> Result<String, String> {
    let folder = |top| Folder { files, top };
    let lab = Lab::load(&folder("labs"), lab).map_err(|error| error.to_string())?;
    let staff = Staff::load(&folder("reference"), &lab, None).map_err(|error| error.to_string())?;
    let submission = match files.get(MODULE) {
        Some(module) => Submission::module(MODULE, module),
        None => Source::new(SCRIPT, text(files, SCRIPT)?).into(),
    };
    let graded = judge::grade(&lab, staff.as_ref(), &submission, &mut InProcess)
        .map_err(|error| error.to_string())?;
    let json = serde_json::to_string_pretty(&graded.grade).map_err(|error| error.to_string())?;
    Ok(json + "\n")
}

fn text<'f>(files: &'f Handed, path: &str) -> Result<&'f str, String> {
    let bytes = files
        .get(path)
        .ok_or_else(|| format!("no file `{path}` was handed in"))?;
    std::str::from_utf8(bytes).map_err(|error| format!("`{path}`: {error}"))
}

/// What lies below one folder.
struct Folder<'f> {
    files: &'f Handed,
    top: &'static str,
}

impl Files for Folder<'_> {
    fn name(&self) -> String {
        self.top.to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(self.files.get(&format!("{}/{path}", self.top)).cloned())
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let mut prefix = format!("{}/", self.top);
        if !folder.is_empty() {
            prefix = format!("{prefix}{folder}/");
        }
        let inside =
            |path: &String| Some(path.strip_prefix(&prefix)?.split('/').next()?.to_owned());
        let names: BTreeSet<String> = self.files.keys().filter_map(inside).collect();
        names.into_iter().collect()
    }
}

#[derive(Default)]
struct Exchange {
    /// What is being handed in.
    item: Vec<u8>,
    /// The path of the file that comes next.
    path: String,
    files: Handed,
    /// What is being taken out.
    result: std::vec::IntoIter<u8>,
}

impl Exchange {
    fn item_text(&mut self) -> String {
        String::from_utf8_lossy(&std::mem::take(&mut self.item)).into_owned()
    }

    /// Keeps a result or the reason why there is none; returns whether there is one.
    fn finish(&mut self, result: Result<String, String>) -> bool {
        let is_ok = result.is_ok();
        self.result = result.unwrap_or_else(|why| why).into_bytes().into_iter();
        is_ok
    }
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> = RefCell::default();
}

/// Hands in the next byte of a path, of a file or of a lab's name.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn put(byte: u8) {
    EXCHANGE.with_borrow_mut(|exchange| exchange.item.push(byte));
}

/// What was put is the path of the file that comes next.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn end_path() {
    EXCHANGE.with_borrow_mut(|exchange| exchange.path = exchange.item_text());
}

/// What was put is the content of the file whose path came before.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn end_file() {
    EXCHANGE.with_borrow_mut(|exchange| {
        let path = std::mem::take(&mut exchange.path);
        let bytes = std::mem::take(&mut exchange.item);
        exchange.files.insert(path, bytes);
    });
}

/// Grades the submission in the lab whose name was put; whether there is a grade. It, or the reason, is then there to take.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn grade() -> bool {
    EXCHANGE.with_borrow_mut(|exchange| {
        let lab = exchange.item_text();
        let result = record(&exchange.files, &lab);
        exchange.finish(result)
    })
}

/// Runs the arm of `labs/robots/rrbot.toml` into contact; whether there is a digest. It, or the reason, is then there to take.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn contact() -> bool {
    EXCHANGE.with_borrow_mut(|exchange| {
        let robot = text(&exchange.files, "labs/robots/rrbot.toml");
        let result = robot.and_then(contact_digest);
        exchange.finish(result)
    })
}

/// The next byte of the result; -1 at its end.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn take() -> i32 {
    EXCHANGE.with_borrow_mut(|exchange| exchange.result.next().map_or(-1, i32::from))
}
