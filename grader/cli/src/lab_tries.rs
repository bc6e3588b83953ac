//! What `lab check` tries: the solution in draws and variants, the starter and the mutants, many at once. The results do not depend on
//! how many.

use indicatif::{ProgressBar, ProgressStyle};
use kinemark_grader::audit::{
    Draws, Form, Found, PracticeError, Variants, depends_on_salt, practice_form,
};
use kinemark_grader::lab::corner::Corner;
use kinemark_grader::lab::practice::{PRACTICE_VARIANTS, PracticeForm};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::task::problem::LoadError;
use kinemark_sim::text::Source;

use crate::disk::Folder;
use crate::failure::Failure;
use crate::parallel;
use crate::staff_folder;

/// Variants that are tried in a hurry.
const QUICK_VARIANTS: u32 = 3;
/// Ends of what students draw that are tried in a hurry.
const QUICK_CORNERS: u32 = 2;
/// Other draws of hidden numbers that are tried in a hurry.
const QUICK_DRAWS: u32 = 1;

/// What is not looked at in a hurry, in words.
pub(crate) fn left_out() -> Vec<String> {
    vec![
        format!("all but {QUICK_VARIANTS} variants and {QUICK_CORNERS} of their corners"),
        format!("all but {QUICK_DRAWS} other draw of hidden cases"),
        "practice.json".to_owned(),
        "the accuracy of the simulation (rule `accuracy`)".to_owned(),
    ]
}

/// The course staff's part of `lab`, with another salt than its own where one is given.
pub(crate) fn staff_of(
    reference: &Folder,
    lab: &Lab,
    salt: Option<&str>,
) -> Result<Staff, Failure> {
    staff_folder::staff(reference, lab, salt)?.ok_or_else(|| {
        Failure::usage(
            staff_folder::no_solution(reference, lab),
            "write it, or give another folder with --reference DIR",
        )
    })
}

/// How much is tried.
pub(crate) struct Extent {
    mutants: usize,
    draws: u32,
    variants: u32,
    /// Variants at the ends of what students draw.
    corners: Vec<Corner>,
    /// Entries of `practice.json`.
    practice: u32,
    /// Whether the solution is run with half the physics step.
    finer: bool,
}

impl Extent {
    /// So many other draws and variants of `lab`, or less in a hurry.
    pub(crate) fn of(
        lab: &Lab,
        staff: &Staff,
        (draws, variants): (u32, u32),
        is_quick: bool,
    ) -> Result<Self, Failure> {
        let most = |count: u32, quick: u32| if is_quick { count.min(quick) } else { count };
        let variants = most(variants, QUICK_VARIANTS);
        let mut corners = lab.corners().map_err(LoadError::from)?;
        corners.truncate(most(variants, QUICK_CORNERS) as usize);
        Ok(Self {
            corners,
            mutants: staff.mutants.len(),
            draws: match depends_on_salt(lab, staff) {
                true => most(draws, QUICK_DRAWS),
                false => 0,
            },
            variants: match lab.variants.is_empty() {
                true => 0,
                false => variants,
            },
            finer: !is_quick,
            practice: match (is_quick, lab.variants.is_empty()) {
                (true, _) => 0,
                (false, true) => 1,
                (false, false) => 1 + PRACTICE_VARIANTS,
            },
        })
    }
}

/// What is tried first. None of it waits for another.
enum First<'c> {
    /// The attempts of a mutant that others are compared with.
    Mutant(usize),
    Reference,
    Finer,
    Zeros,
    PlayedBack,
    Draw(u32),
    Variant(u32),
    Corner(&'c Corner),
    Practice(u32),
}

/// What the first gives.
enum Gave {
    Nothing,
    Reference(Found),
    Finer(Option<Grade>),
    Zeros(Option<Grade>),
    PlayedBack(Option<Grade>),
    Draws(Draws),
    Variants(Variants),
    Corner(Variants),
    Practice(Result<PracticeForm, PracticeError>),
}

/// Everything that was tried.
pub(crate) struct All {
    pub(crate) starter: Found,
    pub(crate) reference: Found,
    pub(crate) finer: Option<Grade>,
    pub(crate) zeros: Option<Grade>,
    pub(crate) played_back: Option<Grade>,
    pub(crate) draws: Draws,
    pub(crate) variants: Option<Variants>,
    pub(crate) corners: Option<Variants>,
    pub(crate) practice: Vec<Result<PracticeForm, PracticeError>>,
    pub(crate) mutants: Vec<Found>,
}

