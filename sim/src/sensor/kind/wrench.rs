//! wrench: force and moment of the parent on the child through a joint, in the child's frame about its origin, N and N m; the
//! mean over the last step.
//!
//! By Newton and Euler: what the joint carries needs a force and a moment for its motion; what contact and gravity do not give, the
//! joint does. Accelerations are the change of velocity over the step. The state they go with is that of the middle of the step,
//! followed back from its end, so that the error is of second order in the step where motion is smooth. In contact it is of first
//! order, as the motion itself is.

use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::kinematics::body_motion::{BodyMotions, Motion};
use crate::model::air::Drag;
use crate::model::contact::Party;
use crate::model::inertia::Inertia;
use crate::model::robot::{Attachment, Loop, Robot, carried_by};
use crate::model::sensor::{Gauge, Measured, Seen, SensorKind, Surroundings};
use crate::part::part_problem::PartError;
use crate::part::toml_text::quoted;
use crate::sensor::registry::{KindTable, SensorReading};
use crate::spatial::Symmetric3;
use crate::text::Spanned;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// The joint through which the parent acts on the child.
    joint: Spanned<String>,
}

impl KindTable for Table {
    const NAME: &'static str = "wrench";
    #[cfg(test)]
    const EXAMPLE: &'static str = "joint = 'elbow'";
    type Kind = Wrench;

    /// Through the joint passes all that its child's side is held by: no loop lies around it.
    fn read(&self, reading: &SensorReading<'_>) -> Result<Wrench, PartError> {
        let robot = reading.robot;
        let (joint, described) = reading.joint(&self.joint)?;
        let carried = carried_by(robot, joint);
        let around = |closed: &&Loop| {
            let [first, second] = closed.links;
            carried[first] != carried[second]
        };
        let Some(closed) = robot.loops().iter().find(around) else {
            return Ok(Wrench { joint });
        };
        let [first, second] = closed.links.map(|link| &robot.links()[link].name);
        reading.refuse(
            self.joint.span(),
            format!(
                "joint `{}` shares its wrench with the loop between `{first}` and `{second}`",
                described.name
            ),
            "name a joint outside of every loop".to_owned(),
        )
    }
}

#[derive(Debug)]
pub(super) struct Wrench {
    /// Index among all joints.
    joint: usize,
}

impl SensorKind for Wrench {
    fn measured(&self) -> Measured {
        Measured::Parts(&["fx", "fy", "fz", "mx", "my", "mz"])
    }

    fn unit(&self, _: &Robot, channel: usize) -> &'static str {
        if channel < 3 { "N" } else { "N m" }
    }

    fn keys(&self, robot: &Robot) -> String {
        format!("joint = {}\n", quoted(&robot.joints()[self.joint].name))
    }

    fn gauge(&self, robot: &Robot, step_s: f64) -> Box<dyn Gauge> {
        Box::new(WrenchGauge::new(robot, self.joint, step_s))
    }
}

/// A gauge in one joint, and what that carries.
struct WrenchGauge {
    step_s: f64,
    motion: MeanMotion,
    /// Where the child's frame is.
    child: Attachment,
    /// Whether each link is carried.
    carried: Vec<bool>,
    parts: Vec<Part>,
    sails: Vec<Sail>,
}

/// A carried link that the air drags on.
struct Sail {
    body: Option<usize>,
    p_com_in_body: Vector3<f64>,
    drag: Drag,
}

/// All that is carried on one body, in the body's frame.
struct Part {
    body: Option<usize>,
    mass_kg: f64,
    first_moment: Vector3<f64>,
    inertia: Symmetric3,
}

impl WrenchGauge {
    /// A gauge in joint `joint` of all joints.
    fn new(robot: &Robot, joint: usize, step_s: f64) -> Self {
        let carried = carried_by(robot, joint);
        let mut sums: Vec<(Option<usize>, Inertia)> = Vec::new();
        let links = robot.links().iter().zip(&carried);
        for (link, _) in links.filter(|(_, carried)| **carried) {
            let Attachment {
                body,
                body_from_here,
            } = &link.attachment;
            let inertia = link.inertia.seen_from(body_from_here);
            match sums.iter_mut().find(|(known, _)| known == body) {
                Some((_, sum)) => *sum = sum.plus(&inertia),
                None => sums.push((*body, inertia)),
            }
        }
        let parts = sums.iter().map(|(body, sum)| Part {
            body: *body,
            mass_kg: sum.mass_kg,
            first_moment: sum.com_m * sum.mass_kg,
            inertia: sum.about_origin_kg_m2(),
        });
        let links = robot.links().iter().zip(&carried);
        let sails = links
            .filter(|(_, carried)| **carried)
            .filter_map(|(link, _)| {
                let Attachment {
                    body,
                    body_from_here,
                } = &link.attachment;
                Some(Sail {
                    body: *body,
                    p_com_in_body: body_from_here
                        .transform_point(&link.inertia.com_m.into())
                        .coords,
                    drag: link.drag?,
                })
            });
        Self {
            step_s,
            motion: MeanMotion::new(robot),
            sails: sails.collect(),
            child: robot.links()[robot.joints()[joint].child]
                .attachment
                .clone(),
            parts: parts.collect(),
            carried,
        }
    }
}

