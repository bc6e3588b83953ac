//! The visible cases of functions that Kinemark knows: their robots, and what the function is given.

use std::sync::Arc;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::spatial::{direction, rotation_from_rpy_deg};
use kinemark_sim::text::Dimension;
use kinemark_sim::text::Spanned;
use nalgebra::{Rotation3, Vector3};

use super::{Reader, numbers};
use crate::lab::case_robot;
use crate::lab::file::CaseTable;
use crate::task::model::{About, Case, Function, Given};
use crate::task::pose::{PoseForm, pose_at};
use crate::task::problem::{LabError, near, problems};
use crate::task::quantity::STATE;
use crate::task::task_joints::TaskJoints;

problems! {
    /// What is wrong with a visible case.
    pub(super) enum CaseProblem {
        Dimensions { case: String, error: String, known: Vec<String> }:
            "lab::case_dimensions", "case `{case}`: {error}", "this case", near("", "dimensions", known);
        Row { error: String }:
            "lab::case_robot", "{error}", "the robot of this case",
            "write a row of joints such as \"RzTxRy\": R turns about an axis, T slides along it";
        Input { case: String, function: String, wanted: String }:
            "lab::case_input", "case `{case}` of `{function}` is given by {wanted}", "this case",
            format!("give {wanted} and nothing else");
        Count { what: &'static str, count: String, expected: usize, joints: Vec<String> }:
            "lab::joint_count", "`{what}` has {count} for {expected} joints", "one number per joint of the task",
            format!("joints of the task: {}", joints.join(", "));
        OpenLoop { robot: String }:
            "lab::case_input", "the loops of robot `{robot}` cannot be closed at these positions", "not a place where the robot can be",
            "try them with the operation `close_loops` of `kinemark robot eval`";
        NoDirection { what: &'static str }:
            "lab::case_input", "`{what}` has no direction", "too short, or not finite", "such as [0, 0, -1]: its length makes no difference";
        Yaw:
            "lab::case_input", "`yaw_deg` is a finite number", "not finite";
    }
}

/// Keys of a case that say what a function is given.
const INPUTS: [&str; 9] = [
    "q_rad",
    "qd_rad_s",
    "qdd_rad_s2",
    "position_m",
    "yaw_deg",
    "axis",
    "rpy_deg",
    "given",
    "expected",
];

/// The keys of [`INPUTS`] that a function takes.
fn inputs(function: &Function) -> &'static [&'static str] {
    match function {
        Function::ForwardKinematics(_) | Function::Jacobian(_) => &INPUTS[..1],
        Function::Quantity(quantity) => &INPUTS[..quantity.order()],
        Function::InverseKinematics(form) => match form {
            PoseForm::Position => &["position_m"],
            PoseForm::Yaw => &["position_m", "yaw_deg"],
            PoseForm::Axis { .. } => &["position_m", "axis"],
            PoseForm::Full => &["position_m", "rpy_deg"],
        },
        Function::Free(_) => &["given", "expected"],
    }
}

impl Reader<'_> {
    pub(super) fn case(
        &self,
        function: &Function,
        about: &About,
        table: &Spanned<CaseTable>,
    ) -> Result<Case, LabError> {
        let case = table.get_ref();
        let name = case.name.get_ref().clone();
        let robot = self.case_robot(about, table)?;
        let is_there = [
            case.q_rad.is_some(),
            case.qd_rad_s.is_some(),
            case.qdd_rad_s2.is_some(),
            case.position_m.is_some(),
            case.yaw_deg.is_some(),
            case.axis.is_some(),
            case.rpy_deg.is_some(),
            case.given.is_some(),
            case.expected.is_some(),
        ];
        let wanted = inputs(function);
        let mut keys = INPUTS.iter().zip(is_there);
        if !keys.all(|(key, is_there)| is_there == wanted.contains(key)) {
            let quoted: Vec<String> = wanted.iter().map(|key| format!("`{key}`")).collect();
            let problem = CaseProblem::Input {
                case: name,
                function: function.name().to_owned(),
                wanted: in_words(&quoted),
            };
            return self.report.refuse_at(table, problem);
        }
        let of_case = robot.as_deref().unwrap_or(self.robot);
        let joints = TaskJoints::of(of_case, &about.ignored);
        let given = match function {
            Function::InverseKinematics(form) => self.pose_of_case(*form, case)?,
            Function::Quantity(_) => {
                let lists = [&case.q_rad, &case.qd_rad_s, &case.qdd_rad_s2];
                let lists = lists
                    .into_iter()
                    .zip(INPUTS)
                    .filter_map(|(list, key)| Some((list.as_ref()?, key)));
                let mut state = Vec::new();
                for (list, key) in lists.take(STATE.len()) {
                    self.per_joint(of_case, &joints, list, key)?;
                    state.push(list.get_ref().clone());
                }
                if let Some(q) = &case.q_rad {
                    self.closed(of_case, &joints, q)?;
                }
                Given::Motion(state)
            }
            _ => match &case.q_rad {
                Some(q) => {
                    self.per_joint(of_case, &joints, q, "q_rad")?;
                    Given::Q(self.closed(of_case, &joints, q)?)
                }
                None => Given::Q(Vec::new()),
            },
        };
        Ok(Case {
            name,
            hidden_class: None,
            row: case.robot.as_ref().map(|row| row.get_ref().clone()),
            dimensions: changed(case),
            robot,
            given,
        })
    }

    /// The robot of a case; `None` where it is the lab's.
    pub(super) fn case_robot(
        &self,
        about: &About,
        table: &Spanned<CaseTable>,
    ) -> Result<Option<Arc<Robot>>, LabError> {
        let case = table.get_ref();
        let row = case.robot.as_ref();
        let typed = row.map(|row| row.get_ref().as_str());
        let description = match case_robot::description(self.robot_file, typed) {
            Ok(description) => description,
            Err(error) => {
                let error = error.to_string();
                let at = row.map_or(table.span(), Spanned::span);
                return self.report.refuse(at, CaseProblem::Row { error });
            }
        };
        let robot = match case_robot::built(self.robot_file, typed, &changed(case), about) {
            Ok(robot) => robot,
            Err(error) => {
                let known = description.dimensions().names().map(str::to_owned);
                let problem = CaseProblem::Dimensions {
                    case: case.name.get_ref().clone(),
                    error: error.to_string(),
                    known: known.collect(),
                };
                return self.report.refuse_at(table, problem);
            }
        };
        if let (Some(frame), Some(robot)) = (&about.frame, &robot)
            && robot.tcp().name != *frame
        {
            let frame = Spanned::new(table.span(), frame.clone());
            return self.refuse_frame(robot, &frame);
        }
        if let Some(robot) = robot
            .as_ref()
            .filter(|robot| robot.frame(self.frame).is_none())
        {
            let frame = Spanned::new(table.span(), self.frame.to_owned());
            return self.refuse_frame(robot, &frame);
        }
        Ok(robot.map(Arc::new))
    }

    /// Refuses another count than one number per joint of the task.
    fn per_joint(
        &self,
        robot: &Robot,
        joints: &TaskJoints,
        list: &Spanned<Vec<f64>>,
        what: &'static str,
    ) -> Result<(), LabError> {
        let found = list.get_ref().len();
        if found == joints.count() {
            return Ok(());
        }
        let names = joints.joints(robot).map(|joint| joint.name.clone());
        let problem = CaseProblem::Count {
            what,
            count: numbers(found),
            expected: joints.count(),
            joints: names.collect(),
        };
        self.report.refuse_at(list, problem)
    }

    /// The positions of all joints at those of the task.
    fn closed(
        &self,
        robot: &Robot,
        joints: &TaskJoints,
        q: &Spanned<Vec<f64>>,
    ) -> Result<Vec<f64>, LabError> {
        match joints.positions(robot, q.get_ref()) {
            Some(whole) => Ok(whole),
            None => {
                let robot = robot.name().to_owned();
                self.report.refuse_at(q, CaseProblem::OpenLoop { robot })
            }
        }
    }

    /// The target of inverse kinematics, in the form that the function takes.
    fn pose_of_case(&self, form: PoseForm, case: &CaseTable) -> Result<Given, LabError> {
        let position_m = case.position_m.unwrap_or_default();
        let p = Vector3::from(position_m);
        let pose = match form {
            PoseForm::Position => position_m.to_vec(),
            PoseForm::Yaw => {
                let yaw_deg = case.yaw_deg.as_ref().map_or(0.0, |yaw| *yaw.get_ref());
                if let (Some(typed), false) = (&case.yaw_deg, yaw_deg.is_finite()) {
                    return self.report.refuse_at(typed, CaseProblem::Yaw);
                }
                [&position_m[..], &[yaw_deg.to_radians()]].concat()
            }
            PoseForm::Axis { .. } => {
                let typed = case.axis.as_ref();
                let axis = typed.map_or(Vector3::z(), |axis| Vector3::from(*axis.get_ref()));
                match (direction(axis), typed) {
                    (Some(unit), _) => [&position_m[..], unit.as_slice()].concat(),
                    (None, Some(typed)) => {
                        let problem = CaseProblem::NoDirection { what: "axis" };
                        return self.report.refuse_at(typed, problem);
                    }
                    (None, None) => position_m.to_vec(),
                }
            }
            PoseForm::Full => {
                let typed = case.rpy_deg.as_ref();
                let rotation = rotation_from_rpy_deg(typed.map_or([0.0; 3], |rpy| *rpy.get_ref()));
                if let (Some(typed), false) = (typed, rotation.iter().all(|x| x.is_finite())) {
                    let problem = CaseProblem::NoDirection { what: "rpy_deg" };
                    return self.report.refuse_at(typed, problem);
                }
                form.of(&pose_at(p, Rotation3::from_matrix_unchecked(rotation)))
            }
        };
        Ok(Given::Position {
            position_m,
            branches: case.branches.as_ref().map_or(2, |branches| {
                u32::try_from(*branches.get_ref()).unwrap_or(2)
            }),
            pose,
        })
    }
}

/// The dimensions that a case changes.
pub(super) fn changed(case: &CaseTable) -> Vec<(String, Dimension)> {
    let dimensions = case.dimensions.iter();
    dimensions
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect()
}

/// `a`, `a and b`, `a, b and c`.
fn in_words(names: &[String]) -> String {
    match names {
        [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        names => names.concat(),
    }
}
