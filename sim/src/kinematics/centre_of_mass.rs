//! The centre of mass of the whole robot.

use nalgebra::Vector3;
use serde::Deserialize;

use super::forward::forward_kinematics;
use crate::joint_space::JointPositions;
use crate::model::robot::Robot;

/// Which masses count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Counted {
    /// The links that joints move; those fixed to the world are left out, as Pinocchio does.
    #[serde(rename = "moving")]
    MovingLinks,
    /// All links.
    #[serde(rename = "all")]
    WholeRobot,
}

impl Counted {
    /// Mass \[kg\] and first moment in the world \[kg m\] of the counted links that no joint moves.
    fn still(self, robot: &Robot) -> (f64, Vector3<f64>) {
        let world = robot.world_inertia();
        match self {
            Self::WholeRobot => (world.mass_kg, world.com_m * world.mass_kg),
            Self::MovingLinks => (0.0, Vector3::zeros()),
        }
    }
}

/// Returns the centre of mass of the `counted` links, in the world \[m\]; `None` if they have no mass.
pub fn centre_of_mass(robot: &Robot, q: &JointPositions, counted: Counted) -> Option<Vector3<f64>> {
    let poses = forward_kinematics(robot, q);
    let (mut mass_kg, mut moment) = counted.still(robot);
    for (body, placed) in robot.bodies().iter().zip(&poses.placed) {
        mass_kg += body.mass_kg;
        moment += placed.position * body.mass_kg + placed.world_from_body * body.first_moment;
    }
    (mass_kg > 0.0).then(|| moment / mass_kg)
}
