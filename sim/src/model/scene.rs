//! The scene: bodies with their shapes and initial states, gravity, wind and ground.

use nalgebra::Vector3;

use super::air::Drag;
use super::gust::Gust;
use super::inertia::Inertia;
use super::prescribed_motion::Motion;
use super::robot::{Contact, Shape};
use crate::spatial::{Pose, Twist};

/// The surroundings of a robot. World axes: z is up.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Gravity, wind and ground.
    pub environment: Environment,
    /// Its bodies, in file order.
    pub bodies: Vec<SceneBody>,
}

impl Scene {
    /// Nothing but air under `gravity_m_s2`, world axes.
    pub fn of_air(gravity_m_s2: Vector3<f64>, wind: Wind) -> Self {
        Self {
            name: "air".to_owned(),
            environment: Environment {
                gravity_m_s2,
                wind: Some(wind),
                ground: None,
            },
            bodies: Vec::new(),
        }
    }
}

/// Gravity, air and ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Acceleration of free fall, world axes \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// Moving or still air, if there is any.
    pub wind: Option<Wind>,
    /// Surface of the plane `z = 0` of the world, if there is ground.
    pub ground: Option<Contact>,
}

impl Default for Environment {
    /// Gravity 9.81 m/s² downwards, no air, no ground.
    fn default() -> Self {
        Self {
            gravity_m_s2: Vector3::new(0.0, 0.0, -9.81),
            wind: None,
            ground: None,
        }
    }
}

/// Wind, the same everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Wind {
    /// Its mean velocity, world axes \[m/s\]; zero is still air, which slows bodies down.
    pub velocity_m_s: Vector3<f64>,
    /// Its density \[kg/m³\].
    pub air_density_kg_m3: f64,
    /// Gusts along its direction, if any.
    pub gust: Option<Gust>,
}

impl Wind {
    /// Velocity of the air while a gust adds `gust_m_s` along the mean wind, world axes \[m/s\].
    ///
    /// Where the mean wind is zero a gust has no direction and adds nothing.
    pub fn air_velocity_m_s(&self, gust_m_s: f64) -> Vector3<f64> {
        match crate::spatial::direction(self.velocity_m_s) {
            Some(along) => self.velocity_m_s + along * gust_m_s,
            None => self.velocity_m_s,
        }
    }
}

/// A body of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneBody {
    /// Its name.
    pub name: String,
    /// Whether and how it moves.
    pub kind: BodyKind,
    /// Its shapes, in its own frame; at least one.
    pub shapes: Vec<Shape>,
    /// Its mass properties, in its own frame; `None` if a fixed or kinematic body states none.
    pub inertia: Inertia,
    /// Its surface.
    pub contact: Contact,
    /// Its initial pose.
    pub world_from_body: Pose,
    /// Its initial twist: velocity of its origin and angular velocity, world axes.
    pub twist: Twist,
    /// Its air drag, if any.
    pub drag: Option<Drag>,
}

/// Whether and how a body moves.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyKind {
    /// Fixed to the world.
    Fixed,
    /// Kinematic: by a prescribed motion, unaffected by contact.
    Kinematic(Motion),
    /// Dynamic: by forces and contacts.
    Free,
}

impl BodyKind {
    /// The word of the scene file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Kinematic(_) => "kinematic",
            Self::Free => "free",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gust_blows_along_the_wind() {
        let wind = |velocity_m_s| Wind {
            velocity_m_s,
            air_density_kg_m3: 1.2,
            gust: None,
        };
        let air = wind(Vector3::new(0.0, -2.0, 0.0)).air_velocity_m_s(0.5);
        assert_eq!(air, Vector3::new(0.0, -2.5, 0.0));
        let still = wind(Vector3::zeros()).air_velocity_m_s(0.5);
        assert_eq!(still, Vector3::zeros());
    }
}
