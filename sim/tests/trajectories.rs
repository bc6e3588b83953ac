//! Laws of every trajectory: derivatives agree, limits are kept and reached, ends are exact, no input breaks it.

#![expect(
    clippy::float_cmp,
    reason = "ends and durations are exact, and that is the claim"
)]

use std::f64::consts::PI;

use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::spatial::{Pose, pose, rotation_exp, rotation_log};
use kinemark_sim::trajectory::{
    AlongPath, Arc, ArcOrientation, Cubic, JerkLimited, JerkLimits, JointTrajectory, Knot, Limits,
    Line, Path, Quintic, RestToRest, Sample, Spline, SplineEnds, Trajectory, Trapezoid,
};
use nalgebra::{Unit, Vector3};
use proptest::prelude::*;

/// Velocity is the derivative of position, and acceleration that of velocity, at `at_fraction` of the duration.
///
/// Central differences over 2 h miss the derivative by the change of the next derivative in that window at most; round-off
/// is 1e-16 of the largest position, `scale`, over h. Accelerations have a term of h² where they peak inside the window.
fn assert_derivatives(motion: &impl Trajectory<Sample = Sample>, at_fraction: f64, scale: f64) {
    let duration_s = motion.duration_s();
    let h = 1e-5 * duration_s;
    let t = (at_fraction * duration_s).clamp(h, duration_s - h);
    let (before, now, after) = (motion.at(t - h), motion.at(t), motion.at(t + h));
    let velocity = (after.position - before.position) / (2.0 * h);
    let acceleration = (after.velocity - before.velocity) / (2.0 * h);
    let change = (after.acceleration - before.acceleration).abs();
    let (per_s, per_s2) = (scale / duration_s, scale / duration_s / duration_s);
    assert!(
        (velocity - now.velocity).abs() <= h * change + 1e-8 * per_s,
        "{velocity} {now:?}"
    );
    assert!(
        (acceleration - now.acceleration).abs() <= change + 1e-6 * per_s2,
        "{acceleration} {now:?}"
    );
}

/// The largest speed and acceleration on a grid of 2000 steps, the ends, the middle and `also`, as fractions of the
/// duration.
fn peaks(motion: &impl Trajectory<Sample = Sample>, also: &[f64]) -> (f64, f64) {
    let duration_s = motion.duration_s();
    (0..=2000)
        .map(|i| f64::from(i) / 2000.0)
        .chain(also.iter().copied())
        .map(|fraction| motion.at((fraction * duration_s).min(duration_s)))
        .fold((0.0, 0.0), |(v, a): (f64, f64), sample| {
            (
                v.max(sample.velocity.abs()),
                a.max(sample.acceleration.abs()),
            )
        })
}

/// The first and last instants have the end positions to the bit, and outside nothing moves.
fn assert_exact_ends(motion: &impl Trajectory<Sample = Sample>, start: f64, end: f64) {
    let duration_s = motion.duration_s();
    assert!(duration_s.is_finite() && duration_s >= 0.0, "{duration_s}");
    if duration_s > 0.0 {
        assert_eq!(motion.at(0.0).position, start);
    }
    assert_eq!(motion.at(duration_s).position, end);
    assert_eq!(motion.at(-1.0), Sample::at_rest(start));
    assert_eq!(motion.at(f64::INFINITY), Sample::at_rest(end));
}

/// The same times by another method: the peak speed by bisection, the distance by the mean of a symmetric speed.
fn jerk_limited_duration_by_bisection(way: f64, limits: &JerkLimits) -> f64 {
    let JerkLimits {
        speed: v,
        acceleration: a,
        jerk: j,
    } = *limits;
    let time_to = |peak: f64| {
        if peak < a * a / j {
            2.0 * (peak / j).sqrt()
        } else {
            a / j + peak / a
        }
    };
    if v * time_to(v) <= way {
        return 2.0 * time_to(v) + (way - v * time_to(v)) / v;
    }
    let (mut low, mut high) = (0.0, v);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle * time_to(middle) < way {
            low = middle;
        } else {
            high = middle;
        }
    }
    2.0 * time_to(high)
}

