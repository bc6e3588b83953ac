//! A push: a constant force on a link or a body for some ticks.

use nalgebra::Vector3;

/// What is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pushed {
    /// The link of this index of the robot.
    Link(usize),
    /// The dynamic body of this index of the scene, at its centre of mass.
    Body(usize),
}

/// A constant force, and a moment on links, for some ticks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// What is pushed.
    pub on: Pushed,
    /// Where the force acts on a link, in the frame of the link \[m\]; of no meaning for a body.
    pub p_m: Vector3<f64>,
    /// The force, world axes \[N\].
    pub force_n: Vector3<f64>,
    /// The moment besides that of the force, world axes \[N m\]; zero for a body.
    pub moment_n_m: Vector3<f64>,
    /// The first tick from which it acts.
    pub from_tick: u64,
    /// The tick at which it has ended.
    pub end_tick: u64,
}

impl Push {
    /// Whether it acts from `tick` to the next.
    pub fn acts_at(&self, tick: u64) -> bool {
        (self.from_tick..self.end_tick).contains(&tick)
    }
}
