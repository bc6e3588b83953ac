//! What a grade is made of once it is made: the record, the runs it rests on, their names and numbers for people.

pub mod comparison;
pub mod grade;
pub mod graded;
pub mod names;
pub mod quantity;
#[cfg(any(test, feature = "sample"))]
pub mod sample;
pub mod staff_fault;
pub mod verdict;
