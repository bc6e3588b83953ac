//! Bytes of a log: never a panic, and what can be read becomes tables.
#![no_main]

use kinemark_report::log::{tables, write_csv};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match tables(bytes) {
        Ok(found) => {
            let out = found.tables.iter().map(|_| Some(std::io::sink()));
            // what was read through once is read again, and only its size can keep it from being written
            if let Err(error) = write_csv(bytes, &found.tables, out.collect()) {
                assert!(!error.way_out().is_empty(), "{error}");
            }
        }
        Err(error) => assert!(!error.to_string().is_empty() && !error.way_out().is_empty()),
    }
});
