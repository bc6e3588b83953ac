//! The scene as the simulator gets it: bodies with their shapes and starts, gravity, wind and ground.

use nalgebra::Vector3;

use super::gust::Gust;
use super::motion::Motion;
use crate::robot::inertia::Inertia;
use crate::robot::model::{Contact, Shape};
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

/// How a body resists the air, the same from every side; the force acts at the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Area that meets the air \[m²\].
    pub area_m2: f64,
    /// Drag coefficient, a ratio of pressures.
    pub coefficient: f64,
}

impl Drag {
    /// The force of air that passes at `air_past_body_m_s`, in the axes of that velocity \[N\]: `½ ρ c A |v| v`.
    pub fn force_n(
        &self,
        air_density_kg_m3: f64,
        air_past_body_m_s: &Vector3<f64>,
    ) -> Vector3<f64> {
        let half_rho_c_a = 0.5 * air_density_kg_m3 * self.coefficient * self.area_m2;
        air_past_body_m_s * (half_rho_c_a * air_past_body_m_s.norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_by_hand() {
        let drag = Drag {
            area_m2: 0.5,
            coefficient: 0.8,
        };
        // ½ 1.2 0.8 0.5 = 0.24; |v| = 5
        let force = drag.force_n(1.2, &Vector3::new(3.0, 0.0, -4.0));
        assert!((force - Vector3::new(3.6, 0.0, -4.8)).norm() < 1e-15);
        assert_eq!(drag.force_n(1.2, &Vector3::zeros()), Vector3::zeros());
    }

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
