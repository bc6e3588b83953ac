//! The kinds of checks, one line each: what it judges, and its file. A file has a `Table`, which says how it is read.

use kinemark_sim::text::Spanned;
use serde::de::MapAccess;

use super::registry::{FunctionTable, Kind, KindTable, MotionTable};

macro_rules! kinds {
    ($($of:ident $module:ident)*) => {
        $(pub mod $module;)*

        /// The kinds, in the order of this list.
        pub const KINDS: &[Kind] = &[$(Kind::$of::<$module::Table>(stringify!($module))),*];

        /// The keys of a check: those that all have, and the kinds.
        pub(super) const KEYS: &[&str] = &[
            "name", "title", "points", "needs", "hints", $(name!($of $module)),*
        ];

        /// Reads the table of the kind called `name`, one of [`KEYS`].
        pub(super) fn table<'de, A: MapAccess<'de>>(
            name: &str,
            map: &mut A,
        ) -> Result<KindTable, A::Error> {
            $(
                if name == name!($of $module) {
                    let table: Spanned<$module::Table> = map.next_value()?;
                    return Ok(KindTable::$of(table));
                }
            )*
            Err(serde::de::Error::unknown_field(name, KEYS))
        }
    };
}

macro_rules! name {
    (motion $module:ident) => {
        <$module::Table as MotionTable>::NAME
    };
    (function $module:ident) => {
        <$module::Table as FunctionTable>::NAME
    };
}

kinds! {
    motion joint_reached
    function fk_error
    function fk_orientation
    function ik_reach
    function ik_branches
    function ik_unreachable
    function jacobian_match
    motion pose_reached
    motion orientation_reached
    motion finish_time
    motion overshoot
    motion effort_saturation
    motion joint_limits
    motion trajectory_match
    motion response_match
    motion joint_tracking
    motion body_falls
    motion contact_impulse
    motion body_reached
    motion never
    motion order
    motion sensor_reads
    motion tcp_speed
    motion path_deviation
    motion path_coverage
    motion path_end
    motion path_speed
    motion time_limit
    motion robustness
    motion rise_time
    motion settling_time
    motion step_overshoot
    motion steady_error
    motion effort_peak
    motion effort_rms
    motion effort_match
    motion energy
    motion jerk
    motion joint_speed
    motion chatter
    function function_cases
}
