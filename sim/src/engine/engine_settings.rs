//! The parameters of contact: prediction distance, combination of surfaces, what counts as an impact, when bodies rest.

use crate::model::robot::Contact;

/// Prediction distance: two surfaces this near are looked at as a coming contact \[m\]; at least this ...
pub(super) const PREDICTION_M: f64 = 0.002;
/// ... and this fraction of the travel of the fastest body in a step, so that an impact is found before surfaces overlap ...
pub(super) const PREDICTION_OF_TRAVEL: f64 = 1.5;
/// ... but at most: a thin body at a speed beyond this may pass through another.
pub(super) const PREDICTION_MOST_M: f64 = 0.05;

/// Of the points within the prediction distance, those count that are nearer than twice the travel of the fastest body and this \[m\].
pub(super) const NEAR_M: f64 = 1e-5;

/// Surfaces that come together slower than this do not bounce, and their contact counts as lasting: twice the speed that gravity adds in
/// a step of 1 ms, so that resting bodies stay at rest \[m/s\].
pub(super) const LANDS_M_S: f64 = 0.02;

/// Surfaces in contact rest this far apart \[m\]: points and normals are found best where nothing overlaps.
pub(super) const SKIN_M: f64 = 1e-7;

/// Surfaces that overlap by more than this \[m\], as they may at the start of a run, are moved apart over several steps ...
pub(super) const DEEP_M: f64 = 5e-5;
/// ... by this fraction of the depth in each.
pub(super) const RECOVERS: f64 = 0.2;

/// The friction of two surfaces: the larger coefficient counts, as in MuJoCo.
pub(super) fn friction_of(first: &Contact, second: &Contact) -> f64 {
    first.friction.max(second.friction)
}

/// The restitution of two surfaces: the larger one counts.
pub(super) fn restitution_of(first: &Contact, second: &Contact) -> f64 {
    first.restitution.max(second.restitution)
}

/// The lever arm of the resistance against rolling of two surfaces: the larger one counts \[m\].
pub(super) fn rolling_of(first: &Contact, second: &Contact) -> f64 {
    first.rolling_m.max(second.rolling_m)
}

/// The surface of a link without a `contact` table: dry metal or plastic.
pub(super) const SURFACE: Contact = Contact {
    friction: 0.3,
    restitution: 0.0,
    rolling_m: 0.0,
};

/// A body sleeps after none of its points has moved faster than this \[m/s\] ...
pub(super) const REST_SPEED_M_S: f64 = 1e-4;
/// ... for this long \[s\].
pub(super) const REST_TIME_S: f64 = 0.2;
