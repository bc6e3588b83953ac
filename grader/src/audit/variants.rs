//! The reference solution in the variants of many students: it must have full marks in every one, with a margin in every band.

use kinemark_sim::text::Dimension;
use serde::Serialize;

use super::bands::{add_mutant, add_reference, difficulty};
use super::form::Form;
use super::lost::{Lost, distinct};
use super::row::{Problem, Row, Tried};
use super::{Audit, staff_code};
use crate::lab::corner::Corner;
use crate::lab::staff::Staff;
use crate::lab::{Lab, TaskWork, Variant};
use crate::record::grade::{Grade, Measure};
use crate::task::files::Files;
use crate::task::model::Function;
use crate::task::problem::{LabError, LoadError};

/// The results of the variants of some students.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Variants {
    /// Students with the numbers of their variants, in words.
    students: Vec<(String, String)>,
    lost: Vec<Lost>,
    rooms: Vec<VariantMargin>,
    grades: Vec<(String, Grade)>,
}

/// The margin of the reference solution in a check's band, over the variants that were tried. Similar margins make variants equally hard.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantMargin {
    /// The task.
    pub task: String,
    /// The check.
    pub check: String,
    /// The least margin of its value to the value that earns all points, as a fraction of the band's width; negative if points were
    /// lost.
    pub least: f64,
    /// The greatest such margin.
    pub greatest: f64,
    /// Whether the reference solution has hardly any room in some variant.
    pub is_thin: bool,
    /// The band where it depends on the reference, as numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<RelativeBand>,
}

/// A band that depends on what the reference solution reaches, over the variants that were tried; each range is least and greatest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RelativeBand {
    /// What the reference solution reaches.
    pub reference: [f64; 2],
    /// What earns all points.
    pub full: [f64; 2],
    /// What earns none.
    pub zero: [f64; 2],
    /// The unit of all of them; empty for a ratio.
    pub unit: String,
}

impl RelativeBand {
    /// Of one variant.
    fn of(measure: &Measure) -> Option<Self> {
        Some(Self {
            reference: [measure.reference?; 2],
            full: [measure.full; 2],
            zero: [measure.zero; 2],
            unit: measure.unit.clone(),
        })
    }

    fn widen(&mut self, other: &Self) {
        let pairs = [
            (&mut self.reference, other.reference),
            (&mut self.full, other.full),
            (&mut self.zero, other.zero),
        ];
        for ([low, high], [other_low, other_high]) in pairs {
            (*low, *high) = (low.min(other_low), high.max(other_high));
        }
    }
}

/// Margins below this share of a band are thin.
const THIN: f64 = 0.05;

/// A value of this share of what still earns everything has room, however wide the band is beyond.
pub(super) const NOT_SPENT: f64 = 0.75;

/// Whether a measure that earns all points has hardly any room to the value where it would not. What is as good as can be is not thin,
/// however near `full` is to it: an answer without error, a path that is wholly covered.
pub(super) fn is_thin(measure: &Measure) -> bool {
    let (Some(margin), Some(value)) = (margin_of(measure), measure.value) else {
        return false;
    };
    let best_is_near = if measure.full > measure.zero {
        value >= 1.0 && measure.unit.is_empty()
    } else if measure.full > 0.0 {
        value <= NOT_SPENT * measure.full
    } else {
        value >= measure.full
    };
    (0.0..THIN).contains(&margin) && !best_is_near
}

/// The margin of a measure; `None` if it has no value or its band has no width.
pub(super) fn margin_of(measure: &Measure) -> Option<f64> {
    let value = measure.value?;
    let margin = (measure.full - value) / (measure.zero - measure.full);
    // adding zero turns -0 into 0
    margin.is_finite().then_some(margin + 0.0)
}

impl Variants {
    /// Tries the variant of `lab` that `student` gets under `salt`, with its hidden cases and runs. A variant that cannot be loaded is
    /// recorded like one that loses points.
    pub fn student(&mut self, base: &Lab, reference: &dyn Files, salt: &str, student: &str) {
        let variant = base.variant_of(salt, student);
        self.variant(base, (reference, salt), (student, variant));
    }

    /// Tries a corner of what students draw, as [`Self::student`] does a student's variant.
    pub fn corner(&mut self, base: &Lab, reference: &dyn Files, salt: &str, corner: &Corner) {
        let variant = Ok(corner.variant.clone());
        self.variant(base, (reference, salt), (&corner.words, variant));
    }

