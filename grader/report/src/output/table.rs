//! The table of outputs: what a report folder is made of, in the order in which it is written.

use serde::Serialize;

use super::material::{Material, OutFile, OutputError, Sources};
use super::{ReportRequest, storyboards};
use crate::html::{PageExtras, html};
use crate::visible::visible_json;

/// The grade record; a folder that has it claims to be a report.
pub const RECORD_FILE: &str = "grade.json";
/// The page for people.
pub const PAGE_FILE: &str = "report.html";
/// The copy of a submission that is a script, or that is neither.
pub const SUBMISSION_FILE: &str = "submission.rhai";
/// The copy of a submission in Python.
pub const PYTHON_FILE: &str = "submission.py";
/// The copy of a submission that is a compiled module.
pub const MODULE_FILE: &str = "submission.wasm";
/// The folder of the copies of lab, robot and scenes.
pub const LAB_FOLDER: &str = "lab";
/// The folder of the sources that were handed in beside a module.
pub const SOURCES_FOLDER: &str = "sources";
/// The folder of the plots.
pub const PLOT_FOLDER: &str = "plots";

/// One output: a row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Output {
    /// What it is called.
    pub name: &'static str,
    /// Whether a report that was requested so has it.
    pub is_requested: fn(&ReportRequest) -> bool,
    /// Makes its files. These, and no others, are ours: `report.json` lists them.
    pub files: fn(&Material<'_>) -> Result<Vec<OutFile>, OutputError>,
}

/// All outputs; `report.json`, which lists their files, is made last of all ([`super::Manifest`]).
pub const OUTPUTS: &[Output] = &[
    Output {
        // what `kinemark grade --json` prints
        name: "grade record",
        is_requested: always,
        files: |material| Ok(vec![OutFile::new(RECORD_FILE, material.record.as_bytes())]),
    },
    Output {
        // with replay and plots inside
        name: "page",
        is_requested: always,
        files: |material| {
            let sources = &material.sources;
            let is_text = sources.submission_file != MODULE_FILE;
            let extras = PageExtras {
                script: is_text.then_some(sources.submission),
                module_sources: sources.module_sources,
                label: material.request.label.as_deref(),
                all_chapters: material.request.storyboard,
                since: material.request.since.as_ref(),
            };
            let page = html(material.graded, material.plots(), &extras);
            Ok(vec![OutFile::new(PAGE_FILE, page)])
        },
    },
    Output {
        // graded again by `kinemark verify` and `kinemark compare`
        name: "submission",
        is_requested: always,
        files: |material| {
            let Sources {
                submission_file,
                submission,
                ..
            } = material.sources;
            Ok(vec![OutFile::new(submission_file, submission)])
        },
    },
    Output {
        // for a person to read: nothing is made from them
        name: "sources",
        is_requested: always,
        files: |material| {
            let sources = material.sources.module_sources.iter();
            let sources = sources.map(|(path, bytes)| {
                OutFile::new(format!("{SOURCES_FOLDER}/{path}"), bytes.as_slice())
            });
            Ok(sources.collect())
        },
    },
    Output {
        // in the shape of a folder of labs
        name: "lab",
        is_requested: always,
        files: |material| {
            let copies = material.sources.lab_files.iter();
            let copies = copies.map(|(path, bytes)| {
                OutFile::new(format!("{LAB_FOLDER}/{path}"), bytes.as_slice())
            });
            Ok(copies.collect())
        },
    },
    Output {
        name: "plots",
        is_requested: always,
        files: |material| {
            let plots = material.captioned_plots();
            let drawn = |(name, svg)| OutFile::new(format!("{PLOT_FOLDER}/{name}.svg"), svg);
            Ok(plots.map(drawn).collect())
        },
    },
    Output {
        name: "plots in pixels",
        is_requested: |request| request.png,
        files: |material| {
            let drawn = |(name, svg): (&str, String)| {
                let pixels = material.pixels_of(&svg)?;
                Ok(OutFile::pixels(format!("{PLOT_FOLDER}/{name}.png"), pixels))
            };
            material.captioned_plots().map(drawn).collect()
        },
    },
    storyboards::OUTPUT,
    #[cfg(feature = "log")]
    super::run_log::OUTPUT,
];

/// Every report has it.
pub(super) fn always(_: &ReportRequest) -> bool {
    true
}

/// All files of a report but `report.json`: a function of the material alone.
///
/// # Errors
/// [`OutputError`] where one of them cannot be made.
pub fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let mut files = Vec::new();
    for output in OUTPUTS {
        if (output.is_requested)(material.request) {
            files.extend((output.files)(material)?);
        }
    }
    Ok(files)
}

/// A value as JSON, in lines a person can read, with a line end; characters that nobody sees are escaped.
///
/// # Errors
/// [`OutputError::Json`] where the value has no JSON form.
pub fn json(value: &impl Serialize) -> Result<String, OutputError> {
    Ok(visible_json(serde_json::to_string_pretty(value)?) + "\n")
}

#[cfg(test)]
mod tests {
    use super::super::material::Pixels;
    use super::*;
    use kinemark_grader::record::sample;

    fn paths(request: &ReportRequest) -> Vec<String> {
        let graded = sample::graded();
        let lab_files = [("one/lab.toml".to_owned(), Vec::new())];
        let sources = Sources {
            submission_file: SUBMISSION_FILE,
            submission: b"",
            module_sources: &[("src/lib.rs".to_owned(), b"mod arm;".to_vec())],
            lab: "",
            robot: "",
            own_robots: &[],
            lab_files: &lab_files,
        };
        let material = Material::new(&graded, sources, request, Pixels::Undrawn).unwrap();
        let mut paths: Vec<_> = files(&material).unwrap();
        paths.sort_by(|one, other| one.path.cmp(&other.path));
        paths.into_iter().map(|file| file.path).collect()
    }

    #[test]
    fn a_report_has_what_was_requested_and_no_path_twice() {
        let plain = paths(&ReportRequest::default());
        assert!(!plain.iter().any(|path| path.ends_with(".png")));
        assert!(!plain.iter().any(|path| path.contains("storyboard")));
        let all = paths(&ReportRequest {
            png: true,
            storyboard: true,
            ..ReportRequest::default()
        });
        assert!(plain.iter().all(|path| all.contains(path)));
        let mut once = all.clone();
        once.dedup();
        assert_eq!(once, all);
        let pixels = all.iter().filter(|path| path.ends_with(".png"));
        for path in pixels {
            let drawing = path.replace(".png", ".svg");
            assert!(all.contains(&drawing), "{path} without its drawing");
        }
        for path in [
            "grade.json",
            "report.html",
            "submission.rhai",
            "sources/src/lib.rs",
            "lab/one/lab.toml",
        ] {
            assert!(plain.iter().any(|known| known == path), "no {path}");
        }
    }
}
