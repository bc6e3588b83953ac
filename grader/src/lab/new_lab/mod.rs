//! The files of a lab that somebody begins: tasks with numbers that fit its robot, and a comment wherever a person has to decide.
//!
//! | file | what is in it |
//! |---|---|
//! | `fitting` | numbers that fit the robot: joint positions, places, gains |
//! | `lab_file` | lab.toml |
//! | `programs` | the functions that students write: starter, solution |
//! | `texts` | what else there is: the brief, hidden numbers, mutants |

mod fitting;
mod lab_file;
mod programs;
mod texts;

use kinemark_sim::dynamics::immovable_joint;
use kinemark_sim::model::robot::Robot;

use crate::task::model::Rows;
use crate::task::quantity::{Quantity, STATE};

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
    /// A motion by joint efforts.
    Effort,
}

impl NewTaskKind {
    /// All of them, by the words that people type.
    pub const ALL: [(&'static str, Self); 13] = [
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
        ("effort", Self::Effort),
    ];

    fn moves(self) -> bool {
        matches!(self, Self::Motion | Self::Velocity | Self::Effort)
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
}

/// The parameter with the target of a task.
fn parameter(task: &NewTask) -> String {
    format!("{}_target", task.name.replace('-', "_"))
}
