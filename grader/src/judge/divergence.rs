//! The first control tick at which a run differs from the reference solution's, in a joint or in the position of the TCP.
//!
//! A difference is not a mistake by itself: another branch, another path or another time may be as right. So it is reported only for
//! runs that lost points, as the moment to look at first.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, trimmed};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::Trace;

use crate::record::comparison::{JOINT_TOLERANCE_RAD, POSITION_TOLERANCE_M};
use crate::record::grade::Divergence;
use crate::record::graded::TcpPath;

/// Compares two runs of the same task by joints and TCP, up to the end of the shorter one.
pub fn from_run(
    student: &Trace,
    reference: &Trace,
    robot: &Robot,
    periods: &Periods,
) -> Option<Divergence> {
    let every = periods.ticks_per_control.get() as usize;
    for tick in (0..student.len().min(reference.len())).step_by(every) {
        let tcp = of_tcp(
            student,
            tick,
            reference.tcp_position(tick).as_slice(),
            periods,
        );
        let pairs = student.q.at(tick).iter().zip(reference.q.at(tick));
        let joints = robot.moving_joints().zip(pairs).enumerate();
        let mut found = tcp;
        for (i, (joint, (yours, theirs))) in joints {
            let (tolerance, unit) = if joint.kind.turns() {
                (JOINT_TOLERANCE_RAD, "rad")
            } else {
                (POSITION_TOLERANCE_M, "m")
            };
            let distance = (yours - theirs).abs();
            let share = |found: &Divergence| found.distance / found.tolerance;
            if distance > tolerance
                && found
                    .as_ref()
                    .is_none_or(|found| distance / tolerance > share(found))
            {
                found = Some(Divergence {
                    tick: tick as u64,
                    time_s: periods.time_s(tick as u64),
                    signal: format!("q[{i}]"),
                    yours: vec![*yours],
                    reference: vec![*theirs],
                    distance,
                    tolerance,
                    unit: unit.to_owned(),
                    message: format!(
                        "`{}` is at {} {unit}, the reference solution's at {} {unit}",
                        joint.name,
                        trimmed(*yours, 4),
                        trimmed(*theirs, 4)
                    ),
                });
            }
        }
        if let Some(mut found) = found {
            let stays = found.signal != "tcp"
                && (tick..student.len().min(reference.len()))
                    .step_by(every)
                    .all(|tick| {
                        let apart = student.tcp_position(tick) - reference.tcp_position(tick);
                        apart.norm() <= POSITION_TOLERANCE_M
                    });
            if stays {
                found.message += &format!(
                    "; the TCP stays within {} of the reference's",
                    metres(POSITION_TOLERANCE_M)
                );
            }
            return Some(found);
        }
    }
    None
}

/// Compares a run with the part of the reference that students have: the path of its TCP.
pub fn from_path(student: &Trace, path: &TcpPath, periods: &Periods) -> Option<Divergence> {
    let every = u64::from(periods.ticks_per_control.get());
    path.points_m
        .iter()
        .enumerate()
        .find_map(|(i, reference_m)| {
            let tick = (i as f64 * path.period_s / periods.step_s).round() as u64;
            let is_control_tick = tick < student.len() as u64 && tick.is_multiple_of(every);
            is_control_tick.then(|| of_tcp(student, tick as usize, reference_m, periods))?
        })
}

/// The difference of the TCP from `reference_m` at a tick, if it is above the tolerance.
fn of_tcp(
    student: &Trace,
    tick: usize,
    reference_m: &[f64],
    periods: &Periods,
) -> Option<Divergence> {
    let yours = student.tcp_position(tick);
    let yours = yours.as_slice();
    let squares = yours
        .iter()
        .zip(reference_m)
        .map(|(a, b)| (a - b) * (a - b));
    let distance = squares.sum::<f64>().sqrt();
    (distance > POSITION_TOLERANCE_M).then(|| Divergence {
        tick: tick as u64,
        time_s: periods.time_s(tick as u64),
        signal: "tcp".to_owned(),
        yours: yours.to_vec(),
        reference: reference_m.to_vec(),
        distance,
        tolerance: POSITION_TOLERANCE_M,
        unit: "m".to_owned(),
        message: format!(
            "the TCP is at {} m, {} from the reference solution's at {} m",
            list(yours),
            metres(distance),
            list(reference_m)
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::sample::chain;

    fn periods() -> Periods {
        Periods::new(0.001, 0.001, 0.01).unwrap()
    }

    #[test]
    fn the_first_control_tick_over_the_tolerance_is_reported() {
        let reference = chain(2, 101, |_, _| 0.0);
        // over 0.02 rad from tick 21 on, which the control tick 30 is the first to see
        let student = chain(2, 101, |tick, joint| 0.001 * (tick * joint as u64) as f64);
        let found = from_run(&student.trace, &reference.trace, &student.robot, &periods());
        let found = found.unwrap();
        assert_eq!((found.tick, found.signal.as_str()), (30, "q[1]"));
        assert_eq!(
            (found.time_s, found.yours, found.reference),
            (0.03, vec![0.03], vec![0.0])
        );
        assert!(
            found
                .message
                .starts_with("`joint-2` is at 0.03 rad, the reference solution's at 0 rad"),
            "{}",
            found.message
        );
    }

    #[test]
    fn runs_that_agree_or_end_before_are_not_reported() {
        let reference = chain(2, 101, |_, _| 0.0);
        let near = chain(2, 101, |_, _| 0.019);
        let short = chain(2, 20, |tick, _| 0.001 * tick as f64);
        for student in [&near, &short, &chain(2, 0, |_, _| 0.0)] {
            let found = from_run(&student.trace, &reference.trace, &student.robot, &periods());
            assert_eq!(found, None);
        }
    }

    #[test]
    fn a_path_is_compared_at_its_own_points() {
        let student = chain(1, 101, |_, _| 0.0);
        let at: [f64; 3] = student.trace.tcp_position(0).into();
        let off = [at[0] + 0.02, at[1], at[2]];
        let path = |points_m: Vec<[f64; 3]>, period_s| TcpPath { period_s, points_m };
        let found = from_path(&student.trace, &path(vec![at, at, off], 0.02), &periods());
        let found = found.unwrap();
        assert_eq!((found.tick, found.signal.as_str()), (40, "tcp"));
        assert!((found.distance - 0.02).abs() < 1e-12);
        // points between control ticks, and after the run's end, are ignored
        for path in [
            path(vec![at, off, at], 0.015),
            path(vec![at, at, off], 0.06),
        ] {
            assert_eq!(from_path(&student.trace, &path, &periods()), None);
        }
    }
}
