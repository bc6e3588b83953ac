//! A class graded: who handed in what, the book of grades, and what goes back to the learning management system (LMS).
//!
//! | module | what it holds |
//! |---|---|
//! | [`course_text`] | the files that people write, read with their places |
//! | [`student`] | ids of students, and when two are alike |
//! | [`roster`] | `roster.csv`: who takes the course |
//! | [`course_file`] | `course.toml`: which labs, by which rules |
//! | [`fixes`] | `fixes.toml`: what people decided |
//! | `private_files` | files that their owner alone can read |
//! | [`journal`] | what happened: hand-ins and grades, one line each |
//! | [`history`] | the journal read: attempts and their grades |
//! | [`standing`] | how each student stands in each lab |
//! | [`book`] | the folder that is written: records, submissions, labs, the journal |
//! | [`index`] | `course.sqlite`: the book as tables |
//! | [`question`] | what waits for a person |
//! | [`reports`] | pages of graded hand-ins |
//! | [`forget`] | removing a person from a book |
//! | [`intake`] | from what the LMS exported to hand-ins |
//! | [`public`] | what anybody can read in Kinemark's own repository |
//! | [`staffed_lab`] | a lab with its staff part, ready for every student |
//! | [`grading`] | one hand-in to its record |
//! | `lab_rows` | the records of a lab as the index has them |
//! | [`statistics`] | the numbers of a class in a lab |
//! | [`clusters`] | equal wrong answers without a name |
//! | [`similarity`] | what is worth a conversation |
//! | [`page`] | the class as a page, and the page for course staff |
//!
//! A module imports only from those above it. This crate reads no clock and starts no process; it reads and writes files.

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod book;
pub mod clusters;
pub mod course_file;
pub mod course_text;
pub mod fixes;
pub mod forget;
pub mod grading;
pub mod history;
pub mod index;
pub mod intake;
pub mod journal;
mod lab_rows;
#[cfg(test)]
mod made_up_class;
pub mod page;
mod private_files;
pub mod public;
pub mod question;
pub mod reports;
pub mod roster;
pub mod similarity;
pub mod staffed_lab;
pub mod standing;
pub mod statistics;
pub mod student;