fn state() -> impl Strategy<Value = Sample> {
    (-3.0..3.0_f64, -3.0..3.0_f64, -3.0..3.0_f64).prop_map(|(position, velocity, acceleration)| {
        Sample {
            position,
            velocity,
            acceleration,
        }
    })
}

fn knot(sample: Sample) -> Knot {
    Knot {
        position: sample.position,
        velocity: sample.velocity,
    }
}

proptest! {
    #[test]
    fn polynomials_meet_their_ends_and_their_derivatives(
        start in state(), end in state(), duration_s in 0.1..10.0_f64, at in 0.0..1.0_f64,
    ) {
        // factors of the polynomials are up to 60 (3 + 3 T + 3 T²)
        let scale = 60.0 * (3.0 + 3.0 * duration_s + 3.0 * duration_s * duration_s);
        let quintic = Quintic::between(start, end, duration_s).unwrap();
        prop_assert_eq!(quintic.at(0.0), start);
        prop_assert_eq!(quintic.at(duration_s), end);
        assert_derivatives(&quintic, at, scale);
        assert_exact_ends(&quintic, start.position, end.position);
        // the polynomial itself arrives, not only its last instant
        let last = quintic.at(duration_s * (1.0 - f64::EPSILON));
        prop_assert!((last.position - end.position).abs() < 1e-14 * scale);
        prop_assert!((last.velocity - end.velocity).abs() < 1e-13 * scale / duration_s);
        prop_assert!(
            (last.acceleration - end.acceleration).abs() < 1e-12 * scale / duration_s / duration_s
        );

        let cubic = Cubic::between(knot(start), knot(end), duration_s).unwrap();
        prop_assert_eq!(knot(cubic.at(0.0)), knot(start));
        prop_assert_eq!(knot(cubic.at(duration_s)), knot(end));
        assert_derivatives(&cubic, at, scale);
        assert_exact_ends(&cubic, start.position, end.position);
        let last = cubic.at(duration_s * (1.0 - f64::EPSILON));
        prop_assert!((last.position - end.position).abs() < 1e-14 * scale);
        prop_assert!((last.velocity - end.velocity).abs() < 1e-13 * scale / duration_s);
    }

    #[test]
    fn limits_are_kept_and_the_tighter_is_reached(
        start in -3.0..3.0_f64, end in -3.0..3.0_f64,
        speed in 0.05..5.0_f64, acceleration in 0.05..20.0_f64, deceleration in 0.05..20.0_f64,
        at in 0.0..1.0_f64,
    ) {
        let limits = Limits { speed, acceleration };
        let way = (end - start).abs();
        // a dozen roundings
        let over = 1.0 + 1e-13;
        let kept = |(v, a): (f64, f64)| v <= speed * over && a <= acceleration * over;
        let reached = |(v, a): (f64, f64)| v >= speed / over || a >= acceleration / over;

        let cubic = Cubic::rest_to_rest(start, end, &limits).unwrap();
        let quintic = Quintic::rest_to_rest(start, end, &limits).unwrap();
        let trapezoid = Trapezoid::rest_to_rest(start, end, &limits).unwrap();
        let peaks_of_cubic = peaks(&cubic, &[]);
        let peaks_of_quintic = peaks(&quintic, &[0.5 - 3.0_f64.sqrt() / 6.0]);
        let peaks_of_trapezoid = peaks(&trapezoid, &[]);
        for both in [peaks_of_cubic, peaks_of_quintic, peaks_of_trapezoid] {
            prop_assert!(kept(both), "{both:?}");
            prop_assert!(reached(both), "{both:?}");
        }
        // the trapezoid is the fastest of all under these limits
        prop_assert!(trapezoid.duration_s() <= cubic.duration_s() * over);
        prop_assert!(trapezoid.duration_s() <= quintic.duration_s() * over);

        let uneven = Trapezoid::with_deceleration(start, end, &limits, deceleration).unwrap();
        let (v, a) = peaks(&uneven, &[]);
        prop_assert!(v <= speed * over && a <= acceleration.max(deceleration) * over);
        // the distance, summed up from the peak speed
        let peak = uneven.peak_speed();
        let by_slopes = 0.5 * peak * peak * (1.0 / acceleration + 1.0 / deceleration);
        let cruise_s = uneven.duration_s() - peak / acceleration - peak / deceleration;
        prop_assert!((by_slopes + peak * cruise_s - way).abs() < 1e-13 * (1.0 + way));
        for motion in [&trapezoid, &uneven] {
            assert_derivatives(motion, at, 3.0);
            assert_exact_ends(motion, start, end);
        }
    }

    #[test]
    fn jerk_limited_motion_keeps_three_limits_in_the_least_time(
        start in -3.0..3.0_f64, end in -3.0..3.0_f64,
        speed in 0.05..5.0_f64, acceleration in 0.05..20.0_f64, jerk in 0.05..200.0_f64,
        at in 0.0..1.0_f64,
    ) {
        let limits = JerkLimits { speed, acceleration, jerk };
        let motion = JerkLimited::rest_to_rest(start, end, &limits).unwrap();
        let over = 1.0 + 1e-13;
        let (v, a) = peaks(&motion, &[]);
        prop_assert!(v <= speed * over && a <= acceleration * over, "{v} {a}");
        prop_assert!(motion.peak_speed() <= speed * over);
        prop_assert!(motion.peak_acceleration() <= acceleration * over);
        // jerk as the slope of acceleration, over a step of 1/2000 of the duration
        let step_s = motion.duration_s() / 2000.0;
        for i in 0..2000 {
            let t_s = f64::from(i) * step_s;
            let change = motion.at(t_s + step_s).acceleration - motion.at(t_s).acceleration;
            prop_assert!(change.abs() <= jerk * step_s * (1.0 + 1e-9) + 1e-12, "{t_s}: {change}");
        }
        let expected_s = jerk_limited_duration_by_bisection((end - start).abs(), &limits);
        prop_assert!((motion.duration_s() - expected_s).abs() <= 1e-12 * expected_s);
        assert_derivatives(&motion, at, 3.0);
        assert_exact_ends(&motion, start, end);
        // symmetric in time
        let (early, late) = (motion.at(at * motion.duration_s()), motion.at((1.0 - at) * motion.duration_s()));
        prop_assert!((early.position - start + late.position - end).abs() < 1e-13);
    }

    #[test]
    fn a_spline_passes_its_points_with_continuous_acceleration(
        points in prop::collection::vec((0.1..2.0_f64, -3.0..3.0_f64), 2..12),
        natural in any::<bool>(), start_velocity in -2.0..2.0_f64, end_velocity in -2.0..2.0_f64,
        at in 0.0..1.0_f64,
    ) {
        let mut time_s = 0.0;
        let mut times_s = Vec::new();
        for (i, point) in points.iter().enumerate() {
            time_s += if i == 0 { 0.0 } else { point.0 };
            times_s.push(time_s);
        }
        let positions: Vec<f64> = points.iter().map(|point| point.1).collect();
        let ends = if natural {
            SplineEnds::Natural
        } else {
            SplineEnds::Clamped { start_velocity, end_velocity }
        };
        let spline = Spline::through(&times_s, &positions, ends).unwrap();
        prop_assert_eq!(spline.duration_s(), time_s);
        for (&t_s, &position) in times_s.iter().zip(&positions) {
            prop_assert_eq!(spline.at(t_s).position, position);
        }
        for &t_s in &times_s[1..times_s.len() - 1] {
            // accelerations are up to some 1e4 (6 over 0.1² s²), their slopes up to 1e6, over 1e-12 s
            let (left, right) = (spline.at(t_s - 1e-12), spline.at(t_s));
            prop_assert!((left.velocity - right.velocity).abs() < 1e-7);
            prop_assert!((left.acceleration - right.acceleration).abs() < 1e-5);
        }
        let (first, last) = (spline.at(0.0), spline.at(time_s));
        if natural {
            prop_assert!(first.acceleration.abs() < 1e-9 && last.acceleration.abs() < 1e-9);
        } else {
            prop_assert_eq!((first.velocity, last.velocity), (start_velocity, end_velocity));
        }
        // pieces are as short as 0.1 s in 20 s
        assert_derivatives(&spline, at, 1e4 * time_s * time_s);
        assert_exact_ends(&spline, positions[0], positions[positions.len() - 1]);
    }

    #[test]
    fn joints_start_and_end_together_within_their_limits(
        joints in prop::collection::vec(
            (-3.0..3.0_f64, -3.0..3.0_f64, 0.1..3.0_f64, 0.1..9.0_f64, 1.0..90.0_f64), 1..7,
        ),
    ) {
        let from = JointPositions::new(joints.iter().map(|joint| joint.0));
        let to = JointPositions::new(joints.iter().map(|joint| joint.1));
        let limits: Vec<JerkLimits> = joints
            .iter()
            .map(|&(_, _, speed, acceleration, jerk)| JerkLimits { speed, acceleration, jerk })
            .collect();
        let motion = JointTrajectory::<JerkLimited>::rest_to_rest(&from, &to, &limits).unwrap();
        let duration_s = motion.duration_s();
        prop_assert!(motion.axes().iter().any(|axis| axis.duration_s() == duration_s));
        prop_assert_eq!(&motion.at(0.0).q, &from);
        prop_assert_eq!(&motion.at(duration_s).q, &to);
        prop_assert_eq!(&motion.at(duration_s + 1.0).q, &to);
        for i in 0..=200 {
            let sample = motion.at((f64::from(i) / 200.0 * duration_s).min(duration_s));
            for (joint, limit) in limits.iter().enumerate() {
                prop_assert!(sample.qd.as_slice()[joint].abs() <= limit.speed * (1.0 + 1e-13));
                prop_assert!(
                    sample.qdd.as_slice()[joint].abs() <= limit.acceleration * (1.0 + 1e-13)
                );
            }
        }
        // the joints are synchronous: by symmetry all are at half of their distance at half time
        let middle = motion.at(0.5 * duration_s);
        for (joint, ends) in joints.iter().enumerate() {
            prop_assert!((middle.q.as_slice()[joint] - 0.5 * (ends.0 + ends.1)).abs() < 1e-14);
        }
    }

    #[test]
    fn no_numbers_break_a_motion_of_one_axis(
        numbers in prop::array::uniform8(any::<f64>()), t_s in any::<f64>(),
    ) {
        let [p0, p1, v, a, j, d, v0, v1] = numbers;
        let limits = Limits { speed: v.abs(), acceleration: a.abs() };
        let jerk_limits = JerkLimits { speed: v.abs(), acceleration: a.abs(), jerk: j.abs() };
        if let Ok(motion) = Trapezoid::with_deceleration(p0, p1, &limits, d.abs()) {
            assert_exact_ends(&motion, p0, p1);
            let _ = motion.at(t_s);
        }
        if let Ok(motion) = JerkLimited::rest_to_rest(p0, p1, &jerk_limits) {
            assert_exact_ends(&motion, p0, p1);
            let _ = motion.at(t_s);
        }
        if let Ok(motion) = Quintic::rest_to_rest(p0, p1, &limits) {
            assert_exact_ends(&motion, p0, p1);
            let _ = motion.at(t_s);
        }
        let (start, end) = (Knot { position: p0, velocity: v0 }, Knot { position: p1, velocity: v1 });
        if let Ok(motion) = Cubic::between(start, end, d.abs()) {
            assert_exact_ends(&motion, p0, p1);
            let _ = motion.at(t_s);
        }
        if let Ok(motion) = Spline::through(&[0.0, v.abs(), a.abs()], &[p0, p1, j], SplineEnds::Natural) {
            assert_exact_ends(&motion, p0, j);
            let _ = motion.at(t_s);
        }
    }

    #[test]
    fn no_numbers_break_a_path(
        numbers in prop::array::uniform9(any::<f64>()), angle_rad in any::<f64>(), t_s in any::<f64>(),
    ) {
        let point = |i: usize| Vector3::new(numbers[i], numbers[i + 1], numbers[i + 2]);
        let (start, end) = (at_rest_at(point(0)), at_rest_at(point(6)));
        let limits = Limits { speed: 1.0, acceleration: 1.0 };
        if let Ok(line) = Line::between(&start, &end) {
            prop_assert_eq!(line.at(1.0).world_from_tcp, end);
            if let Ok(motion) = AlongPath::<_, Trapezoid>::rest_to_rest(line, &limits) {
                let _ = motion.at(t_s);
            }
        }
        let through = Arc::through(&start, point(3), &end);
        let axis = Unit::new_unchecked(point(6));
        let about = Arc::about_axis(&start, point(3), axis, angle_rad, ArcOrientation::Carried);
        for arc in [through, about].into_iter().flatten() {
            if let Ok(motion) = AlongPath::<_, Trapezoid>::rest_to_rest(arc, &limits) {
                let _ = motion.at(t_s);
            }
        }
    }
}

