//! Which visible cases of a function task a page draws, and what is right and wrong in each.

use kinemark_sim::kinematics::{FramePoses, stick_figure};
use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;

use super::case_grades::{SAME_ANGLE_RAD, is_good};
use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::branches::{beyond_limit, count_different, count_distinct};
use crate::attempt::measure::entry_error;
use crate::record::shown_case::{
    AnsweredPlace, BranchCount, ComparedNumber, ComparedNumbers, ShownCase, ShownCases, ShownPlaces,
};
use crate::task::entry::Entry;
use crate::task::model::{Band, Compared, Function, FunctionTask, Given};
use crate::task::pose::{PoseForm, pose_in};

/// Cases of a task that are drawn: more are not looked at.
const MOST_SHOWN: usize = 12;
/// Answered branches of a case that are drawn.
const MOST_BRANCHES: usize = 8;

/// The cases of the task called `name` that are drawn; positions are in `frame`.
pub(super) fn shown_cases(
    (name, frame): (&str, &str),
    task: &FunctionTask,
    facts: &[CaseFacts<'_>],
    band: Band,
) -> ShownCases {
    let seen = Seen { task, frame, band };
    let visible = facts.iter().filter(|facts| facts.is_visible());
    let (good, wrong): (Vec<_>, Vec<_>) = visible.partition(|facts| is_good(facts, band));
    let shown = wrong.into_iter().chain(good).take(MOST_SHOWN);
    let cases = shown.map(|facts| ShownCase {
        name: facts.case.name.clone(),
        is_good: is_good(facts, band),
        places: seen.places(facts),
        numbers: match is_good(facts, band) {
            true => Vec::new(),
            false => seen.numbers(facts),
        },
    });
    ShownCases {
        task: name.to_owned(),
        seen_from: frame.to_owned(),
        cases: cases.collect(),
    }
}

struct Seen<'t> {
    task: &'t FunctionTask,
    frame: &'t str,
    band: Band,
}

