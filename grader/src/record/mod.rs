//! A finished grade: the record, the runs it is based on, and names and numbers for people.

pub mod comparison;
pub mod difference;
pub mod explanation;
pub mod grade;
pub mod graded;
pub mod hints;
pub mod names;
pub mod quantity;
pub mod run_figures;
#[cfg(any(test, feature = "sample"))]
pub mod sample;
pub mod shown_case;
pub mod staff_fault;
pub mod sums;
pub mod verdict;
pub mod visible_part;
