//! The linear loop drawn beside a step response: numbers that make a loop, and one that stays bounded.

use kinemark_sim::control::LinearStep;
use kinemark_sim::control::linear_step::Fed;
use toml::Spanned;

use super::Reader;
use crate::lab::file::DerivativeName;
use crate::lab::file::step::PredictionTable;
use crate::lab::problem::LabError;

impl Reader<'_> {
    pub(super) fn prediction(
        &self,
        spanned: &Spanned<PredictionTable>,
        of: Fed,
    ) -> Result<LinearStep, LabError> {
        let table = spanned.get_ref();
        let refuse = |message: String, help: &str| {
            self.report.err(
                spanned.span(),
                "lab::prediction",
                message,
                "this prediction",
                Some(help.to_owned()),
            )
        };
        if !(table.inertia > 0.0 && table.inertia.is_finite()) {
            return refuse(
                format!("`inertia` must be positive, got {}", table.inertia),
                "it is the joint's moment of inertia [kg m²]",
            );
        }
        let others = [
            ("damping", table.damping),
            ("kp", table.kp),
            ("ki", table.ki),
            ("kd", table.kd),
        ];
        for (name, value) in others {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(
                    format!("`{name}` must be zero or more, got {value}"),
                    "left out it is 0",
                );
            }
        }
        let derivative_of_error = match &table.derivative {
            None => true,
            Some(name) => match name.get_ref() {
                DerivativeName::Error => true,
                // of a measured position both are the velocity
                DerivativeName::Measurement | DerivativeName::Velocity => false,
            },
        };
        let prediction = LinearStep {
            fed: of,
            inertia_kg_m2: table.inertia,
            damping_n_m_s: table.damping,
            kp: table.kp,
            ki: table.ki,
            kd: table.kd,
            derivative_of_error,
        };
        if !prediction.is_bounded() {
            return refuse(
                format!(
                    "the predicted loop is unstable: (damping + kd) kp = {} is less than inertia ki = {}",
                    (table.damping + table.kd) * table.kp,
                    table.inertia * table.ki
                ),
                "predict a loop that settles, or leave the prediction out",
            );
        }
        if prediction.response(0.001, 2).is_none() {
            return refuse(
                "the predicted loop is too fast to be computed".to_owned(),
                "look at its inertia and gains",
            );
        }
        Ok(prediction)
    }
}
