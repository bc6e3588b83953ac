//! The labs of this tree, and everything that is done with a lab before somebody is graded.

use std::path::Path;
use std::sync::OnceLock;

use kinemark_grader::audit::Audit;
use kinemark_grader::lab::brief::pictures;
use kinemark_grader::lab::copies::Copies;
use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use kinemark_report::formula::formula_problems;

use crate::{exercise, explain};

/// What students get: `labs/`.
pub fn labs() -> &'static Copies {
    static LABS: OnceLock<Copies> = OnceLock::new();
    LABS.get_or_init(|| of_folder("labs"))
}

/// What the course staff has: `reference/`.
pub fn reference() -> &'static Copies {
    static REFERENCE: OnceLock<Copies> = OnceLock::new();
    REFERENCE.get_or_init(|| of_folder("reference"))
}

/// Names of the labs.
pub fn names() -> impl Iterator<Item = String> {
    let folders = labs().list("").into_iter();
    folders.filter(|name| name.starts_with(|first: char| first.is_ascii_digit()))
}

fn of_folder(name: &str) -> Copies {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut copies = Copies::default();
    let mut open = vec![name.to_owned()];
    while let Some(folder) = open.pop() {
        let entries = std::fs::read_dir(root.join(&folder)).expect("a folder of this tree");
        for entry in entries.flatten() {
            let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                open.push(path);
            } else if path.ends_with(".toml") || path.ends_with(".md") || path.ends_with(".rhai") {
                let bytes = std::fs::read(entry.path()).expect("a file of this tree");
                copies.add(&path[name.len() + 1..], bytes);
            }
        }
    }
    copies
}

/// Looks through a lab that loaded: its robot, its brief, a student's variant of it, and its hidden cases.
pub fn study(lab: &Lab, files: &dyn Files) {
    exercise(&lab.robot);
    let brief = files.read(&format!("{}/brief.md", lab.name));
    let brief = brief.ok().flatten().unwrap_or_default();
    let formulas = formula_problems(&brief);
    let formula = formulas.first().map(ToString::to_string);
    let mut audit = Audit::new(lab);
    let shown: Vec<String> = pictures(&brief).map(str::to_owned).collect();
    audit.brief(lab, Some(&brief), formula.as_deref(), &shown);
    for task in &lab.tasks {
        assert!(task.max_points() > 0.0);
        task.needs_reference();
    }
    let variant = lab.variant_of("salt", "s1").expect("an id");
    variant.check_fits(lab).expect("a variant of this lab");
    variant.check_drawn(lab).expect("drawn from its rules");
    written_again(&variant);
    with_variant(lab, files, &variant);
    staffed(lab);
}

/// A variant as text is read as the same variant.
pub fn written_again(variant: &Variant) {
    let text = variant.text();
    let source = kinemark_sim::text::Source::new("variant.toml", text.as_str());
    let read = Variant::parse(source).expect("what was written is read");
    assert_eq!(read.text(), text);
}

/// Loads a lab with the numbers of a variant, and draws the hidden cases for them.
pub fn with_variant(lab: &Lab, files: &dyn Files, variant: &Variant) {
    match Lab::load_variant(files, &lab.name, Some(variant)) {
        Ok(lab) => staffed(&lab),
        Err(error) => {
            explain_load(&error);
            if let Some(blamed) = variant.blamed(lab, &error) {
                explain(&blamed);
            }
        }
    }
}

/// Loads the staff's part of a lab, which draws its hidden cases and runs.
fn staffed(lab: &Lab) {
    if let Err(error) = Staff::load_for_student(reference(), lab, Some("salt")) {
        explain_load(&error);
    }
}

/// Reads all that a person would see of an error.
pub fn explain_load(error: &LoadError) {
    match error {
        LoadError::UnknownLab { .. } | LoadError::Unreadable { .. } => {
            assert!(!error.to_string().is_empty());
        }
        LoadError::Lab(error) => explain(error),
        LoadError::Robot(error) => explain(error),
        LoadError::Scene(error) => explain(error),
    }
}
