//! The robot in the engine: a multibody of the same joints, inertias, damping and armature; state and efforts in, state out.

use rapier3d_f64::dynamics::{
    GenericJointBuilder, JointAxesMask, JointAxis, MassProperties, MultibodyDofCoupling,
    MultibodyIndex, RigidBodyBuilder, RigidBodyHandle,
};
use rapier3d_f64::math::Pose as EnginePose;
use rapier3d_f64::pipeline::PhysicsWorld;

use super::collider::collider;
use super::contact_facts::to_user_data;
use super::convert::{engine_pose, matrix, rotation, vector};
use super::engine_error::EngineError;
use super::engine_settings::{LIMIT_SKIN, SURFACE};
use crate::kinematics::position_range::position_ranges;
use crate::model::contact::Party;
use crate::model::robot::{Body, Joint, JointKind, LoopKind, Robot};
use crate::spatial::Symmetric3;

/// Stiffness of the springs that apply the efforts \[N m/rad or N/m\]: a spring this soft, stretched far enough, gives a constant
/// effort to 13 digits, also on prismatic joints.
const CARRIER: f64 = 1e-6;

/// Solver iterations of a step for a robot with coupled joints, which converge more slowly than contacts alone.
const COUPLED_PASSES: usize = 4;

/// The robot as a multibody of the engine.
#[derive(Debug, Clone)]
pub(super) struct Arm {
    multibody: MultibodyIndex,
    joints: Vec<ArmJoint>,
    /// For each entry of `q`, the body whose joint it is.
    masters: Vec<usize>,
    /// For each entry of `q`, its range.
    ranges: Vec<(f64, f64)>,
    displacements: Vec<f64>,
    handles: Vec<RigidBodyHandle>,
    present: bool,
}

#[derive(Debug, Clone)]
struct ArmJoint {
    link: usize,
    axis: usize,
    slot: usize,
}

/// Adds the links that do not move to the world, on one fixed body.
pub(super) fn insert_base(
    robot: &Robot,
    physics: &mut PhysicsWorld,
) -> Result<RigidBodyHandle, EngineError> {
    let root = physics.insert_body(RigidBodyBuilder::fixed());
    insert_shapes(robot, None, root, physics)?;
    Ok(root)
}

fn insert_shapes(
    robot: &Robot,
    body: Option<usize>,
    parent: RigidBodyHandle,
    physics: &mut PhysicsWorld,
) -> Result<(), EngineError> {
    for (index, link) in robot.links().iter().enumerate() {
        if link.attachment.body != body {
            continue;
        }
        for shape in &link.shapes {
            let place = &link.attachment.body_from_here;
            let surface = link.contact.unwrap_or(SURFACE);
            let built = collider(&link.name, shape, place, surface)?
                .user_data(to_user_data(Party::Link(index)));
            physics.insert_collider(built, Some(parent));
        }
    }
    Ok(())
}

fn mass_properties(body: &Body) -> MassProperties {
    if body.mass_kg <= 0.0 {
        return MassProperties::default();
    }
    let com = body.first_moment / body.mass_kg;
    let of_mass = Symmetric3::of_point_mass(body.mass_kg, &com);
    let about_com = body.inertia.to_matrix() - of_mass.to_matrix();
    MassProperties::with_inertia_matrix(vector(&com), body.mass_kg, matrix(&about_com))
}