/// What is needed to try a lab.
pub(crate) struct Tries<'a> {
    pub(crate) lab: &'a Lab,
    pub(crate) form: &'a Form<'a>,
    pub(crate) reference: &'a Folder,
    pub(crate) salt: String,
    pub(crate) starter: &'a Source,
    pub(crate) jobs: usize,
}

impl Tries<'_> {
    /// Tries everything, as many things at once as there are jobs.
    pub(crate) fn all(&self, extent: &Extent) -> Result<All, Failure> {
        let variants = u64::from(extent.variants) + extent.corners.len() as u64;
        let progress = progress(variants + extent.mutants as u64);
        // the longest first, so that none is begun when all others are done
        let mut first = vec![First::Reference];
        first.extend(extent.finer.then_some(First::Finer));
        first.extend([First::Zeros, First::PlayedBack]);
        first.extend((0..extent.mutants).map(First::Mutant));
        first.extend((0..extent.practice).map(First::Practice));
        first.extend((1..=extent.draws).map(First::Draw));
        first.extend((1..=extent.variants).map(First::Variant));
        first.extend(extent.corners.iter().map(First::Corner));
        let is_variant = |first: &First<'_>| matches!(first, First::Variant(_) | First::Corner(_));
        let gave = parallel::in_order(&first, self.jobs, (&progress, is_variant), |first| {
            self.first(first)
        })?;
        // each mutant is compared with all others, whose attempts are there now
        let starter_and_mutants: Vec<Option<usize>> = std::iter::once(None)
            .chain((0..extent.mutants).map(Some))
            .collect();
        let graded = parallel::in_order(
            &starter_and_mutants,
            self.jobs,
            (&progress, Option::is_some),
            |mutant| match mutant {
                Some(index) => self.form.mutant(*index),
                None => self.form.starter(self.starter),
            },
        )?;
        progress.finish_and_clear();
        let mut graded = graded.into_iter();
        let mut all = All {
            starter: graded.next().unwrap_or_default(),
            reference: Found::default(),
            finer: None,
            zeros: None,
            played_back: None,
            draws: Draws::default(),
            variants: (extent.variants > 0).then(Variants::default),
            corners: (!extent.corners.is_empty()).then(Variants::default),
            practice: Vec::new(),
            mutants: graded.collect(),
        };
        for gave in gave {
            match gave? {
                Gave::Nothing => {}
                Gave::Reference(found) => all.reference = found,
                Gave::Finer(grade) => all.finer = grade,
                Gave::Zeros(grade) => all.zeros = grade,
                Gave::PlayedBack(grade) => all.played_back = grade,
                Gave::Draws(draws) => all.draws.join(draws),
                Gave::Variants(tried) => all.variants.get_or_insert_default().join(tried),
                Gave::Corner(tried) => all.corners.get_or_insert_default().join(tried),
                Gave::Practice(form) => all.practice.push(form),
            }
        }
        Ok(all)
    }

    fn first(&self, first: &First<'_>) -> Result<Gave, Failure> {
        let lab = self.lab;
        Ok(match *first {
            First::Mutant(index) => {
                self.form.prepare_mutant(index);
                Gave::Nothing
            }
            First::Reference => Gave::Reference(self.form.reference("own hidden cases")),
            First::Finer => Gave::Finer(self.form.finer()),
            First::Zeros => Gave::Zeros(self.form.zeros()),
            First::PlayedBack => Gave::PlayedBack(self.form.played_back()),
            First::Draw(number) => {
                let salt = format!("lab check {number}");
                let staff = staff_of(self.reference, lab, Some(&salt))?;
                let mut draws = Draws::default();
                draws.draw(&Form::new(lab, &staff), &format!("draw {number}"));
                Gave::Draws(draws)
            }
            First::Variant(number) => {
                let mut variants = Variants::default();
                let student = format!("student {number}");
                variants.student(lab, self.reference, &self.salt, &student);
                Gave::Variants(variants)
            }
            First::Corner(corner) => {
                let mut corners = Variants::default();
                corners.corner(lab, self.reference, &self.salt, corner);
                Gave::Corner(corners)
            }
            First::Practice(number) => {
                Gave::Practice(practice_form(&lab.copies(), lab, self.form.staff(), number))
            }
        })
    }
}

/// A line on a terminal that counts variants and mutants.
fn progress(count: u64) -> ProgressBar {
    let bar = ProgressBar::new(count);
    let style = "{pos}/{len} variants and mutants {wide_bar} {eta} left";
    if let Ok(style) = ProgressStyle::with_template(style) {
        bar.set_style(style);
    }
    bar
}
