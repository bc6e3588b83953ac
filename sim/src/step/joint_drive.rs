//! The drive of one joint in one step: what it delivers of the effort that its servo asks for, while all other joints are left as they are.
//!
//! On its torque-speed line a drive gives the mean of the line over the step, for the rate that a joint of this inertia alone would have:
//! the weight of the rate at the end is `weight_of_end`. For one joint under constant load that is the exact solution at any step.
//!
//! Source: exponential fitting: Liniger & Willoughby, *Efficient integration methods for stiff systems* (1970).

use crate::model::drive::TorqueSpeedLine;
use crate::model::joint_friction::JointFriction;

/// The drive of one entry of `q`, with what else acts on its joint within a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointDrive {
    /// \[rad/s or m/s\].
    pub(super) speed_limit: f64,
    /// That of the servo \[N m or N\].
    pub(super) effort_limit: f64,
    /// That of the servo or the joint, whichever is less: with so much it brakes at its speed limit, or with as much as is asked for where
    /// that is more.
    pub(super) brake_limit: f64,
    pub(super) line: Option<TorqueSpeedLine>,
    /// Effort at the joint per effort of the motor where the joint moves against it; 1 without losses.
    pub(super) held_per_driven: f64,
    pub(super) friction: JointFriction,
    pub(super) range: (f64, f64),
}

impl JointDrive {
    pub(super) fn is_limited(&self) -> bool {
        self.speed_limit < f64::INFINITY || self.line.is_some() || self.held_per_driven > 1.0
    }
}

/// What is known of a joint's step while all other joints are left as they are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    /// Rate at the end of the step without any effort of drive, friction and stop on this joint.
    pub(super) coasting: f64,
    /// Rate per effort over the step, positive.
    pub(super) per_effort: f64,
    /// The effort that the servo asks for.
    pub(super) effort: f64,
    /// Rate at the start of the step.
    pub(super) rate: f64,
    /// Position limit that the joint is on: 1 the upper, -1 the lower, 0 none.
    pub(super) stop: f64,
}

impl Asked {
    /// The same joint counted in the other direction.
    fn mirrored(self) -> Self {
        Self {
            coasting: -self.coasting,
            per_effort: self.per_effort,
            effort: -self.effort,
            rate: -self.rate,
            stop: -self.stop,
        }
    }
}

/// What becomes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Given {
    /// Rate at the end of the step.
    pub(super) rate: f64,
    /// What the drive delivers to the joint.
    pub(super) effort: f64,
}

/// Whether a motor is off, because nothing is asked of it: then its electronics keep no speed limit.
pub(super) fn is_off(effort: f64) -> bool {
    effort == 0.0
}

impl TorqueSpeedLine {
    /// Effort per rate by which the line falls.
    fn slope(&self) -> f64 {
        self.stall / self.free_speed
    }

    /// The greatest effort at `rate`: at full voltage.
    pub(super) fn most(&self, rate: f64) -> f64 {
        self.stall - self.slope() * rate
    }

    /// The least effort at `rate`: at full voltage of the other sign.
    pub(super) fn least(&self, rate: f64) -> f64 {
        -self.stall - self.slope() * rate
    }
}

/// A line of efforts over the rate at the end of the step: `at_rest - slope * rate`.
#[derive(Debug, Clone, Copy)]
struct Falling {
    at_rest: f64,
    slope: f64,
}

impl JointDrive {
    /// Rate and effort of the joint at the end of the step.
    pub(super) fn given(&self, asked: Asked) -> Given {
        let at_rest = self.motor_at_rest(&asked);
        let other = at_rest * self.held_per_driven;
        let (least, most) = (at_rest.min(other), at_rest.max(other));
        let JointFriction { positive, negative } = self.friction;
        let needed = -asked.coasting / asked.per_effort;
        if needed > most + negative {
            let back = JointDrive {
                friction: JointFriction {
                    positive: negative,
                    negative: positive,
                },
                ..*self
            };
            let given = back.given_forwards(asked.mirrored());
            Given {
                rate: -given.rate,
                effort: -given.effort,
            }
        } else if needed < least - positive {
            self.given_forwards(asked)
        } else {
            // it stands: friction takes up what it can, the gear's loss the rest
            let effort = at_rest.max(needed - negative).min(needed + positive);
            Given { rate: 0.0, effort }
        }
    }

