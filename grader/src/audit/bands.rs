//! What the reference solution and the mutants reach in every band: the numbers from which a person chooses one.

use serde::Serialize;

use super::variants::margin_of;
use crate::record::grade::{CheckGrade, Grade, Outcome};

/// What was reached in the band of one check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BandValues {
    /// The task.
    pub task: String,
    /// The check.
    pub check: String,
    /// Its title.
    pub title: String,
    /// What is measured.
    pub quantity: String,
    /// The unit of values and band; empty for a ratio.
    pub unit: String,
    /// The value that earns all points, with the lab's own numbers.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
    /// The reference solution: with the lab's own numbers, then in the variants.
    pub reference: Vec<Reached>,
    /// The mutants of the task, with the lab's own numbers.
    pub mutants: Vec<Reached>,
}

/// What one submission reaches in a band, in one form of the lab.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reached {
    /// The mutant, or the student whose variant it is; empty for the lab's own numbers.
    pub of: String,
    /// The value, of the visible run or cases.
    pub value: f64,
    /// How far it is inside of the value that earns all points, as a fraction of the band's width; negative outside.
    pub margin: f64,
    /// Whether it loses points, in hidden cases and runs as well.
    pub loses: bool,
}

impl BandValues {
    /// Where the reference solution has the least margin.
    pub fn worst(&self) -> Option<&Reached> {
        let mut all = self.reference.iter();
        let first = all.next()?;
        // the first of equal ones
        let least = |a, b: _| if less_margin(b, a) { b } else { a };
        Some(all.fold(first, least))
    }

    /// Where the reference solution has the greatest margin.
    pub fn best(&self) -> Option<&Reached> {
        let mut all = self.reference.iter();
        let first = all.next()?;
        let greatest = |a, b: _| if less_margin(a, b) { b } else { a };
        Some(all.fold(first, greatest))
    }

    /// The mutant whose value loses points here with the least loss. Who loses in hidden cases and runs alone has a value inside.
    pub fn nearest_mutant(&self) -> Option<&Reached> {
        let is_outside = |mutant: &&Reached| mutant.loses && mutant.margin < 0.0;
        let mut losing = self.mutants.iter().filter(is_outside);
        let first = losing.next()?;
        let greatest = |a, b: _| if less_margin(a, b) { b } else { a };
        Some(losing.fold(first, greatest))
    }

    /// How much the margin of the reference solution differs between variants, as a fraction of the band's width.
    pub fn spread(&self) -> f64 {
        match (self.worst(), self.best()) {
            (Some(worst), Some(best)) => best.margin - worst.margin,
            _ => 0.0,
        }
    }
}

fn less_margin(a: &Reached, b: &Reached) -> bool {
    a.margin < b.margin
}

/// Adds to `bands` what the reference solution reaches in `grade`: with the numbers of the student `of`, or the lab's own.
pub(super) fn add_reference(bands: &mut Vec<BandValues>, of: &str, grade: &Grade) {
    for task in &grade.tasks {
        for check in &task.checks {
            let Some((reached, measure)) = reached(of, check) else {
                continue;
            };
            let is_it = |band: &&mut BandValues| band.task == task.name && band.check == check.name;
            match bands.iter_mut().find(is_it) {
                Some(band) => band.reference.push(reached),
                None => bands.push(BandValues {
                    task: task.name.clone(),
                    check: check.name.clone(),
                    title: check.title.clone(),
                    quantity: measure.quantity.clone(),
                    unit: measure.unit.clone(),
                    full: measure.full,
                    zero: measure.zero,
                    reference: vec![reached],
                    mutants: Vec::new(),
                }),
            }
        }
    }
}

/// Adds to `bands` what the mutant `of` reaches in `grade`.
pub(super) fn add_mutant(bands: &mut [BandValues], of: &str, grade: &Grade) {
    for task in &grade.tasks {
        for check in &task.checks {
            let is_it = |band: &&mut BandValues| band.task == task.name && band.check == check.name;
            let band = bands.iter_mut().find(is_it);
            if let (Some(band), Some((reached, _))) = (band, reached(of, check)) {
                band.mutants.push(reached);
            }
        }
    }
}

fn reached<'c>(
    of: &str,
    check: &'c CheckGrade,
) -> Option<(Reached, &'c crate::record::grade::Measure)> {
    let measure = check.measure.as_ref()?;
    if matches!(check.outcome, Outcome::NotJudged | Outcome::AtHandIn) {
        return None;
    }
    let reached = Reached {
        of: of.to_owned(),
        value: measure.value?,
        margin: margin_of(measure)?,
        loses: check.outcome != Outcome::Full,
    };
    Some((reached, measure))
}

/// How much the difficulty differs from variant to variant, by what the reference solution has left in the bands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difficulty {
    /// The task of the check that differs most.
    pub task: String,
    /// That check.
    pub check: String,
    /// How much the margin differs there, as a fraction of the band's width.
    pub spread: f64,
    /// The student in whose variant the margin is least there.
    pub hardest_there: String,
    /// The student in whose variant it is greatest.
    pub easiest_there: String,
    /// Every variant, in the order of its number.
    pub variants: Vec<VariantDifficulty>,
}

/// How hard a variant is, compared with the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantDifficulty {
    /// The student.
    pub student: String,
    /// The numbers, in words.
    pub numbers: String,
    /// By how much the reference solution's margins are smaller than those in the middle of all variants, as a fraction of a band's
    /// width, on the mean over the checks. Positive is harder.
    pub harder: f64,
    /// The check in which it is harder than the others by most, as `task/check`.
    pub most_in: String,
    /// By how much in that check.
    pub most: f64,
}

