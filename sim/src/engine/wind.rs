//! The air of one run: the mean wind of the scene with its gusts, which acts on bodies and links as drag.

use nalgebra::Vector3;

use crate::model::air::AirNow;
use crate::model::gust::GustSequence;
use crate::model::scene::Wind;

/// The air of one run, step by step; a copy continues with the same gusts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Air {
    wind: Wind,
    gusts: Option<GustSequence>,
    velocity_m_s: Vector3<f64>,
}

impl Air {
    pub(super) fn new(wind: &Wind, dt_s: f64) -> Self {
        let mut air = Self {
            wind: wind.clone(),
            gusts: wind.gust.map(|gust| gust.sequence(dt_s)),
            velocity_m_s: wind.velocity_m_s,
        };
        // a run with gusts does not begin in calm air
        air.advance();
        air
    }

    /// Whether the air changes with time.
    pub(super) fn gusts(&self) -> bool {
        self.gusts.is_some()
    }

    /// The air of the next step.
    pub(super) fn now(&self) -> AirNow {
        AirNow {
            density_kg_m3: self.wind.air_density_kg_m3,
            velocity_m_s: self.velocity_m_s,
        }
    }

    /// Advances the gusts by one step.
    pub(super) fn advance(&mut self) {
        if let Some(gust_m_s) = self.gusts.as_mut().and_then(Iterator::next) {
            self.velocity_m_s = self.wind.air_velocity_m_s(gust_m_s);
        }
    }
}
