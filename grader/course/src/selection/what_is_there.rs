//! What a person handed in in place of a submission, in words.

use super::outcome::shown;
use super::search::Node;
use crate::submission_name::NameKind;

/// So many files are named; the others are counted.
const MOST_NAMED: usize = 4;

/// What files with these endings are, where their bytes do not say it.
const ENDINGS: &[(&str, &str)] = &[
    (".m", "a MATLAB script"),
    (".mlx", "a MATLAB live script"),
    (".slx", "a Simulink model"),
    (".py", "a Python script"),
    (".ipynb", "a Jupyter notebook"),
    (".rs", "Rust source"),
    (".c", "C source"),
    (".cpp", "C++ source"),
    (".html", "a web page"),
    (".md", "text"),
    (".txt", "text"),
    (".kinemark", "no hand-in file of this lab"),
];

/// The files in words; `kind` says what a file is by its bytes.
pub(super) fn in_words<'k>(nodes: &[Node], kind: impl Fn(&Node) -> Option<&'k str>) -> String {
    let (reported, own): (Vec<&Node>, Vec<&Node>) = nodes.iter().partition(|node| node.in_report);
    // an archive that was opened is seen by what is in it
    let own: Vec<&Node> = own
        .into_iter()
        .filter(|node| node.kind != NameKind::Archive)
        .collect();
    let mut words: Vec<String> = own
        .iter()
        .take(MOST_NAMED)
        .map(|node| named(node, kind(node)))
        .collect();
    if own.len() > MOST_NAMED {
        words.push(counted(own.len() - MOST_NAMED, "more file"));
    }
    if !reported.is_empty() {
        words.push(format!(
            "{} of a report, which has a grade and not the work",
            counted(reported.len(), "file")
        ));
    }
    match words.as_slice() {
        [] => "no file".to_owned(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}

fn named(node: &Node, kind: Option<&str>) -> String {
    let path = shown(&node.shown);
    if let Some(problem) = &node.problem {
        return format!("{path} ({problem})");
    }
    if node.kind == NameKind::Starter {
        return format!("{path} (a starter)");
    }
    let lower = node.shown.to_lowercase();
    let by_ending = || {
        let known = ENDINGS.iter().find(|(ending, _)| lower.ends_with(ending));
        known.map(|(_, words)| *words)
    };
    match kind.or_else(by_ending) {
        Some(kind) => format!("{path} ({kind})"),
        None => path,
    }
}
