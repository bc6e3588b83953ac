//! The files of a lab that somebody begins: tasks with numbers that fit its robot, and a comment wherever a person has to decide.

use std::fmt::Write as _;

use kinemark_sim::dynamics::crba::mass_matrix;
use kinemark_sim::dynamics::{GRAVITY_M_S2, immovable_joint};
use kinemark_sim::kinematics::branches::{BranchFinder, Reach};
use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::kinematics::position_range::{PositionRange, position_ranges};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, trimmed};
use nalgebra::Vector3;

use crate::attempt::branches::count_distinct;
use crate::task::model::Rows;
use crate::task::quantity::{Quantity, STATE};
use crate::task::task_joints::TaskJoints;
use crate::task::tcp::tcp_in;

/// Angular frequency of the closed loops that gains are chosen for \[rad/s\].
const LOOP_RAD_S: f64 = 20.0;
/// The range of a draw about a visible case, to either side \[rad or m\].
const ABOUT: f64 = 0.15;
/// As many branches may be a continuum.
const CONTINUUM: usize = 16;

/// The keys of what a quantity depends on, in the order of [`STATE`].
const STATE_KEYS: [&str; STATE.len()] = ["q_rad", "qd_rad_s", "qdd_rad_s2"];

/// A task of a new lab.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewTask {
    /// What it asks for.
    pub kind: NewTaskKind,
    /// Its name: lower-case letters, digits and `-`.
    pub name: String,
}

/// What a task of a new lab asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NewTaskKind {
    /// Forward kinematics.
    ForwardKinematics,
    /// Inverse kinematics.
    InverseKinematics,
    /// The Jacobian.
    Jacobian,
    /// A quantity of the robot, such as its gravity efforts.
    Quantity(Quantity),
    /// A function of the lab's own, which has the name of the task.
    Function,
    /// A motion by joint positions.
    Motion,
    /// A motion by joint velocities.
    Velocity,
}

impl NewTaskKind {
    /// All of them, by the words that people type.
    pub const ALL: [(&'static str, Self); 12] = [
        ("fk", Self::ForwardKinematics),
        ("ik", Self::InverseKinematics),
        ("jacobian", Self::Jacobian),
        // `velocity` is a motion by joint velocities
        (
            "tcp-velocity",
            Self::Quantity(Quantity::Velocity(Rows::LINEAR)),
        ),
        (
            "tcp-acceleration",
            Self::Quantity(Quantity::Acceleration(Rows::LINEAR)),
        ),
        ("gravity", Self::Quantity(Quantity::Gravity)),
        ("coriolis", Self::Quantity(Quantity::Coriolis)),
        ("torque", Self::Quantity(Quantity::Torque)),
        ("mass-matrix", Self::Quantity(Quantity::MassMatrix)),
        ("function", Self::Function),
        ("motion", Self::Motion),
        ("velocity", Self::Velocity),
    ];

    fn moves(self) -> bool {
        matches!(self, Self::Motion | Self::Velocity)
    }

    fn needs_masses(self) -> bool {
        match self {
            Self::Quantity(quantity) => quantity.needs_masses(),
            kind => kind.moves(),
        }
    }
}

/// A lab that is to be written.
#[derive(Debug)]
pub struct NewLab<'a> {
    /// Its name, which is that of its folder.
    pub name: &'a str,
    /// The name of its robot, as lab.toml has it.
    pub robot_name: &'a str,
    /// The robot.
    pub robot: &'a Robot,
    /// Its tasks, at least one.
    pub tasks: &'a [NewTask],
    /// The salt of its hidden numbers.
    pub salt: &'a str,
}

/// A robot that cannot do what a task asks for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Unfit {
    /// It has no masses.
    #[error(
        "robot `{robot}` cannot be simulated, which task `{task}` needs: joint `{joint}` moves no inertia"
    )]
    CannotMove {
        /// The robot.
        robot: String,
        /// The task.
        task: String,
        /// The joint.
        joint: String,
    },
    /// Its joints cannot be chosen one by one.
    #[error(
        "robot `{robot}` has closed loops, and task `{task}` needs numbers for each of its joints"
    )]
    Loops {
        /// The robot.
        robot: String,
        /// The task.
        task: String,
    },
}

