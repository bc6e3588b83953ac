//! How everything moved: where links and bodies were in the world at every moment looked at, from a trace.

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::trace::{Trace, pose_numbers};

use super::course::{Course, What};
use super::frames::sound_ticks;

/// Positions are rounded to this part of the unit of length; joint positions that are angles to this \[rad\].
pub(super) const PLACE: f64 = 1e-5;
/// Elements of quaternions are rounded to this.
const TURN: f64 = 2e-5;

/// A course of poses, rounded as finely as `unit_m` \[m\] requires.
pub(super) fn poses(unit_m: f64) -> Course {
    let place = PLACE * unit_m;
    let quanta = [place, place, place, TURN, TURN, TURN, TURN];
    Course::new(What::Pose, &quanta, unit_m)
}

/// How all links of a robot and all bodies of its scene that can move did move.
pub(super) struct Motion {
    /// Of each link; none of one that cannot move.
    pub(super) links: Vec<Option<Course>>,
    /// Of each body in the trace's order.
    pub(super) bodies: Vec<Course>,
}

impl Motion {
    /// The motion in a trace at `looked`, ticks of `step_s`; after its end everything stays where it was. Without a sound row a
    /// course has one row: where the arm is as its file has it.
    pub(super) fn of(
        robot: &Robot,
        trace: &Trace,
        looked: &[usize],
        step_s: f64,
        unit_m: f64,
    ) -> Self {
        let mut now = FramePoses::new(robot);
        let ticks = sound_ticks(trace);
        let frames = &robot.frames()[..robot.links().len()];
        let mut links: Vec<Option<Course>> = frames
            .iter()
            .map(|frame| frame.attachment.body.map(|_| poses(unit_m)))
            .collect();
        if ticks == 0 {
            for (course, frame) in links.iter_mut().zip(frames) {
                if let Some(course) = course {
                    course.push(&pose_numbers(&now.world_from(frame)));
                }
            }
            return Self {
                links,
                bodies: Vec::new(),
            };
        }
        let mut bodies: Vec<Course> = trace.moving_bodies.iter().map(|_| poses(unit_m)).collect();
        let mut at = None;
        for tick in looked {
            // two traces may have steps of different length
            let tick = if trace.step_s.total_cmp(&step_s).is_eq() {
                *tick
            } else {
                (*tick as f64 * step_s / trace.step_s).round() as usize
            };
            let tick = tick.min(ticks - 1);
            if at != Some(tick) {
                now.update(robot, trace.q.at(tick));
                at = Some(tick);
            }
            for (course, frame) in links.iter_mut().zip(frames) {
                if let Some(course) = course {
                    course.push(&pose_numbers(&now.world_from(frame)));
                }
            }
            for (i, course) in bodies.iter_mut().enumerate() {
                course.push(&trace.bodies.at(tick)[7 * i..7 * i + 7]);
            }
        }
        Self { links, bodies }
    }
}
