//! The part of a graded record that anybody can see, compared with the same submission graded again in practice: what no hidden case, no
//! hidden run and no reference solution takes part in. That needs no file of the course staff.

use serde_json::{Map, Value, json};

use super::difference::first_difference;
use super::grade::{CheckGrade, Grade, HiddenClass, Measure, Outcome, TaskGrade, TaskKind};
use super::quantity::{OF_VISIBLE_CASES, points};
use super::sums::Contradiction;

/// The places at which `recorded`, a graded record, cannot be of the submission that was graded again in practice, `now`.
pub fn contradictions(recorded: &Grade, now: &Grade) -> Vec<Contradiction> {
    let names = |grade: &Grade| -> Vec<String> {
        let tasks = grade.tasks.iter();
        tasks.map(|task| task.name.clone()).collect()
    };
    let mut found = Vec::new();
    let tasks = [names(recorded), names(now)].map(Value::from);
    found.extend(first_difference("tasks", &tasks[0], &tasks[1]));
    if !found.is_empty() {
        return found;
    }
    for (i, tasks) in recorded.tasks.iter().zip(&now.tasks).enumerate() {
        let place = format!("tasks[{i}]");
        let task = TwiceGraded::new(tasks.0, tasks.1);
        let [recorded, now] = [tasks.0, tasks.1].map(|side| task.visible_part(side));
        match first_difference(&place, &recorded, &now) {
            Some(difference) => found.push(difference),
            None => found.extend(task.beyond_what_is_visible(&place)),
        }
    }
    found
}

/// A task as it was recorded, and in practice.
struct TwiceGraded<'g> {
    recorded: &'g TaskGrade,
    now: &'g TaskGrade,
    /// Whether hidden cases or runs took part.
    has_hidden: bool,
    /// Checks whose measure is the same in practice, by index.
    comparable: Vec<bool>,
}

impl<'g> TwiceGraded<'g> {
    fn new(recorded: &'g TaskGrade, now: &'g TaskGrade) -> Self {
        let pairs = || recorded.checks.iter().zip(&now.checks);
        // without a value of the reference, where dwells are is unknown, too, and with it what other checks measure
        let lacks_value = pairs().any(|(recorded, now)| reference(recorded) != reference(now));
        let lacks_run = pairs().any(|(recorded, now)| [recorded, now].into_iter().any(at_hand_in));
        let is_sweep = |check: &CheckGrade| {
            let levels = &recorded.digests.rungs;
            levels.iter().any(|level| level.check == check.name)
        };
        let is_judged = |check: &CheckGrade| check.outcome != Outcome::NotJudged;
        let is_comparable = |(recorded, now): (&CheckGrade, &CheckGrade)| {
            let is_settled = !at_hand_in(recorded) && !at_hand_in(now);
            let depends = is_sweep(recorded) || !is_judged(recorded) || !is_judged(now);
            is_settled && !lacks_value && !(lacks_run && depends)
        };
        Self {
            recorded,
            now,
            has_hidden: !recorded.hidden.is_empty(),
            comparable: match recorded.verdict.is_decided() {
                true => pairs().map(is_comparable).collect(),
                false => vec![false; recorded.checks.len()],
            },
        }
    }

    /// Whether every check is judged in practice as it is with the reference solution.
    fn is_all_comparable(&self) -> bool {
        self.comparable.iter().all(|is_comparable| *is_comparable)
    }

    /// What is visible of one of the two sides, in the shape of the record.
    fn visible_part(&self, side: &TaskGrade) -> Value {
        let is_run = side.kind == TaskKind::Motion;
        let checks = side.checks.iter().enumerate();
        let checks = checks.map(|(i, check)| {
            let is_comparable = self.comparable.get(i).copied().unwrap_or(false);
            self.visible_check(check, is_comparable, is_run)
        });
        let mut digests = Map::new();
        digests.insert("seconds".to_owned(), json!(side.digests.seconds));
        if self.is_all_comparable() {
            digests.insert("rungs".to_owned(), json!(side.digests.rungs));
        }
        if !self.has_hidden {
            digests.insert("all".to_owned(), json!(side.digests.all));
        }
        let mut part = json!({
            "title": side.title,
            "kind": side.kind,
            "checks": checks.collect::<Vec<_>>(),
            "cases": side.cases,
            "events": side.events,
            "contacts": side.contacts,
            "operations": side.operations,
            "log": side.log,
            "digests": digests,
        });
        // a hidden case or run may stop where the visible ones do not
        if is_run && self.is_all_comparable() && self.now.stopped.is_some() {
            part["stopped"] = json!(side.stopped);
        }
        // figures are those of a run with full points
        if self.recorded.figures.is_some() && self.now.figures.is_some() {
            part["figures"] = json!(side.figures);
        }
        part
    }

