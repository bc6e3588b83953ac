//! What moves, as a log records it: the scene once, then frames, TCP and joints, and the reference's where it is to be shown.

use foxglove::messages::{
    FrameTransforms, JointState, JointStates, Pose, PoseInFrame, SceneUpdate,
};
use kinemark_sim::kinematics::FramePoses;

use super::bodies::Bodies;
use super::mcap::LogError;
use super::message::{finite, quaternion, time, vector};
use super::messages::Messages;
use super::names::{REFERENCE, frame_id_of};
use super::scene;
use super::tree::Tree;

/// Poses and joint states a second.
const POSE_RATE_HZ: f64 = 60.0;

impl Messages<'_> {
    pub(super) fn scenes(&mut self) -> Result<(), LogError> {
        let topic = self.known_topic::<SceneUpdate>("/scene")?;
        self.message(topic, 0, &scene::scene(self.run))?;
        if let Some(reference) = scene::reference(self.run) {
            let topic = self.known_topic::<SceneUpdate>("/reference/scene")?;
            self.message(topic, 0, &reference)?;
        }
        Ok(())
    }

    /// Every frame, the TCP, the joints.
    pub(super) fn motion(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let tf = self.known_topic::<FrameTransforms>("/tf")?;
        let tcp = self.known_topic::<PoseInFrame>("/tcp")?;
        let states = self.known_topic::<JointStates>("/joint_states")?;
        let tree = Tree::new(&run.robot, "");
        let bodies = Bodies::new(run);
        let lab = frame_id_of(&run.robot, &run.seen_from);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            let ns = self.ns(tick as u64);
            let timestamp = time(ns);
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
                    position: Some(vector([row[0], row[1], row[2]])),
                    orientation: Some(quaternion([row[3], row[4], row[5], row[6]])),
                };
                let message = PoseInFrame {
                    timestamp: Some(timestamp),
                    frame_id: lab.clone(),
                    pose: Some(pose),
                };
                self.message(tcp, ns, &message)?;
            }
            let joints = run
                .robot
                .moving_joints()
                .enumerate()
                .map(|(i, joint)| JointState {
                    name: joint.name.clone(),
                    position: finite(q[i]),
                    velocity: finite(qd[i]),
                    acceleration: None,
                    effort: finite(effort[i]),
                });
            let message = JointStates {
                timestamp: Some(timestamp),
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
        let tf = self.known_topic::<FrameTransforms>("/reference/tf")?;
        let tree = Tree::new(&run.robot, REFERENCE);
        let bodies = Bodies::of_reference(run, trace);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            // a run that goes on longer than the reference's shows how that ended
            let Some(at) = trace.len().checked_sub(1).map(|last| tick.min(last)) else {
                break;
            };
            let ns = self.ns(tick as u64);
            let timestamp = time(ns);
            poses.update(&run.robot, trace.q.at(at));
            let mut transforms = tree.transforms(&poses, timestamp);
            bodies.add(trace, at, timestamp, &mut transforms);
            self.message(tf, ns, &transforms)?;
        }
        Ok(())
    }
}
