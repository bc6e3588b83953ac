//! Which of a folder's files is the submission: found by name and by how near to the top it lies, never guessed.

use crate::hand_in_file::ENDING;

/// What a folder holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Found<'p> {
    /// One submission.
    One(&'p str),
    /// Several that are as good, in order.
    Several(Vec<&'p str>),
    /// None.
    None,
}

/// Names under which every starter is handed out.
const USUAL: [&str; 3] = ["submission.rhai", "submission.wasm", "submission.rhai.txt"];
/// How the names of programs end; the last is what mail programs and browsers make of the first.
const PROGRAMS: [&str; 3] = [".rhai", ".wasm", ".rhai.txt"];
/// Files by which a folder is a report.
const REPORT: [&str; 2] = ["grade.json", "report.json"];

/// The submission among the files of a folder, given by their paths with `/` between names.
///
/// A hand-in file comes first, then `submission.rhai` and its kin, then the only program; of each the one nearest to the top. What lies
/// in `out`, in a report, in `__MACOSX` or behind a name that begins with a dot does not count.
pub fn submission_among<'p>(paths: &[&'p str]) -> Found<'p> {
    let reports = reports(paths);
    let mut counted: Vec<&str> = paths.to_vec();
    counted.retain(|path| is_counted(path, &reports));
    counted.sort_unstable();
    let kinds: [fn(&str) -> bool; 3] = [
        |name| name.ends_with(ENDING),
        |name| USUAL.contains(&name),
        |name| PROGRAMS.iter().any(|ending| name.ends_with(ending)),
    ];
    for kind in kinds {
        let of_kind = |path: &&&str| kind(&file_name(path).to_ascii_lowercase());
        let of_kind: Vec<&str> = counted.iter().filter(of_kind).copied().collect();
        let depth = |path: &&str| path.matches('/').count();
        let Some(top) = of_kind.iter().map(depth).min() else {
            continue;
        };
        let mut nearest = of_kind;
        nearest.retain(|path| depth(path) == top);
        return match nearest.as_slice() {
            [one] => Found::One(one),
            _ => Found::Several(nearest),
        };
    }
    Found::None
}

fn file_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// The folders that are reports, each with a `/` behind it.
fn reports(paths: &[&str]) -> Vec<String> {
    let parent = |path: &str, name: &str| Some(path.strip_suffix(name)?.to_owned());
    let [record, list] = REPORT;
    let records = paths.iter().filter_map(|path| parent(path, record));
    records
        .filter(|folder| paths.contains(&format!("{folder}{list}").as_str()))
        .collect()
}

fn is_counted(path: &str, reports: &[String]) -> bool {
    let hidden = |part: &str| part.starts_with('.');
    let mut folders: Vec<&str> = path.split('/').collect();
    let Some(name) = folders.pop() else {
        return false;
    };
    let aside = |folder: &&str| hidden(folder) || matches!(*folder, "out" | "__MACOSX");
    let in_report = |folder: &String| !folder.is_empty() && path.starts_with(folder.as_str());
    !hidden(name) && !folders.iter().any(aside) && !reports.iter().any(in_report)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_name_nearest_to_the_top_is_taken() {
        for (paths, found) in [
            (&["submission.rhai", "brief.md"][..], "submission.rhai"),
            (
                &[
                    "lab1/submission.rhai",
                    "lab1/old/submission.rhai",
                    "try.rhai",
                ],
                "lab1/submission.rhai",
            ),
            (&["Submission.rhai.txt"], "Submission.rhai.txt"),
            (&["lab1.rhai", "labs/01/starter.rhai"], "lab1.rhai"),
            (
                &["lab1.rhai", "out/submission.rhai", "out/grade.json"],
                "lab1.rhai",
            ),
            (
                &[
                    "a.rhai",
                    "r/submission.rhai",
                    "r/grade.json",
                    "r/report.json",
                ],
                "a.rhai",
            ),
            (
                &["a.rhai", "__MACOSX/._a.rhai", "._a.rhai", ".git/x.rhai"],
                "a.rhai",
            ),
            (&["work/01.kinemark", "submission.rhai"], "work/01.kinemark"),
            // a report at the top is where the student worked, too
            (
                &["submission.rhai", "grade.json", "report.json"],
                "submission.rhai",
            ),
        ] {
            assert_eq!(submission_among(paths), Found::One(found), "{paths:?}");
        }
    }

    #[test]
    fn nothing_is_guessed() {
        let two = ["a/submission.rhai", "b/submission.rhai"];
        assert_eq!(submission_among(&two), Found::Several(two.to_vec()));
        let scripts = ["one.rhai", "two.rhai", "deep/three.rhai"];
        assert_eq!(
            submission_among(&scripts),
            Found::Several(vec!["one.rhai", "two.rhai"])
        );
        assert_eq!(submission_among(&["brief.md", "x.py"]), Found::None);
        assert_eq!(submission_among(&[]), Found::None);
    }
}
