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
    /// Forward kinematics of the whole pose.
    ForwardPose,
    /// Inverse kinematics of a pose, as much of it as the robot can choose.
    InversePose,
    /// The Jacobian.
    Jacobian,
    /// A quantity of the robot, such as its gravity efforts.
    Quantity(Quantity),
    /// A function of the lab's own, which has the name of the task.
    Function,
    /// A motion by joint positions.
    Motion,
    /// A motion by joint positions to places of the TCP.
    Goals,
    /// A motion by joint velocities.
    Velocity,
    /// A motion by joint efforts.
    Effort,
}

impl NewTaskKind {
    /// All of them, by the words that people type.
    pub const ALL: [(&'static str, Self); 16] = [
        ("fk", Self::ForwardKinematics),
        ("ik", Self::InverseKinematics),
        ("fk-pose", Self::ForwardPose),
        ("ik-pose", Self::InversePose),
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
        ("goals", Self::Goals),
        ("velocity", Self::Velocity),
        ("effort", Self::Effort),
    ];

    fn moves(self) -> bool {
        matches!(
            self,
            Self::Motion | Self::Goals | Self::Velocity | Self::Effort
        )
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
    /// The place of its TCP decides how that is turned.
    #[error(
        "robot `{robot}` has too few joints for task `{task}`: where its TCP is decides how it is turned"
    )]
    Pose {
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
    /// [`Unfit`] where a task moves a robot without masses, is about one with closed loops, or asks for poses where places decide them.
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
        let mut of_poses = self.tasks.iter();
        let of_poses = of_poses.find(|task| task.kind == NewTaskKind::InversePose);
        if let (Some(task), None) = (of_poses, self.poses()) {
            let task = task.name.clone();
            return Err(Unfit::Pose { robot, task });
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

    /// Whether a task asks for this.
    fn asks_for(&self, kind: NewTaskKind) -> bool {
        self.tasks.iter().any(|task| task.kind == kind)
    }

    /// The function that answers or is given a pose, and the one that the engine knows it by: another name where a task asks for positions
    /// by that name.
    fn function_of_poses(&self, kind: NewTaskKind) -> (&'static str, &'static str) {
        let (name, other, plain) = match kind {
            NewTaskKind::ForwardPose => (
                "forward_kinematics",
                "pose_of_tcp",
                NewTaskKind::ForwardKinematics,
            ),
            _ => (
                "inverse_kinematics",
                "angles_for_pose",
                NewTaskKind::InverseKinematics,
            ),
        };
        (if self.asks_for(plain) { other } else { name }, name)
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

/// The parameters with the places of a task that has goals.
fn places(task: &NewTask) -> [String; 2] {
    ["first", "second"].map(|place| format!("{}_{place}", task.name.replace('-', "_")))
}
