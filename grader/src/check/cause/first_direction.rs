//! A hand that sets out in another direction than its path: against it, with two numbers exchanged, or as an inverse with a wrong sign
//! in one entry sends it.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{list, trimmed};
use nalgebra::{Matrix2, Vector2, Vector3};

use super::tcp_command::{TcpCommand, angle, combined, damped_inverse};
use super::{Cause, Lost};

/// Less than this aside says nothing \[rad\].
const LEAST_ASIDE: f64 = 0.12;
/// What goes further aside than this, and agrees with no slip, is no correction either \[rad\].
const FAR_ASIDE: f64 = 0.8;
/// Directions that are the same \[rad\].
const SAME: f64 = 0.01;
/// Calls that are looked at.
const CALLS: usize = 5;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let first = motion.first_call()?;
    let calls: Vec<usize> = (first..facts.trace.len())
        .step_by(motion.stride())
        .take(CALLS)
        .collect();
    let aside = |tick: &usize| motion.angle_aside(*tick);
    let asides: Vec<f64> = calls.iter().map(aside).collect::<Option<_>>()?;
    if asides.len() < CALLS || asides.iter().any(|aside| *aside < LEAST_ASIDE) {
        return None;
    }
    let v = motion.velocity_m_s(first)?;
    let mut words = format!(
        "the first command, {}, moves the hand at {} m/s along x, y, z, {}° aside from its path",
        list(facts.trace.command.at(first)),
        list(v.as_slice()),
        trimmed(asides[0] * 180.0 / std::f64::consts::PI, 0),
    );
    let mut question =
        "What is your Jacobian times the command, at the first call? It should be the velocity that you want."
            .to_owned();
    match reading(&motion, &calls) {
        Some((seen, ask)) => {
            words += &format!("; {seen}");
            question = ask.to_owned();
        }
        None if asides.iter().any(|aside| *aside < FAR_ASIDE) => return None,
        // what turns to and fro has no direction
        None if calls.iter().any(|tick| turns(&motion, &v, *tick)) => return None,
        None => {}
    }
    Some(Cause {
        words,
        signal: "tcp".to_owned(),
        tick: first,
        question: Some(question),
    })
}

/// Whether the velocity for which a call asks has turned away from `v`.
fn turns(motion: &TcpCommand<'_>, v: &Vector3<f64>, tick: usize) -> bool {
    let later = motion.velocity_m_s(tick);
    later.is_none_or(|later| angle(&later, v) > FAR_ASIDE)
}

/// What was done to the command, if one slip alone explains the first direction, and those of the calls after it lead back to the path
/// where they leave it.
fn reading(motion: &TcpCommand<'_>, calls: &[usize]) -> Option<(&'static str, &'static str)> {
    let readings: [(Meant, &str, &str); 6] = [
        (
            against,
            "that is straight back",
            "Which sign has your velocity, and which the determinant, if your inverse divides by one? The velocity points from where the hand is to where it should be.",
        ),
        (
            joints_exchanged,
            "with its two numbers exchanged it would follow the path",
            "In which order do you return the velocities of the joints?",
        ),
        (
            axes_exchanged,
            "it would follow the path if x and y of the velocity that you want were exchanged",
            "Which coordinate comes first in the velocity that you want, and which row of your Jacobian is it for?",
        ),
        (
            of_transpose,
            "it is what the transpose of the Jacobian gives where the inverse belongs",
            "Which velocity of the hand does your command give, if you multiply it by the Jacobian?",
        ),
        (
            of_jacobian,
            "it is what the Jacobian itself gives where its inverse belongs",
            "Which velocity of the hand does your command give, if you multiply it by the Jacobian?",
        ),
        (
            of_wrong_inverse,
            "it is what the inverse of the Jacobian gives with a wrong sign in one entry",
            "Multiply your inverse by your Jacobian: is the product 1 on the diagonal and 0 elsewhere?",
        ),
    ];
    let ways = motion.ways_on(calls[0]);
    let asked_m_s = motion.facts.motion.target_number("speed");
    // one that is not as fast as was asked for has another slip, or two
    let is_fast = |v: &Vector3<f64>| {
        let times = asked_m_s.map_or(1.0, |asked| v.norm() / asked);
        (0.5..=2.0).contains(&times)
    };
    let mut found = readings.iter().filter(|(meant, ..)| {
        ways.iter().any(|way| {
            let first = meant(motion, calls[0], way);
            first.is_some_and(|v| angle(&v, way) <= SAME && is_fast(&v))
                && calls[1..]
                    .iter()
                    .all(|&tick| leads_back(motion, calls[0], tick, meant(motion, tick, way), way))
        })
    });
    let (_, seen, ask) = found.next()?;
    found.next().is_none().then_some((*seen, *ask))
}

