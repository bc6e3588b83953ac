//! From parts to the immutable robot: names become indices, links moving bodies, loops conditions that a closed position meets.

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::description::{Description, JointPart};
use super::heavy_meshes;
use super::unphysical_links::{self, Settled};
use crate::format::robot_problem::{KIND, RobotError, RobotProblem};
use crate::kinematics::closure;
use crate::model::inertia::Inertia;
use crate::model::robot::{Attachment, Body, Frame, Joint, JointKind, Link, Loop, Mimic, Robot};
use crate::part::part_problem::PartProblem;
use crate::spatial::{Pose, Symmetric3, pose};
use crate::text::Spanned;

/// A robot with loops has at most this many of them: each makes a dense system larger.
const MOST_LOOPS: usize = 50;

/// A robot with loops has at most this many joints that move, for the same reason.
const MOST_LOOPED_JOINTS: usize = 300;

/// A robot has at most this many links: far beyond any real one, and small enough that no short text makes a large robot.
pub(crate) const MOST_LINKS: usize = 2000;

impl Description {
    /// Fits the parts together.
    pub(crate) fn assemble(&self) -> Result<Robot, RobotError> {
        Assembler { parts: self }.robot()
    }
}

pub(super) struct Assembler<'a> {
    pub(super) parts: &'a Description,
}

