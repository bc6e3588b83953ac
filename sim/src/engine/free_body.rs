//! A dynamic body of the scene: its state, its flight through a step, and what a kick within the step changes.

use nalgebra::{Matrix3, Vector3};
use parry3d_f64::bounding_volume::Aabb;

use super::convert::vector;
use super::engine_error::EngineError;
use super::rotation::{Tensor, orthonormal};
use super::world::BodyState;
use crate::model::scene::SceneBody;
use crate::spatial::{Pose, Twist, pose, rotation_exp};

/// A dynamic body.
#[derive(Debug, Clone)]
pub(super) struct FreeBody {
    /// Its index in the scene.
    pub(super) index: usize,
    pub(super) mass_kg: f64,
    tensor: Tensor,
    com_in_body: Vector3<f64>,
    /// Centre of mass, world axes \[m\].
    pub(super) x: Vector3<f64>,
    rotation: Matrix3<f64>,
    /// Velocity of the centre of mass \[m/s\].
    pub(super) v: Vector3<f64>,
    /// Angular velocity, world axes \[rad/s\].
    pub(super) w: Vector3<f64>,
    /// What forces other than contact give it in this step, the same throughout \[m/s²\].
    pub(super) acceleration_m_s2: Vector3<f64>,
    /// Radius of a sphere about its centre of mass that contains it \[m\].
    radius_m: f64,
    /// Whether it may never sleep.
    pub(super) restless: bool,
    pub(super) sleeps: bool,
    /// Steps for which it has rested.
    pub(super) rested: u32,
    /// What fell asleep together has the same number.
    pub(super) island: u64,
    kick: Kick,
}

/// A body at the time within a step at which impulses act on it.
#[derive(Debug, Clone, Copy, Default)]
struct Kick {
    /// Time from the start of the step \[s\], and how long the step is.
    at_s: f64,
    dt_s: f64,
    rotation: Matrix3<f64>,
    /// Angular momentum before the impulses, world axes.
    momentum: Vector3<f64>,
}

impl FreeBody {
    /// Body `index` of a scene where it starts.
    ///
    /// # Errors
    /// [`EngineError::Massless`].
    pub(super) fn new(index: usize, body: &SceneBody, restless: bool) -> Result<Self, EngineError> {
        let inertia = &body.inertia;
        let kg_m2 = inertia.about_com_kg_m2.to_matrix();
        let least_kg_m2 = kg_m2.symmetric_eigenvalues().min();
        let massless = || EngineError::Massless {
            body: body.name.clone(),
            mass_kg: inertia.mass_kg,
            least_kg_m2,
        };
        if !(inertia.mass_kg > 0.0 && least_kg_m2 > 0.0) {
            return Err(massless());
        }
        let rotation = *body.world_from_body.rotation.matrix();
        let com = rotation * inertia.com_m;
        Ok(Self {
            index,
            mass_kg: inertia.mass_kg,
            tensor: Tensor::new(kg_m2).ok_or_else(massless)?,
            com_in_body: inertia.com_m,
            x: body.world_from_body.translation.vector + com,
            rotation,
            v: body.twist.linear + body.twist.angular.cross(&com),
            w: body.twist.angular,
            acceleration_m_s2: Vector3::zeros(),
            radius_m: 0.0,
            restless,
            sleeps: false,
            rested: 0,
            island: 0,
            kick: Kick::default(),
        })
    }

    /// Enlarges its radius so that it contains `bounds`.
    pub(super) fn cover(&mut self, bounds: &Aabb) {
        let ball = bounds.bounding_sphere();
        let radius_m = (ball.center() - vector(&self.x)).length() + ball.radius();
        self.radius_m = self.radius_m.max(radius_m);
    }

    /// The speed of its fastest point \[m/s\].
    pub(super) fn speed_m_s(&self) -> f64 {
        self.v.norm() + self.w.norm() * self.radius_m
    }

    /// About the farthest that a point of it travels in a step \[m\].
    pub(super) fn travel_m(&self, dt_s: f64) -> f64 {
        self.speed_m_s() * dt_s + 0.5 * self.acceleration_m_s2.norm() * dt_s * dt_s
    }

