//! Makes the sentences that schemas say of kinds of checks, and the digest of the engine: the sources of simulator and grader, and the versions of what they depend on. Two builds with the
//! same digest give the same grades.

use std::collections::BTreeSet;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The package whose dependencies count: what a grade is made by.
const ROOT: &str = "kinemark-grader";

fn main() -> Result<(), Box<dyn Error>> {
    let here = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?);
    let house = here.parent().ok_or("the grader lies in a workspace")?;
    let mut hasher = blake3::Hasher::new();
    for folder in ["grader/src", "sim/src"] {
        println!("cargo::rerun-if-changed={}", house.join(folder).display());
        let mut files = Vec::new();
        sources(&house.join(folder), folder, &mut files)?;
        files.sort();
        for (name, path) in files {
            // a checkout with other line ends is the same program
            let text = std::fs::read_to_string(path)?.replace("\r\n", "\n");
            add(&mut hasher, &name);
            add(&mut hasher, &text);
        }
    }
    let lock = house.join("Cargo.lock");
    println!("cargo::rerun-if-changed={}", lock.display());
    for package in locked(&std::fs::read_to_string(lock)?)? {
        add(&mut hasher, &package);
    }
    for made in ["memory.zst", "runtime.wasm.zst", "rest.wasm.zst"] {
        let made = here.join("python").join(made);
        println!("cargo::rerun-if-changed={}", made.display());
        hasher.update(blake3::hash(&std::fs::read(made)?).as_bytes());
    }
    let digest = hasher.finalize().to_hex();
    println!("cargo::rustc-env=KINEMARK_ENGINE_DIGEST={}", &digest[..16]);
    let summaries = kind_summaries(&here.join("src/check/kind"))?;
    let out = PathBuf::from(std::env::var("OUT_DIR")?).join("kind_summaries.rs");
    Ok(std::fs::write(out, summaries)?)
}

/// A list in Rust of the names of kinds of checks, each with the first paragraph of its file's first comment: what it measures.
fn kind_summaries(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut files = Vec::new();
    sources(folder, "", &mut files)?;
    files.sort();
    let mut list = String::from("&[\n");
    for (_, path) in files {
        let text = std::fs::read_to_string(path)?;
        let lines = text.lines().map_while(|line| line.strip_prefix("//! "));
        let first = lines.collect::<Vec<&str>>().join(" ");
        // the list of kinds has a comment, too, and names none
        let Some((name, summary)) = first.split_once(": ") else {
            continue;
        };
        list += &format!("    ({name:?}, {summary:?}),\n");
    }
    list.push(']');
    Ok(list)
}

fn add(hasher: &mut blake3::Hasher, part: &str) {
    hasher.update(&(part.len() as u64).to_le_bytes());
    hasher.update(part.as_bytes());
}

/// Rust files below `folder`, each with a name that is the same on every system.
fn sources(
    folder: &Path,
    name: &str,
    files: &mut Vec<(String, PathBuf)>,
) -> Result<(), Box<dyn Error>> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{name}/{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            sources(&entry.path(), &name, files)?;
        } else if name.ends_with(".rs") {
            files.push((name, entry.path()));
        }
    }
    Ok(())
}

/// Name, version and checksum of every package that [`ROOT`] is built with, sorted. Packages that it is only tested with are among
/// them, because a lock file does not keep them apart.
fn locked(text: &str) -> Result<BTreeSet<String>, Box<dyn Error>> {
    let lock: toml::Table = text.parse()?;
    let packages = lock.get("package").and_then(toml::Value::as_array);
    let packages = packages.ok_or("a lock file has packages")?;
    let field = |package: &toml::Value, name: &str| {
        let value = package.get(name).and_then(toml::Value::as_str);
        value.unwrap_or_default().to_owned()
    };
    let mut open = vec![ROOT.to_owned()];
    let mut found = BTreeSet::new();
    while let Some(wanted) = open.pop() {
        // `name`, or `name version` where there are several
        let mut words = wanted.split(' ');
        let (name, version) = (words.next().unwrap_or_default(), words.next());
        for package in packages {
            let is_wanted = field(package, "name") == name
                && version.is_none_or(|version| field(package, "version") == version);
            if !is_wanted {
                continue;
            }
            let line = ["name", "version", "checksum"].map(|name| field(package, name));
            if found.insert(line.join(" ")) {
                let dependencies = package.get("dependencies");
                let dependencies = dependencies.and_then(toml::Value::as_array);
                let names = dependencies.into_iter().flatten();
                open.extend(names.filter_map(|name| name.as_str().map(str::to_owned)));
            }
        }
    }
    Ok(found)
}
