//! Out of time: the run ends while the hand is still on its way along its path.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{metres, seconds, trimmed};

use super::tcp_command::{TcpCommand, angle};
use super::{Cause, Lost};
use crate::check::path_following::passages;

/// A hand on its way moves faster than this \[m/s\].
const LEAST_M_S: f64 = 0.01;
/// It is no further beside its path than this \[m\].
const BESIDE_M: f64 = 0.05;
/// It moves along its path within this \[rad\].
const ALONG: f64 = 0.3;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let path = motion.path()?;
    let positions_m = facts.p_tcp_m();
    let passages = passages(&positions_m, path)?;
    let next = passages.iter().position(|passage| passage.gap_m > 0.0)?;
    let (last, point) = (facts.last_tick(), path.points_m[next]);
    let p = positions_m[last];
    let way = point - p;
    let v = motion.velocity_m_s(last.saturating_sub(1))?;
    let beside_m = match next.checked_sub(1) {
        Some(before) => {
            let along = (point - path.points_m[before]).normalize();
            (way - along * way.dot(&along)).norm()
        }
        None => 0.0,
    };
    let is_on_its_way = v.norm() > LEAST_M_S && angle(&v, &way) < ALONG && beside_m < BESIDE_M;
    is_on_its_way.then(|| Cause {
        words: format!(
            "the run ends at {} while the hand is still on its way: {} before point {} of {}, at {} m/s",
            seconds(facts.time_s(last)),
            metres(way.norm()),
            next + 1,
            path.points_m.len(),
            trimmed(v.norm(), 3)
        ),
        signal: "tcp".to_owned(),
        tick: last,
        question: Some("How long is the way, how fast should the hand be on it, and where did it wait?".to_owned()),
    })
}
