//! The joints of a function task: those whose positions a submission is given and asked for.
//!
//! They are the independent joints of a robot, less those that the task ignores, such as fingers. The others have no entry in what goes
//! to a submission: ignored joints stand where they stand at home, and those that loops determine follow.

use kinemark_sim::kinematics::closure::{
    closed_accelerations, closed_positions, closed_velocities, independent_motions,
};
use kinemark_sim::model::robot::{Joint, Robot};

/// The joints of a function task, for one robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TaskJoints {
    /// Entries of `q`, in order.
    entries: Vec<usize>,
}

/// A configuration of the whole robot, its loops closed, each of shape `(n)`.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeMotion {
    /// Positions \[rad or m\].
    pub q: Vec<f64>,
    /// Velocities \[rad/s or m/s\].
    pub qd: Vec<f64>,
    /// Accelerations \[rad/s² or m/s²\].
    pub qdd: Vec<f64>,
}

impl TaskJoints {
    /// The independent joints of `robot` but those called as in `ignored`.
    pub fn of(robot: &Robot, ignored: &[String]) -> Self {
        let counts = |entry: &usize| {
            let mut joints = robot.moving_joints();
            let joint = joints.nth(*entry);
            joint.is_some_and(|joint| !ignored.contains(&joint.name))
        };
        let independent = robot.independent().iter().copied();
        Self {
            entries: independent.filter(counts).collect(),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.entries.len()
    }

    /// Their entries of `q`, in order.
    pub fn entries(&self) -> &[usize] {
        &self.entries
    }

    /// Whether they are all joints of `robot`, so that what a submission is given is `q` itself.
    pub fn are_all_of(&self, robot: &Robot) -> bool {
        self.entries.len() == robot.n()
    }

    /// The joints themselves.
    pub fn joints<'r>(&self, robot: &'r Robot) -> impl Iterator<Item = &'r Joint> {
        let all: Vec<&Joint> = robot.moving_joints().collect();
        self.entries.iter().map(move |&entry| all[entry])
    }

    /// One value per independent joint: `values` at these, `others` elsewhere.
    fn independent(
        &self,
        robot: &Robot,
        values: &[f64],
        others: impl Fn(usize) -> f64,
    ) -> Vec<f64> {
        let of = |entry: &usize| match self.entries.iter().position(|known| known == entry) {
            Some(at) => values[at],
            None => others(*entry),
        };
        robot.independent().iter().map(of).collect()
    }

    /// The whole of `q`, shape `(n)`; `None` where `values` are too many or too few, or loops cannot be closed.
    pub fn positions(&self, robot: &Robot, values: &[f64]) -> Option<Vec<f64>> {
        if values.len() != self.entries.len() {
            return None;
        }
        if self.are_all_of(robot) {
            return Some(values.to_vec());
        }
        let independent = self.independent(robot, values, |entry| robot.home()[entry]);
        closed_positions(robot, &independent).ok()
    }

    /// The whole motion that these joints make with positions, velocities and accelerations; the others that can move by themselves
    /// rest. `None` as of [`TaskJoints::positions`], and where loops do not determine how the others move.
    pub fn motion(&self, robot: &Robot, [q, qd, qdd]: [&[f64]; 3]) -> Option<WholeMotion> {
        let count = self.entries.len();
        if qd.len() != count || qdd.len() != count {
            return None;
        }
        let q = self.positions(robot, q)?;
        let rates = |values: &[f64]| self.independent(robot, values, |_| 0.0);
        let qd = closed_velocities(robot, &q, &rates(qd)).ok()?;
        let qdd = closed_accelerations(robot, &q, &qd, &rates(qdd)).ok()?;
        Some(WholeMotion { q, qd, qdd })
    }

    /// A quantity per joint of the whole robot, in column `j` of each row, as one per joint of the task: what the others do because
    /// loops bind them is counted in. `None` where loops do not determine that.
    ///
    /// With `B` the rates of all joints per rate of a task's joint, each row `r` becomes `r B`.
    pub fn per_joint(&self, robot: &Robot, q: &[f64], rows: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        if self.are_all_of(robot) {
            return Some(rows.to_vec());
        }
        let motions = independent_motions(robot, q).ok()?;
        let column_of = |entry: &usize| robot.independent().iter().position(|i| i == entry);
        let columns: Option<Vec<usize>> = self.entries.iter().map(column_of).collect();
        let columns = columns?;
        let of_row = |row: &Vec<f64>| {
            let of_column = |&column: &usize| {
                let motion = motions.column(column);
                motion.iter().zip(row).map(|(b, r)| b * r).sum::<f64>()
            };
            columns.iter().map(of_column).collect()
        };
        Some(rows.iter().map(of_row).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::format::RobotFile;
    use kinemark_sim::text::Source;

    fn robot(path: &str) -> Robot {
        let path = format!("{}/../labs/robots/{path}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        RobotFile::parse(Source::new(path, text))
            .unwrap()
            .build(&[])
            .unwrap()
    }

    #[test]
    fn an_ignored_joint_stays_at_home() {
        let robot = robot("rrbot.toml");
        let names: Vec<String> = robot
            .moving_joints()
            .map(|joint| joint.name.clone())
            .collect();
        let joints = TaskJoints::of(&robot, &names[..1]);
        assert_eq!((joints.count(), joints.entries()), (1, &[1][..]));
        assert_eq!(joints.positions(&robot, &[0.4]), Some(vec![0.0, 0.4]));
        assert_eq!(joints.positions(&robot, &[0.4, 0.5]), None);
        let motion = joints.motion(&robot, [&[0.4], &[2.0], &[3.0]]).unwrap();
        assert_eq!((motion.qd, motion.qdd), (vec![0.0, 2.0], vec![0.0, 3.0]));
        let rows = joints.per_joint(&robot, &[0.0, 0.4], &[vec![5.0, 7.0]]);
        assert_eq!(rows, Some(vec![vec![7.0]]));
        let all = TaskJoints::of(&robot, &[]);
        assert!(all.are_all_of(&robot));
    }

    #[test]
    fn joints_of_loops_follow_those_of_the_task() {
        let robot = robot("uarm.toml");
        let joints = TaskJoints::of(&robot, &[]);
        assert_eq!(joints.count(), robot.independent().len());
        let values: Vec<f64> = (0..joints.count()).map(|i| 0.1 + 0.05 * i as f64).collect();
        let q = joints.positions(&robot, &values).unwrap();
        assert_eq!(q.len(), robot.n());
        assert!(kinemark_sim::kinematics::closure::loop_gap_m(&robot, &q) < 1e-9);
        // the derivative of each entry of q by the task's joints, against differences
        let h = 1e-6;
        for joint in 0..joints.count() {
            let moved = |by: f64| {
                let mut values = values.clone();
                values[joint] += by;
                joints.positions(&robot, &values).unwrap()
            };
            let (after, before) = (moved(h), moved(-h));
            for entry in 0..robot.n() {
                let mut row = vec![0.0; robot.n()];
                row[entry] = 1.0;
                let rate = joints.per_joint(&robot, &q, &[row]).unwrap()[0][joint];
                let difference = (after[entry] - before[entry]) / (2.0 * h);
                assert!((rate - difference).abs() < 1e-6, "{joint} {entry}");
            }
        }
    }
}
