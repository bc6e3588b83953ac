//! Why a mutant is not named in one of its tasks: the rule of the diagnosis that failed, with its numbers.

use kinemark_sim::text::number::metres;

use super::mutants::OfMutant;
use super::typed;
use crate::judge::diagnose::{Agreement, AtGoal, NotNamed, Ruling};
use crate::lab::TaskWork;
use crate::record::grade::Outcome;
use crate::record::quantity::{with_unit, with_unit_unlike};
use crate::record::verdict::Verdict;
use crate::task::joint_units::JointUnits;

/// The reason and what to do about it; `None` where it is compared, and nothing speaks against it but another mutant that does the same in
/// more places.
pub(super) fn why_unnamed(of: &OfMutant<'_>) -> Option<(String, String)> {
    let Some(rulings) = of.rulings else {
        return Some(not_compared(of));
    };
    let own = rulings.iter();
    let mut own = own.filter(|ruling| ruling.mistake == of.mutant.name);
    let Some(own) = own.next() else {
        return Some(left_out(of));
    };
    match &own.found {
        Err(why) => Some(in_words(of, why)),
        Ok(agreement) => same_as_others(of, rulings, *agreement),
    }
}

/// The others that fit as well.
fn same_as_others(
    of: &OfMutant<'_>,
    rulings: &[Ruling],
    own: Agreement,
) -> Option<(String, String)> {
    let is_run = is_whole_run(of);
    let others = rulings.iter().filter_map(|ruling| {
        let found = *ruling.found.as_ref().ok()?;
        let fits = is_run || (found.telling >= own.telling && found.agreeing == found.telling);
        (ruling.mistake != of.mutant.name && fits).then_some((ruling, found))
    });
    let (other, found) = others.min_by_key(|(_, found)| std::cmp::Reverse(found.telling))?;
    let places = places(of);
    let what = if is_run {
        format!(
            "does the same as mutant `{}`: of {} {places} at which that differs from the solution, it is nearer to that mutant in {}",
            other.mistake, found.telling, found.agreeing
        )
    } else if found.telling > own.telling {
        format!(
            "does the same as mutant `{}` in all {} {places} in which that shows, and shows itself in {}",
            other.mistake, found.telling, own.telling
        )
    } else {
        format!(
            "does the same as mutant `{}` in all {} {places}",
            other.mistake, found.telling
        )
    };
    let help = format!(
        "two mistakes with the same results are one: leave one out, or add a case in which `{}` and `{}` differ",
        of.mutant.name, other.mistake
    );
    Some((what, help))
}

/// Why nothing was compared.
fn not_compared(of: &OfMutant<'_>) -> (String, String) {
    let task = of.task;
    let lost_in_hidden = task.hidden.iter().find(|class| class.good < class.total);
    let is_run = task.cases.is_empty();
    if let (true, Some(class)) = (is_run, lost_in_hidden) {
        let what = format!(
            "its visible run loses nothing: it shows in {} of {} hidden runs of the class \"{}\" only, which a diagnosis never looks at",
            class.total - class.good,
            class.total,
            class.class
        );
        let help = "change the numbers of the visible run, so that it shows there".to_owned();
        return (what, help);
    }
    if task.verdict == Verdict::InvalidOutput && is_run {
        let stopped = task.stopped.as_ref();
        let message = stopped.map_or_else(String::new, |stopped| format!(": {}", stopped.message));
        let what = format!("its run does not come to its end{message}");
        return (what, "a mutant runs to its end, and is wrong".to_owned());
    }
    let what = match of.staff.solution.text().is_empty() {
        true => "there is no reference solution to compare with".to_owned(),
        false => {
            "nothing is compared, because the solution or the run itself does not come to its end"
                .to_owned()
        }
    };
    (what, "mend the solution, or the mutant".to_owned())
}

/// Why it is not among those that are compared.
fn left_out(of: &OfMutant<'_>) -> (String, String) {
    let passed = of.grade.tasks.iter().find(|task| {
        let work = of.lab.tasks.iter().find(|known| known.name == task.name);
        let is_function = work.is_some_and(|task| matches!(task.work, TaskWork::Function(..)));
        is_function && task.verdict == Verdict::Passed
    });
    match passed {
        Some(passed) => (
            format!(
                "it has full marks in task `{}`, where it should show, too: so it is not looked for in a later task",
                passed.name
            ),
            format!(
                "leave task `{}` out of it, or let it be wrong there",
                passed.name
            ),
        ),
        None => (
            "it is not compared in this task".to_owned(),
            "see docs/lab-format.md, how diagnoses are decided".to_owned(),
        ),
    }
}

