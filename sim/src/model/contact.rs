//! The data of a contact: its parties, forces and impulses, independent of the engine that computes them.

use nalgebra::Vector3;

/// One side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Party {
    /// A link of the robot, by its index among [`crate::model::robot::Robot::links`].
    Link(usize),
    /// A body of the scene, by its index among [`crate::model::scene::Scene::bodies`].
    Body(usize),
    /// The ground.
    Ground,
}

impl Party {
    /// Its kind and its index, as numbers for digests.
    pub(crate) fn numbers(self) -> (u64, u64) {
        match self {
            Self::Link(index) => (0, index as u64),
            Self::Body(index) => (1, index as u64),
            Self::Ground => (2, 0),
        }
    }
}

/// The contact of two parties during one step; pairs without a force have none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFact {
    /// Both parties, the lesser first.
    pub parties: [Party; 2],
    /// Sum of the normal impulses at all points, never negative \[N s\]; divided by the step it is the mean force.
    pub impulse_n_s: f64,
    /// Normal impulses on the second party, as a vector in the world \[N s\].
    pub normal_impulse_n_s: Vector3<f64>,
    /// Friction impulses on the second party, as a vector in the world \[N s\].
    pub friction_impulse_n_s: Vector3<f64>,
    /// Moment of all these impulses on the second party about the world's origin \[N m s\].
    pub moment_impulse_n_m_s: Vector3<f64>,
    /// Mean normal force over the step \[N\].
    pub force_n: f64,
    /// Penetration depth of the deepest point at the start of the step, 0 without penetration \[m\].
    pub depth_m: f64,
    /// Number of points with a normal force.
    pub points: usize,
    /// Centre of these points, weighted by impulse, in the world \[m\]: where they are at the start of the step, or on a moving link in
    /// its middle.
    pub p_centre_in_world: Vector3<f64>,
}
