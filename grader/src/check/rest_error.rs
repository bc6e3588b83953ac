//! Why a joint comes to rest beside its target: a command beside it, an error that still shrinks, or an effort that only an error
//! gives, such as against gravity.

use kinemark_sim::control::Mode;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::dynamics::gravity_effort;
use kinemark_sim::text::number::trimmed;

use super::cause::{Law, creeping_law, gravity_term, wrong_setpoint};
use super::shape;
use super::step_response::Response;

/// Efforts below this are no reason for an error \[N m or N\].
const LEAST_EFFORT: f64 = 1e-6;
/// Gravity is the reason where the motor gives what it takes, but for this share.
const SAME_EFFORT: f64 = 0.1;
/// An error that shrinks by more than this share while it is judged is not at rest.
const STILL_NEARING: f64 = 0.1;
/// Nor is a joint that goes this share of the whole way in that time.
const CREEPS_ON: f64 = 0.01;
/// Another joint with this share of a joint's speed turns, too.
const TURNS_TOO: f64 = 0.3;

/// Why the joint of `response` rests beside `target`, where that can be said.
pub(super) fn reason(response: &Response<'_>, target: f64) -> Option<Reason> {
    Rest::of(response, target)?.reason()
}

/// A number with three digits that count, however small.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    let decimals = if size >= 100.0 {
        1
    } else if size >= 0.01 {
        3
    } else {
        6
    };
    trimmed(value, decimals)
}

/// Why a joint rests beside its target, and what helps.
pub(super) struct Reason {
    pub(super) words: String,
    pub(super) help: String,
    /// Whether the joint is not at rest at all.
    pub(super) moves: bool,
    /// Whether it is a mistake that the run shows, beside which a general question would lead astray.
    pub(super) insists: bool,
}

impl Reason {
    fn new(words: impl Into<String>, help: impl Into<String>) -> Option<Self> {
        Some(Self {
            words: words.into(),
            help: help.into(),
            moves: false,
            insists: false,
        })
    }

    fn insists(self) -> Self {
        Self {
            insists: true,
            ..self
        }
    }
}

/// How a joint rests beside its target.
struct Rest<'a> {
    response: &'a Response<'a>,
    target: f64,
    /// From the final value to the target.
    error: f64,
    /// The last tick of the run.
    last: usize,
    /// Mean effort of the joint over the final part \[N m or N\].
    given: f64,
    /// Whether the lab's servo closes the loop over the signal.
    is_servo: bool,
}

impl<'a> Rest<'a> {
    fn of(response: &'a Response<'a>, target: f64) -> Option<Self> {
        let (facts, asked) = (response.facts, response.asked);
        let mut rest = Self {
            response,
            target,
            error: target - response.end,
            last: facts.trace.len().checked_sub(1)?,
            given: 0.0,
            is_servo: matches!(
                (facts.motion.servo.mode, asked.of),
                (Mode::Position, Fed::Position) | (Mode::Velocity, Fed::Velocity)
            ),
        };
        rest.given = rest.mean(|tick| facts.trace.effort.at(tick)[asked.joint]);
        Some(rest)
    }

