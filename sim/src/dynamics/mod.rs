//! Rigid-body dynamics, one algorithm a file: inverse ([`rnea`]), mass matrix ([`crba`]), forward ([`ForwardDynamics`]), energy
//! ([`mod@energy`]), closed loops ([`loops`]), dry friction over a step ([`dry_friction`]), and drag and pushes on links ([`link_forces`]).
//!
//! All of them work in world axes with every body's own origin as reference point, and with classical accelerations: then only
//! the angular velocity enters the velocity terms, and the poses are those of forward kinematics. Passive effort is
//! `-damping qd - dry_friction sign(qd)`; `sign(0)` is 0. `armature` adds to the diagonal of the mass matrix.
//!
//! Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), ch. 5 to 7, whose spatial accelerations are restated here as
//! classical ones.

mod aba;
pub mod crba;
pub(crate) mod damping_rate;
pub mod dry_friction;
pub mod energy;
mod forward;
mod gravity;
pub mod link_forces;
pub mod loops;
pub mod rnea;

pub use aba::SingularMassMatrix;
pub use crba::mass_matrix;
pub use energy::{Energy, energy};
pub use forward::{ForwardDynamics, forward_dynamics, immovable_joint, moves_nothing};
pub use gravity::GRAVITY_M_S2;
pub use loops::{driven_efforts, driven_mass_matrix};
pub use rnea::{bias_effort, coriolis_effort, gravity_effort, inverse_dynamics};