    fn visible_check(&self, check: &CheckGrade, is_comparable: bool, is_run: bool) -> Value {
        let mut part = json!({
            "name": check.name,
            "title": check.title,
            "max_points": check.max_points,
        });
        if !is_comparable {
            return part;
        }
        let measure = check.measure.clone();
        let is_of_cases = self.has_hidden && !is_run;
        part["measure"] = json!(measure.map(|measure| match is_of_cases {
            true => of_visible_cases(measure),
            false => measure,
        }));
        if is_run {
            part["first_lost"] = json!(check.first_lost);
        }
        if !self.has_hidden {
            part["points"] = json!(check.points);
            part["outcome"] = json!(check.outcome);
        }
        part
    }

    /// Points and verdicts that no result of hidden cases and runs leads to, while what is visible is the same.
    fn beyond_what_is_visible(&self, place: &str) -> Vec<Contradiction> {
        let mut found = Vec::new();
        let pairs = self.recorded.checks.iter().zip(&self.now.checks);
        for (i, (recorded, now)) in pairs.enumerate() {
            let is_mean = self.has_hidden && self.recorded.kind == TaskKind::Motion;
            if !is_mean || !self.comparable[i] {
                continue;
            }
            let [least, most] = self.mean_of_runs(now);
            let is_possible = least - 1e-6 <= recorded.points && recorded.points <= most + 1e-6;
            if !is_possible {
                let runs = self.hidden_runs(|class| class.total);
                found.push(Contradiction {
                    place: format!("{place}.checks[{i}].points"),
                    recorded: points(recorded.points),
                    follows: format!(
                        "{} to {}, with {} in the visible run and {runs} hidden ones",
                        points(least.max(0.0)),
                        points(most),
                        points(now.points)
                    ),
                });
            }
        }
        let (recorded, now) = (self.recorded.verdict, self.now.verdict);
        if self.is_all_comparable() && now.is_decided() && recorded > now {
            found.push(Contradiction {
                place: format!("{place}.verdict"),
                recorded: recorded.name().to_owned(),
                follows: format!("{} or worse", now.name()),
            });
        }
        found
    }

    /// Hidden runs, counted.
    fn hidden_runs(&self, count: impl Fn(&HiddenClass) -> u32) -> f64 {
        let classes = self.recorded.hidden.iter();
        classes.map(|class| f64::from(count(class))).sum()
    }

    /// The least and the most that the mean over the visible run, which earned what `now` has, and the hidden ones can be.
    fn mean_of_runs(&self, now: &CheckGrade) -> [f64; 2] {
        let total = self.hidden_runs(|class| class.total);
        // in a good run every check is full
        let good = self.hidden_runs(|class| class.good);
        let of = now.max_points;
        let mean = |visible: f64, full: f64| (visible + full * of) / (total + 1.0);
        // points are cut to hundredths, those of the visible run and those of the mean
        let cut = 0.01;
        [
            mean(now.points, good) - cut,
            mean((now.points + cut).min(of), total).min(of),
        ]
    }
}

/// What was measured, in the words and with the value of practice. Where a check judges hidden cases alone, there is no value to show, and
/// in practice it is none of no case.
fn of_visible_cases(mut measure: Measure) -> Measure {
    if let Some(words) = measure.quantity.strip_suffix(OF_VISIBLE_CASES) {
        measure.quantity = words.to_owned();
    }
    measure.value = measure.value.or(Some(0.0));
    measure
}

/// The value of the reference solution on which the band of a check depends.
fn reference(check: &CheckGrade) -> Option<u64> {
    let measure = check.measure.as_ref()?;
    measure.reference.map(f64::to_bits)
}

