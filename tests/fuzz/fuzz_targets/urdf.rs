//! URDF text to robot: never a panic, and what loads can be worked with.
#![no_main]

use kinemark_fuzz::{exercise, explain};
use kinemark_sim::format::{ReadOptions, detect};
use kinemark_sim::model::unphysical::OnUnphysical;
use kinemark_sim::text::Source;
use libfuzzer_sys::fuzz_target;

/// The smallest mesh that loads: one triangle, as OBJ.
const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fuzz_target!(|text: &str| {
    let format = detect(&Source::new("fuzz.urdf", ""));
    for (ignore_mimic, on_unphysical) in [
        (false, OnUnphysical::Refuse),
        (true, OnUnphysical::Accept),
        (true, OnUnphysical::Balance),
    ] {
        let options = ReadOptions {
            ignore_mimic,
            on_unphysical,
        };
        let mut read_mesh = |file: &str| {
            (format.mesh_location)(file);
            match file.ends_with("obj") {
                true => Ok(TRIANGLE.to_vec()),
                false => Err("none here".to_owned()),
            }
        };
        match (format.read)(Source::new("fuzz.urdf", text), &options, &mut read_mesh) {
            Ok(robot) => exercise(&robot),
            Err(error) => explain(&error),
        }
    }
});
