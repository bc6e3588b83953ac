//! Which student of the roster a folder belongs to: what a source says, compared with the roster exactly, and never a guess.
//!
//! Case, composition and look-alike characters do not count ([`crate::student::folded`]); everything else does.

#[cfg(test)]
mod examples;
mod full_name;
mod matcher;
mod roster_index;

pub use matcher::{Matched, Matcher, Unmatched};
