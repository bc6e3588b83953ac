//! Perturbed models of a robot: with a payload, friction, another damping or drag that its controller does not know.

use nalgebra::Vector3;

use super::air::Drag;
use super::inertia::Inertia;
use super::joint_friction::JointFriction;
use super::robot::{JointKind, Robot};
use crate::spatial::Symmetric3;

impl Robot {
    /// The same robot with a point mass fixed to the TCP's link, at the TCP. Shapes do not change.
    #[must_use]
    pub fn with_payload(mut self, mass_kg: f64) -> Self {
        let tcp = self.tcp().clone();
        let at = tcp.attachment.body_from_here.translation.vector;
        let point = |com_m: Vector3<f64>| Inertia {
            mass_kg,
            com_m,
            about_com_kg_m2: Symmetric3::default(),
        };
        let link = &mut self.links[tcp.link];
        let body_from_link = link.attachment.body_from_here;
        let in_link = body_from_link.inverse_transform_point(&at.into()).coords;
        link.inertia = link.inertia.plus(&point(in_link));
        match tcp.attachment.body {
            Some(body) => {
                let body = &mut self.bodies[body];
                body.mass_kg += mass_kg;
                body.first_moment += at * mass_kg;
                body.inertia.add(&Symmetric3::of_point_mass(mass_kg, &at));
            }
            None => self.world_inertia = self.world_inertia.plus(&point(at)),
        }
        self
    }

    /// The same robot with additional dry friction in every joint that has an entry in `q` \[N m or N\].
    #[must_use]
    pub fn with_more_friction(mut self, effort: f64) -> Self {
        for j in 0..self.joints.len() {
            let joint = &mut self.joints[j];
            if joint.kind == JointKind::Fixed || joint.mimic.is_some() {
                continue;
            }
            joint.dry_friction.positive += effort;
            joint.dry_friction.negative += effort;
            if let Some(body) = self.links[joint.child].attachment.body {
                self.bodies[body].dry_friction += effort;
            }
        }
        self
    }

    /// The same robot with `frictions` in place of the dry friction of its joints, one per entry of `q`. Joints that mimic others keep
    /// theirs.
    ///
    /// # Panics
    /// If there are fewer frictions than entries of `q`.
    #[must_use]
    pub fn with_dry_friction(mut self, frictions: &[JointFriction]) -> Self {
        for (entry, friction) in frictions[..self.n()].iter().enumerate() {
            let joint = &mut self.joints[self.moving[entry]];
            joint.dry_friction = *friction;
            if let Some(body) = self.links[joint.child].attachment.body {
                self.bodies[body].dry_friction = friction.mean();
                self.bodies[body].dry_skew = friction.skew();
            }
        }
        self
    }

    /// The same robot with this drag on every link that moves, in place of its own.
    #[must_use]
    pub fn with_drag(mut self, drag: Drag) -> Self {
        for link in &mut self.links {
            if link.attachment.body.is_some() {
                link.drag = Some(drag);
            }
        }
        self
    }

    /// The same robot with the viscous damping of every joint multiplied.
    #[must_use]
    pub fn with_damping_times(mut self, factor: f64) -> Self {
        for joint in &mut self.joints {
            joint.damping *= factor;
        }
        for body in &mut self.bodies {
            body.damping *= factor;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use crate::dynamics::GRAVITY_M_S2;
    use crate::dynamics::rnea::Rnea;
    use crate::format::RobotFile;
    use crate::model::air::Drag;
    use crate::model::robot::Robot;
    use crate::text::Source;

    /// One link of 1 m and 2 kg that rotates about y. Its centre of mass is in the middle; its TCP, at the end, has a rotated frame.
    fn pendulum() -> Robot {
        let text = r#"
            format = 1
            name = "pendulum"
            [[links]]
            name = "base"
            [[links]]
            name = "arm"
            inertia = { mass_kg = 2.0, com_m = [0.5, 0, 0], tensor_kg_m2 = [0, 0.1667, 0.1667, 0, 0, 0] }
            [[joints]]
            name = "hinge"
            type = "revolute"
            parent = "base"
            child = "arm"
            axis = [0, 1, 0]
            damping = 0.5
            dry_friction = 0.1
            [[frames]]
            name = "tcp"
            link = "arm"
            origin = { xyz_m = [1, 0, 0], rpy_deg = [0, 90, 0] }
        "#;
        let file = RobotFile::parse(Source::new("pendulum.toml", text)).unwrap();
        file.build(&[]).unwrap()
    }

    fn effort(robot: &Robot, qdd: f64, gravity: f64) -> f64 {
        let mut effort = [0.0];
        let gravity = GRAVITY_M_S2 * gravity;
        Rnea::new(robot).effort(robot, &gravity, &[0.0], &[0.0], &[qdd], &mut effort);
        effort[0]
    }

    #[test]
    fn a_payload_weighs_and_resists_at_the_tcp() {
        let (bare, loaded) = (pendulum(), pendulum().with_payload(0.3));
        // weight times lever: 0.3 kg at 1 m more than 2 kg at 0.5 m; about y a weight ahead pulls down, positively
        let weight = effort(&loaded, 0.0, 1.0) - effort(&bare, 0.0, 1.0);
        assert!((weight.abs() - 0.3 * 9.81).abs() < 1e-12, "{weight}");
        // inertia: m l²
        let inertia = effort(&loaded, 1.0, 0.0) - effort(&bare, 1.0, 0.0);
        assert!((inertia - 0.3).abs() < 1e-12, "{inertia}");
        assert!((loaded.mass_kg() - 2.3).abs() < 1e-12);
        // the centre of mass of the link agrees: (2 * 0.5 + 0.3 * 1) / 2.3
        let com = loaded.links()[1].inertia.com_m.x;
        assert!((com - 1.3 / 2.3).abs() < 1e-12, "{com}");
    }

    #[test]
    fn friction_is_added_and_damping_multiplied() {
        let robot = pendulum().with_more_friction(0.2).with_damping_times(3.0);
        assert!((robot.joints()[0].dry_friction.negative - 0.3).abs() < 1e-12);
        assert!((robot.joints()[0].damping - 1.5).abs() < 1e-12);
        assert!((robot.bodies()[0].dry_friction - 0.3).abs() < 1e-12);
        assert!((robot.bodies()[0].damping - 1.5).abs() < 1e-12);
        assert_eq!(
            pendulum().with_more_friction(0.0).with_damping_times(1.0),
            pendulum()
        );
    }

    #[test]
    fn drag_is_on_what_moves() {
        let drag = Drag {
            area_m2: 0.05,
            coefficient: 1.1,
        };
        let robot = pendulum().with_drag(drag);
        let drags: Vec<Option<Drag>> = robot.links().iter().map(|link| link.drag).collect();
        assert_eq!(drags, [None, Some(drag)]);
    }
}
