//! Robot file to robot: expressions, DH tables, loops and all.
#![no_main]

use kinemark_fuzz::{exercise, explain};
use kinemark_sim::format::RobotFile;
use kinemark_sim::text::Source;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let file = match RobotFile::parse(Source::new("fuzz.toml", text)) {
        Ok(file) => file,
        Err(error) => return explain(&error),
    };
    match file.build(&[]) {
        Ok(robot) => exercise(&robot),
        Err(error) => explain(&error),
    }
});
