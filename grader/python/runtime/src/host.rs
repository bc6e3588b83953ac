//! What the grader gives the module: a log, signals, and the granted functions of the robot's model.

use std::cell::{Cell, RefCell};

thread_local! {
    static PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
    static TEXT_SIZE: Cell<usize> = const { Cell::new(4_000) };
}

#[link(wasm_import_module = "kinemark_python")]
unsafe extern "C" {
    #[link_name = "log"]
    fn host_log(at: *const u8, bytes: u32, line: u32);
    #[link_name = "rest"]
    fn host_rest();
}

/// Keeps the import that brings the rest of the module, which only the functions that `image/src/split.rs` writes call.
#[unsafe(no_mangle)]
pub extern "C" fn km_rest() {
    // SAFETY: the host reads nothing
    unsafe { host_rest() }
}

#[link(wasm_import_module = "kinemark")]
unsafe extern "C" {
    #[link_name = "plot"]
    fn host_plot(at: *const u8, bytes: u32, value: f64);
    #[link_name = "fk"]
    fn host_fk(q: *const f64, out: *mut f64);
    #[link_name = "jacobian"]
    fn host_jacobian(q: *const f64, out: *mut f64);
    #[link_name = "gravity"]
    fn host_gravity(q: *const f64, out: *mut f64);
    #[link_name = "mass_matrix"]
    fn host_mass_matrix(q: *const f64, out: *mut f64);
}

/// Sets the longest text that is printed, in bytes.
pub(crate) fn set_text_size(bytes: u32) {
    TEXT_SIZE.set(bytes as usize);
}

/// Adds a line to the log, cut where it is too long, with the line of the submission that prints it; 0 if that is not known.
pub(crate) fn log(line: &str, printed_in: u32) {
    let most = TEXT_SIZE.get();
    let cut;
    let line = if line.len() > most {
        let mut end = most.saturating_sub(3);
        while !line.is_char_boundary(end) {
            end -= 1;
        }
        cut = format!("{}…", &line[..end]);
        &cut
    } else {
        line
    };
    // SAFETY: the host reads so many bytes of this text
    unsafe { host_log(line.as_ptr(), line.len() as u32, printed_in) }
}

/// Adds a value to a signal.
pub(crate) fn plot(name: &str, value: f64) {
    // SAFETY: the host reads so many bytes of this text
    unsafe { host_plot(name.as_ptr(), name.len() as u32, value) }
}

/// A function of the robot's model.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Granted {
    /// Position of the TCP.
    Fk,
    /// Its derivative.
    Jacobian,
    /// Efforts against gravity.
    Gravity,
    /// The joint-space inertia.
    MassMatrix,
}

impl Granted {
    /// Its name on `robot`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Fk => "fk",
            Self::Jacobian => "jacobian",
            Self::Gravity => "gravity",
            Self::MassMatrix => "mass_matrix",
        }
    }

    /// All of them.
    pub(crate) const ALL: [Self; 4] = [Self::Fk, Self::Jacobian, Self::Gravity, Self::MassMatrix];

    /// Its rows for `n` joints; none for a vector.
    pub(crate) fn rows(self, n: usize) -> Option<usize> {
        match self {
            Self::Fk | Self::Gravity => None,
            Self::Jacobian => Some(3),
            Self::MassMatrix => Some(n),
        }
    }

    /// What the host computes at `q`.
    pub(crate) fn at(self, q: &[f64]) -> Vec<f64> {
        let n = q.len();
        let count = match self {
            Self::Fk => 3,
            Self::Gravity => n,
            Self::Jacobian => 3 * n,
            Self::MassMatrix => n * n,
        };
        let mut out = vec![0.0; count];
        let (q, at) = (q.as_ptr(), out.as_mut_ptr());
        // SAFETY: the host reads one number per joint, which the caller checked, and writes as many as there is room for
        unsafe {
            match self {
                Self::Fk => host_fk(q, at),
                Self::Jacobian => host_jacobian(q, at),
                Self::Gravity => host_gravity(q, at),
                Self::MassMatrix => host_mass_matrix(q, at),
            }
        }
        out
    }
}

/// Keeps what a panic says, for the grader to ask.
pub(crate) fn panicked(words: &str) {
    PANIC.with(|panic| {
        if let Ok(mut panic) = panic.try_borrow_mut() {
            *panic = Some(words.to_owned());
        }
    });
}

/// What the last panic said.
pub(crate) fn last_panic() -> Option<String> {
    PANIC.with(|panic| panic.try_borrow().ok().and_then(|panic| panic.clone()))
}
