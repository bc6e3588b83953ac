//! Numbers that fit a robot: joint positions within its ranges, places that it reaches, gains for its inertias.

use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::dynamics::crba::mass_matrix;
use kinemark_sim::kinematics::branches::{BranchFinder, Reach};
use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::kinematics::position_range::{PositionRange, position_ranges};
use kinemark_sim::text::number::{list, trimmed};
use nalgebra::Vector3;

use super::NewLab;
use crate::attempt::branches::count_distinct;
use crate::task::quantity::Quantity;
use crate::task::task_joints::TaskJoints;
use crate::task::tcp::tcp_in;

/// Angular frequency of the closed loops that gains are chosen for \[rad/s\].
pub(super) const LOOP_RAD_S: f64 = 20.0;
/// The range of a draw about a visible case, to either side \[rad or m\].
const ABOUT: f64 = 0.15;
/// As many branches may be a continuum.
pub(super) const CONTINUUM: usize = 16;

impl NewLab<'_> {
    /// Joint positions within the ranges, to two decimals: the sample of this number.
    pub(super) fn q(&self, number: usize) -> Vec<f64> {
        let mut samples = JointSamples::new(self.robot);
        let mut q = vec![0.0; self.robot.n()];
        for _ in 0..=number {
            samples.next_into(&mut q);
        }
        let ranges = position_ranges(self.robot);
        let inside = q.iter().zip(&ranges).map(|(q, range)| {
            let (least, most) = range.sampled();
            let (low, high) = sampled(range);
            // the same share of the range that cases are taken from, away from its ends, where arms are stretched
            let share = if most > least {
                (q - least) / (most - least)
            } else {
                0.5
            };
            round(low + (0.2 + 0.6 * share) * (high - low), 2)
        });
        inside.collect()
    }

    /// A range about each of the positions of a sample.
    pub(super) fn about(&self, number: usize) -> String {
        self.ranges(number, |q, (low, high)| {
            ((q - ABOUT).max(low), (q + ABOUT).min(high))
        })
    }

    /// A range beside each of them, and not about it: a hidden run near the visible one would hide nothing.
    pub(super) fn beside(&self, number: usize) -> String {
        self.ranges(number, |q, (low, high)| match q + ABOUT <= high {
            true => (q + 0.5 * ABOUT, q + ABOUT),
            false => ((q - ABOUT).max(low), q - 0.5 * ABOUT),
        })
    }

    /// A range for each of the positions of a sample, from the position and the ends of what is sampled.
    fn ranges(&self, number: usize, range_of: impl Fn(f64, (f64, f64)) -> (f64, f64)) -> String {
        let sampled_ranges = position_ranges(self.robot).into_iter();
        let pairs = self.q(number).into_iter().zip(sampled_ranges);
        let pairs = pairs.map(|(q, range)| {
            let (from, to) = range_of(q, sampled(&range));
            list(&[round(from, 2), round(to, 2)])
        });
        format!("[{}]", pairs.collect::<Vec<_>>().join(", "))
    }

    /// The whole of what cases are taken from, for each joint.
    pub(super) fn whole(&self) -> String {
        let pairs = position_ranges(self.robot).into_iter().map(|range| {
            let (low, high) = sampled(&range);
            list(&[round_in(low, 1.0), round_in(high, -1.0)])
        });
        format!("[{}]", pairs.collect::<Vec<_>>().join(", "))
    }

    /// Where the TCP is at a sample \[m\], and how many branches reach it.
    pub(super) fn place(&self, number: usize) -> ([f64; 3], usize) {
        let q = self.q(number);
        let at = tcp_in(self.robot, self.frame(), &q).unwrap_or_default();
        let place = [at.x, at.y, at.z].map(|x| round(x, 4));
        let home = self.robot.home();
        let branches = self.in_world(&Vector3::from(place)).and_then(|p_in_world| {
            let mut finder = BranchFinder::new(self.robot, home).ok()?;
            match finder.reach(&p_in_world).ok()? {
                Reach::In(found) => match count_distinct(self.robot, &found) {
                    // nobody can list a continuum: one answer will do
                    count if count >= CONTINUUM => Some(1),
                    count => Some(count),
                },
                Reach::Not { .. } => Some(0),
            }
        });
        (place, branches.unwrap_or(1))
    }

    fn in_world(&self, p_in_lab: &Vector3<f64>) -> Option<Vector3<f64>> {
        let q = self.robot.positions(self.robot.home()).ok()?;
        let poses = forward_kinematics(self.robot, &q);
        let world_from_lab = poses.world_from(self.robot.frame(self.frame())?);
        Some(world_from_lab.transform_point(&(*p_in_lab).into()).coords)
    }

    /// Motion of the joints: positions, and the first so many derivatives.
    pub(super) fn state(&self, quantity: Quantity, sample: usize) -> Vec<Vec<f64>> {
        let mut state = vec![self.q(sample)];
        // any numbers would do: these are of the size of what arms do in a second, and no two joints have the same
        let derivative = |order: usize| -> Vec<f64> {
            let joints = 0..self.robot.n();
            joints
                .map(|joint| round(0.3 + 0.2 * ((joint + 2 * order + sample) % 5) as f64, 2))
                .collect()
        };
        state.extend((1..quantity.order()).map(derivative));
        state
    }

    /// A tenth of the greatest number of the quantity in the first case.
    pub(super) fn least_size(&self, quantity: Quantity) -> f64 {
        let joints = TaskJoints::of(self.robot, &[]);
        let state = self.state(quantity, 1);
        let value = quantity.at(self.robot, &joints, self.frame(), &GRAVITY_M_S2, &state);
        let greatest = value
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let tenth = significant(0.1 * greatest);
        if tenth > 0.0 { tenth } else { 1.0 }
    }

    /// So many times the inertia that each joint has at home, as a list of lab.toml or of a script.
    pub(super) fn gains(&self, factor: f64) -> String {
        let Ok(home) = self.robot.positions(self.robot.home()) else {
            return "[]".to_owned();
        };
        let inertias = mass_matrix(self.robot, &home);
        let gains = (0..self.robot.n()).map(|i| trimmed(significant(factor * inertias[(i, i)]), 6));
        format!("[{}]", gains.collect::<Vec<_>>().join(", "))
    }
}

