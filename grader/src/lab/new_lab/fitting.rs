//! Numbers that fit a robot: joint positions within its ranges, places that it reaches, gains for its inertias.

use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::dynamics::crba::mass_matrix;
use kinemark_sim::kinematics::branches::{BranchFinder, Reach};
use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::kinematics::position_range::{PositionRange, position_ranges};
use kinemark_sim::spatial::{rotation_from_rpy_deg, rpy_deg_from_rotation};
use kinemark_sim::text::number::{list, trimmed};
use nalgebra::{Rotation3, Vector3};

use super::NewLab;
use crate::attempt::branches::{count_different, count_distinct};
use crate::task::pose::{PoseForm, pose_at, pose_in};
use crate::task::pose_target::pose_target;
use crate::task::quantity::Quantity;
use crate::task::task_joints::TaskJoints;
use crate::task::tcp::tcp_in;

/// Angular frequency of the closed loops that gains are chosen for \[rad/s\].
pub(super) const LOOP_RAD_S: f64 = 20.0;
/// The range of a draw about a visible case, to either side \[rad or m\].
const ABOUT: f64 = 0.15;
/// As many branches may be a continuum.
pub(super) const CONTINUUM: usize = 16;
/// The distance from a goal at which nothing is earned, as a share of the distance between the two.
pub(super) const PLACE_BAND: f64 = 0.1;

