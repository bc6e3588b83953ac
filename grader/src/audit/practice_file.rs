//! `practice.json` against the reference solution: what it should hold, and whether it does.

use super::{Audit, Tried};
use crate::judge::{NoPractice, practice};
use crate::lab::practice::{
    PRACTICE_FILE, PRACTICE_SALT, PRACTICE_VARIANTS, PracticeForm, form, practice_student,
};
use crate::lab::staff::Staff;
use crate::lab::{Lab, Practice};
use crate::task::files::Files;
use crate::task::problem::LoadError;

/// Why `practice.json` cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum PracticeError {
    /// A practice variant cannot be loaded.
    #[error(transparent)]
    Load(Box<LoadError>),
    /// The reference solution does not do its work in a variant.
    #[error("in the {of}: {why}")]
    Solution {
        /// The variant.
        of: String,
        /// The reason.
        why: NoPractice,
    },
}

/// What `practice.json` of `lab` should hold: the default variant, and the practice variants where the lab has variants. `done` hears of
/// each as it is done.
///
/// # Errors
/// [`PracticeError`] where a practice variant cannot be loaded, or the solution does not do its work in it.
pub fn practice_forms(
    labs: &dyn Files,
    lab: &Lab,
    staff: &Staff,
    done: &dyn Fn(),
) -> Result<Vec<PracticeForm>, PracticeError> {
    let mut forms = vec![practice_form(labs, lab, staff, 0)?];
    done();
    if lab.variants.is_empty() || forms[0].tasks.is_empty() {
        return Ok(forms);
    }
    for number in 1..=PRACTICE_VARIANTS {
        forms.push(practice_form(labs, lab, staff, number)?);
        done();
    }
    Ok(forms)
}

/// One entry of it: practice variant `number`, or the default variant for 0.
///
/// # Errors
/// As [`practice_forms`].
pub fn practice_form(
    labs: &dyn Files,
    lab: &Lab,
    staff: &Staff,
    number: u32,
) -> Result<PracticeForm, PracticeError> {
    let of = |lab: &Lab, name: &str| {
        practice(lab, staff).map_err(|why| PracticeError::Solution {
            of: name.to_owned(),
            why,
        })
    };
    if number == 0 {
        return Ok(form(None, of(lab, "default variant")?));
    }
    let student = practice_student(number);
    let load = |error: LoadError| PracticeError::Load(Box::new(error));
    let variant = lab.variant_of(PRACTICE_SALT, &student);
    let variant = variant.map_err(|error| load(error.into()))?;
    let own = Lab::load_variant(labs, &lab.name, Some(&variant)).map_err(load)?;
    let tasks = of(&own, &format!("variant `{student}`"))?;
    Ok(form(Some(&variant), tasks))
}

impl Audit {
    /// Compares what `practice.json` says of each variant with what the reference solution gives: `current` has one entry per form.
    pub fn practice(&mut self, forms: &[PracticeForm], current: &[Practice]) {
        if forms.iter().all(|form| form.tasks.is_empty()) && current.iter().all(Practice::is_empty)
        {
            return;
        }
        let mut differ = forms.iter().zip(current).enumerate();
        let problem = differ.find_map(|(i, (form, current))| {
            if current.is_empty() && !form.tasks.has_values() {
                // without a path nothing is drawn, and everything is judged
                return None;
            }
            let what = difference(&form.tasks, current)?;
            let of = match i {
                0 => "the default variant".to_owned(),
                _ => format!("variant `{}`", practice_student(i as u32)),
            };
            Some((
                format!("{PRACTICE_FILE} is not what the reference solution gives in {of}: {what}"),
                format!("write it anew: kinemark lab fill {}", self.lab),
            ))
        });
        self.add((Tried::Practice, ""), None, None, problem);
    }
}

/// The first difference of what students get from what they should get.
fn difference(should: &Practice, is: &Practice) -> Option<String> {
    if should == is {
        return None;
    }
    for (name, task) in should.tasks() {
        for (check, value) in &task.values {
            match is.value(name, check) {
                Some(given) if given.to_bits() == value.to_bits() => {}
                Some(given) => return Some(format!("{name}/{check} is {value}, not {given}")),
                None => return Some(format!("{name}/{check} is missing")),
            }
        }
        if is.path(name) != task.path.as_ref() {
            return Some(format!("the path of task `{name}` differs"));
        }
    }
    Some("it says more than it should".to_owned())
}
