//! What is probably wrong with a rubric, whoever hands in: found without a submission, or in what the course staff's own lose.
//!
//! | file | what it looks for |
//! |---|---|
//! | `band` | bands in which nobody can lose, and margins that are too narrow |
//! | `related_bands` | bands that do not fit to each other |
//! | `reach` | cases, goals and paths that the robot cannot reach, or only where it is singular; branches that are counted wrongly |
//! | `unused` | parameters, variants, paths, sensors and frames that nothing uses |
//! | `weights` | checks that decide alone, and checks that nobody notices |
//! | `goals` | goals that are nearer to each other than their band, stays of a moment, targets that are not the path |
//! | `far_draws` | hidden numbers of another size than the visible ones |
//! | `hidden` | hidden cases and runs that are the visible ones, or leave the limits of joints; a salt that is short or known |
//! | `settings` | a robot without a TCP, gains where they do nothing, a target that differs from the servo |
//! | `variants` | parameters that stand outside of what students draw |
//! | `corners` | ends of what students draw at which the reference solution loses points |
//! | `accuracy` | bands that are thinner than what the simulation is accurate to |
//! | `brief` | what is graded and not mentioned |
//! | `words` | words and numbers of the brief and of checks that differ from what is graded |
//! | `numbers` | numbers with a unit in titles, hints and the brief that nothing has |
//! | `times` | times of runs and calls that the brief says, and lab.toml does not |
//! | `mutant_words` | mutants that say what another does |
//! | `names` | names in texts that nothing has, and what still says TODO |
//! | `twice` | cases, checks, tasks and mutants that are there twice |
//! | `lost` | checks that nobody loses, and checks that are earned for nothing |
//!
//! The course staff may accept a doubt, or a change of the solution that nothing notices ([`super::mutate`]), with a reason: [`Accepted`].

mod accepted;
mod accuracy;
mod band;
mod brief;
mod corners;
mod far_draws;
mod goals;
mod hidden;
mod levels;
mod lost;
mod mutant_words;
mod names;
mod numbers;
mod reach;
mod related_bands;
mod settings;
mod starts;
mod times;
mod titles;
mod twice;
mod unused;
mod variants;
mod weights;
mod words;

use serde::Serialize;

pub use self::accepted::Accepted;
pub(super) use self::accepted::{CHOICE, MUTATION};
use self::lost::Losses;
pub use self::lost::zeros;
use super::mutate::{Mutation, MutationProblem, covers, mutations, no_mutation};
use super::{Audit, Problem, Tried, VariantMargin, Variants};
use crate::judge::MovedBody;
use crate::lab::{Lab, Staff, Task};
use crate::record::grade::{Grade, TaskGrade};

/// What is probably wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Doubt {
    /// The rule that found it.
    pub rule: &'static str,
    /// What it is about: a parameter, or a task with one of its checks or cases, as in `fk/position`.
    pub of: String,
    /// In words, with numbers.
    pub what: String,
    /// What to do.
    pub help: String,
}

/// What the rules look at.
#[derive(Debug)]
pub struct Rubric<'a> {
    /// The lab.
    pub lab: &'a Lab,
    /// The course staff's part of it.
    pub staff: &'a Staff,
    /// The salt of its hidden numbers.
    pub salt: Option<&'a str>,
    /// Salts that others know, each with where it is from.
    pub known_salts: &'a [(String, String)],
    /// The brief.
    pub brief: Option<&'a str>,
    /// The grade of the starter.
    pub starter: Option<&'a Grade>,
    /// The grade of a submission that answers zeros.
    pub zeros: Option<&'a Grade>,
    /// The grade of a submission that plays back what the reference solution commands in visible runs, in the motion tasks.
    pub played_back: Option<&'a Grade>,
    /// The grade of the reference solution.
    pub reference: Option<&'a Grade>,
    /// The grade of the reference solution with half the physics step, in visible cases and runs.
    pub finer: Option<&'a Grade>,
    /// The grades of the mutants, each in its own tasks.
    pub mutants: &'a [Grade],
    /// The bodies of its scenes that move by themselves.
    pub moved_bodies: &'a [MovedBody],
    /// The margins of the reference solution over the variants that were tried.
    pub margins: &'a [VariantMargin],
    /// What the reference solution does at the ends of what students draw.
    pub corners: Option<&'a Variants>,
}

