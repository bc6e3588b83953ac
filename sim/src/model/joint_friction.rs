//! Dry (Coulomb) friction of a joint, which may differ between its two directions, as in worn gears and preloaded screws.

/// The efforts with which dry friction opposes motion, each zero or more \[N m or N\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointFriction {
    /// Against motion towards greater positions.
    pub positive: f64,
    /// Against motion towards lesser positions.
    pub negative: f64,
}

impl JointFriction {
    /// The same friction in both directions.
    pub fn both(effort: f64) -> Self {
        Self {
            positive: effort,
            negative: effort,
        }
    }

    /// Whether both directions have the same friction.
    pub fn is_symmetric(&self) -> bool {
        self.positive.to_bits() == self.negative.to_bits()
    }

    /// Half the sum: what opposes motion in either direction.
    pub(crate) fn mean(&self) -> f64 {
        0.5 * (self.positive + self.negative)
    }

    /// Half the difference: what friction gives towards lesser positions beyond its mean, whatever the direction of the motion. Friction
    /// within `-positive ..= negative` is friction within `±mean` and this effort.
    pub(crate) fn skew(&self) -> f64 {
        0.5 * (self.positive - self.negative)
    }

    /// The friction that motion at `rate` overcomes, of the sign of `rate`; 0 at rest, where dry friction has no direction.
    pub(crate) fn overcome_at(&self, rate: f64) -> f64 {
        if rate > 0.0 {
            self.positive
        } else if rate < 0.0 {
            -self.negative
        } else {
            0.0
        }
    }

    /// As the joint's position counts with `gear` per unit of an entry of `q`: the friction against motion of that entry.
    pub(crate) fn through(&self, gear: f64) -> Self {
        let (positive, negative) = if gear < 0.0 {
            (self.negative, self.positive)
        } else {
            (self.positive, self.negative)
        };
        Self {
            positive: gear.abs() * positive,
            negative: gear.abs() * negative,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_direction_has_its_own_friction() {
        let friction = JointFriction {
            positive: 5.0,
            negative: 3.0,
        };
        assert_eq!(friction.overcome_at(0.1), 5.0);
        assert_eq!(friction.overcome_at(-0.1), -3.0);
        assert_eq!(friction.overcome_at(0.0), 0.0);
        assert_eq!((friction.mean(), friction.skew()), (4.0, 1.0));
        // a joint that goes back twice as fast: its negative direction is the positive one of `q`
        let through = friction.through(-2.0);
        assert_eq!((through.positive, through.negative), (6.0, 10.0));
        assert!(JointFriction::both(2.0).is_symmetric() && !friction.is_symmetric());
    }
}