    /// As [`JointDrive::given`] for a joint that moves towards greater positions at the end of the step.
    fn given_forwards(&self, asked: Asked) -> Given {
        if asked.stop > 0.0 {
            let effort = self.motor_at_rest(&asked);
            return Given { rate: 0.0, effort };
        }
        let coasting = asked.coasting - asked.per_effort * self.friction.positive;
        let under = |effort: f64| Given {
            rate: coasting + asked.per_effort * effort,
            effort,
        };
        let at_joint = |motor: f64| {
            motor
                * if motor < 0.0 {
                    self.held_per_driven
                } else {
                    1.0
                }
        };
        let mut given = under(at_joint(asked.effort));
        if let Some(line) = &self.line {
            let [most, least] = self.ends(line, &asked);
            // the effort falls with the rate, so the side on which the asked one lies beyond the line is the side of the solution
            if asked.effort > most.at(given.rate) {
                given = under(at_joint(self.bounded(self.on(most, coasting, &asked))));
            } else if asked.effort < least.at(given.rate) {
                given = under(at_joint(self.bounded(self.on(least, coasting, &asked))));
            }
        }
        if given.rate > self.speed_limit && !is_off(asked.effort) {
            let needed = (self.speed_limit - coasting) / asked.per_effort;
            let most = self
                .line
                .map_or(f64::NEG_INFINITY, |line| line.least(self.speed_limit));
            let brake = most.max(-self.brake_limit.max(asked.effort.abs()));
            given = under(needed.max(at_joint(brake)));
        }
        given
    }

    /// The motor's effort where the joint is at rest at the end of the step.
    fn motor_at_rest(&self, asked: &Asked) -> f64 {
        match &self.line {
            None => asked.effort,
            Some(line) => {
                let [most, least] = self.ends(line, asked);
                let within = asked.effort.max(least.at_rest).min(most.at_rest);
                self.bounded(within)
            }
        }
    }

    fn bounded(&self, motor: f64) -> f64 {
        motor.max(-self.effort_limit).min(self.effort_limit)
    }

    /// Both ends of what the motor can give, as mean over the step.
    fn ends(&self, line: &TorqueSpeedLine, asked: &Asked) -> [Falling; 2] {
        let weight = weight_of_end(asked.per_effort * line.slope());
        let start = (1.0 - weight) * asked.rate;
        let slope = weight * line.slope();
        [line.most(start), line.least(start)].map(|at_rest| Falling { at_rest, slope })
    }

    /// The motor's effort where the joint moves forwards at the end of the step and the motor is on `end`.
    fn on(&self, end: Falling, coasting: f64, asked: &Asked) -> f64 {
        let with_loss = |gain: f64| {
            let rate = (coasting + asked.per_effort * gain * end.at_rest)
                / (1.0 + asked.per_effort * gain * end.slope);
            end.at(rate)
        };
        let driving = with_loss(1.0);
        if driving < 0.0 {
            with_loss(self.held_per_driven)
        } else {
            driving
        }
    }
}

impl Falling {
    fn at(&self, rate: f64) -> f64 {
        self.at_rest - self.slope * rate
    }
}

