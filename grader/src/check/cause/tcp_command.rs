//! What a velocity command asks of the TCP, and where its path leads from there.

use nalgebra::{Matrix3, Vector3};

use crate::check::facts::MotionFacts;
use crate::check::path_following::passages;
use crate::task::jacobian::jacobian_in;
use crate::task::model::Rows;
use crate::task::watched::PathToFollow;

/// A segment's two ends, and the ticks between which it is followed.
type FollowedBetween = ([Vector3<f64>; 2], [usize; 2]);

/// Commands below this ask for nothing \[rad/s or m/s\].
pub(super) const LEAST_RATE: f64 = 1e-6;

/// The velocity commands of a run, seen at the TCP.
pub(super) struct TcpCommand<'a> {
    pub(super) facts: &'a MotionFacts<'a>,
}

impl<'a> TcpCommand<'a> {
    pub(super) fn new(facts: &'a MotionFacts<'a>) -> Self {
        Self { facts }
    }

    /// The path that the TCP is to follow, if it has one.
    pub(super) fn path(&self) -> Option<&'a PathToFollow> {
        self.facts.motion.paths.first()
    }

    /// Ticks from one call of `control` to the next.
    pub(super) fn stride(&self) -> usize {
        self.facts.motion.periods.ticks_per_control.get() as usize
    }

    /// The tick of the first call that asks for a motion.
    pub(super) fn first_call(&self) -> Option<usize> {
        let calls = (0..self.facts.trace.len()).step_by(self.stride());
        let asks = |tick: &usize| {
            let command = self.facts.trace.command.at(*tick);
            command.iter().any(|rate| rate.abs() > LEAST_RATE)
        };
        calls.into_iter().find(asks)
    }

    /// The linear part of the Jacobian at `q` by column, in the lab's frame.
    pub(super) fn jacobian(&self, q: &[f64]) -> Option<Vec<Vector3<f64>>> {
        let (robot, frame) = (self.facts.robot, self.facts.names.seen_from);
        let rows = jacobian_in(robot, frame, q, Rows::LINEAR)?;
        let columns = 0..robot.n();
        Some(
            columns
                .map(|joint| Vector3::new(rows[0][joint], rows[1][joint], rows[2][joint]))
                .collect(),
        )
    }

    /// The velocity of the TCP under `command` at `q` \[m/s\].
    pub(super) fn under(&self, q: &[f64], command: &[f64]) -> Option<Vector3<f64>> {
        Some(combined(&self.jacobian(q)?, command))
    }

    /// The velocity for which the command of a tick asks \[m/s\].
    pub(super) fn velocity_m_s(&self, tick: usize) -> Option<Vector3<f64>> {
        let trace = self.facts.trace;
        self.under(trace.q.at(tick), trace.command.at(tick))
    }

    /// Unit vectors of the directions that lead on from where the TCP is at the start of its path: to the next point, and along the
    /// first segment.
    pub(super) fn ways_on(&self, tick: usize) -> Vec<Vector3<f64>> {
        let Some(path) = self.path() else {
            return Vec::new();
        };
        let p = self.facts.trace.tcp_position(tick);
        let points = &path.points_m;
        let at_first = (p - points[0]).norm() <= path.trim_m;
        let mut ways = vec![points[usize::from(at_first)] - p];
        if at_first {
            ways.push(points[1] - points[0]);
        }
        let long = ways.into_iter().filter(|way| way.norm() > 1e-6);
        long.map(|way| way.normalize()).collect()
    }

    /// The angle between the velocity for which the command of a tick asks and the nearest way on \[rad\].
    pub(super) fn angle_aside(&self, tick: usize) -> Option<f64> {
        let v = self.velocity_m_s(tick)?;
        let ways = self.ways_on(tick);
        ways.iter().map(|way| angle(&v, way)).min_by(f64::total_cmp)
    }

    /// The segments of the path: their ends, and the ticks between which each is followed.
    pub(super) fn segments(&self) -> Option<Vec<FollowedBetween>> {
        let path = self.path()?;
        let passages = passages(&self.facts.p_tcp_m(), path)?;
        let ends = path.points_m.windows(2).zip(passages.windows(2));
        let segments =
            ends.map(|(ends, passages)| ([ends[0], ends[1]], [passages[0].tick, passages[1].tick]));
        Some(segments.collect())
    }
}

/// The distance of a point from the path \[m\].
pub(super) fn beside_m(path: &PathToFollow, p: &Vector3<f64>) -> f64 {
    let segments = path.points_m.windows(2).map(|ends| {
        let along = ends[1] - ends[0];
        let share = (p - ends[0]).dot(&along) / along.norm_squared();
        (p - ends[0] - along * share.clamp(0.0, 1.0)).norm()
    });
    segments.fold(f64::INFINITY, f64::min)
}

/// The sum of `columns`, each times its factor.
pub(super) fn combined(columns: &[Vector3<f64>], factors: &[f64]) -> Vector3<f64> {
    let terms = columns.iter().zip(factors);
    terms.map(|(column, factor)| column * *factor).sum()
}

/// `(J Jᵀ + λ I)⁻¹` of the Jacobian with these columns, with so little damping that only directions without any motion feel it. It is
/// arithmetic and roots alone, so it has the same bits everywhere.
pub(super) fn damped_inverse(columns: &[Vector3<f64>]) -> Option<Matrix3<f64>> {
    const DAMPING: f64 = 1e-9;
    let products = columns.iter().map(|column| column * column.transpose());
    let product: Matrix3<f64> = products.sum();
    (product + Matrix3::identity() * DAMPING).try_inverse()
}

/// The angle between two directions, in `[0, π]` \[rad\].
pub(super) fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}
