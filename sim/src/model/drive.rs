//! The drive of a joint: a DC motor behind a gear, as its data sheet describes it, seen from the joint.

/// A DC motor and its gear. Efforts and rates are those at the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// The torque-speed line; without one the drive has no limit of its own.
    pub line: Option<TorqueSpeedLine>,
    /// Rotation of the rotor per unit of the joint \[rad/rad or rad/m\].
    pub ratio: f64,
    /// Moment of inertia of the rotor about its own axis \[kg m²\].
    pub rotor_inertia_kg_m2: f64,
    /// Fraction of the power that gets through the gear, in either direction; more than 0, at most 1.
    pub efficiency: f64,
}

/// The torque-speed line of a DC motor at its full voltage, at the joint: the losses of the gear are in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueSpeedLine {
    /// Effort that holds the joint still against the motor at full voltage \[N m or N\].
    pub stall: f64,
    /// Rate of the joint at full voltage without load \[rad/s or m/s\].
    pub free_speed: f64,
}

impl Drive {
    /// The rotor's inertia as the joint feels it: `ratio²` times it \[kg m² or kg\].
    pub fn felt_inertia(&self) -> f64 {
        self.ratio * self.ratio * self.rotor_inertia_kg_m2
    }

    /// Effort at the joint per effort of the motor where the joint moves against it: the gear's loss, which the motor overcomes when it
    /// drives, now helps it, so that the effort is divided by the efficiency twice.
    pub(crate) fn held_per_driven(&self) -> f64 {
        1.0 / (self.efficiency * self.efficiency)
    }
}
