//! Functions of the robot's own model, where the task grants them: the brief says which. One that is not granted ends the call.
//!
//! They are those of the robot of the call. A function of the lab's own gets no robot, and cannot use them.
//!
//! ```no_run
//! # let q = [0.0, 0.0];
//! let [shoulder, elbow] = kinemark_plugin::robot_model::gravity(&q);
//! # let _ = shoulder + elbow;
//! ```

use core::sync::atomic::{AtomicUsize, Ordering};

use crate::host;

/// How many joints the robot of the call has; 0 before there is one.
static JOINTS: AtomicUsize = AtomicUsize::new(0);

pub(crate) fn set_joints(joints: usize) {
    JOINTS.store(joints, Ordering::Relaxed);
}

/// Position of the TCP in the lab's frame \[m\] at joint positions `q`, shape `(n)` \[rad or m\].
///
/// # Panics
/// If `q` has not one number per joint.
#[track_caller]
pub fn fk(q: &[f64]) -> [f64; 3] {
    check(q, q.len());
    let mut position = [0.0; 3];
    // SAFETY: a number per joint at `q`, and room for 3
    unsafe { host::fk(q.as_ptr(), position.as_mut_ptr()) };
    position
}

/// Jacobian of the TCP's position in the lab's frame at `q` \[rad or m\]: rows x, y, z \[m/s\], a column per joint.
///
/// # Panics
/// If `N` or the length of `q` is not the number of joints.
#[track_caller]
pub fn jacobian<const N: usize>(q: &[f64]) -> [[f64; N]; 3] {
    check(q, N);
    let mut matrix = [[0.0; N]; 3];
    // SAFETY: a number per joint at `q`, and room for 3 rows of as many
    unsafe { host::jacobian(q.as_ptr(), matrix.as_flattened_mut().as_mut_ptr()) };
    matrix
}

/// Efforts that balance gravity at rest at `q` \[rad or m\], shape `(n)` \[N m or N\].
///
/// # Panics
/// If `N` or the length of `q` is not the number of joints.
#[track_caller]
pub fn gravity<const N: usize>(q: &[f64]) -> [f64; N] {
    check(q, N);
    let mut effort = [0.0; N];
    // SAFETY: a number per joint at `q`, and room for as many
    unsafe { host::gravity(q.as_ptr(), effort.as_mut_ptr()) };
    effort
}

/// Mass matrix at `q` \[rad or m\], shape `(n, n)` \[kg m², kg m or kg\].
///
/// # Panics
/// If `N` or the length of `q` is not the number of joints.
#[track_caller]
pub fn mass_matrix<const N: usize>(q: &[f64]) -> [[f64; N]; N] {
    check(q, N);
    let mut matrix = [[0.0; N]; N];
    // SAFETY: a number per joint at `q`, and room for as many rows of as many
    unsafe { host::mass_matrix(q.as_ptr(), matrix.as_flattened_mut().as_mut_ptr()) };
    matrix
}

/// Kinemark reads and writes by the number of joints, whatever room there is.
#[track_caller]
fn check(q: &[f64], n: usize) {
    let joints = JOINTS.load(Ordering::Relaxed);
    if joints == 0 {
        panic!("a function of the lab's own gets no robot, and cannot query its model");
    }
    if q.len() != joints {
        panic!(
            "{} positions are given, and the robot has {joints} joints",
            q.len()
        );
    }
    if n != joints {
        panic!("an array of {n} is returned into, and the robot has {joints} joints");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::tests::panicked;

    #[test]
    fn a_wrong_number_of_positions_never_reaches_the_model() {
        assert_eq!(
            panicked(|| _ = gravity::<2>(&[0.0; 2]).len()),
            "a function of the lab's own gets no robot, and cannot query its model"
        );
        set_joints(2);
        assert_eq!(
            panicked(|| _ = fk(&[0.0; 3]).len()),
            "3 positions are given, and the robot has 2 joints"
        );
        assert_eq!(
            panicked(|| _ = mass_matrix::<3>(&[0.0; 2]).len()),
            "an array of 3 is returned into, and the robot has 2 joints"
        );
    }
}
