//! Where the mass of the whole robot is, and how the joints move it.

use nalgebra::{Matrix3xX, Vector3};
use serde::Deserialize;

use super::forward::forward_kinematics;
use crate::joint_space::JointPositions;
use crate::model::robot::Robot;

/// What mass counts.
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
    /// Mass \[kg\] and first moment in the world \[kg m\] of what counts although no joint moves it.
    fn still(self, robot: &Robot) -> (f64, Vector3<f64>) {
        let world = robot.world_inertia();
        match self {
            Self::WholeRobot => (world.mass_kg, world.com_m * world.mass_kg),
            Self::MovingLinks => (0.0, Vector3::zeros()),
        }
    }
}

/// Returns the centre of mass of what is `counted`, in the world \[m\]; none if nothing of it has mass.
pub fn centre_of_mass(robot: &Robot, q: &JointPositions, counted: Counted) -> Option<Vector3<f64>> {
    let poses = forward_kinematics(robot, q);
    let (mut mass_kg, mut moment) = counted.still(robot);
    for (body, placed) in robot.bodies().iter().zip(&poses.placed) {
        mass_kg += body.mass_kg;
        moment += placed.position * body.mass_kg + placed.world_from_body * body.first_moment;
    }
    (mass_kg > 0.0).then(|| moment / mass_kg)
}

/// Returns the Jacobian of [`centre_of_mass`], shape `(3, n)`: its velocity in the world \[m/s\] per unit of joint velocity; none if
/// nothing counted has mass.
///
/// Source: the sum of the bodies' own Jacobians weighted by mass, gathered from the tips to the root: a joint moves all that hangs
/// on it as one rigid body.
pub fn centre_of_mass_jacobian(
    robot: &Robot,
    q: &JointPositions,
    counted: Counted,
) -> Option<Matrix3xX<f64>> {
    let poses = forward_kinematics(robot, q);
    let bodies = robot.bodies();
    // mass and first moment in world axes about the world's origin, of each body with all that hangs on it
    let mut carried: Vec<(f64, Vector3<f64>)> = bodies
        .iter()
        .zip(&poses.placed)
        .map(|(body, placed)| {
            let moment =
                placed.position * body.mass_kg + placed.world_from_body * body.first_moment;
            (body.mass_kg, moment)
        })
        .collect();
    let (mut mass_kg, _) = counted.still(robot);
    for (i, body) in bodies.iter().enumerate().rev() {
        let (mass, moment) = carried[i];
        match body.parent {
            Some(parent) => {
                carried[parent].0 += mass;
                carried[parent].1 += moment;
            }
            None => mass_kg += mass,
        }
    }
    if mass_kg <= 0.0 {
        return None;
    }
    let mut jacobian = Matrix3xX::zeros(robot.n());
    for ((body, placed), (mass, moment)) in bodies.iter().zip(&poses.placed).zip(carried) {
        let axis = placed.axis() * (body.gear / mass_kg);
        let mut column = jacobian.column_mut(body.q_index);
        // a mimic joint adds to the column of its master
        column += if body.turns {
            axis.cross(&(moment - placed.position * mass))
        } else {
            axis * mass
        };
    }
    Some(jacobian)
}
