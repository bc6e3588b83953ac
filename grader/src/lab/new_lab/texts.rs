//! What a new lab has besides lab.toml and programs: hidden numbers, mutants, the brief.

use std::fmt::Write as _;

use kinemark_sim::text::number::trimmed;

use super::programs::StudentFunction;
use super::{NewLab, NewTaskKind, STATE_KEYS, parameter, places, schema_line};
use crate::task::pose::PoseForm;
use crate::task::quantity::Quantity;

impl NewLab<'_> {
    pub(super) fn hidden(&self) -> String {
        let mut text = schema_line("hidden");
        let _ = write!(
            text,
            "# Cases and runs that submissions are graded on and students do not see: `kinemark lab draws {}` lists them.\n\
             # Write another salt every year: `kinemark lab check` doubts one that others may know.\n\
             format = 1\nsalt = \"{}\"\n",
            self.name, self.salt
        );
        let draw = |name: &str, class: &str, what: String| {
            format!(
                "\n[[draws]]\ntask = \"{name}\"\nclass = \"{class}\"  # all that students see of it\ncount = 10\n{what}\n"
            )
        };
        let run = |name: &str, class: &str, parameters: &str| {
            format!(
                "\n[[runs]]\ntask = \"{name}\"\nclass = \"{class}\"\ncount = 1\nparameters = {{ {parameters} }}\n"
            )
        };
        let whole = || format!("q_rad = {}", self.whole());
        for task in self.tasks {
            let name = &task.name;
            let draws = match task.kind {
                NewTaskKind::ForwardKinematics
                | NewTaskKind::ForwardPose
                | NewTaskKind::Jacobian => draw(name, "other angles", whole()),
                NewTaskKind::InverseKinematics => {
                    let (_, branches) = self.place(1);
                    let what = format!("q_rad = {}\nbranches = {branches}", self.about(1));
                    draw(name, "places nearby", what)
                }
                NewTaskKind::InversePose => {
                    let form = self.poses().map_or(PoseForm::Full, |poses| poses[0].form);
                    let (ranges, branches) = self.about_pose(form, 1);
                    let what = format!("q_rad = {ranges}\nbranches = {branches}");
                    draw(name, "poses nearby", what)
                }
                NewTaskKind::Goals => {
                    let samples = (1..).map(|sample| self.beside_place(sample));
                    let ranges = places(task).into_iter().zip(samples);
                    let ranges: Vec<String> = ranges
                        .map(|(name, range)| format!("{name} = {range}"))
                        .collect();
                    run(name, "other places", &ranges.join(", "))
                }
                NewTaskKind::Quantity(quantity) => {
                    let mut lines = vec![whole()];
                    let any = vec!["[-1.0, 1.0]"; self.robot.n()].join(", ");
                    let keys = STATE_KEYS.iter().take(quantity.order()).skip(1);
                    lines.extend(keys.map(|key| format!("{key} = [{any}]")));
                    draw(name, "other motions", lines.join("\n"))
                }
                NewTaskKind::Function => draw(
                    name,
                    "other numbers",
                    "given = { x = [-3.0, 3.0] }".to_owned(),
                ),
                NewTaskKind::Motion | NewTaskKind::Velocity | NewTaskKind::Effort => {
                    let range = self.beside(self.sample(task));
                    run(
                        name,
                        "another place",
                        &format!("{} = {range}", parameter(task)),
                    )
                }
            };
            text.push_str(&draws);
        }
        text
    }

    pub(super) fn mutants(&self) -> String {
        let task = &self.tasks[0].name;
        let text = format!(
            "# Submissions that make one common mistake each, and what a student who makes it reads. A lab needs at least six.\n\
             # mutants/NAME.rhai is the solution with the mistake:\n\
             #\n# [[mutants]]\n# name = \"degrees\"\n# tasks = [\"{task}\"]\n# says = \"The angles are in degrees. All angles are in radians.\"\n\
             format = 1\n"
        );
        schema_line("mutants") + text.as_str()
    }

    pub(super) fn brief(&self) -> String {
        let mut text = "# TODO: the title of the lab\n\nTODO: in two sentences, what one can do afterwards.\n\n## What you write\n\n\
             | function | returns |\n|---|---|\n"
            .to_owned();
        for function in self.functions() {
            let StudentFunction {
                name,
                arguments,
                returns,
                ..
            } = function;
            let _ = writeln!(text, "| `{name}({arguments})` | {returns} |");
        }
        let joints: Vec<String> = self
            .robot
            .moving_joints()
            .map(|joint| format!("`{}`", joint.name))
            .collect();
        let _ = write!(
            text,
            "\nThe joints are, in the order of `q`: {}.\n",
            joints.join(", ")
        );
        for task in self.tasks {
            let _ = write!(
                text,
                "\n## {}: TODO\n\nTODO: what is asked for, with its theory and its numbers.\n",
                task.name
            );
            if task.kind == NewTaskKind::InversePose {
                let form = self
                    .poses()
                    .map_or(PoseForm::Position, |poses| poses[0].form);
                let _ = writeln!(text, "`pose` is {}.", given(form));
            }
            if task.kind == NewTaskKind::Goals {
                let [first, _] = places(task);
                let _ = writeln!(
                    text,
                    "`observation.target` holds the places of the TCP in the lab's frame, one after the other; the x of your first is {}<!-- = {first}[0] --> m. Stay at each for half a second.",
                    trimmed(self.place(1).0[0], 4)
                );
            } else if task.kind.moves() {
                let name = parameter(task);
                let _ = writeln!(
                    text,
                    "`observation.target` holds the positions that the joints should have; yours begin with {}<!-- = {name}[0] -->.",
                    trimmed(self.q(self.sample(task))[0], 2)
                );
                if task.kind == NewTaskKind::Effort {
                    text += "`robot.gravity(q)` is there: the efforts that hold the robot still at `q`.\n";
                }
            }
        }
        text + "\n## How it is graded\n\n<!-- grading: begin -->\n<!-- grading: end -->\n"
    }
}