/// The files of both halves, by their names in the folder of the lab and in that of the course staff.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewLabFiles {
    /// What students get.
    pub lab: Vec<(&'static str, String)>,
    /// What course staff keep.
    pub reference: Vec<(&'static str, String)>,
}

/// The folder of schemas beside those of the labs, and beside those of the course staff's parts.
pub const SCHEMA_FOLDER: &str = "schema";

/// The name of the file of a kind's schema.
pub fn schema_name(kind: &str) -> String {
    format!("{kind}.schema.json")
}

/// The first line of a file of this kind in the folder of a lab: an editor completes its keys by the schema that it names.
pub fn schema_line(kind: &str) -> String {
    format!("#:schema ../{SCHEMA_FOLDER}/{}\n", schema_name(kind))
}

impl NewLab<'_> {
    /// The files.
    ///
    /// # Errors
    /// [`Unfit`] where a task moves a robot without masses, or is about one with closed loops.
    pub fn files(&self) -> Result<NewLabFiles, Unfit> {
        let robot = self.robot_name.to_owned();
        let mut of_robot = self.tasks.iter();
        let of_robot = of_robot.find(|task| task.kind != NewTaskKind::Function);
        if let (Some(task), false) = (of_robot, self.robot.loops().is_empty()) {
            let task = task.name.clone();
            return Err(Unfit::Loops { robot, task });
        }
        let heavy = self.tasks.iter().find(|task| task.kind.needs_masses());
        if let (Some(task), Some(singular)) = (heavy, immovable_joint(self.robot)) {
            return Err(Unfit::CannotMove {
                robot,
                task: task.name.clone(),
                joint: singular.joint,
            });
        }
        Ok(NewLabFiles {
            lab: vec![
                ("lab.toml", self.lab_toml()),
                ("brief.md", self.brief()),
                ("starter.rhai", self.starter()),
            ],
            reference: vec![
                ("solution.rhai", self.solution()),
                ("hidden.toml", self.hidden()),
                ("mutants.toml", self.mutants()),
            ],
        })
    }

    /// The frame of the lab: that of the robot for labs, else its first link.
    fn frame(&self) -> &str {
        match self.robot.frame("lab") {
            Some(_) => "lab",
            None => &self.robot.links()[0].name,
        }
    }

    /// The number of the sample that a motion task goes to.
    fn sample(&self, task: &NewTask) -> usize {
        let mut moving = self.tasks.iter().filter(|task| task.kind.moves());
        moving.position(|known| known == task).unwrap_or(0) + 1
    }

    /// Joint positions within the ranges, to two decimals: the sample of this number.
    fn q(&self, number: usize) -> Vec<f64> {
        let mut samples = JointSamples::new(self.robot);
        let mut q = vec![0.0; self.robot.n()];
        for _ in 0..=number {
            samples.next_into(&mut q);
        }
        let ranges = position_ranges(self.robot);
        let inside = q.iter().zip(&ranges).map(|(q, range)| {
            let (least, most) = range.sampled();
            let (low, high) = sampled(range);
            // the same share of the range that cases are taken from, away from its ends, where arms are stretched
            let share = if most > least {
                (q - least) / (most - least)
            } else {
                0.5
            };
            round(low + (0.2 + 0.6 * share) * (high - low), 2)
        });
        inside.collect()
    }

    /// A range about each of the positions of a sample.
    fn about(&self, number: usize) -> String {
        self.ranges(number, |q, (low, high)| {
            ((q - ABOUT).max(low), (q + ABOUT).min(high))
        })
    }

    /// A range beside each of them, and not about it: a hidden run near the visible one would hide nothing.
    fn beside(&self, number: usize) -> String {
        self.ranges(number, |q, (low, high)| match q + ABOUT <= high {
            true => (q + 0.5 * ABOUT, q + ABOUT),
            false => ((q - ABOUT).max(low), q - 0.5 * ABOUT),
        })
    }

    /// A range for each of the positions of a sample, from the position and the ends of what is sampled.
    fn ranges(&self, number: usize, range_of: impl Fn(f64, (f64, f64)) -> (f64, f64)) -> String {
        let sampled_ranges = position_ranges(self.robot).into_iter();
        let pairs = self.q(number).into_iter().zip(sampled_ranges);
        let pairs = pairs.map(|(q, range)| {
            let (from, to) = range_of(q, sampled(&range));
            list(&[round(from, 2), round(to, 2)])
        });
        format!("[{}]", pairs.collect::<Vec<_>>().join(", "))
    }

    /// Where the TCP is at a sample \[m\], and how many branches reach it.
    fn place(&self, number: usize) -> ([f64; 3], usize) {
        let q = self.q(number);
        let at = tcp_in(self.robot, self.frame(), &q).unwrap_or_default();
        let place = [at.x, at.y, at.z].map(|x| round(x, 4));
        let home = self.robot.home();
        let branches = self.in_world(&Vector3::from(place)).and_then(|p_in_world| {
            let mut finder = BranchFinder::new(self.robot, home).ok()?;
            match finder.reach(&p_in_world).ok()? {
                Reach::In(found) => match count_distinct(self.robot, &found) {
                    // nobody can list a continuum: one answer will do
                    count if count >= CONTINUUM => Some(1),
                    count => Some(count),
                },
                Reach::Not { .. } => Some(0),
            }
        });
        (place, branches.unwrap_or(1))
    }

    fn in_world(&self, p_in_lab: &Vector3<f64>) -> Option<Vector3<f64>> {
        let q = self.robot.positions(self.robot.home()).ok()?;
        let poses = forward_kinematics(self.robot, &q);
        let world_from_lab = poses.world_from(self.robot.frame(self.frame())?);
        Some(world_from_lab.transform_point(&(*p_in_lab).into()).coords)
    }

    fn lab_toml(&self) -> String {
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
            NewTaskKind::InverseKinematics => self.inverse_kinematics_toml(),
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
            NewTaskKind::Velocity => self.motion_toml(task, "velocity"),
        }
    }

    /// Two visible cases of joint positions.
    fn cases_of_angles(&self) -> String {
        cases_toml([1, 2].map(|sample| {
            let q = list(&self.q(sample));
            format!("{{ name = \"TODO: case {sample}\", q_rad = {q} }}")
        }))
    }

    /// Motion of the joints: positions, and the first so many derivatives.
    fn state(&self, quantity: Quantity, sample: usize) -> Vec<Vec<f64>> {
        let mut state = vec![self.q(sample)];
        // any numbers would do: these are of the size of what arms do in a second, and no two joints have the same
        let derivative = |order: usize| -> Vec<f64> {
            let joints = 0..self.robot.n();
            joints
                .map(|joint| round(0.3 + 0.2 * ((joint + 2 * order + sample) % 5) as f64, 2))
                .collect()
        };
        state.extend((1..quantity.order()).map(derivative));
        state
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

    /// A tenth of the greatest number of the quantity in the first case.
    fn least_size(&self, quantity: Quantity) -> f64 {
        let joints = TaskJoints::of(self.robot, &[]);
        let state = self.state(quantity, 1);
        let value = quantity.at(self.robot, &joints, self.frame(), &GRAVITY_M_S2, &state);
        let greatest = value
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let tenth = significant(0.1 * greatest);
        if tenth > 0.0 { tenth } else { 1.0 }
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

    fn motion_toml(&self, task: &NewTask, mode: &str) -> String {
        let name = parameter(task);
        let joint = self.robot.moving_joints().next();
        let joint = joint.map_or("?", |joint| joint.name.as_str());
        [
            format!(
                "[tasks.motion]\nmode = \"{mode}\"  # what a command of `control` is\nduration_s = 5.0\ntarget = \"= {name}\"\n\
                 # TODO: gains of the servo; these are for loops of {LOOP_RAD_S} rad/s where the robot is at home\n\
                 servo = {}\n",
                self.servo(task.kind)
            ),
            check_toml(
                "arrives",
                4,
                &format!(
                    "joint-reached = {{ joint = \"{joint}\", position_rad = \"= {name}[0]\", hold_s = 0.5, full_rad = 0.01, zero_rad = 0.1 }}"
                ),
            ),
        ]
        .concat()
    }

    /// A servo for the inertias that the joints have at home.
    fn servo(&self, kind: NewTaskKind) -> String {
        let Ok(home) = self.robot.positions(self.robot.home()) else {
            return "{}".to_owned();
        };
        let inertias = mass_matrix(self.robot, &home);
        let gains = |factor: f64| {
            let gains =
                (0..self.robot.n()).map(|i| trimmed(significant(factor * inertias[(i, i)]), 6));
            format!("[{}]", gains.collect::<Vec<_>>().join(", "))
        };
        match kind {
            NewTaskKind::Velocity => format!(
                "{{ kp = {}, gravity_compensation = true }}",
                gains(2.0 * LOOP_RAD_S)
            ),
            _ => format!(
                "{{ kp = {}, kd = {}, derivative = \"velocity\", gravity_compensation = true }}",
                gains(LOOP_RAD_S * LOOP_RAD_S),
                gains(2.0 * LOOP_RAD_S)
            ),
        }
    }

    /// The functions that the tasks call, each once: name, arguments, and an answer that is none yet.
    fn functions(&self) -> Vec<(String, String, String)> {
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
                NewTaskKind::Motion | NewTaskKind::Velocity => {
                    ("control".to_owned(), "observation", zeros(n))
                }
            };
            if !all.iter().any(|(known, ..)| *known == name) {
                all.push((name, arguments.to_owned(), answer));
            }
        }
        all
    }

    fn starter(&self) -> String {
        let mut text =
            "// TODO: what students begin with. It runs, and earns next to nothing.\n".to_owned();
        for (name, arguments, answer) in self.functions() {
            let _ = write!(text, "\nfn {name}({arguments}) {{\n    {answer}\n}}\n");
        }
        text
    }

    fn solution(&self) -> String {
        let mut text =
            "// The reference solution: a submission like a student's, which has full marks.\n"
                .to_owned();
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
        let velocity: Vec<String> = self
            .tasks
            .iter()
            .filter(|task| task.kind == NewTaskKind::Velocity)
            .map(|task| format!("observation.task == \"{}\"", task.name))
            .collect();
        let to_target = "2.0 * (observation.target - observation.q)";
        let all_velocity =
            self.tasks.iter().filter(|task| task.kind.moves()).count() == velocity.len();
        match (velocity.is_empty(), all_velocity) {
            (true, _) => "    observation.target".to_owned(),
            (false, true) => format!("    {to_target}"),
            (false, false) => format!(
                "    if {} {{ {to_target} }} else {{ observation.target }}",
                velocity.join(" || ")
            ),
        }
    }

    fn hidden(&self) -> String {
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
        let whole = || {
            let pairs = position_ranges(self.robot).into_iter().map(|range| {
                let (low, high) = sampled(&range);
                list(&[round_in(low, 1.0), round_in(high, -1.0)])
            });
            format!("q_rad = [{}]", pairs.collect::<Vec<_>>().join(", "))
        };
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
                NewTaskKind::Motion | NewTaskKind::Velocity => {
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

    fn mutants(&self) -> String {
        let task = &self.tasks[0].name;
        let text = format!(
            "# Submissions that make one common mistake each, and what a student who makes it reads. A lab needs at least six.\n\
             # mutants/NAME.rhai is the solution with the mistake:\n\
             #\n# [[mutants]]\n# name = \"degrees\"\n# tasks = [\"{task}\"]\n# says = \"The angles are in degrees. All angles are in radians.\"\n\
             format = 1\n"
        );
        schema_line("mutants") + text.as_str()
    }

    fn brief(&self) -> String {
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
            }
        }
        text + "\n## How it is graded\n\n<!-- grading: begin -->\n<!-- grading: end -->\n"
    }
}

