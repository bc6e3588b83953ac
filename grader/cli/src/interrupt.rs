//! Ctrl-C: remembered, and looked at wherever the submission is asked something. Pressed twice it ends the process at once.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::failure::INTERRUPTED;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Starts to listen. Without it Ctrl-C ends the process at once, which is as good: files are renamed into place whole.
pub(crate) fn listen() {
    listen_and(|| {});
}

/// Whether Ctrl-C was pressed.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Starts to listen, and calls `also` the first time.
pub(crate) fn listen_and(mut also: impl FnMut() + Send + 'static) {
    // a second handler, or a system without signals, leaves the default
    let _ = ctrlc::set_handler(move || {
        if ASKED.swap(true, Ordering::Relaxed) {
            at_once();
        }
        also();
    });
}

#[expect(
    clippy::disallowed_methods,
    reason = "whoever presses Ctrl-C twice waits for something that does not end; workers end with their pipes"
)]
fn at_once() -> ! {
    std::process::exit(INTERRUPTED.into())
}