impl Seen<'_> {
    fn places(&self, facts: &CaseFacts<'_>) -> Option<ShownPlaces> {
        let robot = facts.robot;
        let point = |p: &Vector3<f64>| [p.x, p.y, p.z];
        let (right_m, arm_m, branches, answered) = match (&facts.case.given, &self.task.function) {
            (Given::Q(q), Function::ForwardKinematics(form)) => {
                let truth = pose_in(robot, self.frame, q)?;
                let tcp_m = match &facts.answer {
                    Answered::Position(p) => Some(point(p)),
                    Answered::Pose(numbers) => Some(point(&form.position(numbers))),
                    _ => None,
                };
                let answered = tcp_m.map(|tcp_m| AnsweredPlace {
                    tcp_m,
                    arm_m: Vec::new(),
                    is_right: is_good(facts, self.band),
                });
                let arm_m = self.arm(robot, q);
                (
                    point(&truth.translation.vector),
                    arm_m,
                    None,
                    Vec::from_iter(answered),
                )
            }
            (
                Given::Position {
                    position_m,
                    branches,
                    pose,
                },
                Function::InverseKinematics(form),
            ) => {
                let rows = match &facts.answer {
                    Answered::Branches(rows) => rows.as_slice(),
                    _ => &[],
                };
                let target = (*branches > 0).then_some(pose.as_slice());
                let place = |q: &Vec<f64>| self.branch(robot, q, (target, *form));
                let places: Vec<(AnsweredPlace, &Vec<f64>)> =
                    rows.iter().filter_map(|q| Some((place(q)?, q))).collect();
                let right = places.iter().filter(|(place, _)| place.is_right);
                let right: Vec<Vec<f64>> = right.map(|(_, q)| (*q).clone()).collect();
                let found = match form.is_turned() {
                    true => count_different(robot, &right),
                    false => count_distinct(robot, &right),
                };
                let count = BranchCount {
                    found: found as u32,
                    all: *branches,
                };
                let places = places.into_iter().map(|(place, _)| place);
                let places = places.take(MOST_BRANCHES).collect();
                (*position_m, Vec::new(), Some(count), places)
            }
            _ => return None,
        };
        Some(ShownPlaces {
            upward: self.upward(robot),
            right_m,
            arm_m,
            branches,
            answered,
        })
    }

    /// Where an answered branch puts the arm; nothing is right where no branch exists.
    fn branch(
        &self,
        robot: &Robot,
        q: &[f64],
        (target, form): (Option<&[f64]>, PoseForm),
    ) -> Option<AnsweredPlace> {
        let pose = pose_in(robot, self.frame, q)?;
        let counts = !self.task.about.within_limits || beyond_limit(robot, q).is_none();
        let p = pose.translation.vector;
        Some(AnsweredPlace {
            tcp_m: [p.x, p.y, p.z],
            arm_m: self.arm(robot, q),
            is_right: counts
                && target.is_some_and(|target| {
                    let (off_m, off_rad) = form.off(&form.of(&pose), target);
                    off_m <= self.band.full && off_rad <= SAME_ANGLE_RAD
                }),
        })
    }

    fn arm(&self, robot: &Robot, q: &[f64]) -> Vec<[f64; 3]> {
        let mut poses = FramePoses::new(robot);
        poses.update(robot, q);
        stick_figure(robot, &poses, robot.frame(self.frame))
    }

    fn upward(&self, robot: &Robot) -> [f64; 3] {
        let mut poses = FramePoses::new(robot);
        poses.update(robot, robot.home());
        let up = robot.frame(self.frame).map_or(Vector3::z(), |frame| {
            poses
                .world_from(frame)
                .inverse_transform_vector(&Vector3::z())
        });
        [up.x, up.y, up.z]
    }

    fn numbers(&self, facts: &CaseFacts<'_>) -> Vec<ComparedNumbers> {
        match (&facts.answer, &facts.error, &facts.case.given) {
            (Answered::Matrix(rows), CaseError::Jacobian { truth, .. }, _) => {
                let (answered, right) = (rows.concat(), truth.concat());
                // an entry that is off by less than the whole may be is not what costs points
                let most = self.band.full * right.iter().map(|x| x * x).sum::<f64>().sqrt();
                let pairs = answered.iter().zip(&right);
                let numbers = pairs.map(|(a, r)| compared(*a, *r, (a - r).abs() <= most));
                vec![ComparedNumbers {
                    name: String::new(),
                    columns: truth.first().map_or(1, Vec::len).max(1),
                    numbers: numbers.collect(),
                }]
            }
            (Answered::Pose(answered), CaseError::Pose { .. }, Given::Q(q)) => {
                self.pose_numbers(facts.robot, answered, q)
            }
            (Answered::Entries(answered), _, _) => {
                let entries = facts.expected().iter().zip(answered);
                let entries = entries.map(|((name, right), answered)| {
                    entry_numbers(
                        name,
                        right,
                        answered,
                        (&self.task.about.compared, self.band),
                    )
                });
                entries.collect()
            }
            _ => Vec::new(),
        }
    }

    fn pose_numbers(&self, robot: &Robot, answered: &[f64], q: &[f64]) -> Vec<ComparedNumbers> {
        let Function::ForwardKinematics(form) = &self.task.function else {
            return Vec::new();
        };
        let Some(truth) = pose_in(robot, self.frame, q) else {
            return Vec::new();
        };
        let columns = match form {
            PoseForm::Full => 4,
            _ => form.numbers(),
        };
        let is_length = |i: usize| match form {
            PoseForm::Full => i % 4 == 3,
            _ => i < 3,
        };
        let pairs = answered.iter().zip(form.of(&truth)).enumerate();
        let numbers = pairs.map(|(i, (answered, right))| {
            let most = if is_length(i) {
                self.band.full
            } else {
                SAME_ANGLE_RAD
            };
            let off = match form {
                PoseForm::Yaw if !is_length(i) => {
                    let circle = 2.0 * std::f64::consts::PI;
                    let turn = (answered - right).abs() % circle;
                    turn.min(circle - turn)
                }
                _ => (answered - right).abs(),
            };
            compared(*answered, right, off <= most)
        });
        vec![ComparedNumbers {
            name: String::new(),
            columns,
            numbers: numbers.collect(),
        }]
    }
}

fn compared(answered: f64, right: f64, is_right: bool) -> ComparedNumber {
    ComparedNumber {
        answered,
        right,
        is_right,
    }
}

/// The numbers of one entry: all are right where the entry is, else those that alone would be.
fn entry_numbers(
    name: &str,
    right: &Entry,
    answered: &[f64],
    (how, band): (&Compared, Band),
) -> ComparedNumbers {
    let all = right.numbers();
    let is_right = entry_error(answered, &all, name, how) <= band.full;
    let pairs = answered.iter().enumerate().map(|(i, answered)| {
        // the entry with only this number of the answer
        let mut only = all.clone();
        only[i] = *answered;
        let alone = entry_error(&only, &all, name, how) <= band.full;
        compared(*answered, all[i], is_right || alone)
    });
    ComparedNumbers {
        name: name.to_owned(),
        columns: match right {
            Entry::Matrix(rows) => rows.first().map_or(1, Vec::len).max(1),
            Entry::Number(_) | Entry::List(_) => all.len().max(1),
        },
        numbers: pairs.collect(),
    }
}
