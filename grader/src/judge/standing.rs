//! What moves by itself: bodies of a scene that fall or slide before anybody touches them.

use kinemark_sim::control::Mode;
use kinemark_sim::model::contact::Party;
use kinemark_sim::text::Source;

use super::opening::opening;
use super::playback::Player;
use crate::attempt::motion;
use crate::lab::{Lab, Task, TaskWork};
use crate::submission::handed_in::Submission;
use crate::task::value::Value;

/// How long the arm stands still \[s\].
const STANDS_S: f64 = 1.0;
/// A body that settles into its contacts moves by less \[m\].
const SETTLES_M: f64 = 2e-3;

/// A body that moves while the arm stands still and does not touch it.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedBody {
    /// The task.
    pub task: String,
    /// The body.
    pub body: String,
    /// How far it has moved after a second \[m\].
    pub moved_m: f64,
}

/// The bodies that move by themselves in the first second of each task with a scene. In mode `effort` nothing holds the arm, so that such
/// a task says nothing.
pub(crate) fn moved_bodies(lab: &Lab) -> Vec<MovedBody> {
    lab.tasks
        .iter()
        .flat_map(|task| moved_in(lab, task))
        .collect()
}

fn moved_in(lab: &Lab, task: &Task) -> Vec<MovedBody> {
    let TaskWork::Motion(work, _) = &task.work else {
        return Vec::new();
    };
    let Some(scene) = work
        .scene
        .as_ref()
        .filter(|_| work.servo.mode != Mode::Effort)
    else {
        return Vec::new();
    };
    let mut short = (**work).clone();
    while short.ticks > 1 && short.periods.time_s(short.ticks) > STANDS_S {
        short.ticks = short.ticks.div_ceil(2);
    }
    let submission = Submission::from(Source::new("still.rhai", "// stands still"));
    let command = match work.servo.mode {
        Mode::Position => work.start_q.clone(),
        Mode::Velocity | Mode::Effort | Mode::Prescribed => vec![0.0; work.start_q.len()],
    };
    let command = command.into_iter().map(Value::Number).collect();
    let opening = opening(lab, task, &submission);
    let cell = lab.of_task(task).workcell();
    let mut player = Player::of(&task.name, vec![Value::List(command)]);
    let run = motion::run(cell, &short, &opening, &mut player);
    let trace = &run.recorded;
    let Some(last) = trace.len().checked_sub(1) else {
        return Vec::new();
    };
    let by_arm = |index: usize| {
        let is_of_arm = |party: &Party| matches!(party, Party::Link(_));
        let mut spans = trace.contacts.iter();
        spans.any(|span| {
            span.parties.contains(&Party::Body(index)) && span.parties.iter().any(is_of_arm)
        })
    };
    let bodies = trace.moving_bodies.iter().enumerate();
    let moved = bodies
        .filter(|(_, index)| !by_arm(**index))
        .map(|(i, &index)| {
            let at = |tick: usize| {
                let pose = &trace.bodies.at(tick)[7 * i..7 * i + 3];
                nalgebra::Vector3::new(pose[0], pose[1], pose[2])
            };
            MovedBody {
                task: task.name.clone(),
                body: scene.scene.bodies[index].name.clone(),
                moved_m: (at(last) - at(0)).norm(),
            }
        });
    moved.filter(|body| body.moved_m > SETTLES_M).collect()
}
