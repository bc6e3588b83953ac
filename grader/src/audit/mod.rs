//! Proves a lab: the starter must miss, the reference solution must have full marks with any hidden cases, and every mutant must lose
//! points and be named.
//!
//! An [`Audit`] collects rows. A lab has several forms, such as variants: what is tried in one [`Form`] is [`Found`] by itself, in any
//! order and at the same time as others, and collected in one order.

mod bands;
mod form;
mod hidden_losses;
mod lost;
mod mutants;
pub mod mutate;
mod practice_file;
mod quantities;
mod reference;
mod row;
mod rubric;
mod staff_code;
mod starter;
mod typed;
mod unnamed;
mod variants;

use kinemark_sim::text::Source;
use serde::Serialize;

use crate::lab::brief::{BEGIN, END, has_place_for_grading, pictures, with_numbers};
use crate::lab::staff::Staff;
use crate::lab::{Lab, Task, TaskWork};
use crate::record::grade::Grade;

pub use self::bands::{BandValues, Difficulty, Reached, VariantDifficulty};
pub use self::form::{Form, Found};
pub use self::hidden_losses::LostDraw;
pub use self::lost::Draws;
pub use self::mutants::LEAST_SHARE;
pub use self::practice_file::{PracticeError, practice_form, practice_forms};
use self::row::Problem;
pub use self::row::{Row, Tried};
pub use self::rubric::{Accepted, Doubt, Rubric, zeros};
pub use self::staff_code::staff_code;
pub use self::starter::MOST_STARTER_SHARE;
pub use self::variants::{RelativeBand, VariantMargin, Variants};

/// Least number of mutants of a lab.
pub const LEAST_MUTANTS: usize = 6;
/// The parts of a lab that were tried, and their problems.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Audit {
    /// The lab.
    pub lab: String,
    /// Maximum points.
    pub max_points: f64,
    /// One row for each part that was tried, in order.
    pub rows: Vec<Row>,
    /// The margin of the reference solution in every band, over the variants that were tried; empty if none were.
    #[serde(skip)]
    pub rooms: Vec<VariantMargin>,
    /// What the reference solution and the mutants reach in every band.
    pub bands: Vec<BandValues>,
    /// How much the variants that were tried differ in difficulty.
    pub difficulty: Option<Difficulty>,
    /// What was not looked at, in words.
    pub left_out: Vec<String>,
}

impl Audit {
    /// An audit without rows.
    pub fn new(lab: &Lab) -> Self {
        Self {
            lab: lab.name.clone(),
            max_points: lab.tasks.iter().map(|task| task.max_points()).sum(),
            rows: Vec::new(),
            rooms: Vec::new(),
            bands: Vec::new(),
            difficulty: None,
            left_out: Vec::new(),
        }
    }

