//! Granted functions: functions of `robot` that query Kinemark's own model. The map `robot` does not contain them, so that it can be
//! kept in `this` like any other map.

use std::any::TypeId;
use std::cell::RefCell;
use std::rc::Rc;

use kinemark_sim::dynamics::{gravity_effort, mass_matrix};
use kinemark_sim::format::RobotFile;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;
use kinemark_sim::text::Source;
use nalgebra::Vector3;
use rhai::{Dynamic, Map};

use super::budget::Meter;
use super::library::{Arguments, Library};
use super::mistake::{Problem, fault, fault_with_help};
use super::operand::Operand;
use super::vector::{Matrix, Vector};
use super::words::describe;
use crate::submission::controller::{Grant, Granted, RobotFacts, Stop, Value};
use crate::task::jacobian::jacobian_in;
use crate::task::model::Rows;
use crate::task::tcp::tcp_in;

/// The robot that granted functions query, built again only for other dimensions.
#[derive(Debug)]
pub(super) struct Model {
    file: RobotFile,
    frame: String,
    gravity_m_s2: Vector3<f64>,
    current: RefCell<(Vec<(String, Value)>, Robot)>,
}

impl Model {
    /// The model of `granted`, with the dimensions of `facts`.
    pub(super) fn new(granted: &Granted, facts: &RobotFacts) -> Result<Self, Stop> {
        let fault = |error: &dyn std::fmt::Display| {
            Stop::GraderFault(format!("the robot of the granted functions: {error}"))
        };
        let source = Source::new(granted.robot_path.as_str(), granted.robot_text.as_str());
        let file = RobotFile::parse(source)
            .and_then(|file| {
                file.with_meshes(|name| {
                    let mut meshes = granted.meshes.iter();
                    match meshes.find(|(known, _)| known == name) {
                        Some((_, bytes)) => Ok(bytes.clone()),
                        None => Err("it was not handed over".to_owned()),
                    }
                })
            })
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

    fn answer(
        &self,
        grant: Grant,
        meter: &Meter,
        of: Arguments<'_, '_>,
    ) -> Result<Dynamic, Problem> {
        let name = grant.name();
        let is_robot = of[0]
            .as_map_ref()
            .is_ok_and(|map| map.contains_key("joint_names") && map.contains_key("lower"));
        if !is_robot {
            return Err(fault_with_help(
                format!(
                    "`{name}` is a function of the robot, got {}",
                    describe(of[0])
                ),
                format!("write robot.{name}(q)"),
            ));
        }
        let current = self.current.borrow();
        let robot = &current.1;
        let n = robot.n();
        meter.operations(cost(grant, n))?;
        let q: Vec<f64> = match Operand::of(of[1]) {
            Operand::Vector(vector) => vector.elements().to_vec(),
            operand => match operand.number() {
                Some(number) => vec![number],
                None => {
                    return Err(fault(format!(
                        "`robot.{name}` takes one position per joint, got {}",
                        describe(of[1])
                    )));
                }
            },
        };
        let joints = |found: usize| {
            fault_with_help(
                format!("`robot.{name}` takes {n} positions, one per joint, got {found}"),
                format!("write robot.{name}(observation.q)"),
            )
        };
        let positions = robot.positions(&q).map_err(|_| joints(q.len()))?;
        Ok(match grant {
            Grant::Fk => {
                let tcp = tcp_in(robot, &self.frame, &q).ok_or_else(|| joints(q.len()))?;
                Dynamic::from(Vector::new(tcp.as_slice().to_vec()))
            }
            Grant::Jacobian => {
                let rows = jacobian_in(robot, &self.frame, &q, Rows::LINEAR);
                let rows = rows.ok_or_else(|| joints(q.len()))?;
                Dynamic::from(Matrix::from_fn(rows.len(), n, |i, j| rows[i][j]))
            }
            Grant::Gravity => {
                let effort = gravity_effort(robot, &self.gravity_m_s2, &positions);
                Dynamic::from(Vector::new(effort.as_slice().to_vec()))
            }
            Grant::MassMatrix => {
                let matrix = mass_matrix(robot, &positions);
                Dynamic::from(Matrix::from_fn(n, n, |i, j| matrix[(i, j)]))
            }
        })
    }
}

/// Operations charged for a call: about its time in steps of a script, the same in every configuration.
fn cost(grant: Grant, joints: usize) -> u64 {
    let joints = joints as u64;
    match grant {
        Grant::Fk => 10 * joints,
        Grant::Jacobian | Grant::Gravity => 20 * joints,
        Grant::MassMatrix => 10 * joints * joints.max(2),
    }
}

fn built(file: &RobotFile, facts: &RobotFacts) -> Result<Robot, Stop> {
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

/// Adds the functions that are granted.
pub(super) fn register(library: &mut Library, model: &Rc<Model>, grants: &[Grant]) {
    for &grant in grants {
        let of_anything = Rc::clone(model);
        library.function(grant.name(), 2, move |meter, arguments| {
            of_anything.answer(grant, meter, arguments)
        });
        let of_a_map = Rc::clone(model);
        let types = [TypeId::of::<Map>(), TypeId::of::<Vector>()];
        library.shortcut(grant.name(), &types, move |meter, arguments| {
            of_a_map.answer(grant, meter, arguments)
        });
    }
}
