//! The tables of a lab file read part by part, where they cannot be read as a whole: a slip in one check hides none in another.

use kinemark_sim::text::{Dimensions, Mistakes, Source};
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error, ValueDeserializer};

use crate::check::registry::CheckTable;
use crate::lab::file::{LabTable, TaskTable};
use crate::lab::parameters::refused_in_parts;
use crate::task::problem::LabError;

/// All that is refused in the parts of the file; `whole` where that is nothing.
pub(super) fn all_refused(source: &Source, parameters: &Dimensions, whole: LabError) -> LabError {
    let mut mistakes = Mistakes::default();
    for refused in refused_in_parts(source, parameters, refused_in) {
        let _: Option<()> = mistakes.keep(Err(refused));
    }
    mistakes.finish().err().unwrap_or(whole)
}

/// What is refused in the file without its tasks, in each task without its checks, and in each check.
fn refused_in(file: &Spanned<DeTable<'_>>) -> Vec<Error> {
    let mut refused = Vec::new();
    let mut lab = file.get_ref().clone();
    let mut tasks = Vec::new();
    if matches!(
        lab.get("tasks").map(Spanned::get_ref),
        Some(DeValue::Array(_))
    ) && let Some(DeValue::Array(items)) = lab.remove("tasks").map(Spanned::into_inner)
    {
        tasks.extend(items);
    }
    read::<LabTable>(Spanned::new(file.span(), DeValue::Table(lab)), &mut refused);
    for mut task in tasks {
        if let DeValue::Table(table) = task.get_mut()
            && matches!(
                table.get("checks").map(Spanned::get_ref),
                Some(DeValue::Array(_))
            )
            && let Some(DeValue::Array(checks)) = table.remove("checks").map(Spanned::into_inner)
        {
            for check in checks {
                read::<CheckTable>(check, &mut refused);
            }
        }
        read::<TaskTable>(task, &mut refused);
    }
    refused
}

fn read<T: DeserializeOwned>(value: Spanned<DeValue<'_>>, refused: &mut Vec<Error>) {
    refused.extend(T::deserialize(ValueDeserializer::from(value)).err());
}
