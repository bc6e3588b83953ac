//! Text of a scene file: never a panic, and what loads can be looked at.
#![no_main]

use kinemark_sim::engine::{Layout, WorkBudget};
use kinemark_sim::format::SceneFile;
use kinemark_sim::text::Source;
use libfuzzer_sys::fuzz_target;

/// Pairs of shapes that are looked at.
const WORK: u64 = 1_000_000;

fuzz_target!(|text: &str| {
    let Ok(file) = SceneFile::parse(Source::new("fuzz.toml", text)) else {
        return;
    };
    if let Ok(scene) = file.build(&[])
        && let Ok(layout) = Layout::new(&scene, None)
    {
        layout.among_bodies(0.0, &mut WorkBudget::new(WORK));
    }
});
