//! Variants of a lab: the numbers of one student, as a `variant.toml` has them.

use kinemark_sim::text::{Dimension, FileFormat, ParameterSchema, Source, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;

use super::load::tables;
use super::model::Lab;
use super::parameters::NumbersTable;
use crate::task::problem::{LabError, LoadError, near, problems};
use crate::task::reporter::Reporter;

/// The name of the file beside a submission, and in the copy of a lab in a report.
pub const VARIANT_FILE: &str = "variant.toml";

/// Ids longer than this are something else.
const MOST_ID_CHARACTERS: usize = 100;

/// Numbers for the parameters of a lab, and whose they are.
#[derive(Debug, Clone)]
pub struct Variant {
    source: Source,
    lab: Spanned<String>,
    student: Option<String>,
    parameters: NumbersTable,
}

/// `variant.toml`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VariantTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The lab of which it is a variant.
    lab: Spanned<String>,
    /// Whose it is.
    student: Option<Spanned<String>>,
    /// Numbers of the lab, or lists of them; those left out are as in lab.toml.
    #[serde(default)]
    #[schemars(with = "std::collections::BTreeMap<String, ParameterSchema>")]
    parameters: NumbersTable,
}

problems! {
    /// What is wrong with a `variant.toml`, or with it as one of a lab.
    enum VariantProblem {
        Student { why: String }:
            "variant::student", "{why}", "this id", "write the id as the course writes it";
        OtherLab { of: String, lab: String }:
            "variant::lab", "this is a variant of lab `{of}`, not of `{lab}`", "another lab",
            "name the right file with --variant, or move this one away";
        UnknownParameter { lab: String, name: String, known: Vec<String> }:
            "variant::unknown_parameter", "lab `{lab}` has no parameter `{name}`", "not a parameter of this lab",
            near(name, "parameters", known);
        Shape { name: String, base: Dimension, value: Dimension }:
            "variant::shape", "parameter `{name}` is {base}, got {value}", "another shape", "write it as in lab.toml";
        NotVaried { lab: String, name: String, base: String }:
            "variant::not_drawn", "parameter `{name}` of lab `{lab}` is {base} for everybody", "another number",
            "[variants] in lab.toml says which parameters differ from student to student: leave this one out";
        NotDrawn { lab: String, name: String, value: String, steps: String }:
            "variant::not_drawn", "no student's variant of lab `{lab}` has {name} = {value}", "outside of [variants]",
            format!("[variants] in lab.toml gives `{name}` {steps}");
        Invalid { lab: String, why: String }:
            "variant::invalid", "with the numbers of this variant lab `{lab}` is invalid: {why}", "no student's variant has this",
            "use the variant.toml that your course gave you";
    }
}

impl Variant {
    /// Reads a `variant.toml`.
    ///
    /// # Errors
    /// What is no such file.
    pub fn parse(source: Source) -> Result<Self, LabError> {
        let table: VariantTable = tables(&source)?;
        let report = Reporter { source: &source };
        if let Some(student) = &table.student
            && let Err(why) = student_id(student.get_ref())
        {
            return report.refuse_at(student, VariantProblem::Student { why });
        }
        Ok(Self {
            lab: table.lab,
            student: table.student.map(Spanned::into_inner),
            parameters: table.parameters,
            source,
        })
    }

    /// A variant of `lab` with these numbers.
    ///
    /// # Errors
    /// An id that cannot be one, or a number that is not finite.
    pub fn new(
        lab: &str,
        student: Option<&str>,
        parameters: &[(String, Dimension)],
    ) -> Result<Self, LabError> {
        let named = parameters
            .iter()
            .map(|(name, value)| (name.as_str(), value));
        Self::parse(Source::new(VARIANT_FILE, written(lab, student, named)))
    }

    /// The lab of which it is one.
    pub fn lab(&self) -> &str {
        self.lab.get_ref()
    }

    /// Whose it is, where it says so.
    pub fn student(&self) -> Option<&str> {
        self.student.as_deref()
    }

