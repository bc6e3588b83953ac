//! The functions of Kinemark that a module imports, as `kinemark.h` declares them; elsewhere, as in an author's own tests, stand-ins.

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "kinemark")]
unsafe extern "C" {
    /// A line of the log: `bytes` bytes of UTF-8 at `text`.
    #[link_name = "log"]
    pub(crate) fn log_bytes(text: *const u8, bytes: usize);
    /// A value of a signal in the report, with the signal's name as above.
    #[link_name = "plot"]
    pub(crate) fn plot_bytes(name: *const u8, bytes: usize, value: f64);
    /// Ends the call as a crash with these words.
    #[link_name = "fail"]
    pub(crate) fn fail_bytes(text: *const u8, bytes: usize) -> !;

    /// Writes 3 numbers; these functions read n positions at `q`.
    pub(crate) fn fk(q: *const f64, position: *mut f64);
    /// Writes 3 rows of n numbers.
    pub(crate) fn jacobian(q: *const f64, matrix: *mut f64);
    /// Writes n numbers.
    pub(crate) fn gravity(q: *const f64, effort: *mut f64);
    /// Writes n rows of n numbers.
    pub(crate) fn mass_matrix(q: *const f64, matrix: *mut f64);
}

#[cfg(not(target_arch = "wasm32"))]
pub(crate) use elsewhere::*;

/// Where no Kinemark is: lines go to the standard output, and there is no robot's model.
#[cfg(not(target_arch = "wasm32"))]
mod elsewhere {
    #[expect(clippy::print_stdout, reason = "the log of an author's own test")]
    pub(crate) unsafe fn log_bytes(text: *const u8, bytes: usize) {
        // SAFETY: the caller gives the address and the length of a text
        let text = unsafe { core::slice::from_raw_parts(text, bytes) };
        std::println!("{}", std::string::String::from_utf8_lossy(text));
    }

    pub(crate) unsafe fn plot_bytes(_: *const u8, _: usize, _: f64) {}

    pub(crate) unsafe fn fk(_: *const f64, _: *mut f64) {
        panic!("Kinemark alone has the robot's model");
    }
    pub(crate) use {fk as gravity, fk as jacobian, fk as mass_matrix};
}

/// Ends the call as a crash with these words.
#[cfg(target_arch = "wasm32")]
#[cfg_attr(not(any(feature = "std", feature = "panic-handler")), allow(dead_code))]
pub(crate) fn fail(words: &str) -> ! {
    // SAFETY: the address and the length of a text
    unsafe { fail_bytes(words.as_ptr(), words.len()) }
}
