//! Text of a student's variant: never a panic, and one that can be read is tried on every lab.
#![no_main]

use std::sync::OnceLock;

use kinemark_fuzz::explain;
use kinemark_fuzz::labs::{labs, names, with_variant, written_again};
use kinemark_grader::lab::{Lab, Variant};
use kinemark_sim::text::Source;
use libfuzzer_sys::fuzz_target;

fn loaded() -> &'static [Lab] {
    static LOADED: OnceLock<Vec<Lab>> = OnceLock::new();
    LOADED.get_or_init(|| {
        let all = names().map(|name| Lab::load(labs(), &name).expect("a lab of this tree"));
        all.collect()
    })
}

fuzz_target!(|text: &str| {
    let variant = match Variant::parse(Source::new("variant.toml", text)) {
        Ok(variant) => variant,
        Err(error) => return explain(&error),
    };
    written_again(&variant);
    for lab in loaded() {
        if let Err(error) = variant.check_fits(lab) {
            explain(&error);
            continue;
        }
        if let Err(error) = variant.check_drawn(lab) {
            explain(&error);
        }
        with_variant(lab, labs(), &variant);
    }
});