    fn variant(
        &mut self,
        base: &Lab,
        (reference, salt): (&dyn Files, &str),
        (of, variant): (&str, Result<Variant, LabError>),
    ) {
        let mut numbers = String::new();
        let loaded = variant.map_err(Into::into).and_then(|variant| {
            numbers = variant.numbers().trim_end().replace('\n', ", ");
            Self::load(base, reference, salt, &variant)
        });
        self.students.push((of.to_owned(), numbers.clone()));
        let lost = |problem| Lost {
            of: of.to_owned(),
            numbers: numbers.clone(),
            problem,
        };
        let (lab, staff) = match loaded {
            Ok(Some(loaded)) => loaded,
            Ok(None) => return,
            Err(why) => {
                self.lost.push(lost(Problem {
                    what: format!("it cannot be loaded ({numbers}): {why}"),
                    help: "or mend what the error names".to_owned(),
                    key: NOT_LOADED.to_owned(),
                    ..Problem::default()
                }));
                return;
            }
        };
        let (grade, mut problems) = Form::new(&lab, &staff).solved();
        for problem in &mut problems {
            let task = problem.task.as_ref();
            if task.is_some_and(|task| expects_the_same_of_another_robot(base, &lab, task)) {
                problem.help = EXPECTED_STAYS.to_owned();
            }
        }
        self.lost.extend(problems.into_iter().map(lost));
        if let Some(grade) = grade {
            self.measure(&grade);
            self.grades.push((of.to_owned(), grade));
        }
    }

    /// The lab with the numbers of `variant`, and the course staff's part of it.
    fn load(
        lab: &Lab,
        reference: &dyn Files,
        salt: &str,
        variant: &Variant,
    ) -> Result<Option<(Lab, Staff)>, LoadError> {
        let numbers: Vec<(String, Dimension)> = variant
            .parameters()
            .map(|(name, value)| (name.to_owned(), value.clone()))
            .collect();
        let lab = lab.with_parameters(&numbers)?;
        let staff = Staff::load(reference, &lab, Some(salt))?;
        if let Some(staff) = &staff {
            staff_code(&lab, staff)?;
        }
        Ok(staff.map(|staff| (lab, staff)))
    }

    fn measure(&mut self, grade: &Grade) {
        for task in &grade.tasks {
            for check in &task.checks {
                if let Some(margin) = check.measure.as_ref().and_then(margin_of) {
                    self.widen(VariantMargin {
                        task: task.name.clone(),
                        check: check.name.clone(),
                        least: margin,
                        greatest: margin,
                        is_thin: check.measure.as_ref().is_some_and(is_thin),
                        relative: check.measure.as_ref().and_then(RelativeBand::of),
                    });
                }
            }
        }
    }

    fn widen(&mut self, margin: VariantMargin) {
        let known = self.rooms.iter_mut();
        let mut same =
            known.filter(|known| known.task == margin.task && known.check == margin.check);
        match same.next() {
            Some(known) => {
                known.least = known.least.min(margin.least);
                known.greatest = known.greatest.max(margin.greatest);
                known.is_thin |= margin.is_thin;
                match (&mut known.relative, &margin.relative) {
                    (Some(known), Some(other)) => known.widen(other),
                    (known, other) => *known = known.take().or_else(|| other.clone()),
                }
            }
            None => self.rooms.push(margin),
        }
    }

    /// How many were tried.
    pub(super) fn count(&self) -> usize {
        self.students.len()
    }

    /// What was lost, each distinct problem once, in `words` of the first and of how many there are.
    pub(super) fn problems(&self, words: impl Fn(&Lost, usize) -> String) -> Vec<Problem> {
        distinct(self.lost.clone(), &[], words)
    }

    /// Adds the results of other students, who come after these.
    pub fn join(&mut self, other: Self) {
        self.students.extend(other.students);
        self.lost.extend(other.lost);
        self.grades.extend(other.grades);
        for margin in other.rooms {
            self.widen(margin);
        }
    }
}

impl Audit {
    /// Records the results of the variants.
    pub fn variants(&mut self, tried: Variants) {
        let count = tried.students.len();
        let mut problems = distinct(tried.lost, &self.rows, |first, places| {
            let (of, what) = (&first.of, &first.problem.what);
            let numbers = match first.problem.key == NOT_LOADED {
                true => String::new(),
                false => format!(" ({})", first.numbers),
            };
            format!("in {places} of {count}, such as that of `{of}`{numbers}: {what}")
        });
        for problem in &mut problems {
            problem.help = format!("narrow [variants], {}", problem.help);
        }
        let form = format!("{count} variants");
        self.rows
            .extend(Row::all((Tried::Reference, &form), None, problems));
        self.rooms = tried.rooms;
        for (student, grade) in &tried.grades {
            add_reference(&mut self.bands, student, grade);
        }
        self.difficulty = difficulty(&self.bands, &tried.students);
    }

