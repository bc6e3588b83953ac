//! The limit switch: pressed at a place of its joint and beyond, and while it is, the motor cannot push on.

use crate::model::robot::Robot;
use crate::model::sensor::{LimitSwitch, Side, moved_by};

impl LimitSwitch {
    /// The motor that it opens while it is pressed, if any. A mimic joint's motor is its master's.
    pub(super) fn opens(&self, robot: &Robot) -> Option<Opening> {
        let body = moved_by(robot, self.joint)?;
        let outwards = match self.side {
            Side::Lower => -body.gear,
            Side::Upper => body.gear,
        };
        self.opens_motor.then_some(Opening {
            entry: body.q_index,
            outwards,
        })
    }
}

/// The direction in which a motor may be opened.
#[derive(Debug, Clone, Copy)]
pub(super) struct Opening {
    /// The motor's entry in `q`.
    entry: usize,
    /// Positive where positive efforts push towards the switch.
    outwards: f64,
}

impl Opening {
    /// Takes from `effort`, shape `(n)`, what pushes towards the switch.
    pub(super) fn open(self, effort: &mut [f64]) {
        let effort = &mut effort[self.entry];
        if self.outwards * *effort > 0.0 {
            *effort = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_is_pressed_at_its_place_and_beyond() {
        let mut switch = LimitSwitch {
            joint: 0,
            at: 0.25,
            side: Side::Upper,
            opens_motor: true,
        };
        for (position, upper, lower) in [
            (0.249, false, true),
            (0.25, true, true),
            (7.0, true, false),
            (f64::NAN, false, false),
        ] {
            switch.side = Side::Upper;
            assert_eq!(switch.is_pressed(position), upper, "{position}");
            switch.side = Side::Lower;
            assert_eq!(switch.is_pressed(position), lower, "{position}");
        }
    }
}
