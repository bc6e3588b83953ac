//! The model of the robot that granted functions query, the same for every host of submissions.

use std::cell::RefCell;

use kinemark_sim::dynamics::{gravity_effort, mass_matrix};
use kinemark_sim::format::RobotDescription;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;
use kinemark_sim::text::Source;
use nalgebra::Vector3;

use super::controller::{Grant, Granted, RobotFacts, Stop, Value};
use crate::task::jacobian::jacobian_in;
use crate::task::model::Rows;
use crate::task::tcp::tcp_in;

/// The robot that granted functions query, built again only for other dimensions.
#[derive(Debug)]
pub(super) struct Model {
    file: RobotDescription,
    frame: String,
    gravity_m_s2: Vector3<f64>,
    current: RefCell<(Vec<(String, Value)>, Robot)>,
}

/// The result of a granted function.
pub(super) enum Quantity {
    /// A position or one effort per joint.
    Vector(Vec<f64>),
    /// Rows of one number per joint.
    Matrix(Vec<Vec<f64>>),
}

impl Model {
    /// The model of `granted`, with the dimensions of `facts`.
    pub(super) fn new(granted: &Granted, facts: &RobotFacts) -> Result<Self, Stop> {
        let fault = |error: &dyn std::fmt::Display| {
            Stop::GraderFault(format!("the robot of the granted functions: {error}"))
        };
        let source = Source::new(granted.robot_path.as_str(), granted.robot_text.as_str());
        let mut mesh = |name: &str| {
            let mut meshes = granted.meshes.iter();
            match meshes.find(|(known, _)| known == name) {
                Some((_, bytes)) => Ok(bytes.clone()),
                None => Err("it was not handed over".to_owned()),
            }
        };
        let file = RobotDescription::read(source, &granted.read_options, &mut mesh)
            .map_err(|error| fault(&error))?;
        let robot = built(&file, facts)?;
        Ok(Self {
            file,
            frame: granted.frame.clone(),
            gravity_m_s2: Vector3::from(granted.gravity_m_s2),
            current: RefCell::new((facts.dimensions.clone(), robot)),
        })
    }

    /// Sets the robot to that of `facts`.
    pub(super) fn is_now(&self, facts: &RobotFacts) -> Result<(), Stop> {
        let mut current = self.current.borrow_mut();
        if current.0 != facts.dimensions {
            *current = (facts.dimensions.clone(), built(&self.file, facts)?);
        }
        Ok(())
    }

    /// How many joints move.
    pub(super) fn joints(&self) -> usize {
        self.current.borrow().1.n()
    }

    /// The granted function at `q`; `None` if that does not fit the robot.
    pub(super) fn answer(&self, grant: Grant, q: &[f64]) -> Option<Quantity> {
        let current = self.current.borrow();
        let robot = &current.1;
        let positions = robot.positions(q).ok()?;
        let n = robot.n();
        Some(match grant {
            Grant::Fk => Quantity::Vector(tcp_in(robot, &self.frame, q)?.as_slice().to_vec()),
            Grant::Jacobian => Quantity::Matrix(jacobian_in(robot, &self.frame, q, Rows::LINEAR)?),
            Grant::Gravity => {
                let effort = gravity_effort(robot, &self.gravity_m_s2, &positions);
                Quantity::Vector(effort.as_slice().to_vec())
            }
            Grant::MassMatrix => {
                let matrix = mass_matrix(robot, &positions);
                let row = |i: usize| (0..n).map(|j| matrix[(i, j)]).collect();
                Quantity::Matrix((0..n).map(row).collect())
            }
        })
    }
}

/// Operations of a script charged for a call: about its time, the same in every configuration.
pub(super) fn cost(grant: Grant, joints: usize) -> u64 {
    let joints = joints as u64;
    match grant {
        Grant::Fk => 10 * joints,
        Grant::Jacobian | Grant::Gravity => 20 * joints,
        Grant::MassMatrix => 10 * joints * joints.max(2),
    }
}

fn built(file: &RobotDescription, facts: &RobotFacts) -> Result<Robot, Stop> {
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        // dimensions are numbers; building the robot refuses invalid ones
        _ => f64::NAN,
    };
    let dimensions: Vec<(String, Dimension)> = facts
        .dimensions
        .iter()
        .map(|(name, value)| {
            let dimension = match value {
                Value::List(items) => Dimension::List(items.iter().map(number).collect()),
                value => Dimension::Number(number(value)),
            };
            (name.clone(), dimension)
        })
        .collect();
    let built = file.build(&dimensions);
    built.map_err(|error| Stop::GraderFault(format!("the robot of the granted functions: {error}")))
}