    /// Records what the reference solution reaches with the lab's own numbers.
    pub fn measure_reference(&mut self, grade: &Grade) {
        add_reference(&mut self.bands, "", grade);
    }

    /// Records what a mutant reaches with the lab's own numbers.
    pub fn measure_mutant(&mut self, name: &str, grade: &Grade) {
        add_mutant(&mut self.bands, name, grade);
    }
}

/// What to do where visible cases expect numbers of a robot that differs from student to student.
const EXPECTED_STAYS: &str = "or pin the robot of each visible case: `expected` is the same number in every variant, and the robot is not; \
                              give the case `dimensions` of its own, or write `expected` as an expression over the parameters";

/// Whether a task has visible cases of a function of the lab's own whose robot varies, while what is expected does not.
fn expects_the_same_of_another_robot(base: &Lab, lab: &Lab, name: &str) -> bool {
    let Some(task) = lab.tasks.iter().find(|task| task.name == name) else {
        return false;
    };
    let TaskWork::Function(work, _) = &task.work else {
        return false;
    };
    let before = base.tasks.iter().find(|task| task.name == name);
    let before = before.map_or(base, |task| base.of_task(task));
    matches!(work.function, Function::Free(_))
        && work.about.gives_robot
        && work.cases.iter().any(|case| case.robot.is_none())
        && lab.of_task(task).robot_file.dimensions() != before.robot_file.dimensions()
}

/// What a variant that cannot be loaded has in common with the others.
pub(super) const NOT_LOADED: &str = "not loaded";

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(value: f64, full: f64, zero: f64) -> Measure {
        Measure {
            quantity: String::new(),
            value: Some(value),
            unit: String::new(),
            full,
            zero,
            reference: None,
            prediction: None,
        }
    }

    #[test]
    fn room_counts_from_full_in_widths_of_the_band_whichever_way_is_better() {
        assert_eq!(margin_of(&measure(1.0, 2.0, 4.0)), Some(0.5));
        assert_eq!(margin_of(&measure(3.0, 2.0, 4.0)), Some(-0.5));
        assert_eq!(margin_of(&measure(1.0, 0.75, 0.5)), Some(1.0));
        assert_eq!(margin_of(&measure(1.0, 2.0, 2.0)), None);
    }

    #[test]
    fn what_is_as_good_as_can_be_is_not_thin() {
        // an answer without error, in a band that begins at 1 % of its width
        assert!(!is_thin(&measure(1e-16, 0.01, 1.0)));
        assert!(is_thin(&measure(0.009, 0.01, 1.0)));
        assert!(is_thin(&measure(1.95, 2.0, 4.0)));
        assert!(!is_thin(&measure(1.8, 2.0, 4.0)));
        // nothing touched, and nothing may be
        assert!(!is_thin(&measure(0.0, 0.0, 0.5)));
        // a whole path, and nearly one
        assert!(!is_thin(&measure(1.0, 0.98, 0.5)));
        assert!(is_thin(&measure(0.99, 0.98, 0.5)));
        assert!(!is_thin(&measure(0.97, 0.98, 0.5)), "that loses points");
    }

    #[test]
    fn students_that_were_tried_apart_are_joined() {
        let margin = |least, greatest| VariantMargin {
            task: "line".to_owned(),
            check: "speed".to_owned(),
            least,
            greatest,
            is_thin: false,
            relative: Some(
                RelativeBand::of(&Measure {
                    reference: Some(least),
                    ..measure(0.0, 2.0 * least, 3.0 * greatest)
                })
                .expect("a reference"),
            ),
        };
        let some = |student: &str, rooms| Variants {
            students: vec![(student.to_owned(), String::new())],
            rooms,
            ..Variants::default()
        };
        let mut all = some("s1", vec![margin(0.2, 0.3)]);
        all.join(some("s2", vec![margin(0.1, 0.25)]));
        assert_eq!(all.students.len(), 2);
        let [room] = &all.rooms[..] else {
            panic!("one check")
        };
        assert_eq!([room.least, room.greatest], [0.1, 0.3]);
        let band = room.relative.as_ref().unwrap();
        assert_eq!(band.reference, [0.1, 0.2]);
        assert_eq!((band.full, band.zero), ([0.2, 0.4], [0.75, 3.0 * 0.3]));
    }
}