/// The range of a joint that cases are taken from: within its limits, and within half a turn to either side, since more looks the same.
fn sampled(range: &PositionRange) -> (f64, f64) {
    let (low, high) = range.sampled();
    let half = std::f64::consts::PI;
    if range.turns && low < half && high > -half {
        (low.max(-half), high.min(half))
    } else {
        (low, high)
    }
}

/// To so many decimals.
pub(super) fn round(value: f64, decimals: i32) -> f64 {
    let scale = libm::pow(10.0, f64::from(decimals));
    // adding zero turns -0 into 0
    (value * scale).round() / scale + 0.0
}

/// To two decimals, up (1) or down (-1): inside a range.
fn round_in(value: f64, direction: f64) -> f64 {
    let rounded = round(value, 2);
    if (rounded - value) * direction < 0.0 {
        round(rounded + 0.01 * direction, 2)
    } else {
        rounded
    }
}

/// To two significant digits.
fn significant(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let digits = 1 - libm::floor(libm::log10(value.abs())) as i32;
    round(value, digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_for_people_and_stay_inside() {
        assert_eq!(round(-0.0004, 2), 0.0);
        assert_eq!(
            [significant(1234.0), significant(0.01234), significant(0.0)],
            [1200.0, 0.012, 0.0]
        );
        assert_eq!(
            [round_in(-2.0957, 1.0), round_in(2.0957, -1.0)],
            [-2.09, 2.09]
        );
        assert_eq!(
            [round_in(-2.618, 1.0), round_in(2.618, -1.0)],
            [-2.61, 2.61]
        );
    }
}
