//! The bands of a task that more than one of its checks goes by.

use crate::lab::model::{Band, Check, CheckKind};

/// The band by which dwells at goals are chosen \[m\].
pub(super) fn pose_band(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::PoseReached(band) => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 0.002,
        zero: 0.02,
    })
}

/// The band of distances, or of relative ones, by which a function task's single answers are called good or wrong.
pub(super) fn answer_band(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::FkError(band)
        | CheckKind::IkReach(band)
        | CheckKind::JacobianMatch(band)
        | CheckKind::FunctionCases { band, .. } => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 1e-3,
        zero: 1e-2,
    })
}

/// The band of the first check that measures the distance from the path called `path` \[m\].
pub(super) fn path_band(checks: &[Check], path: &str) -> Option<Band> {
    checks.iter().find_map(|check| match &check.kind {
        CheckKind::PathDeviation { path: of, band, .. } if of.name == path => Some(*band),
        _ => None,
    })
}