/// A pose that is asked for.
#[derive(Debug)]
pub(super) struct FittingPose {
    /// How much of it counts.
    pub form: PoseForm,
    /// The keys of a case that say where it is.
    pub keys: String,
    /// How many branches reach it.
    pub branches: usize,
}

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
        let branches = match self.branches(PoseForm::Position, &place) {
            // nobody can list a continuum: one answer will do
            Some(count) if count >= CONTINUUM => 1,
            count => count.unwrap_or(1),
        };
        (place, branches)
    }

    /// Two poses that the robot reaches in so many branches that one can list them, as two samples have them: a heading where nothing tilts
    /// the TCP, else the whole pose, or with five joints one axis. `None` where the place alone decides how the TCP is turned.
    pub(super) fn poses(&self) -> Option<[FittingPose; 2]> {
        let forms = [
            PoseForm::Yaw,
            PoseForm::Full,
            PoseForm::Axis {
                of_tcp: Vector3::z(),
            },
        ];
        let of_form = |form| Some([self.pose(form, 1)?, self.pose(form, 2)?]);
        forms.into_iter().find_map(of_form)
    }

    fn pose(&self, form: PoseForm, number: usize) -> Option<FittingPose> {
        let pose = pose_in(self.robot, self.frame(), &self.q(number))?;
        let at = pose.translation.vector.map(|x| round(x, 4));
        let rpy_deg = rpy_deg_from_rotation(pose.rotation.matrix()).map(|angle| round(angle, 2));
        let mut numbers = at.as_slice().to_vec();
        let turned = match form {
            PoseForm::Position => return None,
            PoseForm::Yaw => {
                numbers.push(rpy_deg[2].to_radians());
                format!("yaw_deg = {}", trimmed(rpy_deg[2], 2))
            }
            PoseForm::Axis { of_tcp } => {
                // with fewer joints the place decides
                if self.robot.n() < 5 {
                    return None;
                }
                let axis = (pose.rotation * of_tcp).map(|x| round(x, 3));
                numbers.extend(axis.normalize().iter());
                format!("axis = {}", list(axis.as_slice()))
            }
            PoseForm::Full => {
                let turn = Rotation3::from_matrix_unchecked(rotation_from_rpy_deg(rpy_deg));
                numbers = PoseForm::Full.of(&pose_at(at, turn));
                format!("rpy_deg = {}", list(&rpy_deg))
            }
        };
        let branches = self.branches(form, &numbers)?;
        (1..CONTINUUM).contains(&branches).then(|| FittingPose {
            form,
            keys: format!("position_m = {}, {turned}", list(at.as_slice())),
            branches,
        })
    }

    /// Ranges about the positions of a sample for each joint, and the number of branches of a pose of this form, which is the same at
    /// corners of the ranges: as narrow as that needs.
    pub(super) fn about_pose(&self, form: PoseForm, number: usize) -> (String, usize) {
        let q = self.q(number);
        let at = |q: &[f64]| {
            let pose = pose_in(self.robot, self.frame(), q)?;
            self.branches(form, &form.of(&pose))
        };
        let branches = at(&q).unwrap_or(1);
        let corner = |half: f64, which: usize| -> Vec<f64> {
            let joints = q.iter().enumerate();
            joints
                .map(|(joint, q)| match which >> (joint % 3) & 1 {
                    0 => q - half,
                    _ => q + half,
                })
                .collect()
        };
        let is_same = |half: &f64| (0..8).all(|which| at(&corner(*half, which)) == Some(branches));
        let narrowest = 0.1 * ABOUT;
        let half = [ABOUT, 0.3 * ABOUT].into_iter().find(is_same);
        let half = half.unwrap_or(narrowest);
        let ranges = self.ranges(number, |q, (low, high)| {
            ((q - half).max(low), (q + half).min(high))
        });
        (ranges, branches)
    }

    /// How many branches reach numbers of a form.
    fn branches(&self, form: PoseForm, numbers: &[f64]) -> Option<usize> {
        let target = pose_target(self.robot, self.frame(), form, numbers)?;
        let mut finder = BranchFinder::of_kind(self.robot, self.robot.home(), target, None).ok()?;
        Some(match finder.reach_target(target).ok()? {
            Reach::In(found) if form.is_turned() => count_different(self.robot, &found),
            Reach::In(found) => count_distinct(self.robot, &found),
            Reach::Not { .. } => 0,
        })
    }

    /// The distance between the two places of a task with goals \[m\], by which its bands are chosen.
    pub(super) fn between_places(&self) -> f64 {
        let [first, second] = [1, 2].map(|sample| Vector3::from(self.place(sample).0));
        (second - first).norm()
    }

    /// Ranges for x, y and z beside the place of a sample, each of which the robot reaches: where the place can move along an axis of the
    /// lab's frame, by more than what still earns something; else the number itself.
    pub(super) fn beside_place(&self, number: usize) -> String {
        let place = self.place(number).0;
        let ends = [PLACE_BAND, 2.0 * PLACE_BAND].map(|share| share * self.between_places());
        let is_reached = |place: &[f64; 3]| {
            let branches = self.branches(PoseForm::Position, place);
            branches.is_some_and(|count| count > 0)
        };
        let range = |axis: usize| {
            [1.0, -1.0].into_iter().find_map(|sign| {
                let ends = ends.map(|by| round(place[axis] + sign * by, 3));
                let reached = ends.iter().all(|end| {
                    let mut there = place;
                    there[axis] = *end;
                    is_reached(&there)
                });
                reached.then_some([ends[0].min(ends[1]), ends[0].max(ends[1])])
            })
        };
        let alone = [0, 1, 2].map(range);
        let corner = |which: usize| {
            let end = |axis: usize| alone[axis].map_or(place[axis], |ends| ends[which >> axis & 1]);
            [0, 1, 2].map(end)
        };
        // where they cannot all move together, the first alone
        let together = (0..8).all(|which| is_reached(&corner(which)));
        let first = alone.iter().position(Option::is_some);
        let range = |axis: usize| match alone[axis] {
            Some(ends) if together || first == Some(axis) => list(&ends),
            _ => list(&[place[axis]; 2]),
        };
        format!("[{}]", [0, 1, 2].map(range).join(", "))
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
        let gains = self.robot.moving_joints().enumerate().map(|(i, joint)| {
            // what has no drive takes no command
            let factor = if joint.passive { 0.0 } else { factor };
            trimmed(significant(factor * inertias[(i, i)]), 6)
        });
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
pub(super) fn significant(value: f64) -> f64 {
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
