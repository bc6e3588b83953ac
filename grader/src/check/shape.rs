//! What a response looks like as a whole, before a sentence about it is chosen: it leaves its target at once, it swings and does not
//! get smaller, or it is where another joint should be.

use kinemark_sim::control::Mode;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::text::number::{list, seconds, trimmed};

use super::cause::{creeping_law, speed_term, wrong_setpoint};
use super::step_response::Response;
use crate::task::value::Value;

/// What is seen, from when on, and what to ask.
pub(super) struct Seen {
    /// In words, beginning with the signal.
    pub(super) words: String,
    /// The earliest tick that shows it.
    pub(super) tick: usize,
    /// A question, or what to look at.
    pub(super) next_step: String,
}

/// A joint that moves by this share of the way has left its start.
const LEFT: f64 = 0.02;
/// A joint that is this much further from its target than it began has not only dipped the other way at first.
const RUN_OFF: f64 = 1.5;
/// A value is another's, but for this share of the way.
const SAME: f64 = 0.2;
/// Ways below this may agree by chance \[rad, m, or a second of them\].
const LEAST_WAY: f64 = 0.05;
/// A joint that has turned so far and still turns so fast spins \[rad, rad/s\].
const TURNED: f64 = std::f64::consts::TAU;
const SPINS: f64 = 5.0;
/// Fewer half swings than this say nothing.
const LEAST_HALVES: usize = 4;
/// A swing that keeps this share of its size from the first half of its half swings to the second hardly gets smaller.
const LASTING: f64 = 0.5;
/// One that keeps this share does not get smaller.
const KEPT: f64 = 0.9;

/// What is seen of a response that does not come to rest, or not at its target.
pub(super) fn seen(response: &Response<'_>) -> Option<Seen> {
    swapped_output(response)
        .or_else(|| away(response))
        .or_else(|| swapped(response))
        .or_else(|| other_joint_spins(response))
        .or_else(|| wrong_setpoint(response))
        .or_else(|| speed_term(response))
        .or_else(|| creeping_law(response))
        .or_else(|| lasting_swing(response))
}

/// The first command does nothing for the joint, which is away from its target, and something for another one: the numbers that
/// `control` returns are exchanged.
fn swapped_output(response: &Response<'_>) -> Option<Seen> {
    let facts = response.facts;
    let way = response.asked.target? - response.start;
    if facts.motion.servo.mode != Mode::Effort || way.abs() < LEAST_WAY {
        return None;
    }
    let joint = response.asked.joint;
    let first = facts.trace.command.at(0);
    let mut others = (0..facts.robot.n()).filter(|other| *other != joint);
    let other = others.find(|other| first[*other] * way > 0.0)?;
    (first[joint] == 0.0).then(|| Seen {
        words: format!(
            "the first command, {}, has nothing for {}, which is {} from its target, and something for joint `{}`",
            list(first),
            response.what(),
            response.with_unit(way.abs()),
            facts.joint_name(other),
        ),
        tick: 0,
        next_step: are_swapped(response),
    })
}

/// Another joint turns round and round at the end: what this one does follows from that.
fn other_joint_spins(response: &Response<'_>) -> Option<Seen> {
    let facts = response.facts;
    let (trace, last) = (facts.trace, facts.last_tick());
    let mut others = (0..facts.robot.n()).filter(|joint| *joint != response.asked.joint);
    let other = others.find(|joint| {
        let turned = trace.q.at(last)[*joint] - trace.q.at(0)[*joint];
        let speed = trace.qd.at(last)[*joint];
        facts.units(*joint).position() == "rad"
            && turned.abs() > TURNED
            && speed.abs() > SPINS
            && turned * speed > 0.0
    })?;
    let units = facts.units(other);
    let turned = trace.q.at(last)[other] - trace.q.at(0)[other];
    let begins =
        (0..=last).find(|tick| (trace.q.at(*tick)[other] - trace.q.at(0)[other]).abs() > 1.0);
    let name = facts.joint_name(other);
    Some(Seen {
        words: format!(
            "joint `{name}` spins: at the end it turns at {} {} and is {} {} from where it began",
            trimmed(trace.qd.at(last)[other], 2),
            units.speed(),
            trimmed(turned.abs(), 2),
            units.position(),
        ),
        tick: begins.unwrap_or(last),
        next_step: format!(
            "What do you return for joint `{name}`, and which way does that drive it?"
        ),
    })
}