impl Gauge for WrenchGauge {
    fn read(&mut self, seen: &Seen<'_>, around: &dyn Surroundings, values: &mut [f64]) {
        self.motion.update(seen, self.step_s);
        let (motion, step_s) = (&self.motion, self.step_s);
        let placed = motion.of(self.child.body).placed;
        let here = &self.child.body_from_here;
        let p_here = placed.position + placed.world_from_body * here.translation.vector;
        let world_from_here: Matrix3<f64> = placed.world_from_body * here.rotation.matrix();
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for part in &self.parts {
            let Motion {
                placed, w, dw, a, ..
            } = motion.of(part.body);
            let a = a - seen.gravity_m_s2;
            let h = placed.world_from_body * part.first_moment;
            let inertia = part.inertia.rotated(&placed.world_from_body);
            let f = a * part.mass_kg + dw.cross(&h) + w.cross(&w.cross(&h));
            let n = inertia.times(&dw) + w.cross(&inertia.times(&w)) + h.cross(&a);
            force += f;
            moment += n + (placed.position - p_here).cross(&f);
        }
        let air = around.air();
        for (sail, air) in self.sails.iter().filter_map(|sail| Some((sail, air?))) {
            let motion = motion.of(sail.body);
            let com = motion.at(&(motion.placed.world_from_body * sail.p_com_in_body));
            let pushed = air.drag_n(&sail.drag, &com.velocity);
            force -= pushed;
            moment -= (com.position - p_here).cross(&pushed);
        }
        for fact in seen.contacts {
            let [first, second] = fact
                .parties
                .map(|party| matches!(party, Party::Link(link) if self.carried[link]));
            let sign = match (first, second) {
                (false, true) => 1.0,
                (true, false) => -1.0,
                _ => continue,
            };
            let impulse = fact.normal_impulse_n_s + fact.friction_impulse_n_s;
            let turning = fact.moment_impulse_n_m_s - p_here.cross(&impulse);
            force -= impulse * (sign / step_s);
            moment -= turning * (sign / step_s);
        }
        let force = world_from_here.tr_mul(&force);
        let moment = world_from_here.tr_mul(&moment);
        values[..3].copy_from_slice(force.as_slice());
        values[3..].copy_from_slice(moment.as_slice());
    }
}

/// How every body moved in the middle of the last step, and its mean acceleration over it.
struct MeanMotion {
    motions: BodyMotions,
    /// Angular acceleration, and acceleration of the origin, that the joints' accelerations cause.
    caused: Vec<(Vector3<f64>, Vector3<f64>)>,
    q: Vec<f64>,
    qd: Vec<f64>,
}

impl MeanMotion {
    fn new(robot: &Robot) -> Self {
        let nothing = (Vector3::zeros(), Vector3::zeros());
        Self {
            motions: BodyMotions::new(robot),
            caused: vec![nothing; robot.bodies().len()],
            q: vec![0.0; robot.n()],
            qd: vec![0.0; robot.n()],
        }
    }

    /// Takes the motion of the step that ended in `seen`; before the first step there is none, and the state stands as
    /// it is, without acceleration.
    fn update(&mut self, seen: &Seen<'_>, step_s: f64) {
        let back_s = if seen.tick == 0 { 0.0 } else { 0.5 * step_s };
        for i in 0..self.q.len() {
            let (qd, qdd) = (seen.qd[i], seen.qdd[i]);
            self.qd[i] = qd - back_s * qdd;
            self.q[i] = seen.q[i] - back_s * qd + 0.5 * back_s * back_s * qdd;
        }
        self.motions.update(seen.robot, &self.q, &self.qd);
        for (i, body) in seen.robot.bodies().iter().enumerate() {
            let placed = self.motions.body(i).placed;
            let (mut dw, mut a) = (Vector3::zeros(), Vector3::zeros());
            if let Some(parent) = body.parent {
                let from = self.motions.body(parent).placed.position;
                (dw, a) = self.caused[parent];
                a += dw.cross(&(placed.position - from));
            }
            let drive = placed.axis() * body.rate(seen.qdd);
            if body.turns {
                dw += drive;
            } else {
                a += drive;
            }
            self.caused[i] = (dw, a);
        }
    }

    fn of(&self, body: Option<usize>) -> Motion {
        let Some(body) = body else {
            return Motion::STILL;
        };
        let motion = *self.motions.body(body);
        let (dw, a) = self.caused[body];
        Motion {
            dw: motion.dw + dw,
            a: motion.a + a,
            ..motion
        }
    }
}