fn at_hand_in(check: &CheckGrade) -> bool {
    check.outcome == Outcome::AtHandIn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::grade::GradeMode;
    use crate::record::sample;
    use crate::record::verdict::Verdict;

    /// A record with three hidden runs in its last task, and the practice record of the same submission.
    fn twice_graded() -> [Grade; 2] {
        let mut now = sample::graded().grade;
        // hidden cases are those of a graded record
        now.tasks.iter_mut().for_each(|task| task.hidden.clear());
        let mut recorded = now.clone();
        recorded.mode = GradeMode::Graded;
        let task = recorded.tasks.last_mut().unwrap();
        task.hidden = vec![HiddenClass {
            class: "elsewhere".to_owned(),
            good: 0,
            total: 3,
            under_resolved: 0,
        }];
        task.digests.all = "keyed".to_owned();
        [recorded, now]
    }

    #[test]
    fn points_are_a_mean_that_hidden_runs_can_give() {
        let [mut recorded, now] = twice_graded();
        assert_eq!(contradictions(&recorded, &now), []);
        let (visible, max) = {
            let check = &now.tasks[3].checks[2];
            (check.points, check.max_points)
        };
        assert!(0.0 < visible && visible < max);
        // none that earns anything, or three good ones, beside the visible one
        let [least, most] = [0.0, 3.0].map(|good| (visible + good * max) / 4.0);
        for (points, is_possible) in [
            (least, true),
            (most, true),
            (least - 0.02, false),
            (most + 0.02, false),
            (max, false),
            (-1.0, false),
        ] {
            recorded.tasks[3].checks[2].points = points;
            let found = contradictions(&recorded, &now);
            let places: Vec<&str> = found.iter().map(|it| it.place.as_str()).collect();
            let expected: &[&str] = match is_possible {
                true => &[],
                false => &["tasks[3].checks[2].points"],
            };
            assert_eq!(places, expected, "{points}");
        }
    }

    #[test]
    fn what_is_visible_is_the_same_and_what_is_hidden_may_differ() {
        type Change = fn(&mut Grade);
        let changes: [(Change, &str); 9] = [
            (|grade| grade.tasks[3].digests.all = "x".to_owned(), ""),
            (|grade| grade.tasks[3].checks[2].evidence.clear(), ""),
            (
                |grade| grade.tasks[0].digests.all = "x".to_owned(),
                "tasks[0].digests.all",
            ),
            (
                |grade| grade.tasks[0].checks[0].points = 0.9,
                "tasks[0].checks[0].points",
            ),
            (
                |grade| grade.tasks[3].checks[0].max_points = 9.0,
                "tasks[3].checks[0].max_points",
            ),
            (
                |grade| grade.tasks[3].operations += 1,
                "tasks[3].operations",
            ),
            (
                |grade| grade.tasks[3].digests.seconds[1].q = "x".to_owned(),
                "tasks[3].digests.seconds[1].q",
            ),
            (
                |grade| grade.tasks[3].verdict = Verdict::Passed,
                "tasks[3].verdict",
            ),
            (|grade| grade.tasks.truncate(2), "tasks"),
        ];
        for (change, place) in changes {
            let [mut recorded, now] = twice_graded();
            change(&mut recorded);
            let found = contradictions(&recorded, &now);
            let first = found.first().map_or("", |it| it.place.as_str());
            assert_eq!(first, place);
        }
    }

    /// The points of a function's check are those of hidden cases, too, and its value is that of the visible ones.
    #[test]
    fn the_value_of_a_functions_check_is_that_of_practice() {
        let [mut recorded, now] = twice_graded();
        let fk = recorded.tasks.iter().position(|task| task.name == "fk");
        let fk = fk.unwrap();
        let task = &mut recorded.tasks[fk];
        task.digests.all = "keyed".to_owned();
        task.hidden = vec![HiddenClass {
            class: "folded".to_owned(),
            good: 1,
            total: 2,
            under_resolved: 0,
        }];
        task.checks[0].points = 0.5;
        let measure = task.checks[0].measure.as_mut().unwrap();
        measure.quantity += OF_VISIBLE_CASES;
        assert_eq!(contradictions(&recorded, &now), []);
        let measure = recorded.tasks[fk].checks[0].measure.as_mut().unwrap();
        measure.value = Some(0.0);
        let found = contradictions(&recorded, &now);
        let place = format!("tasks[{fk}].checks[0].measure.value");
        assert_eq!(found[0].place, place);
    }

    /// In practice the reference solution's values may be others, or unknown.
    #[test]
    fn what_depends_on_the_reference_is_not_compared() {
        let [mut recorded, mut now] = twice_graded();
        let measure = recorded.tasks[0].checks[0].measure.as_mut().unwrap();
        measure.reference = Some(0.2);
        measure.full = 0.3;
        recorded.tasks[0].checks[0].points = 0.5;
        assert_eq!(contradictions(&recorded, &now), []);
        let known = recorded.tasks[0].checks[0].measure.clone();
        now.tasks[0].checks[0].measure = known;
        let found = contradictions(&recorded, &now);
        assert_eq!(found[0].place, "tasks[0].checks[0].points");
        now.tasks[0].checks[0].outcome = Outcome::AtHandIn;
        assert_eq!(contradictions(&recorded, &now), []);
    }
}