/// The weight of the rate at the end of a step in the mean of a torque-speed line over it, where `z` is the step by the time constant of
/// the joint on the line: `1 / (1 - exp(-z)) - 1 / z`, from a half (slow) to one (fast).
fn weight_of_end(z: f64) -> f64 {
    // below, the difference of the two fractions loses more digits than the series leaves out
    if z < 1e-3 {
        0.5 + z / 12.0
    } else {
        -1.0 / libm::expm1(-z) - 1.0 / z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive() -> JointDrive {
        JointDrive {
            speed_limit: f64::INFINITY,
            effort_limit: f64::INFINITY,
            brake_limit: f64::INFINITY,
            line: None,
            held_per_driven: 1.0,
            friction: JointFriction::default(),
            range: (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// A joint at rest that 1 N brings to 1 m/s in the step.
    fn asked(effort: f64) -> Asked {
        Asked {
            coasting: 0.0,
            per_effort: 1.0,
            effort,
            rate: 0.0,
            stop: 0.0,
        }
    }

    fn given(drive: JointDrive, asked: Asked) -> (f64, f64) {
        let Given { rate, effort } = drive.given(asked);
        (rate, effort)
    }

    #[test]
    fn a_speed_limit_is_met_exactly_from_either_side() {
        let limited = JointDrive {
            speed_limit: 2.0,
            ..drive()
        };
        assert_eq!(given(limited, asked(1.5)), (1.5, 1.5));
        assert_eq!(given(limited, asked(1e9)), (2.0, 2.0));
        assert_eq!(given(limited, asked(-1e9)), (-2.0, -2.0));
        // a load that takes it along is braked, as far as the drive can
        let falling = Asked {
            coasting: 7.0,
            ..asked(0.5)
        };
        assert_eq!(given(limited, falling), (2.0, -5.0));
        // unless it is off
        let coasting = Asked {
            effort: 0.0,
            ..falling
        };
        assert_eq!(given(limited, coasting), (7.0, 0.0));
        let weak = JointDrive {
            brake_limit: 3.0,
            ..limited
        };
        assert_eq!(given(weak, falling), (4.0, -3.0));
        // friction helps, and is overcome first
        let rough = JointDrive {
            friction: JointFriction {
                positive: 1.0,
                negative: 4.0,
            },
            ..limited
        };
        assert_eq!(given(rough, falling), (2.0, -4.0));
        assert_eq!(given(rough, asked(1e9)), (2.0, 3.0));
        assert_eq!(given(rough, asked(0.5)), (0.0, 0.5));
        assert_eq!(given(rough, asked(-3.5)), (0.0, -3.5));
        assert_eq!(given(rough, asked(-5.0)), (-1.0, -5.0));
    }

    #[test]
    fn a_joint_on_its_stop_gets_the_whole_effort_and_stays() {
        let limited = JointDrive {
            speed_limit: 2.0,
            ..drive()
        };
        let on = |stop: f64, effort: f64| {
            given(
                limited,
                Asked {
                    stop,
                    ..asked(effort)
                },
            )
        };
        assert_eq!(on(1.0, 50.0), (0.0, 50.0));
        assert_eq!(on(-1.0, -50.0), (0.0, -50.0));
        assert_eq!(on(1.0, -50.0), (-2.0, -2.0));
    }

    #[test]
    fn the_line_gives_the_rate_of_the_exact_solution() {
        // M dv/dt = stall (1 - v / free): v = free (1 - exp(-t stall / (M free))), here after one step of z time constants
        for z in [1e-6_f64, 1e-3, 0.1, 1.0, 30.0] {
            let (stall, free_speed) = (10.0, 4.0);
            let motor = JointDrive {
                line: Some(TorqueSpeedLine { stall, free_speed }),
                ..drive()
            };
            let step = Asked {
                per_effort: z * free_speed / stall,
                ..asked(1e6)
            };
            let exact = -free_speed * libm::expm1(-z);
            let (rate, _) = given(motor, step);
            assert!((rate - exact).abs() <= 1e-12 * exact, "{z}: {rate} {exact}");
            let (back, _) = given(motor, step.mirrored());
            assert!((back + exact).abs() <= 1e-12 * exact, "{z}: {back}");
            // beyond the free speed it brakes, towards free (1 + load / stall)
            let pulled = Asked {
                coasting: 3.0 * free_speed,
                rate: 3.0 * free_speed,
                ..step
            };
            let exact = free_speed * (1.0 + 2.0 * libm::exp(-z));
            let (rate, effort) = given(motor, pulled);
            assert!((rate - exact).abs() <= 1e-12 * exact, "{z}: {rate} {exact}");
            assert!(effort < 0.0);
        }
    }

    #[test]
    fn a_gear_with_losses_is_harder_to_drive_back() {
        // efficiency 0.5: what drives with 1 holds against 4
        let lossy = JointDrive {
            held_per_driven: 4.0,
            ..drive()
        };
        let loaded = |load: f64| {
            given(
                lossy,
                Asked {
                    coasting: load,
                    ..asked(1.0)
                },
            )
        };
        assert_eq!(loaded(-0.5), (0.5, 1.0));
        assert_eq!(loaded(-1.0), (0.0, 1.0));
        assert_eq!(loaded(-3.0), (0.0, 3.0));
        assert_eq!(loaded(-4.5), (-0.5, 4.0));
    }
}