/// What the function of a task returns, as a brief says it.
pub(super) fn returns(kind: NewTaskKind) -> &'static str {
    match kind {
        NewTaskKind::ForwardKinematics => {
            "the position of the TCP in the lab's frame, [x, y, z] in m"
        }
        NewTaskKind::InverseKinematics => {
            "every `q` that brings the TCP there, a list of lists; `[]` where it cannot get there"
        }
        NewTaskKind::ForwardPose => {
            "the 4 x 4 matrix that takes the TCP's frame to the lab's, a list of rows"
        }
        NewTaskKind::InversePose => {
            "every `q` that brings the TCP into the pose, a list of lists; `[]` where it cannot get there"
        }
        NewTaskKind::Jacobian => {
            "the derivative of the TCP's position by `q`: rows x, y, z, a column for each joint"
        }
        NewTaskKind::Quantity(Quantity::Velocity(_)) => {
            "the velocity of the TCP along the axes of the lab's frame, [x, y, z] in m/s"
        }
        NewTaskKind::Quantity(Quantity::Acceleration(_)) => {
            "the acceleration of the TCP along the axes of the lab's frame, [x, y, z] in m/s²"
        }
        NewTaskKind::Quantity(Quantity::Gravity) => {
            "the efforts that hold the robot still, one for each joint"
        }
        NewTaskKind::Quantity(Quantity::Coriolis) => {
            "the Coriolis and centrifugal efforts, one for each joint"
        }
        NewTaskKind::Quantity(Quantity::Torque) => {
            "the efforts for this motion, gravity and friction included, one for each joint"
        }
        NewTaskKind::Quantity(Quantity::MassMatrix) => {
            "the joint-space inertia matrix, a list of rows"
        }
        NewTaskKind::Function => "TODO: what, in which unit",
        NewTaskKind::Motion | NewTaskKind::Goals | NewTaskKind::Velocity | NewTaskKind::Effort => {
            "one number for each joint, at every call"
        }
    }
}

/// What a function is given for a pose of this form, as a brief says it.
fn given(form: PoseForm) -> &'static str {
    match form {
        PoseForm::Position => "[x, y, z] in m, in the lab's frame",
        PoseForm::Yaw => {
            "[x, y, z, yaw]: m and rad, in the lab's frame; the yaw is the heading of the TCP's x axis"
        }
        PoseForm::Axis { .. } => {
            "[x, y, z, ax, ay, az]: the place in m, and the direction of the TCP's z axis, in the lab's frame"
        }
        PoseForm::Full => {
            "the 4 x 4 matrix that takes the TCP's frame to the lab's, a list of rows"
        }
    }
}
