//! The opening of a submission: the task, the robot's numbers, and what the task grants.

use kinemark_sim::dynamics::GRAVITY_M_S2;

use crate::attempt::function;
use crate::attempt::motion;
use crate::lab::TaskWork;
use crate::lab::{Lab, Task};
use crate::submission::controller::{AskedFunction, Granted, Opening};
use crate::submission::handed_in::Submission;
use crate::task::mesh_file::MeshFile;
use crate::task::model::FunctionTask;
use crate::task::value::Value;

/// The opening of a submission for `task` of `lab`.
pub(crate) fn opening(lab: &Lab, task: &Task, submission: &Submission) -> Opening {
    let lab = lab.of_task(task);
    let (robot, target, sensors) = match &task.work {
        TaskWork::Function(task, _) => (
            function::facts_of_task(&lab.robot, task),
            Value::Nothing,
            Vec::new(),
        ),
        TaskWork::Motion(motion, _) => (
            motion::facts_of(&lab.robot, motion),
            motion::target_of(motion),
            motion::sensors_of(motion),
        ),
    };
    Opening {
        file: submission.name().to_owned(),
        program: submission.program().clone(),
        task: task.name.clone(),
        robot,
        target,
        sensors,
        budgets: lab.budgets.clone(),
        granted: granted(lab, &task.work),
        function: match &task.work {
            TaskWork::Function(task, _) => (!task.is_usual()).then(|| asked(task)),
            TaskWork::Motion(..) => None,
        },
    }
}

/// The function of a task.
fn asked(task: &FunctionTask) -> AskedFunction {
    let parameters = task.parameters().into_iter();
    AskedFunction {
        name: task.name().to_owned(),
        parameters: parameters.map(str::to_owned).collect(),
    }
}

/// The functions that a task grants, with the files of the robot's model; `None` if it grants nothing.
fn granted(lab: &Lab, work: &TaskWork) -> Option<Granted> {
    let (functions, gravity_m_s2) = match work {
        TaskWork::Function(function, _) => (&function.grants, GRAVITY_M_S2),
        TaskWork::Motion(motion, _) => (&motion.grants, motion.gravity_m_s2),
    };
    let source = lab.robot_file.source();
    let mesh = |mesh: &MeshFile| (mesh.name.clone(), mesh.bytes.clone());
    (!functions.is_empty()).then(|| Granted {
        functions: functions.clone(),
        robot_path: source.name().to_owned(),
        robot_text: source.text().to_owned(),
        read_options: lab.robot_file.options(),
        meshes: lab.robot_meshes.iter().map(mesh).collect(),
        frame: lab.frame.clone(),
        gravity_m_s2: gravity_m_s2.into(),
    })
}
