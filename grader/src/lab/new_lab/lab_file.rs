//! lab.toml of a new lab.

use std::fmt::Write as _;

use kinemark_sim::text::number::{list, trimmed};

use super::fitting::{CONTINUUM, LOOP_RAD_S, PLACE_BAND, significant};
use super::{NewLab, NewTask, NewTaskKind, STATE_KEYS, parameter, places, schema_line};
use crate::task::quantity::Quantity;

impl NewLab<'_> {
    pub(super) fn lab_toml(&self) -> String {
        let mut text = schema_line("lab");
        let _ = write!(
            text,
            "# What each key means: docs/lab-format.md. TODO marks what a person has to decide.\n\
             format = 1\nname = \"{}\"\ntitle = \"TODO: one line that students read\"\n\
             summary = \"TODO: one sentence, which `kinemark` lists\"\nrobot = \"{}\"\nframe = \"{}\"\n",
            self.name,
            self.robot_name,
            self.frame(),
        );
        let moving: Vec<&NewTask> = self.tasks.iter().filter(|task| task.kind.moves()).collect();
        if !moving.is_empty() {
            text += "\n# Numbers that hidden runs, and with [variants] also students, have others of.\n[parameters]\n";
            for task in &moving {
                if task.kind == NewTaskKind::Goals {
                    for (sample, name) in (1..).zip(places(task)) {
                        let place = list(&self.place(sample).0);
                        let _ = writeln!(text, "{name} = {place}  # a place of the TCP, m");
                    }
                    continue;
                }
                let _ = writeln!(
                    text,
                    "{} = {}  # joint positions",
                    parameter(task),
                    list(&self.q(self.sample(task)))
                );
            }
        }
        for task in self.tasks {
            let name = &task.name;
            let _ = write!(
                text,
                "\n# {}\n[[tasks]]\nname = \"{name}\"\ntitle = \"TODO: {name}\"\n\n",
                "-".repeat(100)
            );
            text.push_str(&self.task_toml(task));
        }
        text
    }

    fn task_toml(&self, task: &NewTask) -> String {
        match task.kind {
            NewTaskKind::ForwardKinematics => [
                "[tasks.function]\ncall = \"forward_kinematics\"\n".to_owned(),
                self.cases_of_angles(),
                check_toml(
                    "position",
                    4,
                    "# full: the worst that still earns everything; zero: what earns nothing\n\
                     fk-error = { full_m = 1e-4, zero_m = 5e-3 }",
                ),
            ]
            .concat(),
            NewTaskKind::ForwardPose => [
                self.call_of_poses(task.kind),
                "pose = \"full\"  # a 4 x 4 matrix\n".to_owned(),
                self.cases_of_angles(),
                check_toml("position", 2, "fk-error = { full_m = 1e-4, zero_m = 5e-3 }"),
                check_toml(
                    "turn",
                    2,
                    "fk-orientation = { full_rad = 1e-4, zero_rad = 0.05 }",
                ),
            ]
            .concat(),
            NewTaskKind::InverseKinematics => self.inverse_kinematics_toml(),
            NewTaskKind::InversePose => self.inverse_pose_toml(task.kind),
            NewTaskKind::Jacobian => [
                "[tasks.function]\ncall = \"jacobian\"\nrows = [\"x\", \"y\", \"z\"]\n".to_owned(),
                self.cases_of_angles(),
                check_toml("entries", 4, "jacobian-match = { full = 0.01, zero = 0.1 }"),
            ]
            .concat(),
            NewTaskKind::Quantity(quantity) => self.quantity_toml(quantity),
            NewTaskKind::Function => [
                "# TODO: what the function is given, and what a right answer is: a number, a list of numbers, or a table of these\n"
                    .to_owned(),
                format!("[tasks.function]\ncall = \"{}\"\n", task.name.replace('-', "_")),
                cases_toml([
                    "{ name = \"TODO: case 1\", given = { x = 2.0 }, expected = 4.0 }".to_owned(),
                    "{ name = \"TODO: case 2\", given = { x = -0.5 }, expected = 0.25 }".to_owned(),
                ]),
                check_toml("answer", 2, "function-cases = { full = 0.001, zero = 0.1 }"),
            ]
            .concat(),
            NewTaskKind::Motion => self.motion_toml(task, "position"),
            NewTaskKind::Goals => self.goals_toml(task),
            NewTaskKind::Velocity => self.motion_toml(task, "velocity"),
            NewTaskKind::Effort => self.motion_toml(task, "effort"),
        }
    }

    /// Two visible cases of joint positions.
    fn cases_of_angles(&self) -> String {
        cases_toml([1, 2].map(|sample| {
            let q = list(&self.q(sample));
            format!("{{ name = \"TODO: case {sample}\", q_rad = {q} }}")
        }))
    }

    fn quantity_toml(&self, quantity: Quantity) -> String {
        let cases = [1, 2].map(|sample| {
            let state = self.state(quantity, sample);
            let keys = STATE_KEYS.iter().zip(&state);
            let keys: Vec<String> = keys
                .map(|(key, numbers)| format!("{key} = {}", list(numbers)))
                .collect();
            format!("{{ name = \"TODO: case {sample}\", {} }}", keys.join(", "))
        });
        [
            format!("[tasks.function]\ncall = \"{}\"\n", quantity.name()),
            format!(
                "least_size = {}  # near zero, what is off is a part of this\n",
                trimmed(self.least_size(quantity), 6)
            ),
            cases_toml(cases),
            check_toml("answer", 4, "function-cases = { full = 1e-6, zero = 0.1 }"),
        ]
        .concat()
    }

    fn inverse_kinematics_toml(&self) -> String {
        let cases = [1, 2].map(|sample| {
            let (place, branches) = self.place(sample);
            let place = list(&place);
            format!(
                "{{ name = \"TODO: case {sample}\", position_m = {place}, branches = {branches} }}"
            )
        });
        let mut text = [
            "[tasks.function]\ncall = \"inverse_kinematics\"\n".to_owned(),
            cases_toml(cases),
            check_toml("reach", 4, "ik-reach = { full_m = 1e-3, zero_m = 1e-2 }"),
        ]
        .concat();
        if (2..CONTINUUM).contains(&self.place(1).1) {
            let kind = "ik-branches = { full_m = 1e-3, zero_m = 1e-2 }";
            text.push_str(&check_toml("branches", 2, kind));
        }
        text
    }

    /// The begin of the table of a task about poses.
    fn call_of_poses(&self, kind: NewTaskKind) -> String {
        let (name, call) = self.function_of_poses(kind);
        let renamed = match name == call {
            true => String::new(),
            false => format!("as = \"{name}\"\n"),
        };
        format!("[tasks.function]\ncall = \"{call}\"\n{renamed}")
    }

    fn inverse_pose_toml(&self, kind: NewTaskKind) -> String {
        // `files` has refused a robot without them
        let Some(poses) = self.poses() else {
            return String::new();
        };
        let form = poses[0].form.name();
        let listed = (2..CONTINUUM).contains(&poses[0].branches);
        let mut number = 0;
        let cases = poses.map(|pose| {
            number += 1;
            format!(
                "{{ name = \"TODO: case {number}\", {}, branches = {} }}",
                pose.keys, pose.branches
            )
        });
        let band = "{ full_m = 1e-3, zero_m = 1e-2, full_rad = 1e-3, zero_rad = 1e-2 }";
        let mut text = [
            self.call_of_poses(kind),
            format!("pose = \"{form}\"  # how much of the pose is asked for\n"),
            cases_toml(cases),
            check_toml("reach", 4, &format!("ik-reach = {band}")),
        ]
        .concat();
        if listed {
            text.push_str(&check_toml("branches", 2, &format!("ik-branches = {band}")));
        }
        text
    }

    fn goals_toml(&self, task: &NewTask) -> String {
        let [first, second] = places(task);
        let zero = significant(PLACE_BAND * self.between_places());
        [
            format!(
                "[tasks.motion]\nmode = \"position\"  # what a command of `control` is\nduration_s = 8.0\ngoals = [\n    \
                 {{ position_m = \"= {first}\", dwell_s = 0.5 }},\n    {{ position_m = \"= {second}\", dwell_s = 0.5 }},\n]\n{}",
                self.servo(task.kind)
            ),
            check_toml(
                "places",
                4,
                &format!(
                    "pose-reached = {{ full_m = {}, zero_m = {} }}",
                    trimmed(0.1 * zero, 9),
                    trimmed(zero, 9)
                ),
            ),
        ]
        .concat()
    }

    fn motion_toml(&self, task: &NewTask, mode: &str) -> String {
        let name = parameter(task);
        let mut joints = self.robot.moving_joints().enumerate();
        let driven = joints.find(|(_, joint)| !joint.passive);
        let (entry, joint) = driven.map_or((0, "?"), |(entry, joint)| (entry, joint.name.as_str()));
        [
            format!(
                "[tasks.motion]\nmode = \"{mode}\"  # what a command of `control` is\nduration_s = 5.0\ntarget = \"= {name}\"\n{}",
                self.servo(task.kind)
            ),
            check_toml(
                "arrives",
                4,
                &format!(
                    "joint-reached = {{ joint = \"{joint}\", position_rad = \"= {name}[{entry}]\", hold_s = 0.5, full_rad = 0.01, zero_rad = 0.1 }}"
                ),
            ),
        ]
        .concat()
    }

    /// A servo for the inertias that the joints have at home; in mode `effort`, what the controller is lent in its place.
    fn servo(&self, kind: NewTaskKind) -> String {
        let gains = match kind {
            NewTaskKind::Effort => {
                return "# TODO: what students may call; without it they compensate gravity themselves\ngrants = [\"gravity\"]\n".to_owned();
            }
            NewTaskKind::Velocity => format!("kp = {}", self.gains(2.0 * LOOP_RAD_S)),
            _ => format!(
                "kp = {}, kd = {}, derivative = \"velocity\"",
                self.gains(LOOP_RAD_S * LOOP_RAD_S),
                self.gains(2.0 * LOOP_RAD_S)
            ),
        };
        format!(
            "# TODO: gains of the servo; these are for loops of {LOOP_RAD_S} rad/s where the robot is at home\n\
             servo = {{ {gains}, gravity_compensation = true }}\n"
        )
    }
}

/// The visible cases of a function task.
fn cases_toml([first, second]: [String; 2]) -> String {
    format!("cases = [\n    {first},\n    {second},\n]\n")
}

/// A check with its kind.
fn check_toml(name: &str, points: u32, kind: &str) -> String {
    format!(
        "\n[[tasks.checks]]\nname = \"{name}\"\ntitle = \"TODO: what earns these points\"\npoints = {points}\n\
         hints = [\n    \"TODO: a question that leads to the mistake?\",\n]\n{kind}\n"
    )
}
