//! What a submission is opened with.

use kinemark_grader::submission::controller::{Budgets, Opening, RobotFacts, Value};
use kinemark_grader::submission::handed_in::Program;

/// A task of an arm of two links, with budgets that are spent in milliseconds.
pub fn opening(program: Program) -> Opening {
    Opening {
        file: "submission".into(),
        program,
        task: "move".into(),
        robot: RobotFacts {
            name: "arm".into(),
            joint_names: vec!["shoulder".into(), "elbow".into()],
            dimensions: vec![("base_height".into(), Value::Number(2.0))],
            lower: vec![-6.3; 2],
            upper: vec![6.3; 2],
            effort: vec![30.0, 15.0],
        },
        target: Value::List([2.0, 1.4, 0.0].map(Value::Number).to_vec()),
        sensors: Vec::new(),
        budgets: Budgets {
            operations_per_call: 5_000,
            instructions_per_call: 20_000,
            ..Budgets::default()
        },
        granted: None,
        function: None,
    }
}
