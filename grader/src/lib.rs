//! Lab and submission in, graded run out. No terminal, no clock, no process, no file: what must not differ between machines
//! lives here.
//!
//! | module | what it holds |
//! |---|---|
//! | [`task`] | what a task asks for, its robot and its scene, and the files they come from |
//! | [`record`] | the grade and what is drawn with it, for every renderer |
//! | [`submission`] | the seam to a student's code, who opens it, and the script language |
//! | [`attempt`] | a submission tried on one task, and how that ended |
//! | [`check`] | what a check finds in an attempt |
//! | [`lab`] | labs, their hidden cases and known mistakes: read, and none of their code run |
//! | [`judge`] | from attempts to a grade |
//! | [`compare`] | two graded submissions, compared |
//! | [`audit`] | the grader of a lab, graded |
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