    /// Its numbers, by name.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &Dimension)> {
        let pairs = self.parameters.iter();
        pairs.map(|(name, value)| (name.get_ref().as_str(), value.get_ref()))
    }

    /// It as a `variant.toml`: the same text for the same numbers, however they were typed.
    pub fn text(&self) -> String {
        written(self.lab.get_ref(), self.student(), self.parameters())
    }

    /// Its numbers as text alone: what the digests of two variants differ by.
    pub(crate) fn numbers(&self) -> String {
        let lines = self.parameters();
        lines
            .map(|(name, value)| format!("{name} = {}\n", toml_of(value)))
            .collect()
    }

    /// Checks that it is one of `lab`, which has the default numbers.
    ///
    /// # Errors
    /// Another lab's variant, a parameter that the lab does not have, a number in place of a list.
    pub fn check_fits(&self, lab: &Lab) -> Result<(), LabError> {
        self.fits(&lab.name, &lab.parameters)
    }

    /// Checks that it has no other numbers than a student's variant of `lab` can have: those that `[variants]` gives, else those that
    /// everybody has. `lab` has the default numbers, and it is a variant of that lab.
    ///
    /// # Errors
    /// The first parameter that has another number.
    pub fn check_drawn(&self, lab: &Lab) -> Result<(), LabError> {
        let report = Reporter {
            source: &self.source,
        };
        for (name, value) in &self.parameters {
            let base = lab.parameters.get(name.get_ref());
            let rule = lab
                .variants
                .iter()
                .find(|rule| rule.name == *name.get_ref());
            // what a file leaves out stands as in lab.toml, so it may say that, too
            if base == Some(value.get_ref()) || rule.is_some_and(|rule| rule.gives(value.get_ref()))
            {
                continue;
            }
            let (lab_name, name) = (lab.name.clone(), name.get_ref().clone());
            return report.refuse_at(
                value,
                match rule {
                    Some(rule) => VariantProblem::NotDrawn {
                        lab: lab_name,
                        name,
                        value: toml_of(value.get_ref()),
                        steps: rule.words(),
                    },
                    None => VariantProblem::NotVaried {
                        lab: lab_name,
                        name,
                        base: base.map(toml_of).unwrap_or_default(),
                    },
                },
            );
        }
        Ok(())
    }

    /// Why `lab`, which has the default numbers, is invalid with those of this variant, where it is the variant that is to blame: it has
    /// a number that no student's variant has.
    pub fn blamed(&self, lab: &Lab, why: &LoadError) -> Option<LabError> {
        let not_drawn = self.check_drawn(lab).err()?;
        Some(not_drawn.map(|_| {
            let problem = VariantProblem::Invalid {
                lab: lab.name.clone(),
                why: why.to_string(),
            };
            Box::new(problem) as Box<_>
        }))
    }

    /// Checks that it is one of `lab`: the lab's name, and each number one of its parameters in the same shape.
    pub(super) fn fits(
        &self,
        lab: &str,
        stated: &kinemark_sim::text::Dimensions,
    ) -> Result<(), LabError> {
        let report = Reporter {
            source: &self.source,
        };
        if self.lab.get_ref() != lab {
            let problem = VariantProblem::OtherLab {
                of: self.lab.get_ref().clone(),
                lab: lab.to_owned(),
            };
            return report.refuse_at(&self.lab, problem);
        }
        for (name, value) in &self.parameters {
            let Some(base) = stated.get(name.get_ref()) else {
                let problem = VariantProblem::UnknownParameter {
                    lab: lab.to_owned(),
                    name: name.get_ref().clone(),
                    known: stated.names().map(str::to_owned).collect(),
                };
                return report.refuse_at(name, problem);
            };
            if base.to_string() != value.get_ref().to_string() {
                let problem = VariantProblem::Shape {
                    name: name.get_ref().clone(),
                    base: base.clone(),
                    value: value.get_ref().clone(),
                };
                return report.refuse_at(value, problem);
            }
        }
        Ok(())
    }
}

/// A number or a list as TOML, exact.
pub(super) fn toml_of(value: &Dimension) -> String {
    match value {
        Dimension::Number(number) => format!("{number:?}"),
        Dimension::List(numbers) => format!("{numbers:?}"),
        Dimension::Text(text) => toml::Value::String(text.clone()).to_string(),
    }
}

fn written<'n>(
    lab: &str,
    student: Option<&str>,
    parameters: impl Iterator<Item = (&'n str, &'n Dimension)>,
) -> String {
    let quoted = |text: &str| toml::Value::String(text.to_owned()).to_string();
    let mut text = format!("format = 1\nlab = {}\n", quoted(lab));
    if let Some(student) = student {
        text += &format!("student = {}\n", quoted(student));
    }
    text += "\n[parameters]\n";
    for (name, value) in parameters {
        text += &format!("{name} = {}\n", toml_of(value));
    }
    text
}

/// What can be a student's id: it is taken letter by letter, so what nobody sees in it has no place.
///
/// # Errors
/// Why it cannot, in words.
pub fn student_id(id: &str) -> Result<(), String> {
    if id.is_empty() {
        return Err("the student id is empty".to_owned());
    }
    if let Some(sign) = id.chars().find(|sign| sign.is_control()) {
        let number = u32::from(sign);
        return Err(format!(
            "the student id has an invisible character (U+{number:04X})"
        ));
    }
    if id.trim() != id {
        return Err("the student id begins or ends with a space".to_owned());
    }
    if id.chars().count() > MOST_ID_CHARACTERS {
        return Err(format!(
            "a student id has at most {MOST_ID_CHARACTERS} characters"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_is_read_as_it_is_written() {
        let parameters = [
            ("l".to_owned(), Dimension::List(vec![1.0, 0.1 + 0.2])),
            ("x".to_owned(), Dimension::Number(3.04)),
        ];
        let variant = Variant::new("04-line", Some("s \"7\""), &parameters).unwrap();
        assert_eq!(
            variant.text(),
            "format = 1\nlab = \"04-line\"\nstudent = 's \"7\"'\n\n[parameters]\nl = [1.0, 0.30000000000000004]\nx = 3.04\n"
        );
        let read = Variant::parse(Source::new("variant.toml", variant.text())).unwrap();
        assert_eq!(read.student(), Some("s \"7\""));
        assert_eq!(read.text(), variant.text());
        for id in ["", " a", "a\n", "a\u{7}"] {
            assert!(Variant::new("x", Some(id), &[]).is_err(), "{id:?}");
        }
    }
}