/// The range of a joint that cases are taken from: within its limits, and within half a turn to either side, since more looks the same.
fn sampled(range: &PositionRange) -> (f64, f64) {
    let (low, high) = range.sampled();
    let half = std::f64::consts::PI;
    if range.turns && low < half && high > -half {
        (low.max(-half), high.min(half))
    } else {
        (low, high)
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

/// The parameter with the target of a task.
fn parameter(task: &NewTask) -> String {
    format!("{}_target", task.name.replace('-', "_"))
}

/// To so many decimals.
fn round(value: f64, decimals: i32) -> f64 {
    let scale = libm::pow(10.0, f64::from(decimals));
    // adding zero turns -0 into 0
    (value * scale).round() / scale + 0.0
}

/// To two decimals, up (1) or down (-1): inside a range.
fn round_in(value: f64, direction: f64) -> f64 {
    let rounded = round(value, 2);
    if (rounded - value) * direction < 0.0 {
        round(rounded + 0.01 * direction, 2)
    } else {
        rounded
    }
}

/// To two significant digits.
fn significant(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let digits = 1 - libm::floor(libm::log10(value.abs())) as i32;
    round(value, digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_for_people_and_stay_inside() {
        assert_eq!(round(-0.0004, 2), 0.0);
        assert_eq!(
            [significant(1234.0), significant(0.01234), significant(0.0)],
            [1200.0, 0.012, 0.0]
        );
        assert_eq!(
            [round_in(-2.0957, 1.0), round_in(2.0957, -1.0)],
            [-2.09, 2.09]
        );
        assert_eq!(
            [round_in(-2.618, 1.0), round_in(2.618, -1.0)],
            [-2.61, 2.61]
        );
    }
}
