//! The scene as the simulator gets it: bodies with their shapes and starts, gravity, wind and ground.

use nalgebra::Vector3;

use super::air::Drag;
use super::gust::Gust;
use super::inertia::Inertia;
use super::prescribed_motion::Motion;
use super::robot::{Contact, Shape};
use crate::spatial::{Pose, Twist};

/// What is around a robot. World axes: z is up.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Gravity, wind and ground.
    pub environment: Environment,
    /// Its bodies, in file order.
    pub bodies: Vec<SceneBody>,
}

/// What acts on everything.
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

/// Air that moves, the same everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Wind {
    /// Its mean velocity, world axes \[m/s\]; zero is still air, which slows bodies down.
    pub velocity_m_s: Vector3<f64>,
    /// Its density \[kg/m³\].
    pub air_density_kg_m3: f64,
    /// What comes and goes along its direction.
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
    /// What moves it.
    pub kind: BodyKind,
    /// Its shapes, in its own frame; at least one.
    pub shapes: Vec<Shape>,
    /// Its mass properties, in its own frame; none where a body that is not free states none.
    pub inertia: Inertia,
    /// Its surface.
    pub contact: Contact,
    /// Where it starts.
    pub world_from_body: Pose,
    /// How it starts: velocity of its origin and angular velocity, world axes.
    pub twist: Twist,
    /// What the air does to it; nothing where it is absent.
    pub drag: Option<Drag>,
}

/// What moves a body.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyKind {
    /// Nothing: it stands where it is.
    Fixed,
    /// A law, whatever it touches.
    Kinematic(Motion),
    /// Forces and contacts.
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