fn at_rest_at(position_m: Vector3<f64>) -> Pose {
    pose(nalgebra::Matrix3::identity(), position_m)
}

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

fn any_pose() -> impl Strategy<Value = Pose> {
    (vector(3.0), vector(1.0)).prop_map(|(turn, position)| pose(rotation_exp(&turn), position))
}

/// The twist is the derivative of the pose and its rate that of the twist, by central differences over two steps.
///
/// Extrapolated, the differences miss the derivative by the fourth power of the step, 1e-16 of the duration's, times a sixth
/// derivative of up to 12⁶ lengths (12 rad per duration round a full circle) over 480: 1e-12; round-off is 1e-15 over 1e-4.
fn assert_twist(motion: &AlongPath<impl Path, Quintic>, at_fraction: f64) {
    let duration_s = motion.duration_s();
    let h = 1e-4 * duration_s;
    let t_s = (at_fraction * duration_s).clamp(h, duration_s - h);
    let slopes = |h: f64| {
        let (before, after) = (motion.at(t_s - h), motion.at(t_s + h));
        let (from, to) = (before.world_from_tcp, after.world_from_tcp);
        let turned = to.rotation.matrix() * from.rotation.matrix().transpose();
        [
            to.translation.vector - from.translation.vector,
            rotation_log(&turned),
            after.twist.linear - before.twist.linear,
            after.twist.angular - before.twist.angular,
        ]
        .map(|difference| difference / (2.0 * h))
    };
    let (wide, narrow) = (slopes(h), slopes(0.5 * h));
    let now = motion.at(t_s);
    let expected = [
        now.twist.linear,
        now.twist.angular,
        now.twist_rate.linear,
        now.twist_rate.angular,
    ];
    let per_s = (1.0 + motion.path().length_m()) / duration_s;
    let tolerances = [per_s, per_s, per_s / duration_s, per_s / duration_s];
    for (i, tolerance) in tolerances.into_iter().enumerate() {
        let slope = (narrow[i] * 4.0 - wide[i]) / 3.0;
        let error = (slope - expected[i]).norm();
        assert!(error <= 1e-9 * tolerance, "{i}: {slope} {}", expected[i]);
    }
}

