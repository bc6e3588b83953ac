//! What a new lab has besides lab.toml and programs: hidden numbers, mutants, the brief.

use std::fmt::Write as _;

use kinemark_sim::text::number::trimmed;

use super::{NewLab, NewTaskKind, STATE_KEYS, parameter, schema_line};

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
        let whole = || format!("q_rad = {}", self.whole());
        for task in self.tasks {
            let name = &task.name;
            let draws = match task.kind {
                NewTaskKind::ForwardKinematics | NewTaskKind::Jacobian => {
                    draw(name, "other angles", whole())
                }
                NewTaskKind::InverseKinematics => {
                    let (_, branches) = self.place(1);
                    let what = format!("q_rad = {}\nbranches = {branches}", self.about(1));
                    draw(name, "places nearby", what)
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
                    format!(
                        "\n[[runs]]\ntask = \"{name}\"\nclass = \"another place\"\ncount = 1\nparameters = {{ {} = {} }}\n",
                        parameter(task),
                        self.beside(self.sample(task))
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
        for (name, arguments, _) in self.functions() {
            let what = match name.as_str() {
                "forward_kinematics" => {
                    "the position of the TCP in the lab's frame, [x, y, z] in m"
                }
                "inverse_kinematics" => {
                    "every `q` that brings the TCP there, a list of lists; `[]` where it cannot get there"
                }
                "jacobian" => {
                    "the derivative of the TCP's position by `q`: rows x, y, z, a column for each joint"
                }
                "velocity" => {
                    "the velocity of the TCP along the axes of the lab's frame, [x, y, z] in m/s"
                }
                "acceleration" => {
                    "the acceleration of the TCP along the axes of the lab's frame, [x, y, z] in m/s²"
                }
                "gravity" => "the efforts that hold the robot still, one for each joint",
                "coriolis" => "the Coriolis and centrifugal efforts, one for each joint",
                "torque" => {
                    "the efforts for this motion, gravity and friction included, one for each joint"
                }
                "mass_matrix" => "the joint-space inertia matrix, a list of rows",
                "control" => "one number for each joint, at every call",
                _ => "TODO: what, in which unit",
            };
            let _ = writeln!(text, "| `{name}({arguments})` | {what} |");
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
            if task.kind.moves() {
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
