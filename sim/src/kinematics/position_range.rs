//! The range of each entry of `q`, with the limits of the joints that mimic it, and the range of its samples.

use std::f64::consts::PI;

use crate::model::robot::{Joint, JointKind, Robot};

/// Half the range of the samples of an unlimited prismatic joint \[m\]: about an arm's length.
const UNLIMITED_SLIDE_M: f64 = 1.0;

/// The range of an entry of `q`; infinite where it is unlimited.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionRange {
    /// Lowest position \[rad or m\].
    pub lower: f64,
    /// Highest position \[rad or m\].
    pub upper: f64,
    /// Whether the joint is revolute (else prismatic).
    pub turns: bool,
    /// Whether a full turn of it leaves every body in the same pose.
    pub(crate) repeats: bool,
}

impl PositionRange {
    /// Whether `position` is inside, both ends included; false for NaN.
    pub fn contains(&self, position: f64) -> bool {
        self.lower <= position && position <= self.upper
    }

    /// The nearest position inside.
    pub fn clamp(&self, position: f64) -> f64 {
        // not f64::clamp: crossed limits of a mimic joint must not panic
        position.max(self.lower).min(self.upper)
    }

    /// A finite range for samples: the range itself or, if one end is unlimited, one turn or two metres.
    pub fn sampled(&self) -> (f64, f64) {
        let half = if self.turns { PI } else { UNLIMITED_SLIDE_M };
        match (self.lower.is_finite(), self.upper.is_finite()) {
            (true, true) => (self.lower, self.upper.max(self.lower)),
            (true, false) => (self.lower, self.lower + 2.0 * half),
            (false, true) => (self.upper - 2.0 * half, self.upper),
            (false, false) => (-half, half),
        }
    }

    /// The position inside the range that differs from `position` by full turns and is nearest to `wanted`; `position` itself if a full
    /// turn changes the pose of a body.
    pub(crate) fn nearest_turn(&self, position: f64, wanted: f64) -> f64 {
        const TURN: f64 = 2.0 * PI;
        if !self.repeats {
            return position;
        }
        let turned = |turns: f64| position + turns * TURN;
        let best = ((wanted - position) / TURN).round();
        // limits may cut off the nearest one
        let fewest = ((self.lower - position) / TURN).ceil();
        let most = ((self.upper - position) / TURN).floor();
        let turns = best.max(fewest).min(most);
        if turns != 0.0 && self.contains(turned(turns)) {
            turned(turns)
        } else {
            position
        }
    }
}

/// The ranges of all entries of `q`, shape `(n)`: the joint's own limits and, divided by their multipliers, those of its mimic joints.
pub fn position_ranges(robot: &Robot) -> Vec<PositionRange> {
    let mut ranges = vec![
        PositionRange {
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            turns: true,
            repeats: true,
        };
        robot.n()
    ];
    let own = |joint: &Joint| joint.kind != JointKind::Fixed && joint.mimic.is_none();
    let mut entry_of = vec![None; robot.joints().len()];
    let moving = (0..robot.joints().len()).filter(|&joint| own(&robot.joints()[joint]));
    for (entry, joint) in moving.enumerate() {
        entry_of[joint] = Some(entry);
        ranges[entry].turns = robot.joints()[joint].kind.turns();
    }
    for (index, joint) in robot.joints().iter().enumerate() {
        // from a mimic joint through its masters to the entry that drives it; a fixed joint has none
        let (mut gear, mut offset, mut master) = (1.0, 0.0, index);
        while let Some(mimic) = robot.joints()[master].mimic {
            offset += gear * mimic.offset;
            gear *= mimic.multiplier;
            master = mimic.joint;
        }
        let Some(entry) = entry_of[master] else {
            continue;
        };
        let range = &mut ranges[entry];
        range.repeats &= joint.kind.turns() && gear.fract() == 0.0;
        if gear == 0.0 {
            continue;
        }
        let limits = &joint.limits;
        let ends = [
            (limits.lower.unwrap_or(f64::NEG_INFINITY) - offset) / gear,
            (limits.upper.unwrap_or(f64::INFINITY) - offset) / gear,
        ];
        range.lower = range.lower.max(ends[0].min(ends[1]));
        range.upper = range.upper.min(ends[0].max(ends[1]));
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning(lower: f64, upper: f64) -> PositionRange {
        PositionRange {
            lower,
            upper,
            turns: true,
            repeats: true,
        }
    }

    #[test]
    fn whole_turns_come_near_what_is_wanted_and_stay_inside() {
        let free = turning(f64::NEG_INFINITY, f64::INFINITY);
        assert!((free.nearest_turn(7.0, 0.5) - (7.0 - 2.0 * PI)).abs() < 1e-15);
        let limited = turning(-3.0, 4.0);
        // 3.5 is nearer to 3.0 than 3.5 - 2 pi, which is inside
        assert_eq!(limited.nearest_turn(3.5, 3.0), 3.5);
        assert!((limited.nearest_turn(3.5, -2.0) - (3.5 - 2.0 * PI)).abs() < 1e-15);
        // one turn down would be outside
        assert_eq!(limited.nearest_turn(2.0, -4.0), 2.0);
        assert!(!limited.contains(f64::NAN));
    }

    #[test]
    fn samples_of_open_ranges_are_finite() {
        assert_eq!(
            turning(f64::NEG_INFINITY, f64::INFINITY).sampled(),
            (-PI, PI)
        );
        assert_eq!(turning(1.0, f64::INFINITY).sampled(), (1.0, 1.0 + 2.0 * PI));
    }
}
