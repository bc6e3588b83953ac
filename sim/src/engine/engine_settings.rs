//! The numbers of contact: how stiff, how far ahead, how surfaces combine.

use rapier3d_f64::dynamics::SpringCoefficients;
use rapier3d_f64::dynamics::{CoefficientCombineRule, FrictionModel, IntegrationParameters};

use crate::model::robot::Contact;

/// Natural frequency of a contact \[Hz\] and its damping ratio: stiff enough that an arm pushed into a shelf sinks in by hundredths of
/// a millimetre, damped enough that it does not ring.
const CONTACT: (f64, f64) = (300.0, 5.0);

/// How far apart two surfaces already count as a contact to come \[m\], at least ...
pub(super) const PREDICTION_M: f64 = 0.002;
/// ... and as a part of what the fastest body travels in a step, so that an impact is seen before surfaces are in each other ...
pub(super) const PREDICTION_OF_TRAVEL: f64 = 1.5;
/// ... but at most: a thin body at a speed beyond this may pass through another.
pub(super) const PREDICTION_MOST_M: f64 = 0.05;

/// Of two surfaces the rougher and the bouncier one counts, as in MuJoCo.
pub(super) const COMBINE: CoefficientCombineRule = CoefficientCombineRule::Max;

/// The surface of a link that describes none: dry metal or plastic.
pub(super) const SURFACE: Contact = Contact {
    friction: 0.3,
    restitution: 0.0,
};

/// A body sleeps when no point of it has moved faster than this \[m/s\] ...
pub(super) const REST_SPEED_M_S: f64 = 1e-4;
/// ... for this long \[s\].
pub(super) const REST_TIME_S: f64 = 0.2;

/// Rows of joint limits act only beyond the limit; moving them in by this much \[rad or m\] lets them hold a joint that rests on it.
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
        // the engine's own bound, 400 m/s, would pass for physics; a run ends soon after that
        normalized_max_linear_velocity: f64::MAX,
        // would move a link away from where its joints say it is
        max_ccd_substeps: 0,
        ..IntegrationParameters::default()
    }
}
