//! What moves, as a log records it: the scene once, then frames, TCP and joints, and the reference's where it is to be shown.

use kinemark_sim::kinematics::FramePoses;

use super::bodies::Bodies;
use super::mcap::LogError;
use super::message::{JointState, JointStates, Pose, PoseInFrame, Quaternion, Time, Vector};
use super::messages::Messages;
use super::names::{REFERENCE, frame_id_of};
use super::tree::Tree;
use super::{scene, schema};

/// Poses and joint states a second.
const POSE_RATE_HZ: f64 = 60.0;

impl Messages<'_> {
    pub(super) fn scenes(&mut self) -> Result<(), LogError> {
        let topic = self.topic("/scene", "foxglove.SceneUpdate", schema::scene_update());
        self.message(topic, 0, &scene::scene(self.run))?;
        if let Some(reference) = scene::reference(self.run) {
            let topic = self.topic(
                "/reference/scene",
                "foxglove.SceneUpdate",
                schema::scene_update(),
            );
            self.message(topic, 0, &reference)?;
        }
        Ok(())
    }

    /// Every frame, the TCP, the joints.
    pub(super) fn motion(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let tf = self.topic(
            "/tf",
            "foxglove.FrameTransforms",
            schema::frame_transforms(),
        );
        let tcp = self.topic("/tcp", "foxglove.PoseInFrame", schema::pose_in_frame());
        let states = self.topic(
            "/joint_states",
            "foxglove.JointStates",
            schema::joint_states(),
        );
        let tree = Tree::new(&run.robot, "");
        let bodies = Bodies::new(run);
        let lab = frame_id_of(&run.robot, &run.seen_from);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            let ns = self.ns(tick as u64);
            let timestamp = Time::from_ns(ns);
            let (q, qd, effort) = (
                run.trace.q.at(tick),
                run.trace.qd.at(tick),
                run.trace.effort.at(tick),
            );
            if q.iter().all(|q| q.is_finite()) {
                poses.update(&run.robot, q);
                let mut transforms = tree.transforms(&poses, timestamp);
                bodies.add(&run.trace, tick, timestamp, &mut transforms);
                self.message(tf, ns, &transforms)?;
            }
            let row = run.trace.tcp.at(tick);
            if row.iter().all(|x| x.is_finite()) {
                let pose = Pose {
                    position: Vector::new([row[0], row[1], row[2]]),
                    orientation: Quaternion::new([row[3], row[4], row[5], row[6]]),
                };
                let message = PoseInFrame {
                    timestamp,
                    frame_id: &lab,
                    pose,
                };
                self.message(tcp, ns, &message)?;
            }
            let joints = run
                .robot
                .moving_joints()
                .enumerate()
                .map(|(i, joint)| JointState {
                    name: &joint.name,
                    position: q[i],
                    velocity: qd[i],
                    effort: effort[i],
                });
            let message = JointStates {
                timestamp,
                joints: joints.collect(),
            };
            self.message(states, ns, &message)?;
        }
        Ok(())
    }

    /// The reference solution's motion, where it is to be shown: its links, and what of the scene can move.
    pub(super) fn ghost(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let Some(trace) = &run.reference_overlay else {
            return Ok(());
        };
        let tf = self.topic(
            "/reference/tf",
            "foxglove.FrameTransforms",
            schema::frame_transforms(),
        );
        let tree = Tree::new(&run.robot, REFERENCE);
        let bodies = Bodies::of_reference(run, trace);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            // a run that goes on longer than the reference's shows how that ended
            let Some(at) = trace.len().checked_sub(1).map(|last| tick.min(last)) else {
                break;
            };
            let ns = self.ns(tick as u64);
            let timestamp = Time::from_ns(ns);
            poses.update(&run.robot, trace.q.at(at));
            let mut transforms = tree.transforms(&poses, timestamp);
            bodies.add(trace, at, timestamp, &mut transforms);
            self.message(tf, ns, &transforms)?;
        }
        Ok(())
    }
}
