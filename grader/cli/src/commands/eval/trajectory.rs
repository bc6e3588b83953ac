//! The operation `trajectory`: a motion of the joints or of the TCP, sampled at the times asked for.

use kinemark_sim::joint::{JointAccelerations, JointPositions, JointVelocities};
use kinemark_sim::spatial::{Pose, pose};
use kinemark_sim::trajectory::{
    AlongPath, Arc, Cubic, JerkLimited, JerkLimits, JointSample, JointTrajectory, Line, Path,
    PoseSample, Quintic, Sample, Spline, SplineEnds, Trajectory, TrajectoryError, Trapezoid,
};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::Refusal;
use super::operation::{finite, matrix_rows};
use super::request::Fields;

/// More samples than this are asked for by mistake.
const MOST_SAMPLES: usize = 100_000;

const KINDS: &str = "`cubic`, `quintic`, `trapezoid`, `jerk-limited`, `spline`, `line` or `arc`";
const LAWS: &str = "`cubic`, `quintic`, `trapezoid` or `jerk-limited`";

/// Answers one request.
pub(super) fn answer(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let kind = fields
        .text("kind")?
        .ok_or_else(|| Refusal::new("missing-field", format!("`kind` is missing: {KINDS}")))?;
    let at_s = if fields.has("at_s") {
        fields.numbers("at_s")?
    } else {
        Vec::new()
    };
    if at_s.len() > MOST_SAMPLES {
        let message = format!("{} times are more than {MOST_SAMPLES}", at_s.len());
        return Err(Refusal::new("too-large", message));
    }
    match kind.as_str() {
        "line" => {
            let [start, end] = poses(&mut fields)?;
            let path = Line::between(&start, &end).map_err(|error| refuse(&error))?;
            along(fields, path, &at_s)
        }
        "arc" => {
            let [start, end] = poses(&mut fields)?;
            let via = fields.triple("via_m")?.ok_or_else(|| {
                Refusal::new("missing-field", "`via_m` is missing: a point of the arc")
            })?;
            let path = Arc::through(&start, via, &end).map_err(|error| refuse(&error))?;
            along(fields, path, &at_s)
        }
        "spline" => {
            let times_s = fields.numbers("times_s")?;
            let points = fields.lists("points")?;
            let natural = fields.truth("natural")?.unwrap_or(false);
            fields.finish()?;
            let ends = if natural {
                SplineEnds::Natural
            } else {
                SplineEnds::AT_REST
            };
            let n = points.first().map_or(0, Vec::len);
            if let Some(other) = points.iter().find(|point| point.len() != n) {
                let message = format!("a point has {} numbers, the first {n}", other.len());
                return Err(Refusal::new("wrong-length", message));
            }
            let axes = (0..n)
                .map(|i| {
                    let axis: Vec<f64> = points.iter().map(|point| point[i]).collect();
                    Spline::through(&times_s, &axis, ends)
                })
                .collect();
            joints(axes, &at_s)
        }
        law => {
            let (from, to) = (fields.numbers("from")?, fields.numbers("to")?);
            if from.len() != to.len() {
                let message = format!("`from` has {} numbers, `to` {}", from.len(), to.len());
                return Err(Refusal::new("wrong-length", message));
            }
            let n = from.len();
            match law {
                "cubic" | "quintic" => {
                    let [start, end] = states(&mut fields, law, from, to)?;
                    let duration_s = fields.positive("duration_s")?;
                    fields.finish()?;
                    if law == "cubic" {
                        sampled(
                            JointTrajectory::<Cubic>::between(&start, &end, duration_s),
                            &at_s,
                        )
                    } else {
                        sampled(
                            JointTrajectory::<Quintic>::between(&start, &end, duration_s),
                            &at_s,
                        )
                    }
                }
                "trapezoid" => {
                    let limits = limits(&mut fields, n)?;
                    let deceleration = fields.per_axis("deceleration", n)?;
                    fields.finish()?;
                    let axes = (0..n)
                        .map(|i| {
                            let slow = deceleration.as_ref().map(|d| d[i]);
                            let slow = slow.unwrap_or(limits[i].acceleration);
                            Trapezoid::with_deceleration(from[i], to[i], &limits[i], slow)
                        })
                        .collect();
                    joints(axes, &at_s)
                }
                "jerk-limited" => {
                    let limits = jerk_limits(&mut fields, n)?;
                    fields.finish()?;
                    let (from, to) = (JointPositions::new(from), JointPositions::new(to));
                    sampled(
                        JointTrajectory::<JerkLimited>::rest_to_rest(&from, &to, &limits),
                        &at_s,
                    )
                }
                other => Err(Refusal::new(
                    "out-of-range",
                    format!("no trajectory `{other}`: {KINDS}"),
                )),
            }
        }
    }
}

fn refuse(error: &TrajectoryError) -> Refusal {
    Refusal::new("cannot-plan", error.to_string())
}

/// Start and end of polynomials, at rest where nothing else is said.
fn states(
    fields: &mut Fields<'_>,
    law: &str,
    from: Vec<f64>,
    to: Vec<f64>,
) -> Result<[JointSample; 2], Refusal> {
    let n = from.len();
    let mut rates = |name| Ok::<_, Refusal>(fields.per_axis(name, n)?.unwrap_or(vec![0.0; n]));
    let mut state = |q: Vec<f64>, qd, qdd| {
        Ok(JointSample {
            q: JointPositions::new(q),
            qd: JointVelocities::new(rates(qd)?),
            // a cubic has no say about accelerations: its field is then unknown
            qdd: match law {
                "quintic" => JointAccelerations::new(rates(qdd)?),
                _ => JointAccelerations::zeros(n),
            },
        })
    };
    Ok([
        state(from, "from_qd", "from_qdd")?,
        state(to, "to_qd", "to_qdd")?,
    ])
}

