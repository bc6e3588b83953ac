//! The pictures of briefs: those that show a run are drawn from that run, and every picture that a brief names is there.
//!
//! A brief shows a plot by its name: `plot-PLOT.svg` of the reference's run, `plot-PLOT-by-MUTANT.svg` of a mutant's run.

use std::path::PathBuf;
use std::sync::Mutex;

use kinemark_grader::lab::load::lab_names;
use kinemark_grader::record::graded::GradedRun;
use kinemark_report::plot::plots;

use crate::every_case::every_case;
use crate::golden::are_current;
use crate::testbed::{Folder, grade, lab, root, staff};

/// The pictures that `brief` links to.
fn linked(brief: &str) -> Vec<&str> {
    let targets = brief.split("](").skip(1).filter_map(|rest| {
        let (target, _) = rest.split_once(')')?;
        target.ends_with(".svg").then_some(target)
    });
    targets.collect()
}

/// The plot called `name`; panics with the names there are.
fn plot_of(run: &GradedRun, name: &str, picture: &str) -> String {
    let all: Vec<_> = run.runs.iter().flat_map(plots).collect();
    let names: Vec<&str> = all.iter().map(|plot| plot.name.as_str()).collect();
    let found = all.iter().find(|plot| plot.name == name);
    found
        .unwrap_or_else(|| panic!("{picture}: no plot `{name}` among {names:?}"))
        .svg
        .clone()
}

#[test]
fn briefs_show_the_runs_they_speak_of() {
    let labs = lab_names(&Folder(root().join("labs")));
    let cases: Vec<_> = labs.into_iter().map(|lab| (lab.clone(), lab)).collect();
    let drawn = Mutex::new(Vec::new());
    every_case(&cases, |name| {
        let drawn_of_lab = shown(name);
        drawn.lock().expect("not poisoned").extend(drawn_of_lab);
    });
    are_current(&drawn.into_inner().expect("not poisoned"));
}

/// The plots that the brief of a lab shows, by their paths, as they are drawn now.
fn shown(name: &str) -> Vec<(PathBuf, String)> {
    let folder = root().join("labs").join(name);
    let brief = std::fs::read_to_string(folder.join("brief.md")).expect("brief.md");
    let pictures = linked(&brief);
    assert!(!pictures.is_empty(), "a brief without a picture");
    let lab = lab(name);
    let staff = staff(&lab, None);
    let run_of = |file: &str, text: &str| grade(&lab, None, file, text);
    let reference = run_of("solution.rhai", staff.solution.text());
    let mut drawn = Vec::new();
    for picture in &pictures {
        let path = folder.join(picture);
        let plot = picture
            .strip_prefix("plot-")
            .and_then(|rest| rest.strip_suffix(".svg"));
        let Some(plot) = plot else {
            assert!(path.exists(), "{picture} is not there");
            continue;
        };
        let svg = match plot.split_once("-by-") {
            None => plot_of(&reference, plot, picture),
            Some((plot, mutant)) => {
                let known = staff.mutants.iter().find(|known| known.name == mutant);
                let mutant = known.unwrap_or_else(|| panic!("{picture}: no mutant `{mutant}`"));
                let run = run_of("mutant.rhai", mutant.source.text());
                plot_of(&run, plot, picture)
            }
        };
        drawn.push((path, svg));
    }
    for entry in std::fs::read_dir(&folder).expect("the lab's folder") {
        let file = entry.expect("entry").file_name();
        let file = file.to_string_lossy();
        let is_shown = !file.ends_with(".svg") || pictures.contains(&file.as_ref());
        assert!(is_shown, "the brief does not show {file}");
    }
    drawn
}