impl Arm {
    /// Builds the multibody on the fixed body `root`; `None` for a robot without joints.
    pub(super) fn insert(
        robot: &Robot,
        root: RigidBodyHandle,
        physics: &mut PhysicsWorld,
    ) -> Result<Option<Self>, EngineError> {
        let mut handles: Vec<RigidBodyHandle> = Vec::new();
        let mut multibody_joint = None;
        for (index, body) in robot.bodies().iter().enumerate() {
            let rigid = RigidBodyBuilder::dynamic()
                .additional_mass_properties(mass_properties(body))
                // springs and contacts do nothing to a sleeping arm
                .can_sleep(false);
            let handle = physics.insert_body(rigid);
            insert_shapes(robot, Some(index), handle, physics)?;
            let parent = body.parent.map_or(root, |parent| handles[parent]);
            let locked = JointAxesMask::LOCKED_FIXED_AXES - free_axis(body);
            let joint = GenericJointBuilder::new(locked)
                .local_frame1(EnginePose::from_parts(
                    vector(&body.p_body_in_parent),
                    rotation(&body.parent_from_body),
                ))
                .contacts_enabled(false);
            let inserted = physics
                .multibody_joints
                .insert(parent, handle, joint.build(), true);
            multibody_joint = Some(inserted.ok_or_else(|| refused(robot, index))?);
            handles.push(handle);
        }
        let Some(any) = multibody_joint else {
            return Ok(None);
        };
        let multibody = physics
            .multibody_joints
            .rigid_body_link(RigidBodyHandle(any.0))
            .map(|link| link.multibody)
            .ok_or_else(|| refused(robot, 0))?;
        let arm = Self::describe(robot, multibody, &handles, physics);
        arm.close_loops(robot, root, &handles, physics);
        Ok(Some(arm))
    }

    fn describe(
        robot: &Robot,
        index: MultibodyIndex,
        handles: &[RigidBodyHandle],
        physics: &mut PhysicsWorld,
    ) -> Self {
        let links: Vec<usize> = handles
            .iter()
            .map(|handle| {
                physics
                    .multibody_joints
                    .rigid_body_link(*handle)
                    .map_or(0, |link| link.id)
            })
            .collect();
        let masters: Vec<usize> = robot
            .moving_joints()
            .map(|joint| robot.links()[joint.child].attachment.body.unwrap_or(0))
            .collect();
        let mut joints = Vec::new();
        if let Some(multibody) = physics.multibody_joints.get_multibody_mut(index) {
            multibody.set_self_contacts_enabled(false);
            // only now the fixed root loses its six degrees of freedom
            multibody.forward_kinematics(&physics.bodies, true);
            multibody.update_rigid_bodies(&mut physics.bodies, true);
            for (body, link) in robot.bodies().iter().zip(&links) {
                joints.push(ArmJoint {
                    link: *link,
                    axis: if body.turns { 5 } else { 2 },
                    slot: multibody.link(*link).map_or(0, |link| link.assembly_id()),
                });
            }
            for (body, joint) in robot.bodies().iter().zip(&joints) {
                multibody.damping_mut()[joint.slot] = body.damping;
                multibody.armature_mut()[joint.slot] = body.armature;
                multibody.frictions_mut()[joint.slot] = body.dry_friction;
            }
            for (body_index, body) in robot.bodies().iter().enumerate() {
                let master = masters[body.q_index];
                if master != body_index {
                    multibody.add_dof_coupling(MultibodyDofCoupling {
                        link1: joints[master].link,
                        dof1: 0,
                        axis1: joints[master].axis,
                        link2: joints[body_index].link,
                        dof2: 0,
                        axis2: joints[body_index].axis,
                        coeff: body.gear,
                        offset: body.offset,
                    });
                }
            }
        }
        if !robot.is_plain_tree() {
            physics.integration_parameters.num_internal_pgs_iterations = COUPLED_PASSES;
        }
        Self {
            multibody: index,
            displacements: vec![0.0; joints.len()],
            handles: handles.to_vec(),
            present: true,
            joints,
            masters,
            ranges: position_ranges(robot)
                .iter()
                .map(|r| (r.lower, r.upper))
                .collect(),
        }
    }

    fn close_loops(
        &self,
        robot: &Robot,
        root: RigidBodyHandle,
        handles: &[RigidBodyHandle],
        physics: &mut PhysicsWorld,
    ) {
        for closed in robot.loops() {
            let [first, second] = &closed.ends;
            let body = |index: Option<usize>| index.map_or(root, |index| handles[index]);
            let locked = match closed.kind {
                LoopKind::Revolute => JointAxesMask::LOCKED_FIXED_AXES - JointAxesMask::ANG_Z,
                LoopKind::Spherical => JointAxesMask::LOCKED_SPHERICAL_AXES,
            };
            let joint = GenericJointBuilder::new(locked)
                .local_frame1(engine_pose(&first.body_from_here))
                .local_frame2(engine_pose(&second.body_from_here))
                .contacts_enabled(false);
            physics.insert_impulse_joint(body(first.body), body(second.body), joint.build());
        }
    }

