//! How everything moved: poses of links and bodies in the world, frame by frame, from a trace.

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::robot::Robot;
use kinemark_sim::trace::{Trace, pose_numbers};

use super::column::Columns;
use super::frames::sound_ticks;

/// Positions are told to this \[m\], joint positions too \[rad or m\].
pub(super) const PLACE: f64 = 1e-5;
/// Elements of quaternions are told to this.
const TURN: f64 = 2e-5;
const POSE: [f64; 7] = [PLACE, PLACE, PLACE, TURN, TURN, TURN, TURN];

/// How one node moved.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    /// Where it is first.
    pub(super) start: [f64; 7],
    /// Where it is in every frame, its quaternion without jumps of sign.
    pub(super) columns: Columns,
    turn: [f64; 4],
}

impl Course {
    fn new(start: [f64; 7]) -> Self {
        Self {
            start,
            columns: Columns::new(&POSE),
            turn: [start[3], start[4], start[5], start[6]],
        }
    }

    fn push(&mut self, mut pose: [f64; 7]) {
        // a turn and its negative are the same; the nearer one lets a viewer go between two frames
        let dot: f64 = (0..4).map(|i| self.turn[i] * pose[3 + i]).sum();
        if dot < 0.0 {
            pose[3..].iter_mut().for_each(|x| *x = -*x);
        }
        self.turn.copy_from_slice(&pose[3..]);
        self.columns.push(&pose);
    }
}

/// How all links of a robot and all bodies of its scene that can move did move.
pub(super) struct Motion {
    /// Of each link; none of one that cannot move.
    pub(super) links: Vec<Option<Course>>,
    /// Of each body in the trace's order.
    pub(super) bodies: Vec<Course>,
}

impl Motion {
    /// The motion in a trace at `frames`, ticks of `step_s`; after its end everything stays where it was.
    pub(super) fn of(robot: &Robot, trace: &Trace, frames: &[usize], step_s: f64) -> Self {
        let mut poses = FramePoses::new(robot);
        let ticks = sound_ticks(trace);
        let link_frames = &robot.frames()[..robot.links().len()];
        let place = |poses: &mut FramePoses, tick: Option<usize>| {
            if let Some(tick) = tick {
                poses.update(robot, trace.q.at(tick));
            }
        };
        let first = (ticks > 0).then_some(0);
        place(&mut poses, first);
        let mut links: Vec<Option<Course>> = link_frames
            .iter()
            .map(|frame| {
                let moves = frame.attachment.body.is_some();
                moves.then(|| Course::new(pose_numbers(&poses.world_from(frame))))
            })
            .collect();
        let body = |tick: usize, i: usize| -> [f64; 7] {
            let mut pose = [0.0; 7];
            pose.copy_from_slice(&trace.bodies.at(tick)[7 * i..7 * i + 7]);
            pose
        };
        let count = if ticks > 0 {
            trace.moving_bodies.len()
        } else {
            0
        };
        let mut bodies: Vec<Course> = (0..count).map(|i| Course::new(body(0, i))).collect();
        if ticks > 0 {
            for frame in frames {
                // two traces may have steps of different length
                let tick = if trace.step_s.total_cmp(&step_s).is_eq() {
                    *frame
                } else {
                    (*frame as f64 * step_s / trace.step_s).round() as usize
                };
                let tick = tick.min(ticks - 1);
                place(&mut poses, Some(tick));
                for (course, frame) in links.iter_mut().zip(link_frames) {
                    if let Some(course) = course {
                        course.push(pose_numbers(&poses.world_from(frame)));
                    }
                }
                for (i, course) in bodies.iter_mut().enumerate() {
                    course.push(body(tick, i));
                }
            }
        }
        Self { links, bodies }
    }
}
