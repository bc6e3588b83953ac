//! The folder that a case runs in: its files, modules made of WebAssembly text, and what its steps make.

use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::process::Command;

use crate::case::{Case, Step, of_hex};
use crate::testbed::{TestBed, root};

/// Words of a case with the places that only the machine knows.
pub(crate) fn filled(text: &str) -> String {
    text.replace("{root}", &root().display().to_string())
}

/// Copies the files of a case; `NAME.wat` becomes `NAME.wasm`.
pub(crate) fn lay_out(case: &Case, bed: &TestBed) {
    lay_out_folder(&case.folder, &case.folder, bed);
}

fn lay_out_folder(folder: &Path, base: &Path, bed: &TestBed) {
    for entry in std::fs::read_dir(folder).expect("the case") {
        let path = entry.expect("an entry").path();
        let name = path.strip_prefix(base).expect("below");
        let name = name.to_str().expect("UTF-8").to_owned();
        if path.is_dir() {
            lay_out_folder(&path, base, bed);
        } else if let Some(stem) = name.strip_suffix(".wat") {
            let bytes = wat::parse_file(&path).unwrap_or_else(|error| panic!("{error}"));
            bed.write(&format!("{stem}.wasm"), bytes);
        } else if name != "case.toml" {
            bed.write(&name, std::fs::read(&path).expect("a file"));
        }
    }
}

/// Makes what a step makes.
pub(crate) fn make(step: &Step, bed: &TestBed) {
    let to = || bed.path(step.to.as_deref().expect("`to`"));
    if let Some(name) = &step.file {
        bed.write(name, "");
        append(&bed.path(name), step);
    }
    if let Some(name) = &step.append {
        append(&bed.path(name), step);
    }
    if let Some(name) = &step.pipe {
        let made = Command::new("mkfifo").arg(bed.path(name)).status();
        assert!(made.expect("mkfifo runs").success());
    }
    if let Some(name) = &step.link {
        let to = filled(step.to.as_deref().expect("`to`"));
        std::os::unix::fs::symlink(to, parent_made(&bed.path(name))).expect("a link");
    }
    if let Some(name) = &step.hard_link {
        std::fs::hard_link(to(), parent_made(&bed.path(name))).expect("a hard link");
    }
    if let Some(name) = &step.delete {
        let path = bed.path(name);
        let deleted = match path.is_dir() {
            true => std::fs::remove_dir_all(path),
            false => std::fs::remove_file(path),
        };
        deleted.unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    if let Some(name) = &step.edit {
        let (from, to) = (step.from.as_deref(), step.to.as_deref());
        let (from, to) = (from.expect("`from`"), to.expect("`to`"));
        let text = std::fs::read_to_string(bed.path(name)).expect("a text");
        assert!(text.contains(from), "`{name}` has no `{from}`");
        std::fs::write(bed.path(name), text.replace(from, to)).expect("written");
    }
    if let Some(name) = &step.zip {
        let file = std::fs::File::create(bed.path(name)).expect("an archive");
        let mut archive = zip::ZipWriter::new(file);
        for (name, text) in &step.entries {
            let options = zip::write::SimpleFileOptions::default();
            archive.start_file(name, options).expect("an entry");
            archive.write_all(text.as_bytes()).expect("an entry");
        }
        archive.finish().expect("an archive");
    }
}

fn parent_made(path: &Path) -> &Path {
    std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    path
}

/// Writes what a step says to the end of a file, little by little: what this process takes, its children begin with.
fn append(path: &Path, step: &Step) {
    let file = std::fs::OpenOptions::new().append(true).open(path);
    let mut file = BufWriter::new(file.expect("a file"));
    let mut write = |bytes: &[u8], times: usize| {
        for _ in 0..times {
            file.write_all(bytes).expect("written");
        }
    };
    if let Some(from) = &step.copy {
        let bytes = std::fs::read(root().join(from));
        write(&bytes.unwrap_or_else(|e| panic!("{from}: {e}")), 1);
    }
    let text = |text: &Option<String>| text.clone().unwrap_or_default().into_bytes();
    write(&text(&step.text), 1);
    write(&of_hex(&step.hex), 1);
    write(&of_hex(&step.repeat_hex), step.times);
    write(&text(&step.repeat), step.times);
    write(&text(&step.after), 1);
    file.flush().expect("written");
}
