//! Scenes that the tests share: the shelf and the can of the labs, loose parts, and where the arm reaches them.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::robot::{Contact, Shape};
use kinemark_sim::model::scene::{BodyKind, Environment, Scene, SceneBody};
use kinemark_sim::spatial::{Pose, Twist, pose};
use nalgebra::{Matrix3, Vector3};

pub(crate) const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);
pub(crate) const STILL: Twist = Twist {
    linear: Vector3::new(0.0, 0.0, 0.0),
    angular: Vector3::new(0.0, 0.0, 0.0),
};

pub(crate) fn at(x: f64, y: f64, z: f64) -> Pose {
    pose(Matrix3::identity(), Vector3::new(x, y, z))
}

pub(crate) fn boxed(x: f64, y: f64, z: f64) -> Solid {
    Solid::Box { size_m: [x, y, z] }
}

/// One body of one shape.
pub(crate) fn part(
    name: &str,
    kind: BodyKind,
    solid: Solid,
    mass_kg: f64,
    start: Pose,
) -> SceneBody {
    let inertia = solid.inertia(mass_kg).expect("a solid");
    SceneBody {
        name: name.to_owned(),
        kind,
        shapes: vec![Shape {
            solid,
            link_from_shape: Pose::identity(),
        }],
        inertia,
        contact: Contact {
            friction: 0.4,
            restitution: 0.0,
            rolling_m: 0.0,
        },
        world_from_body: start,
        twist: STILL,
        drag: None,
    }
}

pub(crate) fn scene(bodies: Vec<SceneBody>) -> Scene {
    Scene {
        name: "test".to_owned(),
        environment: Environment {
            gravity_m_s2: GRAVITY,
            wind: None,
            ground: Some(Contact {
                friction: 0.4,
                restitution: 0.0,
                rolling_m: 0.0,
            }),
        },
        bodies,
    }
}

/// The shelf of the labs (S5 of the golden file): 0.2 m deep, 0.9 m wide, 1.2 m high, a metre away.
pub(crate) fn shelf() -> SceneBody {
    let mut shelf = part(
        "shelf",
        BodyKind::Fixed,
        boxed(0.2, 0.9, 1.2),
        1.0,
        at(1.0, 0.05, 0.6),
    );
    shelf.contact.friction = 0.2;
    shelf
}

/// The can of the labs, upright.
pub(crate) fn can(x: f64, z_bottom: f64) -> SceneBody {
    let solid = Solid::Cylinder {
        radius_m: 0.033,
        length_m: 0.1,
    };
    part(
        "can",
        BodyKind::Free,
        solid,
        0.39,
        at(x, 0.05, z_bottom + 0.05),
    )
}

/// Shelf (body 0) and can on it (body 1).
pub(crate) fn shelf_and_can() -> Scene {
    scene(vec![shelf(), can(1.0, 1.2)])
}

/// Joint angles that put the tip of the course's arm `up` the ground and `out` from its post, elbow outwards.
pub(crate) fn reach(up: f64, out: f64) -> [f64; 2] {
    let (x, y) = (up - 2.0, out);
    let q2 = libm::acos((x * x + y * y - 2.0) / 2.0);
    let q1 = libm::atan2(y, x) - libm::atan2(libm::sin(q2), 1.0 + libm::cos(q2));
    [q1, q2]
}