impl Assembler<'_> {
    pub(super) fn err<T>(
        &self,
        at: Range<usize>,
        problem: impl Into<RobotProblem>,
    ) -> Result<T, RobotError> {
        Err(RobotError::new(problem.into(), &self.parts.source, at))
    }

    /// Names of one kind, each checked to be usable and to be there once.
    fn names<'n>(
        &self,
        what: &'static str,
        names: impl Iterator<Item = &'n Spanned<String>>,
        taken: &BTreeMap<&str, usize>,
    ) -> Result<BTreeMap<&'n str, usize>, RobotError> {
        let mut seen = BTreeMap::new();
        for (index, at) in names.enumerate() {
            let name = at.get_ref().as_str();
            // `world` may be the root, as URDFs have it, and nothing else
            if name.trim().is_empty() || (name == "world" && (what, index) != ("link", 0)) {
                let name = name.to_owned();
                return self.err(
                    at.span(),
                    PartProblem::BadName {
                        what,
                        name,
                        help: "a name is not empty, and `world` is taken by the world itself",
                    },
                );
            }
            if taken.contains_key(name) || seen.insert(name, index).is_some() {
                let name = name.to_owned();
                return self.err(at.span(), PartProblem::Duplicate { what, name });
            }
        }
        Ok(seen)
    }

    fn index(
        &self,
        what: &'static str,
        name: &Spanned<String>,
        known: &BTreeMap<&str, usize>,
    ) -> Result<usize, RobotError> {
        match known.get(name.get_ref().as_str()) {
            Some(&index) => Ok(index),
            None => {
                let problem = PartProblem::unknown(what, name.get_ref(), known.keys().copied());
                self.err(name.span(), problem)
            }
        }
    }

    fn robot(&self) -> Result<Robot, RobotError> {
        let parts = self.parts;
        if parts.links.is_empty() {
            return self.err(parts.at.clone(), RobotProblem::NoLinks);
        }
        if parts.links.len() > MOST_LINKS {
            let problem = PartProblem::TooLarge {
                kind: KIND,
                parts: "links",
                found: parts.links.len(),
                most: MOST_LINKS,
            };
            return self.err(parts.at.clone(), problem);
        }
        let nothing = BTreeMap::new();
        let link_names = self.names("link", parts.links.iter().map(|l| &l.name), &nothing)?;
        let joint_names = self.names("joint", parts.joints.iter().map(|j| &j.name), &nothing)?;
        self.names("frame", parts.frames.iter().map(|f| &f.name), &link_names)?;

        let joints: Vec<Joint> = parts
            .joints
            .iter()
            .map(|part| self.joint(part, &link_names, &joint_names))
            .collect::<Result<_, _>>()?;
        let order = self.order(&joints)?;
        let moving: Vec<usize> = (0..joints.len())
            .filter(|&j| joints[j].kind != JointKind::Fixed && joints[j].mimic.is_none())
            .collect();
        let drives: Vec<Drive> = (0..joints.len())
            .map(|j| self.drive(&joints, &moving, j))
            .collect::<Result<_, _>>()?;
        let (attachments, mut bodies) = bodies(&joints, &order, &drives, parts.links.len());
        let mut links: Vec<Link> = parts
            .links
            .iter()
            .zip(attachments)
            .map(|(part, attachment)| Link {
                name: part.name.get_ref().clone(),
                shapes: part.shapes.clone(),
                inertia: part.inertia,
                contact: part.contact,
                drag: part.drag,
                attachment,
            })
            .collect();
        let Settled { refused, warnings } = unphysical_links::settle(parts, &mut links);
        let warnings = parts.warnings.iter().cloned().chain(warnings);
        let warnings = warnings.chain(heavy_meshes::warning(&links)).collect();
        let world_inertia = gather_inertia(&links, &mut bodies);
        let frames = self.frames(&links, &link_names)?;
        let named_tcp = frames.iter().position(|frame| frame.name == "tcp");
        let loops = self.loops(&links, &link_names)?;
        let n = moving.len();
        let home: Vec<f64> = moving.iter().map(|&j| joints[j].guess).collect();
        let robot = Robot {
            name: parts.name.clone(),
            dimensions: parts.dimensions.clone(),
            links,
            joints,
            moving,
            tcp: named_tcp.unwrap_or(parts.links.len() - 1),
            frames,
            bodies,
            world_inertia,
            loops,
            dependent: Vec::new(),
            independent: (0..n).collect(),
            home,
            warnings,
            unphysical: refused,
            sensors: Vec::new(),
        };
        self.closed(robot)
    }

    fn joint(
        &self,
        part: &JointPart,
        links: &BTreeMap<&str, usize>,
        joints: &BTreeMap<&str, usize>,
    ) -> Result<Joint, RobotError> {
        let mimic = match &part.mimic {
            None => None,
            Some(mimic) => {
                let joint = self.index("joint", &mimic.joint, joints)?;
                let refuse = |message: String, help: &str| {
                    let help = help.to_owned();
                    self.err(mimic.joint.span(), RobotProblem::Mimic { message, help })
                };
                if part.kind == JointKind::Fixed {
                    let message = format!(
                        "joint `{}` is fixed and mimics nothing",
                        part.name.get_ref()
                    );
                    return refuse(
                        message,
                        "drop the mimic, or give the joint a type that moves",
                    );
                }
                if self.parts.joints[joint].kind == JointKind::Fixed {
                    let message = format!("joint `{}` does not move", mimic.joint.get_ref());
                    return refuse(message, "name a joint that moves as the master");
                }
                Some(Mimic {
                    joint,
                    multiplier: mimic.multiplier,
                    offset: mimic.offset,
                })
            }
        };
        Ok(Joint {
            name: part.name.get_ref().clone(),
            kind: part.kind,
            parent: self.index("link", &part.parent, links)?,
            child: self.index("link", &part.child, links)?,
            parent_from_child: part.parent_from_child,
            axis: part.axis,
            damping: part.damping,
            dry_friction: part.dry_friction,
            armature: part.armature,
            drive: part.drive,
            limits: part.limits,
            mimic,
            passive: part.passive,
            guess: part.guess,
        })
    }

    /// Which entry of `q` moves joint `j`, through any chain of masters.
    fn drive(&self, joints: &[Joint], moving: &[usize], j: usize) -> Result<Drive, RobotError> {
        let (mut gear, mut offset, mut master) = (1.0, 0.0, j);
        for _ in 0..=joints.len() {
            match joints[master].mimic {
                Some(mimic) => {
                    offset += gear * mimic.offset;
                    gear *= mimic.multiplier;
                    master = mimic.joint;
                }
                None => {
                    return Ok(Drive {
                        q_index: moving.binary_search(&master).ok(),
                        gear,
                        offset,
                    });
                }
            }
        }
        let part = &self.parts.joints[j];
        let problem = RobotProblem::Mimic {
            message: format!("joint `{}` mimics itself in a circle", part.name.get_ref()),
            help: "one joint of the circle must have an entry of its own".to_owned(),
        };
        self.err(part.name.span(), problem)
    }

    fn frames(
        &self,
        links: &[Link],
        link_names: &BTreeMap<&str, usize>,
    ) -> Result<Vec<Frame>, RobotError> {
        let mut frames: Vec<Frame> = links
            .iter()
            .enumerate()
            .map(|(index, link)| Frame {
                name: link.name.clone(),
                link: index,
                attachment: link.attachment.clone(),
            })
            .collect();
        for part in &self.parts.frames {
            let link = self.index("link", &part.link, link_names)?;
            frames.push(Frame {
                name: part.name.get_ref().clone(),
                link,
                attachment: on_link(&links[link], &part.link_from_frame),
            });
        }
        Ok(frames)
    }

    fn loops(
        &self,
        links: &[Link],
        link_names: &BTreeMap<&str, usize>,
    ) -> Result<Vec<Loop>, RobotError> {
        let mut loops = Vec::with_capacity(self.parts.loops.len());
        for part in &self.parts.loops {
            let [first, second] = &part.links;
            let ends = [
                self.index("link", first, link_names)?,
                self.index("link", second, link_names)?,
            ];
            if links[ends[0]].attachment.body == links[ends[1]].attachment.body {
                let problem = RobotProblem::Loop {
                    message: format!(
                        "links `{}` and `{}` do not move against each other",
                        first.get_ref(),
                        second.get_ref()
                    ),
                    help: "a loop joins two links that a joint lies between".to_owned(),
                };
                return self.err(part.at.clone(), problem);
            }
            loops.push(Loop {
                kind: part.kind,
                links: ends,
                link_from_end: part.link_from_end,
                ends: [0, 1].map(|i| on_link(&links[ends[i]], &part.link_from_end[i])),
            });
        }
        Ok(loops)
    }

    /// Decides which joints the loops make dependent, and closes the loops.
    fn closed(&self, mut robot: Robot) -> Result<Robot, RobotError> {
        let Some(first) = self.parts.loops.first() else {
            // guesses are for loops; a plain tree is at home at zero
            robot.home.fill(0.0);
            return Ok(robot);
        };
        let (loops, joints) = (robot.loops.len(), robot.n());
        if loops > MOST_LOOPS || joints > MOST_LOOPED_JOINTS {
            let problem = RobotProblem::Loop {
                message: format!("{loops} loops over {joints} joints are too many"),
                help: format!(
                    "a robot with loops has at most {MOST_LOOPS} of them and {MOST_LOOPED_JOINTS} joints that move"
                ),
            };
            return self.err(first.at.clone(), problem);
        }
        match closure::dependents(&robot) {
            Ok(closure::Dependents { dependent, home }) => {
                robot.independent.retain(|i| !dependent.contains(i));
                robot.dependent = dependent;
                robot.home = home;
                Ok(robot)
            }
            Err(problem) => self.err(
                first.at.clone(),
                RobotProblem::Loop {
                    message: problem.to_string(),
                    help: problem.help().to_owned(),
                },
            ),
        }
    }
}

