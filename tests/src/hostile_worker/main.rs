//! Workers that are against the grader: this executable starts itself as a worker, sealed by the very code that seals a real one, and then
//! tries natively what no script and no module can: to get out, and to lie about what it is asked.
//!
//! What a sealed worker must not get, an unsealed process must get first, so that a refusal is the seal's. Only Linux has all layers.

#![cfg_attr(
    target_os = "linux",
    expect(
        clippy::print_stdout,
        reason = "as the usual harness, it prints what it did"
    )
)]

#[cfg(target_os = "linux")]
mod attempts;
#[cfg(target_os = "linux")]
mod breaking_out;
#[cfg(target_os = "linux")]
mod errand;
#[cfg(target_os = "linux")]
mod host_limits;
#[cfg(target_os = "linux")]
mod lying;
#[cfg(target_os = "linux")]
mod python;
#[cfg(target_os = "linux")]
mod system_call;
#[cfg(target_os = "linux")]
mod worker;

#[cfg(target_os = "linux")]
#[expect(dead_code, reason = "shared with the cases that run the program")]
#[path = "../attacks/case.rs"]
mod case;
#[cfg(target_os = "linux")]
#[path = "../every_case.rs"]
mod every_case;
#[cfg(target_os = "linux")]
#[expect(dead_code, reason = "shared with the tests of the whole system")]
#[path = "../testbed.rs"]
mod testbed;

/// Part of the grader that a worker's host asks whether Ctrl-C was pressed.
#[cfg(target_os = "linux")]
mod interrupt {
    /// Nobody presses it here.
    pub(crate) fn asked() -> bool {
        false
    }
}
#[cfg(target_os = "linux")]
#[expect(
    dead_code,
    unused_imports,
    reason = "part of the program, which uses all of it, and its unit tests run there"
)]
#[path = "../../../grader/cli/src/one_processor.rs"]
mod one_processor;

/// The tests, and the two processes that they start: a worker, and one that runs an errand.
#[cfg(target_os = "linux")]
fn main() -> std::process::ExitCode {
    use std::process::ExitCode;

    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        // as `worker::process` starts it
        ["worker", parent, ref ahead @ ..] => worker::serve_hostile(parent, ahead),
        ["errand", layer, errand] => errand::run_unsealed(layer, errand),
        _ => {
            let tests: [(&str, fn()); 9] = [
                (
                    "every_layer_has_attempts",
                    breaking_out::every_layer_has_attempts,
                ),
                (
                    "unsealed_attempts_work",
                    breaking_out::unsealed_attempts_work,
                ),
                (
                    "each_layer_refuses_by_itself",
                    breaking_out::each_layer_refuses_by_itself,
                ),
                (
                    "a_sealed_worker_cannot_get_out",
                    breaking_out::a_sealed_worker_cannot_get_out,
                ),
                (
                    "every_lie_costs_one_submission",
                    lying::every_lie_costs_one_submission,
                ),
                (
                    "the_end_of_cpu_time_is_a_limit_of_time",
                    host_limits::the_end_of_cpu_time_is_a_limit_of_time,
                ),
                (
                    "the_end_of_memory_is_a_limit_of_memory",
                    host_limits::the_end_of_memory_is_a_limit_of_memory,
                ),
                (
                    "a_worker_serves_the_next_task",
                    python::a_worker_serves_the_next_task,
                ),
                (
                    "the_largest_submission_leaves_address_space",
                    python::the_largest_submission_leaves_address_space,
                ),
            ];
            // names choose tests, as elsewhere; options are the other harness's
            let names: Vec<&String> = words.iter().filter(|word| !word.starts_with('-')).collect();
            let chosen = |test: &str| {
                names.is_empty() || names.iter().any(|name| test.contains(name.as_str()))
            };
            let mut failed = 0;
            for (name, test) in tests.into_iter().filter(|(name, _)| chosen(name)) {
                // a panic has printed its own message
                let is_ok = std::panic::catch_unwind(test).is_ok();
                println!("test {name} ... {}", if is_ok { "ok" } else { "FAILED" });
                failed += u8::from(!is_ok);
            }
            ExitCode::from(failed)
        }
    }
}

/// Other systems have no such layers.
#[cfg(not(target_os = "linux"))]
fn main() {}
