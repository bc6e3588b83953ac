//! Granted functions: functions of `robot` that query Kinemark's own model. The map `robot` does not contain them, so that it can be
//! kept in `this` like any other map.

use std::any::TypeId;
use std::rc::Rc;

use rhai::{Dynamic, Map};

use super::budget::Meter;
use super::library::{Arguments, Library};
use super::mistake::{Problem, fault, fault_with_help};
use super::operand::Operand;
use super::vector::{Matrix, Vector};
use super::words::describe;
use crate::submission::controller::Grant;
use crate::submission::robot_model::{Model, Quantity, cost};

/// The answer of a granted function to the arguments of a script.
fn answer(
    model: &Model,
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
    let n = model.joints();
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
    match model.answer(grant, &q) {
        Some(Quantity::Vector(numbers)) => Ok(Dynamic::from(Vector::new(&numbers))),
        Some(Quantity::Matrix(rows)) => {
            let matrix = Matrix::from_fn(rows.len(), n, |i, j| rows[i][j]);
            Ok(Dynamic::from(matrix))
        }
        None => Err(fault_with_help(
            format!(
                "`robot.{name}` takes {n} positions, one per joint, got {}",
                q.len()
            ),
            format!("write robot.{name}(observation.q)"),
        )),
    }
}

/// Adds the functions that are granted.
pub(super) fn register(library: &mut Library, model: &Rc<Model>, grants: &[Grant]) {
    for &grant in grants {
        let of_anything = Rc::clone(model);
        library.function(grant.name(), 2, move |meter, arguments| {
            answer(&of_anything, grant, meter, arguments)
        });
        let of_a_map = Rc::clone(model);
        let types = [TypeId::of::<Map>(), TypeId::of::<Vector>()];
        library.shortcut(grant.name(), &types, move |meter, arguments| {
            answer(&of_a_map, grant, meter, arguments)
        });
    }
}