/// The velocity that was meant at a tick, if the command suffers from a slip \[m/s\].
type Meant = fn(&TcpCommand<'_>, usize, &Vector3<f64>) -> Option<Vector3<f64>>;

/// Whether what was meant at a tick goes on along the `way` from tick `first`, and aside from it only back to it.
fn leads_back(
    motion: &TcpCommand<'_>,
    first: usize,
    tick: usize,
    meant: Option<Vector3<f64>>,
    way: &Vector3<f64>,
) -> bool {
    let Some(meant) = meant else {
        return false;
    };
    let trace = motion.facts.trace;
    let gone = trace.tcp_position(tick) - trace.tcp_position(first);
    let across = |v: &Vector3<f64>| v - way * v.dot(way);
    let back = -across(&gone).dot(&across(&meant));
    meant.dot(way) > 0.0 && back >= -SAME * meant.norm() * across(&gone).norm()
}

fn against(motion: &TcpCommand<'_>, tick: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
    Some(-motion.velocity_m_s(tick)?)
}

fn joints_exchanged(
    motion: &TcpCommand<'_>,
    tick: usize,
    _: &Vector3<f64>,
) -> Option<Vector3<f64>> {
    let trace = motion.facts.trace;
    let [a, b] = *trace.command.at(tick) else {
        return None;
    };
    motion.under(trace.q.at(tick), &[b, a])
}

fn axes_exchanged(motion: &TcpCommand<'_>, tick: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
    let v = motion.velocity_m_s(tick)?;
    Some(Vector3::new(v.y, v.x, v.z))
}

/// The velocity whose multiple with the transpose of the Jacobian is the command.
fn of_transpose(motion: &TcpCommand<'_>, tick: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
    let trace = motion.facts.trace;
    let jacobian = motion.jacobian(trace.q.at(tick))?;
    let inverse = damped_inverse(&jacobian)?;
    Some(inverse * combined(&jacobian, trace.command.at(tick)))
}

/// The velocity whose multiple with the Jacobian of a planar arm of two joints is the command.
fn of_jacobian(motion: &TcpCommand<'_>, tick: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
    let trace = motion.facts.trace;
    let (planar, [first, second]) = planar_jacobian(motion, tick)?;
    let command = Vector2::from_column_slice(trace.command.at(tick));
    let meant = planar.try_inverse()? * command;
    let mut v = Vector3::zeros();
    (v[first], v[second]) = (meant.x, meant.y);
    Some(v)
}

/// The Jacobian of a planar arm of two joints, and its two rows of three.
fn planar_jacobian(motion: &TcpCommand<'_>, tick: usize) -> Option<(Matrix2<f64>, [usize; 2])> {
    let jacobian = motion.jacobian(motion.facts.trace.q.at(tick))?;
    let moves = |row: &usize| jacobian.iter().any(|column| column[*row].abs() > 1e-9);
    let rows: Vec<usize> = (0..3).filter(moves).collect();
    let (&[first, second], 2) = (&rows[..], jacobian.len()) else {
        return None;
    };
    let planar = Matrix2::from_fn(|row, column| jacobian[column][rows[row]]);
    Some((planar, [first, second]))
}

/// The velocity from which the inverse of the Jacobian, with the other sign in one entry, makes the command; of the four, the one
/// nearest to `way`. For a planar arm of two joints.
fn of_wrong_inverse(
    motion: &TcpCommand<'_>,
    tick: usize,
    way: &Vector3<f64>,
) -> Option<Vector3<f64>> {
    let trace = motion.facts.trace;
    let (planar, [first, second]) = planar_jacobian(motion, tick)?;
    let inverse = planar.try_inverse()?;
    let command = Vector2::from_column_slice(trace.command.at(tick));
    let right = planar * command;
    let mut nearest: Option<Vector3<f64>> = None;
    for entry in 0..4 {
        let mut wrong = inverse;
        wrong[entry] = -wrong[entry];
        let Some(back) = wrong.try_inverse() else {
            continue;
        };
        let meant = back * command;
        // an entry of no effect is no mistake that shows
        if (meant - right).norm() <= LEAST_ASIDE * right.norm() {
            continue;
        }
        let mut v = Vector3::zeros();
        (v[first], v[second]) = (meant.x, meant.y);
        if nearest.is_none_or(|known| angle(&v, way) < angle(&known, way)) {
            nearest = Some(v);
        }
    }
    nearest
}