/// A rule that failed.
fn in_words(of: &OfMutant<'_>, why: &NotNamed) -> (String, String) {
    let joints = JointUnits::of_all(&of.lab.robot).position();
    let more = "make the mistake greater, or add cases in which it shows";
    match why {
        NotNamed::FewAnswers {
            telling,
            cases,
            needed,
            nearest,
        } => {
            let nearest = nearest.as_ref().map_or_else(String::new, |miss| {
                format!(
                    "; in case \"{}\" it is off by {}, where {} would count",
                    miss.case,
                    exactly(miss.error, miss.unit),
                    exactly(miss.needed, miss.unit)
                )
            });
            (
                format!(
                    "its answer earns nothing in {telling} of {cases} cases, hidden ones among them, and {needed} are needed{nearest}"
                ),
                of_few_answers(of, more),
            )
        }
        NotNamed::NoGoal(goals) => {
            let goals = goals.iter().enumerate();
            let goals: Vec<String> = goals.map(|(i, goal)| at_goal(i + 1, goal)).collect();
            (
                goals.join("; "),
                "move the start or the goal, so that the arm stands still where the mistake puts it; or write `named = false`: of a mistake on the way the points alone can tell"
                    .to_owned(),
            )
        }
        NotNamed::NoRest => (
            "its run is too short for a stay at each goal".to_owned(),
            "lengthen the run, or shorten dwell_s".to_owned(),
        ),
        NotNamed::NearReference { mean, needed } => (
            format!(
                "its joints differ from those of the solution by {}, where {} would count (root mean square over the run, at the best shift of up to 0.1 s)",
                exactly(*mean, joints),
                exactly(*needed, joints)
            ),
            lost_by(of, more),
        ),
        NotNamed::Still => (
            "its arm does not move, or it commands nothing: so do many mistakes".to_owned(),
            "let it move".to_owned(),
        ),
        NotNamed::EndsOtherwise => (
            "its run does not come to its end".to_owned(),
            "a mutant runs to its end, and is wrong".to_owned(),
        ),
        NotNamed::WrongElsewhere => (
            "it is wrong in a case in which it should be right".to_owned(),
            more.to_owned(),
        ),
        NotNamed::Far {
            mean_and_most: Some([mean, most]),
        } => (
            format!(
                "run again it is {} from itself, and {} is the most: it does not always do the same",
                exactly(*mean, joints),
                exactly(*most, joints)
            ),
            "let it do the same in the same run".to_owned(),
        ),
        NotNamed::Far {
            mean_and_most: None,
        }
        | NotNamed::NoRun => (
            "it does not start".to_owned(),
            "a mutant runs to its end, and is wrong".to_owned(),
        ),
    }
}

/// A value that may be far below everything that counts.
fn exactly(value: f64, unit: &str) -> String {
    match value {
        small if small != 0.0 && small < 1e-4 && !unit.is_empty() => format!("{small:.1e} {unit}"),
        small if small != 0.0 && small < 1e-6 => format!("{:.1e} %", 100.0 * small),
        value => with_unit(value, unit),
    }
}

/// What to do about a run that loses points although it hardly differs: the check in which it loses.
fn lost_by(of: &OfMutant<'_>, more: &str) -> String {
    let checks = of.task.checks.iter();
    let mut lost = checks.filter(|check| matches!(check.outcome, Outcome::Partial | Outcome::None));
    match lost.next() {
        Some(check) => format!("{more}; it loses in \"{}\"", check.title),
        None => more.to_owned(),
    }
}

fn at_goal(number: usize, goal: &AtGoal) -> String {
    match goal {
        AtGoal::Start {
            from_start_m,
            still_m,
        } => format!(
            "goal {number}: its nearest stay is the start ({} from it, and less than {} counts as the start), so it says nothing",
            metres(*from_start_m),
            metres(*still_m)
        ),
        AtGoal::There {
            off_m,
            full_m,
            turned_rad,
        } => {
            let turned = turned_rad.map_or(String::new(), |[turned, counts]| {
                let turned = with_unit_unlike(turned, counts, "rad");
                format!("; it is turned by {turned} away, and {counts} rad would count")
            });
            format!(
                "goal {number}: it stands {} from it, and more than {} would count{turned}",
                metres(*off_m),
                metres(*full_m)
            )
        }
    }
}

/// What to do about a mutant with too few telling answers; `more` where nothing is special about it.
fn of_few_answers(of: &OfMutant<'_>, more: &str) -> String {
    if loses_branches(of) {
        "a branch that is missing is never compared, since many answers miss one: write `named = false`".to_owned()
    } else {
        more.to_owned()
    }
}

/// Whether a mutant loses in nothing but the number of its branches.
fn loses_branches(of: &OfMutant<'_>) -> bool {
    let table = typed::table(of.lab).unwrap_or_default();
    let typed = typed::named(&table, "tasks", &of.task.name);
    let is_of_branches = |check: &str| {
        let typed = typed.and_then(|typed| typed::named(typed, "checks", check));
        let kind = typed.and_then(typed::kind);
        kind.is_some_and(|(kind, _)| kind == "ik-branches")
    };
    let checks = of.task.checks.iter();
    let lost = |outcome| matches!(outcome, Outcome::Partial | Outcome::None);
    let mut lost = checks.filter(|check| lost(check.outcome)).peekable();
    lost.peek().is_some() && lost.all(|check| is_of_branches(&check.name))
}

fn is_whole_run(of: &OfMutant<'_>) -> bool {
    let mut tasks = of.lab.tasks.iter();
    let task = tasks.find(|task| task.name == of.task.name);
    task.is_some_and(
        |task| matches!(&task.work, TaskWork::Motion(motion, _) if motion.goals.is_empty()),
    )
}

/// What is counted in a task.
fn places(of: &OfMutant<'_>) -> &'static str {
    if is_whole_run(of) {
        "control ticks"
    } else if of.task.cases.is_empty() {
        "goals"
    } else {
        "cases"
    }
}
