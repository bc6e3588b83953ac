//! A correction with the wrong sign: the further the hand is beside its path, the faster the command leads it further away.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{metres, seconds, trimmed};
use nalgebra::Vector3;

use super::tcp_command::TcpCommand;
use super::{Cause, Lost};

/// The hand counts as beside its path within these distances: nearer is rounding, and further the directions no longer hold \[m\].
const BESIDE_M: [f64; 2] = [1e-5, 0.1];
/// It must get this far \[m\].
const FAR_M: f64 = 0.03;
/// Velocity away from the path for each metre beside it \[1/s\].
const LEAST_GAIN: f64 = 0.3;
/// Share of the velocity across the path that the distance explains.
const EXPLAINED: f64 = 0.9;
/// The rate is the same early and late, but for this share.
const STEADY: f64 = 0.3;
/// Calls that say something.
const LEAST_CALLS: usize = 10;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    for ([from, to], [first, last]) in motion.segments()? {
        let along = (to - from).normalize();
        let across = |v: Vector3<f64>| v - along * v.dot(&along);
        let mut seen: Vec<Beside> = Vec::new();
        let (mut began, mut furthest_m, mut is_near) = (None, 0.0, true);
        for tick in (first..=last).step_by(motion.stride()) {
            let beside = across(facts.trace.tcp_position(tick) - from);
            let beside_m = beside.norm();
            furthest_m = f64::max(furthest_m, beside_m);
            is_near &= beside_m <= BESIDE_M[1];
            if !is_near {
                continue;
            }
            if beside_m < BESIDE_M[0] {
                continue;
            }
            began.get_or_insert(tick);
            let leads = across(motion.velocity_m_s(tick)?);
            seen.push(Beside {
                both: beside.dot(&leads),
                beside2: beside.norm_squared(),
                leads2: leads.norm_squared(),
            });
        }
        if seen.len() < LEAST_CALLS || furthest_m < FAR_M {
            continue;
        }
        // what drifts aside leads there from the start: only a correction grows with the distance, always at the same rate
        let (early, late) = seen.split_at(seen.len() / 2);
        let [Some((gain_early, early)), Some((gain, late))] = [early, late].map(gain) else {
            continue;
        };
        let is_steady = (gain_early - gain).abs() <= STEADY * gain.abs();
        if gain < LEAST_GAIN || early.min(late) < EXPLAINED || !is_steady {
            continue;
        }
        let tick = began?;
        return Some(Cause {
            words: format!(
                "from {} on, the command leads the hand away from its path, and the faster the further it is beside it: by {} m/s for each metre; it gets {} away",
                seconds(facts.time_s(tick)),
                trimmed(gain, 2),
                metres(furthest_m),
            ),
            signal: "tcp".to_owned(),
            tick,
            question: Some("Which way does your correction point when the hand is beside its path? It should point back.".to_owned()),
        });
    }
    None
}

/// A call: the products of the distance from the path and of the velocity across it.
struct Beside {
    both: f64,
    beside2: f64,
    leads2: f64,
}

/// Velocity across the path for each metre beside it \[1/s\], and the share of that velocity that the distance explains.
fn gain(calls: &[Beside]) -> Option<(f64, f64)> {
    let sum = |part: fn(&Beside) -> f64| calls.iter().map(part).sum::<f64>();
    let both = sum(|call| call.both);
    let (beside2, leads2) = (sum(|call| call.beside2), sum(|call| call.leads2));
    (beside2 > 0.0 && leads2 > 0.0).then(|| (both / beside2, both * both / (beside2 * leads2)))
}