    /// The mean over the final part; the efforts of the last row are never applied.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let ticks = self.response.final_tick..self.last;
        let count = ticks.len().max(1) as f64;
        ticks.map(value).sum::<f64>() / count
    }

    fn reason(&self) -> Option<Reason> {
        self.command_is_beside()
            .or_else(|| self.is_of_another())
            .or_else(|| self.is_steered_elsewhere())
            .or_else(|| self.creeps())
            .or_else(|| self.still_swings())
            .map(Reason::insists)
            .or_else(|| self.is_still_nearing())
            .or_else(|| match self.response.asked.of {
                Fed::Position => self.gravity(),
                Fed::Velocity => self
                    .other_turns()
                    .map(Reason::insists)
                    .or_else(|| self.drag()),
            })
    }

    /// `control` asks the servo for something else.
    fn command_is_beside(&self) -> Option<Reason> {
        let response = self.response;
        let joint = response.asked.joint;
        let commanded = self.mean(|tick| response.facts.trace.command.at(tick)[joint]);
        let beside = (commanded - self.target).abs();
        if !(self.is_servo && beside > 0.5 * self.error.abs()) {
            return None;
        }
        Reason::new(
            format!("`control` asks for {} there", response.with_unit(commanded)),
            format!(
                "Return {} for joint `{}`.",
                response.with_unit(self.target),
                response.name()
            ),
        )
    }

    /// It rests where another joint should be, or another joint where it should.
    fn is_of_another(&self) -> Option<Reason> {
        let (words, help) = match shape::swapped(self.response) {
            Some(seen) => (seen.words, seen.next_step),
            None => shape::place_of_another(self.response, self.target)?,
        };
        Reason::new(words, help)
    }

    /// What is returned steers it there.
    fn is_steered_elsewhere(&self) -> Option<Reason> {
        let seen = wrong_setpoint(self.response)?;
        Reason::new(seen.words, seen.next_step)
    }

    /// What is returned brakes it so much that it is still on its way.
    fn creeps(&self) -> Option<Reason> {
        let seen = creeping_law(self.response)?;
        Some(Reason {
            moves: true,
            ..Reason::new(seen.words, seen.next_step)?
        })
    }

    /// It swings where it is judged: then its distance at two moments says nothing.
    fn still_swings(&self) -> Option<Reason> {
        let response = self.response;
        let judged = &response.values[response.final_tick..];
        let above = |value: f64| value > response.end;
        let turns = judged
            .windows(2)
            .filter(|pair| above(pair[0]) != above(pair[1]));
        // what creeps passes its mean once, and what bounces once twice
        let turns = turns.count();
        if turns < 2 {
            return None;
        }
        let low = judged.iter().copied().fold(f64::INFINITY, f64::min);
        let high = judged.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = match turns {
            2 => 1.0,
            _ => STILL_NEARING,
        };
        let wide = high - low > least * self.error.abs();
        if !wide {
            return None;
        }
        let swings = Reason::new(
            format!(
                "it swings between {} and {}",
                response.with_unit(low),
                response.with_unit(high)
            ),
            "Damp the swing: a stronger derivative, a smaller integral, or lower gains.",
        )?;
        Some(Reason {
            moves: true,
            ..swings
        })
    }

    /// The error still shrinks.
    fn is_still_nearing(&self) -> Option<Reason> {
        let response = self.response;
        let ends = [response.final_tick, self.last].map(|tick| response.values[tick]);
        let [then, now] = ends.map(|value| (value - self.target).abs());
        let way = (self.target - self.response.start).abs();
        // far from its target a joint creeps by less than a share of what is left
        let nears = then - now > (STILL_NEARING * self.error.abs()).min(CREEPS_ON * way);
        if !nears {
            return None;
        }
        let [from, to] = ends.map(|value| response.with_unit(value));
        let nearing = Reason::new(
            format!("from {from} to {to} in this time"),
            "The error is removed too slowly: use a stronger integral, or compensate gravity, so that less is left to remove.",
        )?;
        Some(Reason {
            moves: true,
            ..nearing
        })
    }

    /// A joint that has to be held against gravity.
    fn gravity(&self) -> Option<Reason> {
        let (facts, asked) = (self.response.facts, self.response.asked);
        let (motion, force) = (facts.motion, asked.units.effort());
        // what holds a robot with loops is shared among its joints
        if motion.servo.gravity_compensation || !facts.robot.loops().is_empty() {
            return None;
        }
        let q = facts.robot.positions(facts.trace.q.at(self.last)).ok()?;
        let gravity = gravity_effort(facts.robot, &motion.gravity_m_s2, &q).as_slice()[asked.joint];
        let limit = motion.servo.gains[asked.joint].effort_limit;
        if self.given.abs() >= 0.99 * limit {
            return Reason::new(
                format!("the motor is at its limit of {} {force}", number(limit)),
                "Ask for less: the motor must have some effort left to correct with.",
            );
        }
        // another torque at work, such as a push of the other joints, would make gravity a wrong reason
        if gravity.abs() < LEAST_EFFORT
            || (self.given - gravity).abs() > SAME_EFFORT * gravity.abs()
        {
            return None;
        }
        let reason = format!("gravity takes {} {force} there", number(gravity.abs()));
        if let Some((seen, question)) = gravity_term(self.response) {
            return Reason::new(format!("{reason}, and {seen}"), question).map(Reason::insists);
        }
        self.proportional(gravity, reason)
    }

    /// Another joint that turns at much of this one's speed: what it carries along takes effort of both.
    fn other_turns(&self) -> Option<Reason> {
        let (response, facts) = (self.response, self.response.facts);
        let mut others = (0..facts.robot.n()).filter(|joint| *joint != response.asked.joint);
        let (other, speed) = others.find_map(|joint| {
            let speed = self.mean(|tick| facts.trace.qd.at(tick)[joint]);
            let is_same = facts.units(joint).speed() == response.asked.unit();
            (is_same && speed.abs() > TURNS_TOO * response.end.abs()).then_some((joint, speed))
        })?;
        let name = facts.joint_name(other);
        Reason::new(
            format!(
                "joint `{name}` turns, too, at {}, and what it moves pushes on this one",
                response.with_unit(speed)
            ),
            format!("What do you return for joint `{name}`, and should it turn?"),
        )
    }

    /// A velocity that has to be kept up.
    fn drag(&self) -> Option<Reason> {
        let (given, force) = (self.given, self.response.asked.units.effort());
        if given.abs() < LEAST_EFFORT {
            return None;
        }
        let reason = format!("keeping it takes {} {force}", number(given.abs()));
        self.proportional(given, reason)
    }

    /// The error at which a proportional gain gives `effort`, which is needed for `reason`.
    fn proportional(&self, effort: f64, reason: String) -> Option<Reason> {
        let asked = self.response.asked;
        let (unit, force) = (asked.unit(), asked.units.effort());
        let kp = self.response.facts.motion.servo.gains[asked.joint].kp;
        let (given, error) = (self.given, self.error);
        if self.is_servo && kp > 0.0 {
            let needed = number((effort / kp).abs());
            Reason::new(
                format!(
                    "{reason}, and kp = {} needs {needed} {unit} of error to supply it",
                    number(kp)
                ),
                "More proportional gain makes the error smaller; integral action, or adding that effort yourself, takes it away.",
            )
        } else if let Some(law) = Law::of(self.response)
            .filter(|law| law.error > 0.0 && law.integral.abs() <= 0.0 && law.gravity.abs() <= 0.0)
        {
            let needed = number((effort / law.error).abs());
            Reason::new(
                format!(
                    "{reason}, and the {} {force} that `control` gives for each {unit} of error need {needed} {unit} of it",
                    number(law.error)
                ),
                "More proportional gain makes the error smaller; integral action, or adding that effort yourself, takes it away.",
            )
        } else if given * error < 0.0 && error.abs() > 1e-9 {
            // no feedback of the error alone gives that
            Reason::new(
                format!(
                    "{reason}, and the motor gives it although feedback of this error alone would push the other way"
                ),
                "Look at what you add to the feedback, and at the setpoint that its error is measured from: together they hold the joint beside its target.",
            )
        } else if error.abs() > 1e-9 {
            Reason::new(
                format!(
                    "{reason}; the motor gives {} {force} with {} {unit} of error: as a proportional gain of {} would",
                    number(given.abs()),
                    number(error.abs()),
                    number((given / error).abs())
                ),
                "Add integral action, or add that effort to what you return. If your own gain is higher than that, something that you add acts the wrong way: check its sign.",
            )
        } else {
            Reason::new(reason, "Add integral action.")
        }
    }
}