fn limits(
    fields: &mut Fields<'_>,
    n: usize,
) -> Result<Vec<kinemark_sim::trajectory::Limits>, Refusal> {
    let mut need = |name| {
        fields
            .per_axis(name, n)?
            .ok_or_else(|| Refusal::new("missing-field", format!("`{name}` is missing")))
    };
    let (speed, acceleration) = (need("speed")?, need("acceleration")?);
    Ok((0..n)
        .map(|i| kinemark_sim::trajectory::Limits {
            speed: speed[i],
            acceleration: acceleration[i],
        })
        .collect())
}

fn jerk_limits(fields: &mut Fields<'_>, n: usize) -> Result<Vec<JerkLimits>, Refusal> {
    let limits = limits(fields, n)?;
    let jerk = fields
        .per_axis("jerk", n)?
        .ok_or_else(|| Refusal::new("missing-field", "`jerk` is missing"))?;
    Ok((0..n)
        .map(|i| JerkLimits {
            speed: limits[i].speed,
            acceleration: limits[i].acceleration,
            jerk: jerk[i],
        })
        .collect())
}

fn joints<A: Trajectory<Sample = Sample>>(
    axes: Result<Vec<A>, TrajectoryError>,
    at_s: &[f64],
) -> Result<Value, Refusal> {
    sampled(axes.and_then(JointTrajectory::together), at_s)
}

fn sampled<A: Trajectory<Sample = Sample>>(
    motion: Result<JointTrajectory<A>, TrajectoryError>,
    at_s: &[f64],
) -> Result<Value, Refusal> {
    let motion = motion.map_err(|error| refuse(&error))?;
    let samples: Vec<JointSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: &dyn Fn(&JointSample) -> Vec<f64>| -> Result<Value, Refusal> {
        samples.iter().map(|sample| finite(&part(sample))).collect()
    };
    Ok(json!({
        "duration_s": motion.duration_s(),
        "q": column(&|s| s.q.as_slice().to_vec())?,
        "qd": column(&|s| s.qd.as_slice().to_vec())?,
        "qdd": column(&|s| s.qdd.as_slice().to_vec())?,
    }))
}

/// `from` and `to` as poses: `{position_m, rotation?}`.
fn poses(fields: &mut Fields<'_>) -> Result<[Pose; 2], Refusal> {
    let mut one = |name: &'static str| {
        let mut part = fields.object(name)?;
        let position = part.triple("position_m")?.ok_or_else(|| {
            Refusal::new(
                "missing-field",
                format!("`position_m` of `{name}` is missing"),
            )
        })?;
        let rotation = part.rotation("rotation")?.unwrap_or(Matrix3::identity());
        part.finish()?;
        Ok(pose(rotation, position))
    };
    Ok([one("from")?, one("to")?])
}

fn along<P: Path>(mut fields: Fields<'_>, path: P, at_s: &[f64]) -> Result<Value, Refusal> {
    let law = fields.text("law")?.unwrap_or_else(|| "quintic".to_owned());
    let extent = path.extent();
    match law.as_str() {
        "cubic" | "quintic" => {
            let duration_s = fields.positive("duration_s")?;
            fields.finish()?;
            let (start, end) = (Sample::at_rest(0.0), Sample::at_rest(extent));
            if law == "quintic" {
                let law = Quintic::between(start, end, duration_s);
                travelled(path, law, at_s)
            } else {
                use kinemark_sim::trajectory::Knot;
                let law = Cubic::between(Knot::at_rest(0.0), Knot::at_rest(extent), duration_s);
                travelled(path, law, at_s)
            }
        }
        "trapezoid" => {
            let limits = limits(&mut fields, 1)?;
            fields.finish()?;
            let slow = limits[0].acceleration;
            travelled(
                path,
                Trapezoid::with_deceleration(0.0, extent, &limits[0], slow),
                at_s,
            )
        }
        "jerk-limited" => {
            use kinemark_sim::trajectory::RestToRest as _;
            let limits = jerk_limits(&mut fields, 1)?;
            fields.finish()?;
            travelled(
                path,
                JerkLimited::rest_to_rest(0.0, extent, &limits[0]),
                at_s,
            )
        }
        other => Err(Refusal::new(
            "out-of-range",
            format!("no time law `{other}`: {LAWS}"),
        )),
    }
}

fn travelled<P: Path, L: Trajectory<Sample = Sample>>(
    path: P,
    law: Result<L, TrajectoryError>,
    at_s: &[f64],
) -> Result<Value, Refusal> {
    let motion = law
        .and_then(|law| AlongPath::new(path, law))
        .map_err(|error| refuse(&error))?;
    let samples: Vec<PoseSample> = at_s.iter().map(|&t| motion.at(t)).collect();
    let column = |part: &dyn Fn(&PoseSample) -> Vector3<f64>| -> Result<Value, Refusal> {
        samples
            .iter()
            .map(|sample| finite(part(sample).as_slice()))
            .collect()
    };
    let rotations: Result<Value, Refusal> = samples
        .iter()
        .map(|sample| matrix_rows(sample.world_from_tcp.rotation.matrix()))
        .collect();
    Ok(json!({
        "duration_s": motion.duration_s(),
        "length_m": motion.path().length_m(),
        "position_m": column(&|s| s.world_from_tcp.translation.vector)?,
        "rotation": rotations?,
        "velocity_m_s": column(&|s| s.twist.linear)?,
        "angular_velocity_rad_s": column(&|s| s.twist.angular)?,
        "acceleration_m_s2": column(&|s| s.twist_rate.linear)?,
        "angular_acceleration_rad_s2": column(&|s| s.twist_rate.angular)?,
    }))
}