    /// Its bodies.
    pub(super) fn handles(&self) -> &[RigidBodyHandle] {
        &self.handles
    }

    /// Removes the robot from the world, to save time, or puts it back; then its state must be written before the next step.
    pub(super) fn set_present(&mut self, physics: &mut PhysicsWorld, present: bool) {
        if self.present == present {
            return;
        }
        self.present = present;
        for handle in &self.handles {
            physics.bodies[*handle].set_enabled(present);
        }
    }

    /// Puts the multibody into the state `(q, qd)` and under `effort`, all finite and of shape `(n)`.
    pub(super) fn write(
        &mut self,
        robot: &Robot,
        physics: &mut PhysicsWorld,
        effort: &[f64],
        q: &[f64],
        qd: &[f64],
    ) {
        let Some(multibody) = physics.multibody_joints.get_multibody_mut(self.multibody) else {
            return;
        };
        let mut moved = false;
        for (body, joint) in robot.bodies().iter().zip(&self.joints) {
            let now = multibody
                .link(joint.link)
                .map_or(0.0, |link| link.joint.coords()[joint.axis]);
            let displacement = body.position(q) - now;
            moved |= displacement != 0.0;
            self.displacements[joint.slot] = displacement;
            let rate = body.rate(qd);
            let slot = &mut multibody.generalized_velocity_mut()[joint.slot];
            moved |= *slot - rate != 0.0;
            *slot = rate;
        }
        // after a step in contact the multibody is where the robot is
        if moved {
            multibody.apply_displacements(&self.displacements);
            multibody.forward_kinematics(&physics.bodies, false);
            multibody.update_rigid_bodies(&mut physics.bodies, true);
        }
        for (entry, master) in self.masters.iter().enumerate() {
            let joint = &self.joints[*master];
            let Some(link) = multibody.link_mut(joint.link) else {
                continue;
            };
            link.joint
                .set_spring(joint.axis, CARRIER, q[entry] + effort[entry] / CARRIER);
            let (lower, upper) = self.ranges[entry];
            if lower.is_finite() || upper.is_finite() {
                // a joint that starts outside is not thrown back in
                let low = lower.min(q[entry]).max(-f64::MAX) + LIMIT_SKIN;
                let high = upper.max(q[entry]).min(f64::MAX) - LIMIT_SKIN;
                link.joint
                    .data
                    .set_limits(axis_of(joint.axis), [low.min(high), high.max(low)]);
            }
        }
    }

    /// Reads the state of the multibody, shape `(n)` each.
    pub(super) fn read(&self, physics: &PhysicsWorld, q: &mut [f64], qd: &mut [f64]) {
        let Some(multibody) = physics.multibody_joints.get_multibody(self.multibody) else {
            return;
        };
        for (entry, master) in self.masters.iter().enumerate() {
            let joint = &self.joints[*master];
            if let Some(link) = multibody.link(joint.link) {
                q[entry] = link.joint.coords()[joint.axis];
                qd[entry] = multibody.generalized_velocity()[joint.slot];
            }
        }
    }
}

fn free_axis(body: &Body) -> JointAxesMask {
    if body.turns {
        JointAxesMask::ANG_Z
    } else {
        JointAxesMask::LIN_Z
    }
}

fn axis_of(axis: usize) -> JointAxis {
    if axis == 5 {
        JointAxis::AngZ
    } else {
        JointAxis::LinZ
    }
}

fn refused(robot: &Robot, body: usize) -> EngineError {
    let moves = |joint: &&Joint| {
        joint.kind != JointKind::Fixed && robot.links()[joint.child].attachment.body == Some(body)
    };
    let joint = robot.joints().iter().find(moves);
    EngineError::Joint {
        joint: joint.map_or_else(String::new, |joint| joint.name.clone()),
        kind: joint.map_or(JointKind::Fixed, |joint| joint.kind),
    }
}
