//! The robot of a call.

use core::ffi::c_char;

use crate::map::{Map, part};
use crate::text::until_zero;

/// The robot: its joints that move, their limits, and its dimensions.
#[repr(C)]
pub struct Robot {
    name: *const c_char,
    joints: u32,
    joint_names: *const *const c_char,
    lower: *const f64,
    upper: *const f64,
    effort: *const f64,
    dimensions: Map,
}

impl Robot {
    /// Its name, as the robot file has it.
    pub fn name(&self) -> &str {
        // SAFETY: Kinemark gives the address of a text, which stays as it is during the call
        unsafe { until_zero(self.name) }
    }

    /// How many joints move: `n`.
    pub fn joints(&self) -> usize {
        self.joints as usize
    }

    /// The names of the `n` joints, in the order of `q`.
    pub fn joint_names(&self) -> impl ExactSizeIterator<Item = &str> {
        // SAFETY: Kinemark gives the addresses of `n` texts, which stay as they are during the call
        unsafe {
            let names = part(self.joint_names, self.joints);
            names.iter().map(|name| until_zero(*name))
        }
    }

    /// Lower position limits, shape `(n)`; minus infinity without a limit \[rad or m\].
    pub fn lower(&self) -> &[f64] {
        // SAFETY: Kinemark gives the address of `n` numbers, which stay as they are during the call
        unsafe { part(self.lower, self.joints) }
    }

    /// Upper position limits, shape `(n)`; infinity without a limit \[rad or m\].
    pub fn upper(&self) -> &[f64] {
        // SAFETY: as in `lower`
        unsafe { part(self.upper, self.joints) }
    }

    /// Effort limits of the task's servo, shape `(n)`; infinity without a limit \[N m or N\].
    pub fn effort(&self) -> &[f64] {
        // SAFETY: as in `lower`
        unsafe { part(self.effort, self.joints) }
    }

    /// The numbers of the robot file, such as `link_lengths`, in SI units.
    pub fn dimensions(&self) -> &Map {
        &self.dimensions
    }
}

#[cfg(target_pointer_width = "32")]
const _: () = {
    use core::mem::{align_of, offset_of, size_of};

    assert!(size_of::<Robot>() == 32 && align_of::<Robot>() == 4);
    assert!(offset_of!(Robot, name) == 0);
    assert!(offset_of!(Robot, joints) == 4);
    assert!(offset_of!(Robot, joint_names) == 8);
    assert!(offset_of!(Robot, lower) == 12);
    assert!(offset_of!(Robot, upper) == 16);
    assert!(offset_of!(Robot, effort) == 20);
    assert!(offset_of!(Robot, dimensions) == 24);
};