/// It moves away from its target at once, and gets much further from it than it began: the sign of the error.
fn away(response: &Response<'_>) -> Option<Seen> {
    let target = response.asked.target?;
    let way = target - response.start;
    if way.abs() < LEAST_WAY {
        return None;
    }
    let left = |value: &f64| (value - response.start).abs() > LEFT * way.abs();
    let tick = response.values.iter().position(left)?;
    let goes_away = (response.values[tick] - response.start) * way < 0.0;
    // an arm that first dips the other way comes back, and is never much further off than at its start
    let off = response.values.iter().map(|value| (value - target).abs());
    let runs_off = off.fold(0.0, f64::max) > RUN_OFF * way.abs();
    (goes_away && runs_off).then(|| Seen {
        words: format!(
            "{} moves away from its target at once: at {} it is at {}; {} was asked for",
            response.what(),
            seconds(response.time_s(tick as f64)),
            response.with_unit(response.values[tick]),
            response.with_unit(target),
        ),
        tick,
        next_step:
            "Which sign has the error in your law, the target minus what is measured? It should pull the joint to its target."
                .to_owned(),
    })
}

/// It stays where it was, and another joint is where it should be.
pub(super) fn swapped(response: &Response<'_>) -> Option<Seen> {
    let target = response.asked.target?;
    let way = (target - response.start).abs();
    let stayed = (response.end - response.start).abs() < 0.5 * way;
    if way < LEAST_WAY || !stayed {
        return None;
    }
    let facts = response.facts;
    let signal = match response.asked.of {
        Fed::Position => &facts.trace.q,
        Fed::Velocity => &facts.trace.qd,
    };
    let last = facts.last_tick();
    let mut others = (0..facts.robot.n()).filter(|joint| *joint != response.asked.joint);
    let other = others.find(|joint| {
        let [begins, ends] = [0, last].map(|tick| signal.at(tick)[*joint]);
        (ends - target).abs() <= SAME * way && (ends - begins).abs() > 0.5 * way
    })?;
    Some(Seen {
        words: format!(
            "joint `{}` is at {} at the end, where {} should be",
            facts.joint_name(other),
            response.with_unit(signal.at(last)[other]),
            response.what(),
        ),
        tick: last,
        next_step: are_swapped(response),
    })
}

fn are_swapped(response: &Response<'_>) -> String {
    format!(
        "Are two joints swapped in what you return? Its first number is for joint `{}`.",
        response.facts.joint_name(0)
    )
}

/// The joint that should be where this one is, by the name of an entry of the task's target such as `elbow_rad`, and that entry.
pub(super) fn place_of_another(
    response: &Response<'_>,
    own_target: f64,
) -> Option<(String, String)> {
    let Value::Map(entries) = &response.facts.motion.target else {
        return None;
    };
    let unit = match response.asked.of {
        Fed::Position => "rad",
        Fed::Velocity => "rad_s",
    };
    let others = (0..response.facts.robot.n()).filter(|joint| *joint != response.asked.joint);
    others
        .filter_map(|joint| {
            let key = format!("{}_{unit}", response.facts.joint_name(joint));
            let entry = entries.iter().find(|(name, _)| *name == key)?;
            let Value::Number(target) = entry.1 else {
                return None;
            };
            let is_there = (response.end - target).abs() <= SAME * target.abs();
            let is_another = (target - own_target).abs() >= LEAST_WAY;
            (is_there && is_another).then(|| {
                let words = format!(
                    "that is where joint `{}` should be",
                    response.facts.joint_name(joint)
                );
                (words, are_swapped(response))
            })
        })
        .next()
}

/// A swing across the target, or the final value where there is none.
struct Swing {
    /// The first crossing.
    tick: usize,
    low: f64,
    high: f64,
    /// Swings a second.
    per_s: f64,
    /// The size of the later half of its half swings, as a share of that of the earlier.
    remains: f64,
}

/// The swing of a signal across `centre` from its first crossing on; `None` with too few half swings.
fn swing(values: &[f64], centre: f64, step_s: f64) -> Option<Swing> {
    let side = |value: f64| value > centre;
    let crossings: Vec<usize> = (1..values.len())
        .filter(|tick| side(values[*tick]) != side(values[tick - 1]))
        .collect();
    // what comes after the last crossing may be no whole half swing
    let halves: Vec<f64> = crossings
        .windows(2)
        .map(|pair| {
            let half = values[pair[0]..pair[1]].iter();
            half.fold(0.0, |most: f64, value| most.max((value - centre).abs()))
        })
        .collect();
    if halves.len() < LEAST_HALVES {
        return None;
    }
    let (earlier, later) = halves.split_at(halves.len() / 2);
    let largest = |halves: &[f64]| halves.iter().copied().fold(0.0, f64::max);
    let (first, last) = (crossings[0], crossings[crossings.len() - 1]);
    let swung = &values[first..last];
    Some(Swing {
        tick: first,
        low: swung.iter().copied().fold(f64::INFINITY, f64::min),
        high: swung.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        per_s: 0.5 * halves.len() as f64 / ((last - first) as f64 * step_s),
        remains: largest(later) / largest(earlier),
    })
}

