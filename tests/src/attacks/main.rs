//! The attack corpus: every case of `tests/attacks` gets the verdict it must get, takes little memory, prints nothing that could reach
//! beyond a terminal or a page, leaves nothing behind, and reads nothing that is not its own.
//!
//! A test of its own: what a case takes is what its processes take, and a process begins with the memory of the one that starts it.

#![cfg(unix)]

#[expect(dead_code, reason = "shared with hostile workers")]
mod case;
mod folder;
mod good_beside;
mod hidden;
mod run;
mod served;

#[expect(dead_code, reason = "shared with the tests of the whole system")]
#[path = "../course_class.rs"]
mod course_class;
#[path = "../every_case.rs"]
mod every_case;
#[expect(dead_code, reason = "shared with the tests of the whole system")]
#[path = "../testbed.rs"]
mod testbed;

use std::sync::Mutex;

use case::{Case, Kind, all_cases};
use every_case::every_case;
use run::Spent;

#[test]
fn every_attack_gets_the_verdict_it_must_get() {
    let mut cases = all_cases();
    // those of workers are run by workers: tests/src/hostile_worker
    cases.retain(|(_, case)| case.kind != Kind::Frames);
    assert!(cases.len() >= 300, "{} cases", cases.len());
    let spent: Mutex<Vec<(String, Spent)>> = Mutex::default();
    every_case(&cases, |case: &Case| {
        let one = run::run(case);
        spent.lock().expect("spent").push((case.name.clone(), one));
    });
    let mut spent = spent.into_inner().expect("spent");
    spent.sort_by(|(_, a), (_, b)| b.cpu_s.total_cmp(&a.cpu_s));
    println!("{} cases; the most CPU time:", cases.len());
    for (name, one) in spent.iter().take(10) {
        println!("{:7.2} s {:5} MB  {name}", one.cpu_s, one.memory_mb);
    }
    let most = spent.iter().max_by_key(|(_, one)| one.memory_mb);
    if let Some((name, one)) = most {
        println!("the most memory: {} MB, {name}", one.memory_mb);
    }
}
