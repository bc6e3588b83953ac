//! The parameters of contact: stiffness, prediction distance, combination of surfaces.

use rapier3d_f64::dynamics::SpringCoefficients;
use rapier3d_f64::dynamics::{CoefficientCombineRule, FrictionModel, IntegrationParameters};

use crate::model::robot::Contact;

/// Natural frequency of a contact \[Hz\] and its damping ratio: stiff enough that an arm pressed on a shelf penetrates it by hundredths
/// of a millimetre, damped enough that it does not oscillate.
const CONTACT: (f64, f64) = (300.0, 5.0);

/// Prediction distance: two surfaces this near are treated as a coming contact \[m\]; at least this ...
pub(super) const PREDICTION_M: f64 = 0.002;
/// ... and this fraction of the travel of the fastest body in a step, so that an impact is found before surfaces overlap ...
pub(super) const PREDICTION_OF_TRAVEL: f64 = 1.5;
/// ... but at most: a thin body at a speed beyond this may pass through another.
pub(super) const PREDICTION_MOST_M: f64 = 0.05;

/// The larger friction and the larger restitution of two surfaces count, as in MuJoCo.
pub(super) const COMBINE: CoefficientCombineRule = CoefficientCombineRule::Max;

/// The surface of a link without a `contact` table: dry metal or plastic.
pub(super) const SURFACE: Contact = Contact {
    friction: 0.3,
    restitution: 0.0,
};

/// A body sleeps after none of its points has moved faster than this \[m/s\] ...
pub(super) const REST_SPEED_M_S: f64 = 1e-4;
/// ... for this long \[s\].
pub(super) const REST_TIME_S: f64 = 0.2;

/// The engine's joint limits act only beyond the limit; moving them in by this much \[rad or m\] lets them hold a joint that rests on it.
pub(super) const LIMIT_SKIN: f64 = 1e-7;

pub(super) fn parameters(dt_s: f64) -> IntegrationParameters {
    let softness = SpringCoefficients::new(CONTACT.0, CONTACT.1);
    IntegrationParameters {
        dt: dt_s,
        contact_softness: softness,
        static_contact_softness: softness,
        normalized_prediction_distance: PREDICTION_M,
        // Coulomb's cone for the patch of each face and a twist about its centre. The engine's other model, a cone at every point,
        // slides with 6 to 14 % less than the coefficient says: it weighs the direction of sliding by the anisotropy of
        // each corner. Contacts of links always have a cone at every point.
        friction_model: FrictionModel::Simplified,
        // stale lever arms and distances
        contact_recycling: false,
        // the engine's default bound of 400 m/s would look like physics; with this one a run ends soon after it is reached
        normalized_max_linear_velocity: f64::MAX,
        // would move a link away from the pose that its joints give
        max_ccd_substeps: 0,
        ..IntegrationParameters::default()
    }
}