    /// The number of rows with a problem.
    pub fn problems(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.problem.is_some())
    }

    fn add(
        &mut self,
        (tried, name): (Tried, &str),
        task: Option<&str>,
        earned: Option<(f64, f64)>,
        problem: Option<impl Into<Problem>>,
    ) {
        let row = Row::new((tried, name), task, earned, problem.map(Into::into));
        self.rows.push(row);
    }

    /// Checks the brief: it exists, its numbers can be computed for every variant, its formulas can be drawn (`formula` is what is wrong
    /// with one, in words), its pictures are among the lab's `files`, and it marks the position of the table of points.
    pub fn brief(
        &mut self,
        lab: &Lab,
        brief: Option<&str>,
        formula: Option<&str>,
        files: &[String],
    ) {
        let no_svg = |brief| pictures(brief).find(|picture| !picture.ends_with(".svg"));
        let missing =
            |brief| pictures(brief).find(|picture| !files.iter().any(|file| file == picture));
        let problem = match brief.map(|brief| (brief, with_numbers(brief, lab))) {
            None => Some((
                "there is no brief.md".to_owned(),
                "write the brief next to lab.toml: `kinemark new` copies it for students",
            )),
            Some((_, Err(why))) => Some((
                format!("brief.md: {why}"),
                "a mark is `<!-- = expression -->`, right after the number that it computes",
            )),
            Some((_, Ok(_))) if let Some(why) = formula => Some((
                format!("brief.md: {why}"),
                "a formula is LaTeX between `$` and `$`, or `$$` and `$$`; a dollar sign is `\\$`",
            )),
            Some((brief, Ok(_))) if let Some(picture) = no_svg(brief) => Some((
                format!(
                    "brief.md shows the picture `{picture}`, and students get pictures in SVG alone"
                ),
                "save it as SVG beside brief.md",
            )),
            Some((brief, Ok(_))) if let Some(picture) = missing(brief) => Some((
                format!("brief.md shows the picture `{picture}`, and there is no such file"),
                "put the picture beside brief.md, or write its name as the file has it",
            )),
            Some((brief, Ok(_))) if !has_place_for_grading(brief) => Some((
                format!(
                    "brief.md has no place for the table of points: `{BEGIN}` with `{END}` after it"
                ),
                "write the two marks, each on a line, where the table should be",
            )),
            Some((_, Ok(_))) => None,
        };
        self.add((Tried::Brief, ""), None, None, problem);
    }

    /// Tries the starter: it must run, earn almost nothing, and be diagnosed with no mistake.
    pub fn starter(&mut self, lab: &Lab, staff: &Staff, starter: &Source) -> Option<Grade> {
        self.take(Form::new(lab, staff).starter(starter))
    }

    /// Looks into the starter of a compiled language, which is not built here: it should define what the tasks call. `defines` says
    /// whether it defines a function of this name.
    pub fn compiled_starter(&mut self, lab: &Lab, file: &str, defines: &dyn Fn(&str) -> bool) {
        let missing = lab.tasks.iter().find_map(|task| {
            let function = match &task.work {
                TaskWork::Function(function, _) => function.name(),
                TaskWork::Motion(..) => "control",
            };
            (!defines(function)).then_some((function, &task.name))
        });
        let problem = missing.map(|(function, task)| {
            let what = format!("{file} does not define `{function}`, which task `{task}` calls");
            let help = "write every function that the tasks call, as the starter in Rhai does; or remove the file: students then get \
                        one with these functions";
            (what, help)
        });
        self.add((Tried::Starter, file), None, None, problem);
    }

    /// Tries the reference solution in the form `form` of the lab.
    pub fn reference(&mut self, lab: &Lab, staff: &Staff, form: &str) -> Option<Grade> {
        self.take(Form::new(lab, staff).reference(form))
    }

    /// Tries every mutant in each of its tasks: it must lose points, show in enough cases, and be named.
    pub fn mutants(&mut self, lab: &Lab, staff: &Staff) {
        self.count_mutants(staff);
        let form = Form::new(lab, staff);
        for index in 0..staff.mutants.len() {
            self.take(form.mutant(index));
        }
    }

    /// Whether there are enough mutants.
    pub fn count_mutants(&mut self, staff: &Staff) {
        let count = staff.mutants.len();
        let few = (count < LEAST_MUTANTS).then(|| {
            let what = format!("{count} mutants, and a lab needs at least {LEAST_MUTANTS}");
            (what, "add what students really do wrong to mutants.toml")
        });
        self.add((Tried::Mutants, ""), None, None, few);
    }

    /// Adds what was found; its grade, if it came to one.
    pub fn take(&mut self, found: Found) -> Option<Grade> {
        self.rows.extend(found.rows);
        found.grade
    }
}

/// Whether a lab has tasks whose hidden cases depend on the salt.
pub fn depends_on_salt(lab: &Lab, staff: &Staff) -> bool {
    let is_function = |work: &TaskWork| matches!(work, TaskWork::Function(..));
    let has_hidden = |task: &Task| is_function(&task.work) || !staff.runs(&task.name).is_empty();
    lab.tasks.iter().any(has_hidden)
}