/// It swings across its target and does not get smaller: nothing brakes it.
fn lasting_swing(response: &Response<'_>) -> Option<Seen> {
    // a joint that is to stop in the end may turn to and fro before
    if response.asked.of == Fed::Velocity && response.asked.target.is_some_and(|it| it.abs() <= 0.0)
    {
        return None;
    }
    let centre = response.asked.target.unwrap_or(response.end);
    let step_s = response.facts.motion.periods.step_s;
    let swing = swing(&response.values, centre, step_s)?;
    if swing.remains < LASTING {
        return None;
    }
    let how = match swing.remains {
        remains if remains > 1.0 / KEPT => "gets larger",
        remains if remains >= KEPT => "does not get smaller",
        _ => "hardly gets smaller",
    };
    let across = match response.asked.target {
        Some(_) => "its target",
        None => "its final value",
    };
    Some(Seen {
        words: format!(
            "{} swings back and forth across {across} and {}: between {} and {}, about {} times a second",
            response.what(),
            how,
            response.with_unit(swing.low),
            response.with_unit(swing.high),
            trimmed(swing.per_s, 1),
        ),
        tick: swing.tick,
        next_step: match response.asked.of {
            Fed::Position => {
                "Damp the swing: is a derivative term subtracted, `- kd * qd`? If it is, raise kd or lower kp and ki."
            }
            Fed::Velocity => {
                "Which term of your law follows the swing? Feedback that is too strong overcorrects, and so does its derivative."
            }
        }
        .to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::swing;
    use crate::check::by_hand::{HandRow, judged};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 2.0";
    const STEADY: &str =
        "steady-error = { joint = \"elbow\", target_rad = 1.0, full_rad = 0.01, zero_rad = 0.1 }";

    /// The message and the advice of an elbow that should go to 1 rad.
    fn read(elbow: impl Fn(f64) -> f64) -> (String, String) {
        let finding = judged(MOTION, STEADY, |t_s| HandRow {
            q: [0.0, elbow(t_s)],
            ..HandRow::default()
        });
        (finding.evidence[0].message.clone(), finding.next_step)
    }

    #[test]
    fn what_leaves_its_target_at_once_has_the_wrong_sign() {
        let (message, next_step) = read(|t_s| -2.0 * t_s);
        assert!(
            message.starts_with(
                "joint `elbow` moves away from its target at once: at 0.011 s it is at -0.022 rad"
            ),
            "{message}"
        );
        assert!(
            next_step.starts_with("Which sign has the error in your law"),
            "{next_step}"
        );
        // one that turns back is no such
        let (message, _) = read(|t_s| if t_s < 0.1 { -t_s } else { 0.5 });
        assert!(!message.contains("moves away"), "{message}");
    }

    #[test]
    fn what_swings_and_does_not_get_smaller_is_not_braked() {
        let (message, next_step) = read(|t_s| 1.0 - libm::cos(20.0 * t_s));
        assert!(
            message.contains("swings back and forth across its target and does not get smaller: between 0 rad and 2 rad, about 3.2 times a second"),
            "{message}"
        );
        assert!(next_step.starts_with("Damp the swing"), "{next_step}");
        let (message, _) = read(|t_s| 1.0 - libm::exp(0.5 * t_s) * libm::cos(20.0 * t_s));
        assert!(message.contains("and gets larger"), "{message}");
        // one that dies away does get smaller
        let (message, _) = read(|t_s| 1.0 - libm::exp(-1.2 * t_s) * libm::cos(20.0 * t_s));
        assert!(!message.contains("get smaller"), "{message}");
    }

    #[test]
    fn a_joint_where_another_should_be_is_swapped() {
        let finding = judged(MOTION, STEADY, |t_s| HandRow {
            q: [t_s.min(1.0), 0.0],
            ..HandRow::default()
        });
        let message = &finding.evidence[0].message;
        assert_eq!(
            message,
            "joint `shoulder` is at 1 rad at the end, where joint `elbow` should be"
        );
        assert!(finding.next_step.starts_with("Are two joints swapped"));
    }

    #[test]
    fn a_joint_is_where_the_target_wants_another() {
        let motion = "mode = \"effort\"\nduration_s = 2.0\ntarget = { elbow_rad = 1.0 }";
        let held = "steady-error = { joint = \"shoulder\", target_rad = 0.0, full_rad = 0.01, zero_rad = 0.1 }";
        let finding = judged(motion, held, |t_s| HandRow {
            q: [t_s.min(1.0), 0.0],
            ..HandRow::default()
        });
        let message = &finding.evidence[0].message;
        assert!(
            message.ends_with("that is where joint `elbow` should be"),
            "{message}"
        );
    }

    #[test]
    fn half_swings_are_counted_between_crossings() {
        let values: Vec<f64> = (0..1000)
            .map(|tick| libm::cos(0.05 * f64::from(tick)))
            .collect();
        let found = swing(&values, 0.0, 0.001).expect("a swing");
        // 0.05 rad a tick of 1 ms: 7.96 Hz
        assert!((found.per_s - 7.96).abs() < 0.05, "{}", found.per_s);
        assert!((found.remains - 1.0).abs() < 0.01);
        assert!(swing(&values[..100], 0.0, 0.001).is_none());
    }
}
