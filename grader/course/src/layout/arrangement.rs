//! A source with the layout that fits it best, and a row for every file that no layout can place.

use super::{Confidence, LAYOUTS, Layout, PersonFiles, PersonProblem};
use crate::tree::Tree;

/// A source whose layout is known.
#[derive(Debug)]
pub struct Arrangement {
    /// The layout.
    pub layout: &'static Layout,
    /// Why it is this one, in words.
    pub reason: String,
    /// The people, by label.
    pub people: Vec<PersonFiles>,
}

/// Names that lead elsewhere are listed one by one up to here.
const MOST_MISNAMED: usize = 50;

/// The layout of a source and its people.
pub fn arrange(tree: &Tree) -> Arrangement {
    let mut best = (&LAYOUTS[LAYOUTS.len() - 1], Confidence::No);
    for layout in LAYOUTS {
        let confidence = (layout.recognise)(tree);
        if rank(&confidence) > rank(&best.1) {
            best = (layout, confidence);
        }
    }
    let (layout, confidence) = best;
    arranged(tree, layout, reason(confidence))
}

/// The people of a source whose layout a person named.
pub fn arrange_as(tree: &Tree, name: &str) -> Option<Arrangement> {
    let layout = LAYOUTS.iter().find(|layout| layout.name == name)?;
    Some(arranged(tree, layout, "it was given".to_owned()))
}

fn arranged(tree: &Tree, layout: &'static Layout, reason: String) -> Arrangement {
    let mut people = (layout.people)(tree);
    people.extend(misnamed(tree));
    people.sort_by(|one, other| one.label.cmp(&other.label));
    Arrangement {
        layout,
        reason,
        people,
    }
}

/// Which of two confidences is greater, whatever their words are.
fn rank(confidence: &Confidence) -> u8 {
    match confidence {
        Confidence::No => 0,
        Confidence::Anything(_) => 1,
        Confidence::Likely(_) => 2,
        Confidence::Certain(_) => 3,
    }
}

fn reason(confidence: Confidence) -> String {
    match confidence {
        Confidence::No => String::new(),
        Confidence::Anything(why) | Confidence::Likely(why) | Confidence::Certain(why) => why,
    }
}

/// Files that are in nobody's folder because of their names: a row each, so that none is lost in silence.
fn misnamed(tree: &Tree) -> Vec<PersonFiles> {
    let row = |label: String, what: String, help: &str| PersonFiles {
        label,
        problems: vec![PersonProblem {
            what,
            help: help.to_owned(),
        }],
        ..PersonFiles::default()
    };
    let all = tree.misnamed();
    let mut rows: Vec<PersonFiles> = Vec::new();
    for (i, entry) in all.iter().take(MOST_MISNAMED).enumerate() {
        let shown = kinemark_report::visible::visible(&entry.original).into_owned();
        let label = match rows.iter().any(|row| row.label == shown) {
            true => format!("{shown} (no. {})", i + 1),
            false => shown,
        };
        rows.push(row(label, entry.problem.to_string(), entry.problem.help()));
    }
    if all.len() > MOST_MISNAMED {
        let more = all.len() - MOST_MISNAMED;
        rows.push(row(
            "(other names)".to_owned(),
            format!("{more} more files have names that lead elsewhere or cannot be shown"),
            "ask who made this archive, and how",
        ));
    }
    rows
}
