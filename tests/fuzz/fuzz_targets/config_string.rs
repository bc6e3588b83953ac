//! Configuration string and link lengths to robot. The input is the string, then the lengths, on two lines.
#![no_main]

use kinemark_fuzz::{exercise, explain};
use kinemark_sim::format::joint_string;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let (string, lengths) = text.split_once('\n').unwrap_or((text, ""));
    match joint_string::robot(string, 0.5, lengths, 2700.0) {
        Ok(robot) => exercise(&robot),
        Err(error) => explain(&error),
    }
});
