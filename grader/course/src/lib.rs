//! A class graded: who handed in what, the book of grades, and what goes back to the learning management system (LMS).
//!
//! | module | what it holds |
//! |---|---|
//! | [`course_text`] | the files that people write, read with their places |
//! | [`student`] | ids of students, and when two are alike |
//! | [`roster`] | `roster.csv`: who takes the course |
//! | [`course_file`] | `course.toml`: which labs, by which rules |
//! | [`fixes`] | `fixes.toml`: what people decided |
//! | [`tree`] | what an LMS exported, as a tree of files |
//! | `submission_name` | what the name of a file says: a script, a hand-in file, an archive, a copy |
//! | [`device_name`] | names that Windows takes for devices |
//! | [`language`] | the languages of submissions: starters, sources, how they are built |
//! | [`plugin_project`] | what a project in C or Rust has beside its source |
//! | [`module_sources`] | the sources beside a module: which are kept, and under which names |
//! | [`layout`] | how the files of a class are arranged: whose folder is which |
//! | [`selection`] | which of a person's files is the submission |
//! | [`matching`] | which student of the roster a folder belongs to |
//! | [`durable`] | writing that a loss of power does not undo |
//! | [`private_files`] | files that their owner alone can read |
//! | [`journal`] | what happened: hand-ins and grades, one line each |
//! | [`history`] | the journal read: attempts and their grades |
//! | [`standing`] | how each student stands in each lab |
//! | [`book`] | the folder that is written: records, submissions, labs, the journal |
//! | [`index`] | `course.sqlite`: the book as tables |
//! | [`standing_rows`] | how everybody stands, as the index has it |
//! | [`release`] | what goes back: grades and feedback in the forms that LMSs and programs read |
//! | [`fixed_zip`] | archives whose bytes follow from their files alone |
//! | `sources_archive` | the sources of a module as one file |
//! | [`hand_in_file`] | the one file that a student uploads |
//! | [`submission_file`] | the submission among a person's files, with what says whose it is |
//! | [`question`] | what waits for a person |
//! | [`reports`] | pages of graded hand-ins |
//! | [`class_pages`] | where the pages of the class are |
//! | [`forget`] | removing a person from a book |
//! | [`intake`] | from what the LMS exported to hand-ins |
//! | [`public`] | what anybody can read in Kinemark's own repository |
//! | [`staffed_lab`] | a lab with its staff part, ready for every student |
//! | [`submission_source`] | a submission's bytes as what is graded |
//! | [`grading`] | one hand-in to its record |
//! | [`handed_out`] | the note of which lab and engine the course uses |
//! | `plugin_starter` | a starter in a compiled language where a lab has none |
//! | [`working_folder`] | what a student begins a lab with |
//! | [`gradescope_results`] | a grade as Gradescope's autograder reports it |
//! | [`pack`] | archives to hand out: for students, for course staff, for Gradescope |
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
pub mod class_pages;
pub mod clusters;
pub mod course_file;
pub mod course_text;
pub mod device_name;
pub mod durable;
mod editor_files;
pub mod fixed_zip;
pub mod fixes;
pub mod forget;
#[cfg(test)]
mod generated_class;
pub mod gradescope_results;
pub mod grading;
pub mod hand_in_file;
pub mod handed_out;
pub mod history;
pub mod index;
pub mod intake;
pub mod journal;
mod lab_rows;
pub mod language;
pub mod layout;
#[cfg(test)]
mod made_up_class;
pub mod matching;
pub mod module_sources;
pub mod pack;
pub mod page;
pub mod plugin_project;
mod plugin_starter;
pub mod private_files;
pub mod public;
pub mod question;
pub mod release;
pub mod reports;
pub mod roster;
pub mod selection;
pub mod similarity;
mod sources_archive;
pub mod staffed_lab;
pub mod standing;
pub mod standing_rows;
pub mod statistics;
pub mod student;
pub mod submission_file;
mod submission_name;
pub mod submission_source;
pub mod tree;
pub mod working_folder;
