//! Output in the report: lines of the log, and values of signals.

use core::fmt;

use crate::host;
use crate::text::Text;

/// Writes a line to the log of the run. [`log!`](macro@crate::log) formats one.
pub fn log(line: &str) {
    // SAFETY: the address and the length of a text
    unsafe { host::log_bytes(line.as_ptr(), line.len()) }
}

/// Adds a value to the signal `name` in the report; its time is that of the call.
pub fn plot(name: &str, value: f64) {
    // SAFETY: the address and the length of a text
    unsafe { host::plot_bytes(name.as_ptr(), name.len(), value) }
}

/// Writes a line to the log of the run, formatted as `println!` does; it is cut after 1,000 bytes.
///
/// ```
/// let q = [0.5, -0.25];
/// kinemark_plugin::log!("shoulder {:.3}, elbow {:.3}", q[0], q[1]);
/// ```
///
/// Formatting costs a few thousand instructions a line, and some kilobytes of module.
#[macro_export]
macro_rules! log {
    ($($arguments:tt)*) => {
        $crate::private::log_arguments(::core::format_args!($($arguments)*))
    };
}

/// The function behind [`log!`](macro@crate::log).
pub fn log_arguments(arguments: fmt::Arguments<'_>) {
    match arguments.as_str() {
        Some(line) => log(line),
        None => {
            let mut line = Text::new();
            // what does not fit is cut
            let _ = fmt::write(&mut line, arguments);
            log(line.as_str());
        }
    }
}
