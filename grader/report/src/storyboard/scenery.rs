//! What stands still over all panels: the TCP's way, the reference's, paths asked for and goals, in the world.

use nalgebra::Point3;

use super::stage::Stage;
use kinemark_grader::record::graded::TaskRun;

/// Goals and paths that are drawn.
const MOST_GOALS: usize = 50;
const MOST_PATHS: usize = 20;

/// What is the same in all panels, in the world.
pub(super) struct Scenery {
    pub(super) trail: Vec<Point3<f64>>,
    pub(super) reference: Vec<Point3<f64>>,
    pub(super) paths: Vec<Vec<Point3<f64>>>,
    pub(super) goals: Vec<Point3<f64>>,
}

impl Scenery {
    pub(super) fn of(run: &TaskRun, stage: &Stage<'_>) -> Self {
        let world_from_lab = stage.world_from_lab();
        let placed = |p: &[f64; 3]| world_from_lab * Point3::from(*p);
        let reference = run.reference_tcp.iter().flat_map(|path| &path.points_m);
        let paths = run.paths.iter().take(MOST_PATHS);
        let goals = run.goals.iter().take(MOST_GOALS);
        Self {
            trail: (0..run.trace.len())
                .map(|tick| world_from_lab * Point3::from(run.trace.tcp_position(tick)))
                .collect(),
            reference: reference.map(placed).collect(),
            paths: paths
                .map(|path| path.points_m.iter().map(placed).collect())
                .collect(),
            goals: goals.map(|goal| placed(&goal.position_m)).collect(),
        }
    }
}

/// Whether a point can be drawn: an arm that flies away leaves the picture.
pub(super) fn finite(p: &Point3<f64>) -> bool {
    p.iter().all(|x| x.abs() < 1e6)
}
