//! How the files of a class are arranged: whose folder is which, and what its name says.
//!
//! A layout is one file of this folder and one line of [`LAYOUTS`].

mod arrangement;
mod canvas;
#[cfg(test)]
mod examples;
mod flat;
mod gradescope;
mod level;
mod moodle;
mod person_files;
mod repositories;

pub use arrangement::{Arrangement, arrange, arrange_as};
pub use person_files::{Hint, PersonFile, PersonFiles, PersonProblem};

use crate::tree::Tree;

/// How surely a source has a layout, and why, in words.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Confidence {
    /// Nothing speaks for it.
    No,
    /// It takes any source.
    Anything(String),
    /// Most of the names are of its form.
    Likely(String),
    /// Only this layout has such names.
    Certain(String),
}

/// A way to arrange the files of a class.
#[derive(Debug)]
pub struct Layout {
    /// What people call it.
    pub name: &'static str,
    /// How surely a source has it.
    pub recognise: fn(&Tree) -> Confidence,
    /// The people in a source that has it.
    pub people: fn(&Tree) -> Vec<PersonFiles>,
}

/// All layouts; where two are equally sure, the first is taken.
pub const LAYOUTS: &[Layout] = &[
    gradescope::LAYOUT,
    moodle::LAYOUT,
    canvas::LAYOUT,
    repositories::LAYOUT,
    flat::LAYOUT,
];

/// `3 of 4 folders`, and `1 folder` where it is all.
fn count_of(found: usize, all: usize, what: &str) -> String {
    let plural = if all == 1 { "" } else { "s" };
    match found == all {
        true => format!("{all} {what}{plural}"),
        false => format!("{found} of {all} {what}{plural}"),
    }
}
