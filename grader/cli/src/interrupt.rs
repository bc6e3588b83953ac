//! Ctrl-C: remembered, and looked at wherever the submission is asked something.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Starts to listen. Without it Ctrl-C ends the process at once, which is as good: files are renamed into place whole.
pub(crate) fn listen() {
    // a second handler, or a system without signals, leaves the default
    let _ = ctrlc::set_handler(|| ASKED.store(true, Ordering::Relaxed));
}

/// Whether Ctrl-C was pressed.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Starts to listen, and tells `also` each time.
pub(crate) fn listen_and(mut also: impl FnMut() + Send + 'static) {
    let _ = ctrlc::set_handler(move || {
        ASKED.store(true, Ordering::Relaxed);
        also();
    });
}
