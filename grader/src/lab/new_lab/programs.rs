//! The programs of a new lab: what students begin with, and the reference solution.

use std::fmt::Write as _;

use super::fitting::LOOP_RAD_S;
use super::{NewLab, NewTask, NewTaskKind};

impl NewLab<'_> {
    /// The functions that the tasks call, each once: name, arguments, and an answer that is none yet.
    pub(super) fn functions(&self) -> Vec<(String, String, String)> {
        let zeros = |count: usize| format!("[{}]", vec!["0.0"; count].join(", "));
        let mut all: Vec<(String, String, String)> = Vec::new();
        for task in self.tasks {
            let n = self.robot.n();
            let (name, arguments, answer) = match task.kind {
                NewTaskKind::ForwardKinematics => {
                    ("forward_kinematics".to_owned(), "robot, q", zeros(3))
                }
                NewTaskKind::InverseKinematics => (
                    "inverse_kinematics".to_owned(),
                    "robot, position",
                    format!("[{}]", zeros(n)),
                ),
                NewTaskKind::Jacobian => {
                    let rows = vec![zeros(n); 3].join(", ");
                    ("jacobian".to_owned(), "robot, q", format!("[{rows}]"))
                }
                NewTaskKind::Quantity(quantity) => {
                    let rows = vec![zeros(n); n].join(", ");
                    let answer = match quantity.is_matrix() {
                        true => format!("[{rows}]"),
                        false => zeros(quantity.count(n)),
                    };
                    let parameters = quantity.parameters().join(", ");
                    all.retain(|(known, ..)| known != quantity.name());
                    all.push((quantity.name().to_owned(), parameters, answer));
                    continue;
                }
                NewTaskKind::Function => (task.name.replace('-', "_"), "given", "0.0".to_owned()),
                NewTaskKind::Motion | NewTaskKind::Velocity | NewTaskKind::Effort => {
                    ("control".to_owned(), "observation", zeros(n))
                }
            };
            if !all.iter().any(|(known, ..)| *known == name) {
                all.push((name, arguments.to_owned(), answer));
            }
        }
        all
    }

    pub(super) fn starter(&self) -> String {
        let mut text =
            "// TODO: what students begin with. It runs, and earns next to nothing.\n".to_owned();
        for (name, arguments, answer) in self.functions() {
            let _ = write!(text, "\nfn {name}({arguments}) {{\n    {answer}\n}}\n");
        }
        text
    }

    pub(super) fn solution(&self) -> String {
        let mut text =
            "// The reference solution: a submission like a student's, which has full marks.\n"
                .to_owned();
        let is_by_effort = |task: &NewTask| task.kind == NewTaskKind::Effort;
        if self.tasks.iter().any(is_by_effort) {
            text += "\nfn init(robot, task) {\n    this.robot = robot;\n}\n";
        }
        for (name, arguments, _) in self.functions() {
            let body = if name == "control" {
                self.control()
            } else if arguments == "given" {
                "    // TODO: write the solution\n    given.x * given.x".to_owned()
            } else {
                format!(
                    "    // TODO: write the solution\n    throw \"TODO: {name} of the reference solution\""
                )
            };
            let _ = write!(text, "\nfn {name}({arguments}) {{\n{body}\n}}\n");
        }
        text
    }

    /// The body of a `control` that goes where the target is, in each of its tasks.
    fn control(&self) -> String {
        let kinds = [
            NewTaskKind::Velocity,
            NewTaskKind::Effort,
            NewTaskKind::Motion,
        ];
        let body = |kind: NewTaskKind| match kind {
            NewTaskKind::Velocity => "    2.0 * (observation.target - observation.q)".to_owned(),
            NewTaskKind::Effort => self.effort(),
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