/// The difficulty of the variants called `students`, each with its numbers; `None` if there are fewer than two, or no band to compare in.
pub(super) fn difficulty(
    bands: &[BandValues],
    students: &[(String, String)],
) -> Option<Difficulty> {
    if students.len() < 2 {
        return None;
    }
    let of_variants: Vec<BandValues> = bands
        .iter()
        .map(|band| {
            let mut band = band.clone();
            band.reference.retain(|reached| !reached.of.is_empty());
            for reached in &mut band.reference {
                // where a whole band's width is left nothing is hard, however much more there is
                reached.margin = reached.margin.min(1.0);
            }
            band
        })
        .filter(|band| !band.reference.is_empty())
        .collect();
    let first = of_variants.first()?;
    let widest = of_variants
        .iter()
        .fold(first, |a, b| if b.spread() > a.spread() { b } else { a });
    let medians: Vec<f64> = of_variants.iter().map(median_margin).collect();
    let variants = students.iter().map(|(student, numbers)| {
        let mut off = Vec::new();
        for (band, median) in of_variants.iter().zip(&medians) {
            let mut own = band.reference.iter();
            if let Some(own) = own.find(|reached| reached.of == *student) {
                off.push((format!("{}/{}", band.task, band.check), median - own.margin));
            }
        }
        let sum: f64 = off.iter().map(|(_, off)| off).sum();
        let most = off.iter().fold(("", f64::NEG_INFINITY), |most, (of, off)| {
            if *off > most.1 { (of, *off) } else { most }
        });
        VariantDifficulty {
            student: student.clone(),
            numbers: numbers.clone(),
            harder: sum / off.len().max(1) as f64,
            most_in: most.0.to_owned(),
            most: if most.1.is_finite() { most.1 } else { 0.0 },
        }
    });
    Some(Difficulty {
        task: widest.task.clone(),
        check: widest.check.clone(),
        spread: widest.spread(),
        hardest_there: widest.worst()?.of.clone(),
        easiest_there: widest.best()?.of.clone(),
        variants: variants.collect(),
    })
}

fn median_margin(band: &BandValues) -> f64 {
    let mut margins: Vec<f64> = band.reference.iter().map(|of| of.margin).collect();
    margins.sort_by(f64::total_cmp);
    margins[margins.len() / 2]
}

impl Difficulty {
    /// The hardest variant.
    pub fn hardest(&self) -> Option<&VariantDifficulty> {
        let mut all = self.variants.iter();
        let first = all.next()?;
        Some(all.fold(first, |a, b| if b.harder > a.harder { b } else { a }))
    }

    /// The easiest variant.
    pub fn easiest(&self) -> Option<&VariantDifficulty> {
        let mut all = self.variants.iter();
        let first = all.next()?;
        Some(all.fold(first, |a, b| if b.harder < a.harder { b } else { a }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band(reference: &[(&str, f64)], mutants: &[(&str, f64, bool)]) -> BandValues {
        let reached = |of: &str, margin: f64, loses| Reached {
            of: of.to_owned(),
            value: 2.0 - margin,
            margin,
            loses,
        };
        BandValues {
            task: "line".to_owned(),
            check: "speed".to_owned(),
            title: String::new(),
            quantity: String::new(),
            unit: "m/s".to_owned(),
            full: 2.0,
            zero: 3.0,
            reference: reference
                .iter()
                .map(|(of, margin)| reached(of, *margin, false))
                .collect(),
            mutants: mutants
                .iter()
                .map(|(of, margin, loses)| reached(of, *margin, *loses))
                .collect(),
        }
    }

    #[test]
    fn the_nearest_mutant_is_the_one_that_loses_least() {
        let band = band(
            &[("", 0.5), ("student 1", 0.2), ("student 2", 0.8)],
            &[
                ("far", -3.0, true),
                ("near", -0.1, true),
                ("right", 0.7, false),
                ("hidden", 0.3, true),
            ],
        );
        assert_eq!(band.nearest_mutant().unwrap().of, "near");
        assert_eq!(band.worst().unwrap().of, "student 1");
        assert_eq!(band.best().unwrap().of, "student 2");
        assert!((band.spread() - 0.6).abs() < 1e-12);
    }

    #[test]
    fn a_variant_is_as_hard_as_its_margins_are_below_those_in_the_middle() {
        let narrow = band(&[("", 9.0), ("a", 0.5), ("b", 0.5), ("c", 0.1)], &[]);
        let mut wide = band(&[("a", 0.9), ("b", 0.3), ("c", 0.6)], &[]);
        wide.check = "time".to_owned();
        let students = ["a", "b", "c"].map(|name| (name.to_owned(), format!("x = {name}")));
        let found = difficulty(&[narrow.clone(), wide], &students).expect("variants");
        assert_eq!((&found.check[..], &found.hardest_there[..]), ("time", "b"));
        let hardest = found.hardest().unwrap();
        assert_eq!(
            (&hardest.student[..], &hardest.most_in[..]),
            ("c", "line/speed")
        );
        assert!((hardest.harder - 0.2).abs() < 1e-12, "{hardest:?}");
        assert_eq!(found.easiest().unwrap().student, "a");
        assert_eq!(difficulty(&[narrow], &students[..1]), None);
        // more than a whole band's width is no difference
        let far = band(&[("", 5.0), ("a", 40.0), ("b", 3.0)], &[]);
        assert_eq!(
            difficulty(&[far], &students[..2]).map(|found| found.spread),
            Some(0.0)
        );
    }
}
