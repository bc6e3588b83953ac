//! The kinds of sensors, one line each. A file has a `Table`, which says how the kind is read.

use super::registry::Kind;

macro_rules! kinds {
    ($($module:ident)*) => {
        $(mod $module;)*

        /// The kinds, in the order of this list.
        pub(super) const KINDS: &[Kind] = &[$(Kind::of::<$module::Table>()),*];
    };
}

kinds! {
    joint_position
    joint_velocity
    joint_effort
    limit_switch
    range_finder
    contact
    wrench
}
