//! The programs of a new lab: what students begin with, and the reference solution.

use std::fmt::Write as _;

use super::fitting::LOOP_RAD_S;
use super::texts::returns;
use super::{NewLab, NewTask, NewTaskKind};

/// The function of a solution that moves to places, where no task asks for inverse kinematics.
const OF_PLACES: &str = "angles_for";

/// A function that students write.
#[derive(Debug)]
pub(super) struct StudentFunction {
    /// Its name.
    pub name: String,
    /// Its arguments, as in its first line.
    pub arguments: String,
    /// An answer that is none yet, of the right shape.
    pub answer: String,
    /// What the brief says that it returns.
    pub returns: &'static str,
}

impl NewLab<'_> {
    /// The functions that the tasks call, each once.
    pub(super) fn functions(&self) -> Vec<StudentFunction> {
        let mut all: Vec<StudentFunction> = Vec::new();
        for task in self.tasks {
            let function = self.function(task);
            if !all.iter().any(|known| known.name == function.name) {
                all.push(function);
            }
        }
        all
    }

    fn function(&self, task: &NewTask) -> StudentFunction {
        let n = self.robot.n();
        let zeros = |count: usize| format!("[{}]", vec!["0.0"; count].join(", "));
        let matrix = |rows: usize| format!("[{}]", vec![zeros(n); rows].join(", "));
        let angles = format!("[{}]", zeros(n));
        let (name, arguments, answer) = match task.kind {
            NewTaskKind::ForwardKinematics => ("forward_kinematics", "robot, q", zeros(3)),
            NewTaskKind::InverseKinematics => ("inverse_kinematics", "robot, position", angles),
            NewTaskKind::ForwardPose => {
                let unit = "[[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]";
                (
                    self.function_of_poses(task.kind).0,
                    "robot, q",
                    unit.to_owned(),
                )
            }
            NewTaskKind::InversePose => {
                (self.function_of_poses(task.kind).0, "robot, pose", angles)
            }
            NewTaskKind::Jacobian => ("jacobian", "robot, q", matrix(3)),
            NewTaskKind::Quantity(quantity) => {
                let answer = match quantity.is_matrix() {
                    true => matrix(n),
                    false => zeros(quantity.count(n)),
                };
                return StudentFunction {
                    name: quantity.name().to_owned(),
                    arguments: quantity.parameters().join(", "),
                    answer,
                    returns: returns(task.kind),
                };
            }
            NewTaskKind::Function => {
                return StudentFunction {
                    name: task.name.replace('-', "_"),
                    arguments: "given".to_owned(),
                    answer: "0.0".to_owned(),
                    returns: returns(task.kind),
                };
            }
            NewTaskKind::Motion
            | NewTaskKind::Goals
            | NewTaskKind::Velocity
            | NewTaskKind::Effort => ("control", "observation", zeros(n)),
        };
        StudentFunction {
            name: name.to_owned(),
            arguments: arguments.to_owned(),
            answer,
            returns: returns(task.kind),
        }
    }

    pub(super) fn starter(&self) -> String {
        let mut text =
            "// TODO: what students begin with. It runs, and earns next to nothing.\n".to_owned();
        for function in self.functions() {
            let StudentFunction {
                name,
                arguments,
                answer,
                ..
            } = function;
            let _ = write!(text, "\nfn {name}({arguments}) {{\n    {answer}\n}}\n");
        }
        text
    }

    pub(super) fn solution(&self) -> String {
        let mut text =
            "// The reference solution: a submission like a student's, which has full marks.\n"
                .to_owned();
        let goes_to_places = self.asks_for(NewTaskKind::Goals);
        if goes_to_places || self.asks_for(NewTaskKind::Effort) {
            let places = if goes_to_places {
                "    // joint positions, from the start to the last place\n    this.way = [];\n"
            } else {
                ""
            };
            let _ = write!(
                text,
                "\nfn init(robot, task) {{\n    this.robot = robot;\n{places}}}\n"
            );
        }
        let to_do = |name: &str| {
            format!(
                "    // TODO: write the solution\n    throw \"TODO: {name} of the reference solution\""
            )
        };
        for function in self.functions() {
            let StudentFunction {
                name, arguments, ..
            } = function;
            let body = if name == "control" {
                self.control()
            } else if arguments == "given" {
                "    // TODO: write the solution\n    given.x * given.x".to_owned()
            } else {
                to_do(&name)
            };
            let _ = write!(text, "\nfn {name}({arguments}) {{\n{body}\n}}\n");
        }
        if goes_to_places && !self.asks_for(NewTaskKind::InverseKinematics) {
            let body = to_do(OF_PLACES);
            let _ = write!(
                text,
                "\n// every `q` that brings the TCP to a place, as a list\nfn {OF_PLACES}(robot, position) {{\n{body}\n}}\n"
            );
        }
        text
    }

    /// The body of a `control` that goes where the target is, in each of its tasks.
    fn control(&self) -> String {
        let kinds = [
            NewTaskKind::Velocity,
            NewTaskKind::Effort,
            NewTaskKind::Goals,
            NewTaskKind::Motion,
        ];
        let body = |kind: NewTaskKind| match kind {
            NewTaskKind::Velocity => "    2.0 * (observation.target - observation.q)".to_owned(),
            NewTaskKind::Effort => self.effort(),
            NewTaskKind::Goals => self.to_places(),
            _ => "    observation.target".to_owned(),
        };
        let of_kind = |kind: NewTaskKind| -> Vec<String> {
            let tasks = self.tasks.iter().filter(move |task| task.kind == kind);
            tasks
                .map(|task| format!("observation.task == \"{}\"", task.name))
                .collect()
        };
        let there: Vec<_> = kinds
            .into_iter()
            .map(|kind| (kind, of_kind(kind)))
            .filter(|(_, tasks)| !tasks.is_empty())
            .collect();
        let Some(((last, _), before)) = there.split_last() else {
            return String::new();
        };
        let mut text = String::new();
        for (kind, tasks) in before {
            let body = body(*kind).replace("\n    ", "\n        ");
            let _ = write!(
                text,
                "    if {} {{\n    {body}\n    }} else ",
                tasks.join(" || ")
            );
        }
        let body = body(*last);
        match text.is_empty() {
            true => body,
            false => format!(
                "{text}{{\n    {}\n    }}",
                body.replace("\n    ", "\n        ")
            )
            .replace("else     if", "else if"),
        }
    }

    /// From place to place by the angles of inverse kinematics, with a stay at each.
    fn to_places(&self) -> String {
        let function = match self.asks_for(NewTaskKind::InverseKinematics) {
            true => "inverse_kinematics",
            false => OF_PLACES,
        };
        format!(
            "    if this.way.is_empty() {{\n        this.way.push(vector(observation.q));\n        \
             for place in observation.target {{ this.way.push(vector({function}(this.robot, place)[0])); }}\n    }}\n    \
             // two seconds to each place, and one second there\n    \
             let leg = if observation.time < 3.0 {{ 0 }} else {{ 1 }};\n    \
             let s = clamp((observation.time - 3.0 * leg) / 2.0, 0, 1);\n    \
             lerp(this.way[leg], this.way[leg + 1], quintic(s))"
        )
    }

    /// A spring and a damper on each joint, and gravity taken out.
    fn effort(&self) -> String {
        format!(
            "    // a spring and a damper on each joint, for loops of {LOOP_RAD_S} rad/s where the robot is at home\n    \
             let kp = {};\n    let kd = {};\n    let error = observation.target - observation.q;\n    \
             let command = this.robot.gravity(observation.q);\n    \
             for i in 0..{} {{ command[i] += kp[i] * error[i] - kd[i] * observation.qd[i]; }}\n    command",
            self.gains(LOOP_RAD_S * LOOP_RAD_S),
            self.gains(2.0 * LOOP_RAD_S),
            self.robot.n()
        )
    }
}
