//! The schemas of the files of a lab, for editors of TOML.

use kinemark_sim::text::schema::{schema_of, with_marked_numbers};
use schemars::Schema;

use super::file::{HiddenTable, LabTable, MutantsTable};
use super::variant::VariantTable;

/// The JSON schema of `lab.toml`, in which numbers may be expressions over the parameters.
pub fn lab_schema() -> Schema {
    // what the expressions are over is no expression itself
    with_marked_numbers(
        schema_of::<LabTable>("A lab of Kinemark"),
        &["parameters", "variants"],
    )
}

/// The JSON schema of `hidden.toml`.
pub fn hidden_schema() -> Schema {
    schema_of::<HiddenTable>("What is hidden in a lab of Kinemark")
}

/// The JSON schema of `mutants.toml`.
pub fn mutants_schema() -> Schema {
    schema_of::<MutantsTable>("The mutants of a lab of Kinemark")
}

/// The JSON schema of `variant.toml`.
pub fn variant_schema() -> Schema {
    schema_of::<VariantTable>("A student's variant of a lab of Kinemark")
}