const LIMITS: Limits = Limits {
    speed: 0.7,
    acceleration: 1.3,
};

proptest! {
    #[test]
    fn a_line_is_straight_and_its_axis_of_turning_fixed(
        start in any_pose(), end in any_pose(), at in 0.0..1.0_f64,
    ) {
        let line = Line::between(&start, &end).unwrap();
        let motion = AlongPath::<_, Quintic>::rest_to_rest(line, &LIMITS).unwrap();
        prop_assert_eq!(motion.at(0.0).world_from_tcp, start);
        prop_assert_eq!(motion.at(motion.duration_s()).world_from_tcp, end);
        let sample = motion.at(at * motion.duration_s());
        let chord = end.translation.vector - start.translation.vector;
        let off = (sample.world_from_tcp.translation.vector - start.translation.vector).cross(&chord);
        prop_assert!(off.norm() < 1e-14);
        let axis = line.turn().rotation_vector_rad();
        prop_assert!(sample.twist.angular.cross(&axis).norm() < 1e-13);
        // `log` is taken of a product of rounded rotations, and half a turn is near for some
        let end_by_turning = rotation_exp(&axis) * start.rotation.matrix();
        prop_assert!((end_by_turning - end.rotation.matrix()).norm() < 1e-14);
        assert_twist(&motion, at);
    }

    #[test]
    fn an_arc_stays_on_its_circle_and_meets_its_points(
        start in any_pose(), end in any_pose(), via in vector(1.0), at in 0.0..1.0_f64,
    ) {
        let (p0, p1) = (start.translation.vector, end.translation.vector);
        // a height of 0.1 m over every side: a circle the points fix well
        prop_assume!((via - p0).cross(&(p1 - p0)).norm() > 0.1 * (p1 - p0).norm());
        prop_assume!((via - p0).cross(&(p1 - p0)).norm() > 0.1 * (via - p0).norm());
        prop_assume!((via - p0).cross(&(p1 - p0)).norm() > 0.1 * (via - p1).norm());
        let arc = Arc::through(&start, via, &end).unwrap();
        let (centre, radius_m) = (arc.centre_in_world(), arc.radius_m());
        let tolerance_m = 1e-13 * (1.0 + radius_m * radius_m);
        for point in [p0, via, p1] {
            prop_assert!(((point - centre).norm() - radius_m).abs() < tolerance_m);
        }
        prop_assert!(arc.angle_rad() > 0.0 && arc.angle_rad() < 2.0 * PI);
        // the path passes through via, at its angle about the centre
        let (x, y) = ((p0 - centre) / radius_m, arc.axis_in_world().cross(&(p0 - centre)) / radius_m);
        let to_via = via - centre;
        let seen = libm::atan2(to_via.dot(&y), to_via.dot(&x)).rem_euclid(2.0 * PI);
        prop_assert!(seen < arc.angle_rad(), "{seen} of {}", arc.angle_rad());
        let met = arc.at(seen / arc.angle_rad()).world_from_tcp.translation.vector;
        prop_assert!((met - via).norm() < tolerance_m);

        let motion = AlongPath::<_, Quintic>::rest_to_rest(arc, &LIMITS).unwrap();
        prop_assert_eq!(motion.at(0.0).world_from_tcp, start);
        prop_assert_eq!(motion.at(motion.duration_s()).world_from_tcp, end);
        let sample = motion.at(at * motion.duration_s());
        let spoke = sample.world_from_tcp.translation.vector - centre;
        prop_assert!((spoke.norm() - radius_m).abs() < tolerance_m);
        prop_assert!(spoke.dot(&sample.twist.linear).abs() < tolerance_m);
        // the speed of the law, and v²/r towards the centre
        let law = motion.law().at(at * motion.duration_s());
        prop_assert!((sample.twist.linear.norm() - law.velocity.abs()).abs() < 1e-12);
        let inward = -sample.twist_rate.linear.dot(&spoke) / radius_m;
        prop_assert!((inward - law.velocity * law.velocity / radius_m).abs() < 1e-11);
        assert_twist(&motion, at);
    }
}
