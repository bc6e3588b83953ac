//! Lab and submission in, graded run out. No terminal, no clock, no process, no file: what must not differ between machines
//! lives here.
//!
//! | module | what it holds |
//! |---|---|
//! | [`lab`] | labs, their hidden cases and known mistakes |
//! | [`controller`] | the seam to a student's code: calls, answers, stops |
//! | [`submission`] | the script host |
//! | [`grading`] | the way from lab and submission to a graded run |
//! | [`cases`], [`motion`] | a function task, a motion task |
//! | [`jacobian`] | the Jacobian that answers are held against |
//! | [`check`] | one file per check |
//! | [`climb`] | the same motion under disturbances |
//! | [`diagnose`] | known mistakes, recognised |
//! | [`divergence`] | where a run first differs from the reference solution's |
//! | [`compare`] | two graded submissions beside each other |
//! | [`audit`] | the grader of a lab, graded |
//! | [`event_words`], [`blow_up`] | events, contacts and runaways in words |
//! | [`grade`], [`verdict`] | the record every format is rendered from |
//! | [`graded`] | the record with the runs it rests on |

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod answer;
pub mod audit;
pub mod blow_up;
pub mod cases;
pub mod check;
pub mod climb;
pub mod compare;
pub mod controller;
pub mod diagnose;
pub mod divergence;
pub mod event_words;
pub mod ghost;
pub mod grade;
pub mod graded;
pub mod grading;
mod hidden_runs;
pub mod jacobian;
pub mod lab;
#[cfg(not(target_family = "wasm"))]
pub mod log;
pub mod motion;
pub mod quantity;
pub mod report;
pub mod stopped;
pub mod submission;
pub mod verdict;
