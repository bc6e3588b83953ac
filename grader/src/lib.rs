//! Lab and submission in, graded run out. This crate uses no terminal, clock, process or file, so that its results are the same on
//! every machine.
//!
//! | module | what it holds |
//! |---|---|
//! | [`task`] | what a task asks for, its robot and its scene, and the files they come from |
//! | [`record`] | the grade and what is drawn with it, for every renderer |
//! | [`submission`] | the interface to a student's code, the hosts that open it, and the script language |
//! | [`attempt`] | a submission tried on one task, and how that ended |
//! | [`check`] | what a check finds in an attempt |
//! | [`lab`] | labs with their hidden cases and mutants; they are read, and none of their code runs |
//! | [`judge`] | from attempts to a grade |
//! | [`compare`] | two graded submissions, compared |
//! | [`audit`] | proves a lab: starter, reference solution, mutants, the course staff's code |
//!
//! A module imports only from those above it.

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod attempt;
pub mod audit;
pub mod check;
pub mod compare;
pub mod judge;
pub mod lab;
pub mod record;
pub mod submission;
pub mod task;