    pub(super) fn pose(&self) -> Pose {
        pose(self.rotation, self.x - self.rotation * self.com_in_body)
    }

    pub(super) fn state(&self) -> BodyState {
        let com = self.rotation * self.com_in_body;
        BodyState {
            world_from_body: self.pose(),
            twist: Twist {
                linear: self.v - self.w.cross(&com),
                angular: self.w,
            },
            sleeps: self.sleeps,
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let numbers = [&self.x, &self.v, &self.w];
        numbers.iter().all(|v| v.iter().all(|x| x.is_finite()))
            && self.rotation.iter().all(|x| x.is_finite())
    }

    pub(super) fn sleep(&mut self, island: u64) {
        self.sleeps = true;
        self.island = island;
        (self.v, self.w) = (Vector3::zeros(), Vector3::zeros());
    }

    pub(super) fn wake(&mut self) {
        self.sleeps = false;
        self.rested = 0;
    }

    /// Its velocities at the start of the step, and at the end without contact; its displacement without contact: linear and angular.
    pub(super) fn free_motion(&self, dt_s: f64) -> [[f64; 6]; 3] {
        let (v, w, a) = (&self.v, &self.w, &self.acceleration_m_s2);
        let next = v + a * dt_s;
        let gone = (v + a * (0.5 * dt_s)) * dt_s;
        let turned = w * dt_s;
        let six = |v: &Vector3<f64>, w: &Vector3<f64>| [v.x, v.y, v.z, w.x, w.y, w.z];
        [six(v, w), six(&next, w), six(&gone, &turned)]
    }

    /// Prepares for impulses `at_s` after the start of a step of `dt_s`; returns the inverse inertia tensor there, in world axes.
    pub(super) fn turn_to(&mut self, at_s: f64, dt_s: f64) -> Matrix3<f64> {
        let momentum = self.tensor.momentum(&self.rotation, &self.w);
        let rotation = self.tensor.turned(&self.rotation, &momentum, at_s);
        self.kick = Kick {
            at_s,
            dt_s,
            rotation,
            momentum,
        };
        self.tensor.inverse_in_world(&rotation)
    }

    /// Moves it through a step of `dt_s` without contact.
    pub(super) fn fly(&mut self, dt_s: f64) {
        let a = self.acceleration_m_s2;
        self.x += (self.v + a * (0.5 * dt_s)) * dt_s;
        self.v += a * dt_s;
        let momentum = self.tensor.momentum(&self.rotation, &self.w);
        let next = self.tensor.turned(&self.rotation, &momentum, dt_s);
        if next != self.rotation {
            self.rotation = next;
            self.w = self.tensor.rate(&next, &momentum);
        }
    }

    /// Moves it through the step of [`FreeBody::turn_to`], in which a kick changes its velocities by `kick` and its displacement, besides
    /// what follows from the kick, by `moved` (linear, angular each).
    pub(super) fn fly_kicked(&mut self, kick: &[f64; 6], moved: &[f64; 6]) {
        let linear = |six: &[f64; 6]| Vector3::new(six[0], six[1], six[2]);
        let angular = |six: &[f64; 6]| Vector3::new(six[3], six[4], six[5]);
        let a = self.acceleration_m_s2;
        let Kick {
            at_s,
            dt_s,
            rotation: then,
            momentum,
        } = self.kick;
        let after_s = dt_s - at_s;
        self.x += (self.v + a * (0.5 * dt_s)) * dt_s + linear(kick) * after_s + linear(moved);
        self.v += a * dt_s + linear(kick);
        let momentum = momentum + self.tensor.momentum(&then, &angular(kick));
        let next = self.tensor.turned(&then, &momentum, after_s);
        let w = self.tensor.rate(&next, &momentum);
        // the correction turns the motion too, so that it brings no energy
        let turn = rotation_exp(&angular(moved));
        (self.rotation, self.w) = (orthonormal(&(turn * next)), turn * w);
    }
}