/// What moves a joint: an entry of `q`, and how.
#[derive(Debug, Clone, Copy)]
struct Drive {
    q_index: Option<usize>,
    gear: f64,
    offset: f64,
}

fn on_link(link: &Link, link_from_here: &Pose) -> Attachment {
    Attachment {
        body: link.attachment.body,
        body_from_here: link.attachment.body_from_here * link_from_here,
    }
}

/// Where every link is fixed, and the bodies that move; both without mass.
fn bodies(
    joints: &[Joint],
    order: &[usize],
    drives: &[Drive],
    links: usize,
) -> (Vec<Attachment>, Vec<Body>) {
    let world = Attachment {
        body: None,
        body_from_here: Pose::identity(),
    };
    let mut attachments = vec![world; links];
    let mut bodies: Vec<Body> = Vec::with_capacity(joints.len());
    for &j in order {
        let joint = &joints[j];
        let parent = &attachments[joint.parent];
        let body_from_child = parent.body_from_here * joint.parent_from_child;
        attachments[joint.child] = match (joint.kind, drives[j].q_index) {
            (JointKind::Fixed, _) | (_, None) => Attachment {
                body: parent.body,
                body_from_here: body_from_child,
            },
            (_, Some(q_index)) => {
                let child_from_body = axes_with_z_along(&joint.axis);
                bodies.push(Body {
                    parent: parent.body,
                    turns: joint.kind.turns(),
                    q_index,
                    gear: drives[j].gear,
                    offset: drives[j].offset,
                    parent_from_body: body_from_child.rotation.matrix() * child_from_body,
                    p_body_in_parent: body_from_child.translation.vector,
                    mass_kg: 0.0,
                    first_moment: Vector3::zeros(),
                    inertia: Symmetric3::default(),
                    damping: joint.damping,
                    dry_friction: joint.dry_friction.mean(),
                    dry_skew: joint.dry_friction.skew(),
                    armature: joint.armature
                        + joint.drive.map_or(0.0, |drive| drive.felt_inertia()),
                });
                Attachment {
                    body: Some(bodies.len() - 1),
                    body_from_here: pose(child_from_body.transpose(), Vector3::zeros()),
                }
            }
        };
    }
    (attachments, bodies)
}

/// Gives every body the mass of the links fixed to it; returns what is fixed to the world.
fn gather_inertia(links: &[Link], bodies: &mut [Body]) -> Inertia {
    let mut sums = vec![Inertia::zero(); bodies.len()];
    let mut world = Inertia::zero();
    for link in links {
        let Attachment {
            body,
            body_from_here,
        } = &link.attachment;
        let part = link.inertia.seen_from(body_from_here);
        let sum = body.map_or(&mut world, |body| &mut sums[body]);
        *sum = sum.plus(&part);
    }
    for (body, sum) in bodies.iter_mut().zip(sums) {
        body.mass_kg = sum.mass_kg;
        body.first_moment = sum.com_m * sum.mass_kg;
        body.inertia = sum.about_origin_kg_m2();
    }
    world
}

/// Axes, as columns, whose third is `axis`; a cyclic or signed permutation, and so exact, where `axis` is a coordinate axis.
pub(crate) fn axes_with_z_along(axis: &Vector3<f64>) -> Matrix3<f64> {
    let largest = axis.iamax();
    let mut beside = Vector3::zeros();
    beside[(largest + 1) % 3] = 1.0;
    let x = (beside - axis * axis.dot(&beside)).normalize();
    Matrix3::from_columns(&[x, axis.cross(&x), *axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinate_axes_are_exact() {
        for axis in [
            Vector3::x(),
            Vector3::y(),
            Vector3::z(),
            -Vector3::x(),
            -Vector3::y(),
            -Vector3::z(),
        ] {
            let m = axes_with_z_along(&axis);
            assert!(m.iter().all(|v| *v == 0.0 || v.abs() == 1.0), "{m}");
            assert_eq!(m.determinant(), 1.0);
            assert_eq!(m * Vector3::z(), axis);
        }
    }
}