/// A rule: its name, what it makes sure of, and what it finds.
type Rule = (&'static str, &'static str, fn(&Rubric<'_>, &mut Vec<Doubt>));

/// The rule that needs the runs of half the physics step.
const ACCURACY: &str = "accuracy";

/// The rules, in their order.
const RULES: &[Rule] = &[
    (
        "settings",
        "the robot has a TCP, gains do something, bodies stay",
        |rubric, doubts| {
            settings::rule(rubric, doubts);
            settings::bodies(rubric, doubts);
            levels::rule(rubric, doubts);
        },
    ),
    (
        "variants",
        "the lab's own numbers are one student's variant",
        variants::rule,
    ),
    (
        "corners",
        "the reference has full marks at the ends of what students draw",
        corners::rule,
    ),
    (
        "unused",
        "every parameter, path, sensor and frame is used",
        |rubric, doubts| {
            unused::rule(rubric, doubts);
            unused::sensors(rubric, doubts);
            unused::frames(rubric, doubts);
            unused::target_keys(rubric, doubts);
        },
    ),
    (
        "reach",
        "cases, goals and paths can be reached",
        reach::reach,
    ),
    (
        "branches",
        "as many branches as the robot has",
        reach::branches,
    ),
    (
        "cases",
        "no case, check, task or mutant is there twice",
        twice::rule,
    ),
    (
        "goals",
        "goals are apart, and what is to stay stays",
        |rubric, doubts| {
            goals::rule(rubric, doubts);
            starts::rule(rubric, doubts);
        },
    ),
    (
        "hidden",
        "what is hidden differs from what is visible",
        |rubric, doubts| {
            hidden::rule(rubric, doubts);
            far_draws::rule(rubric, doubts);
            far_draws::signs(rubric, doubts);
            hidden::played_back(rubric, doubts);
        },
    ),
    ("salt", "nobody can guess it", hidden::salt),
    ("brief", "mentions what is graded", |rubric, doubts| {
        brief::rule(rubric, doubts);
        brief::gains(rubric, doubts);
    }),
    (
        "words",
        "words and numbers say what is graded",
        |rubric, doubts| {
            words::rule(rubric, doubts);
            titles::rule(rubric, doubts);
            mutant_words::rule(rubric, doubts);
            times::rule(rubric, doubts);
            numbers::rule(rubric, doubts);
        },
    ),
    (
        "names",
        "what is mentioned is there, and nothing says TODO",
        names::rule,
    ),
    (
        "points",
        "no check decides alone, and each is noticed",
        weights::rule,
    ),
    ("band", "points can be lost", |rubric, doubts| {
        band::rule(rubric, doubts);
        band::against_reference(rubric, doubts);
        related_bands::rule(rubric, doubts);
    }),
    (
        "margin",
        "the reference has room in every band",
        |rubric, doubts| {
            band::margins(rubric, doubts);
            band::periods(rubric, doubts);
            band::budgets(rubric, doubts);
        },
    ),
    (
        ACCURACY,
        "half the physics step changes nothing",
        accuracy::rule,
    ),
    (
        "dead",
        "every check is lost by somebody",
        |rubric, doubts| {
            lost::dead(rubric, doubts);
            lost::hardly(rubric, doubts);
        },
    ),
    ("free", "no check is earned for nothing", lost::free),
];

impl Rubric<'_> {
    fn losses(&self) -> Losses<'_> {
        Losses::of(self)
    }

    /// The tasks in which the reference solution was graded.
    fn graded_tasks(&self) -> impl Iterator<Item = (&Task, &TaskGrade)> {
        let of = |grade: &TaskGrade| {
            let mut tasks = self.lab.tasks.iter();
            tasks.find(|task| task.name == grade.name)
        };
        let grades = self.reference.into_iter().flat_map(|grade| &grade.tasks);
        grades.filter_map(move |grade| Some((of(grade)?, grade)))
    }
}

impl Audit {
    /// Looks at the rubric itself: a row for each doubt, and one for each rule that has none. What `accepted` accepts is no problem; what
    /// it accepts and nobody doubts is.
    pub fn rubric(&mut self, rubric: &Rubric<'_>, accepted: &Accepted) {
        let mut used = vec![false; accepted.len()];
        for (name, _, find) in RULES {
            // nobody has tried it
            if *name == ACCURACY && rubric.finer.is_none() {
                let of_rule = accepted.entries().zip(&mut used);
                of_rule
                    .filter(|(entry, _)| entry.rule == ACCURACY)
                    .for_each(|(_, used)| *used = true);
                continue;
            }
            let mut doubts = Vec::new();
            find(rubric, &mut doubts);
            let before = self.rows.len();
            for doubt in doubts {
                if let Some(index) = accepted.position(&doubt) {
                    used[index] = true;
                    continue;
                }
                let what = format!("{}: {}", doubt.of, doubt.what);
                let problem = Problem::from((what, doubt.help));
                self.add((Tried::Rubric, name), None, None, Some(problem));
            }
            if self.rows.len() == before {
                self.add((Tried::Rubric, name), None, None, None::<Problem>);
            }
        }
        self.survivors(rubric, accepted);
        for (entry, used) in accepted.entries().zip(used) {
            if !used && !entry.is_of_mutation() {
                let what = format!(
                    "accepted.toml accepts `{}` of `{}`, and nobody doubts it",
                    entry.rule, entry.of
                );
                let problem = Problem::from((what, "remove the entry"));
                self.add((Tried::Rubric, &entry.rule), None, None, Some(problem));
            }
        }
    }

    /// Looks for accepted survivors that are no changes of the solution any more; whether the others survive shows when they are tried.
    fn survivors(&mut self, rubric: &Rubric<'_>, accepted: &Accepted) {
        let mut accepted = accepted.mutations().peekable();
        if accepted.peek().is_none() {
            return;
        }
        let known = mutations(&rubric.staff.solution);
        let known: Vec<String> = known.iter().map(Mutation::of).collect();
        for of in accepted {
            if !known.iter().any(|known| covers(of, known)) {
                let MutationProblem { what, help, .. } = no_mutation(of);
                let problem = Problem::from((what, help));
                self.add((Tried::Rubric, MUTATION), None, None, Some(problem));
            }
        }
    }

    /// What the rule called `name` makes sure of, in words.
    pub fn rule_in_words(name: &str) -> &'static str {
        let rule = RULES.iter().find(|(known, ..)| *known == name);
        rule.map_or("", |(_, words, _)| words)
    }
}
