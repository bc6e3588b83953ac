//! What `control` sees.

use core::ffi::c_char;

use crate::map::{Map, part};
use crate::text::until_zero;

/// An observation: what is measured at one tick, and what the task wants.
#[repr(C)]
pub struct Observation {
    tick: f64,
    time: f64,
    dt: f64,
    joints: u32,
    q: *const f64,
    qd: *const f64,
    effort: *const f64,
    tcp: *const f64,
    task: *const c_char,
    target: Map,
    sensors: Map,
    tcp_rotation: *const f64,
}

impl Observation {
    /// The tick: how many control periods have passed.
    pub fn tick(&self) -> u64 {
        self.tick as u64
    }

    /// The time since the start of the run \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The control period: the time from one call to the next \[s\].
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// How many joints move: `n`.
    pub fn joints(&self) -> usize {
        self.joints as usize
    }

    /// Joint positions, shape `(n)` \[rad or m\].
    pub fn q(&self) -> &[f64] {
        // SAFETY: Kinemark gives the address of `n` numbers, which stay as they are during the call
        unsafe { part(self.q, self.joints) }
    }

    /// Joint velocities, shape `(n)` \[rad/s or m/s\].
    pub fn qd(&self) -> &[f64] {
        // SAFETY: as in `q`
        unsafe { part(self.qd, self.joints) }
    }

    /// Joint efforts of the tick before, shape `(n)` \[N m or N\].
    pub fn effort(&self) -> &[f64] {
        // SAFETY: as in `q`
        unsafe { part(self.effort, self.joints) }
    }

    /// Position of the TCP in the lab's frame \[m\].
    pub fn tcp(&self) -> [f64; 3] {
        // SAFETY: Kinemark gives the address of 3 numbers, at a multiple of 8
        unsafe { *self.tcp.cast() }
    }

    /// Rotation matrix of the TCP in the lab's frame, row by row: its columns are the axes of the TCP.
    pub fn tcp_rotation(&self) -> [[f64; 3]; 3] {
        // SAFETY: Kinemark gives the address of 9 numbers, at a multiple of 8
        unsafe { *self.tcp_rotation.cast() }
    }

    /// The name of the task.
    pub fn task(&self) -> &str {
        // SAFETY: Kinemark gives the address of a text, which stays as it is during the call
        unsafe { until_zero(self.task) }
    }

    /// What the task sets, in SI units; a target that is no map is its only field, `target`.
    pub fn target(&self) -> &Map {
        &self.target
    }

    /// Readings by the names of the sensors; 1 for true and 0 for false.
    pub fn sensors(&self) -> &Map {
        &self.sensors
    }
}

#[cfg(target_pointer_width = "32")]
const _: () = {
    use core::mem::{align_of, offset_of, size_of};

    assert!(size_of::<Observation>() == 72 && align_of::<Observation>() == 8);
    assert!(offset_of!(Observation, tick) == 0);
    assert!(offset_of!(Observation, time) == 8);
    assert!(offset_of!(Observation, dt) == 16);
    assert!(offset_of!(Observation, joints) == 24);
    assert!(offset_of!(Observation, q) == 28);
    assert!(offset_of!(Observation, qd) == 32);
    assert!(offset_of!(Observation, effort) == 36);
    assert!(offset_of!(Observation, tcp) == 40);
    assert!(offset_of!(Observation, task) == 44);
    assert!(offset_of!(Observation, target) == 48);
    assert!(offset_of!(Observation, sensors) == 56);
    assert!(offset_of!(Observation, tcp_rotation) == 64);
};
