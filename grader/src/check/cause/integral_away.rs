//! An integral with the wrong sign, in position commands: the further a joint is beyond an angle, the further the command goes with it.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{seconds, trimmed};

use super::{Cause, Lost};

/// Changes of the command that are no more than this say nothing \[rad or m\], nor do squares of their differences.
const LEAST_CHANGE: f64 = 1e-9;
/// A greater change from one call to the next is another setpoint and no integral \[rad or m\].
const JUMP: f64 = 0.05;
/// Calls that say something.
const LEAST_CALLS: usize = 25;
/// Share of the changes that the distance explains.
const EXPLAINED: f64 = 0.98;
/// The joint ends so many times as far away as it began.
const LED_AWAY: f64 = 3.0;
/// Growth for each second of which an integral is worth a word \[1/s\].
const LEAST_RATE: f64 = 0.1;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Position {
        return None;
    }
    let stride = facts.motion.periods.ticks_per_control.get() as usize;
    let calls: Vec<usize> = (0..facts.last_tick()).step_by(stride).collect();
    (0..facts.robot.n()).find_map(|joint| {
        let command = |tick: usize| facts.trace.command.at(tick)[joint];
        let q = |tick: usize| facts.trace.q.at(tick)[joint];
        // from the first call on that no jump leads to
        let mut pairs = Vec::new();
        for pair in calls.windows(2).skip(1) {
            let change = command(pair[1]) - command(pair[0]);
            if change.abs() > JUMP {
                break;
            }
            pairs.push((q(pair[1]), change, pair[1]));
        }
        let moving = pairs.iter().filter(|(_, change, _)| change.abs() > LEAST_CHANGE);
        if moving.count() < LEAST_CALLS {
            return None;
        }
        let (slope, zero, explained) = line(&pairs)?;
        let rate = slope / facts.motion.periods.control_s();
        if explained < EXPLAINED || rate < LEAST_RATE {
            return None;
        }
        let ((first, _, tick), (end, ..)) = (pairs[0], pairs[pairs.len() - 1]);
        if (end - zero).abs() < LED_AWAY * (first - zero).abs() {
            return None;
        }
        let units = facts.units(joint);
        let unit = units.position();
        let name = facts.joint_name(joint);
        Some(Cause {
            words: format!(
                "from {} on, the command of joint `{name}` goes by {} {unit} in each second for each {unit} that the joint is beyond {} {unit}, \
                 and in the same direction: so the joint is led further away",
                seconds(facts.time_s(tick)),
                trimmed(rate, 2),
                trimmed(zero, 3),
            ),
            signal: format!("command[{joint}]"),
            tick,
            question: Some(
                "When a joint is below the angle that you want, which way does your correction move its command?".to_owned(),
            ),
        })
    })
}

/// The line through changes over positions: its slope, where it is 0, and the share of the changes that it explains.
fn line(pairs: &[(f64, f64, usize)]) -> Option<(f64, f64, f64)> {
    let count = pairs.len() as f64;
    let mean = |part: fn(&(f64, f64, usize)) -> f64| pairs.iter().map(part).sum::<f64>() / count;
    let (x, y) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let sums = pairs.iter().map(|pair| {
        let (dx, dy) = (pair.0 - x, pair.1 - y);
        [dx * dx, dx * dy, dy * dy]
    });
    let [xx, xy, yy] = sums.fold([0.0; 3], |sum, now| {
        [sum[0] + now[0], sum[1] + now[1], sum[2] + now[2]]
    });
    // an even ramp changes by rounding alone
    if !(xx > 0.0 && yy > LEAST_CHANGE * count) {
        return None;
    }
    let slope = xy / xx;
    let zero = x - y / slope;
    zero.is_finite()
        .then_some((slope, zero, xy * xy / (xx * yy)))
}
