//! Moments of a run: the part of an address after the page, by which a report's replay goes there, and where points were lost first.

use kinemark_sim::text::number::trimmed;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::stop_words::stop_of_whole_file;
use super::visible::visible;
use kinemark_grader::record::grade::{
    CheckGrade, Grade, Instant, Outcome, Stopped, TaskGrade, repair_first,
};

/// What does not stand for itself in a part of an address (RFC 3986, section 2.3).
pub const ADDRESS_PART: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'_')
    .remove(b'.')
    .remove(b'~');

/// The fragment of a task, such as `#task=move`, which leads to its section; characters that steer an address are written as `%XX`.
pub fn of_task(task: &str) -> String {
    let task = visible(task);
    format!("#task={}", utf8_percent_encode(&task, ADDRESS_PART))
}

/// The fragment of a moment of a task, such as `#task=move&t=2.35`.
pub fn fragment(task: &str, time_s: f64) -> String {
    // a step shorter than a tenth of a millisecond is no lab's
    format!("{}&t={}", of_task(task), trimmed(time_s.max(0.0), 4))
}

/// The last moment of a run that was stopped: the tick before the call that failed, whose own tick was never run. None where there is
/// no such tick.
pub fn last_before(stopped: &Stopped) -> Option<Instant> {
    let (tick, time_s) = (stopped.tick?, stopped.time_s?);
    let before = tick.checked_sub(1)?;
    Some(Instant {
        tick: before,
        time_s: time_s * (before as f64 / tick as f64),
    })
}

/// Where a task lost its first points.
#[derive(Debug, Clone, Copy)]
pub struct FirstLoss<'a> {
    /// The task.
    pub task: &'a TaskGrade,
    /// The check that lost them; none where the submission was stopped.
    pub check: Option<&'a CheckGrade>,
    /// The moment of its run; none where no moment is given, as in a function task.
    pub at: Option<Instant>,
}

impl FirstLoss<'_> {
    /// Where a report shows it: the moment, else the section of the task.
    pub fn fragment(&self) -> String {
        let name = &self.task.name;
        self.at
            .map_or_else(|| of_task(name), |at| fragment(name, at.time_s))
    }
}

/// Where the task that lost the most points lost the first of them; of tasks that lost as much the first in the lab's order.
fn first_loss(grade: &Grade) -> Option<FirstLoss<'_>> {
    let lost = |loss: &FirstLoss<'_>| loss.task.max_points - loss.task.points;
    let losses = grade.tasks.iter().filter_map(first_loss_of);
    let most = losses.reduce(|a, b| if lost(&b) > lost(&a) { b } else { a })?;
    // the function from which it makes its motion
    let mut before = grade.tasks.iter().filter(|task| {
        let wanted = repair_first(&task.name);
        let mut checks = most.task.checks.iter();
        checks.any(|check| check.next_step.as_deref() == Some(&wanted))
    });
    Some(before.find_map(first_loss_of).unwrap_or(most))
}

/// Where to look first: in the task that lost the most points, of equal ones the first, or in the earlier one that this one says to repair first; there, what stopped it, else the cause that its whole run or all
/// its answers show, else where it lost the first of them.
pub fn look_first(grade: &Grade) -> Option<FirstLoss<'_>> {
    let first = first_loss(grade)?;
    let cause = cause_of(first.task).filter(|_| first.task.stopped.is_none());
    Some(cause.unwrap_or(first))
}

/// The end of the address of a page that leads to where to look first; none where the whole file could not be run, which the page says at its top.
pub fn place_to_look(grade: &Grade) -> Option<String> {
    let loss = look_first(grade).filter(|_| stop_of_whole_file(grade).is_none());
    Some(loss?.fragment())
}

/// Where a task lost its first points: what stopped it, whatever its run lost besides; else the earliest moment given for all its checks
/// that lost some, of equal ones the costliest. Where no moment is given, the first check that lost points.
pub fn first_loss_of(task: &TaskGrade) -> Option<FirstLoss<'_>> {
    if let Some(stopped) = &task.stopped {
        return Some(FirstLoss {
            task,
            check: None,
            at: last_before(stopped),
        });
    }
    let lost = task.checks.iter().filter(|check| has_lost(check));
    let all: Vec<FirstLoss<'_>> = lost
        .map(|check| FirstLoss {
            task,
            check: Some(check),
            at: check.first_lost,
        })
        .collect();
    let cost = |loss: &FirstLoss<'_>| loss.check.map_or(f64::INFINITY, lost_points);
    let timed = all.iter().filter_map(|loss| Some((loss.at?.tick, loss)));
    let earliest = timed
        .min_by(|(a, of_a), (b, of_b)| a.cmp(b).then_with(|| cost(of_b).total_cmp(&cost(of_a))));
    match earliest {
        Some((_, loss)) => Some(*loss),
        // no moment is given, as in a function task: what cost the most, of equal ones the first
        None => all
            .into_iter()
            .reduce(|a, b| if cost(&b) > cost(&a) { b } else { a }),
    }
}

/// The cause that the run of a task, or all its answers together, show, if they show one.
fn cause_of(task: &TaskGrade) -> Option<FirstLoss<'_>> {
    let mut lost = task.checks.iter().filter(|check| has_lost(check));
    lost.find_map(|check| {
        let cause = check.evidence.first().filter(|fact| fact.is_cause)?;
        let at = cause.tick.zip(cause.time_s);
        Some(FirstLoss {
            task,
            check: Some(check),
            at: at.map(|(tick, time_s)| Instant { tick, time_s }),
        })
    })
}

/// Whether a check was judged and lost points.
pub fn has_lost(check: &CheckGrade) -> bool {
    matches!(check.outcome, Outcome::Partial | Outcome::None)
}

/// The points a check lost.
pub fn lost_points(check: &CheckGrade) -> f64 {
    (check.max_points - check.points).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::Evidence;
    use kinemark_grader::record::sample;
    use kinemark_grader::record::verdict::Verdict;

    #[test]
    fn a_cause_is_looked_at_before_the_earliest_moment() {
        let mut grade = sample::graded().grade;
        // the motion task, some of whose checks lost points
        grade.tasks.drain(..3);
        let first = |grade: &Grade| {
            let loss = look_first(grade).expect("a loss");
            (
                loss.task.name.clone(),
                loss.check.map(|check| check.name.clone()),
            )
        };
        let before = first(&grade);
        assert_eq!(before.0, first_loss(&grade).expect("a loss").task.name);
        let mut tasks = grade.tasks.iter_mut();
        let task = tasks.find(|task| task.name == before.0).expect("the task");
        task.stopped = None;
        let lost = task.checks.iter_mut().filter(|check| has_lost(check));
        let last = lost.last().expect("a lost check");
        let name = last.name.clone();
        let cause = Evidence {
            is_cause: true,
            tick: Some(7000),
            time_s: Some(7.0),
            ..Evidence::default()
        };
        last.evidence.insert(0, cause);
        assert_eq!(first(&grade), (before.0.clone(), Some(name)));
        let fragment = look_first(&grade).map(|loss| loss.fragment());
        assert_eq!(fragment, Some(format!("#task={}&t=7", before.0)));
    }

    #[test]
    fn the_task_that_lost_most_is_looked_at_first() {
        let mut grade = sample::graded().grade;
        for task in &mut grade.tasks {
            task.max_points = 6.0;
            task.points = 4.0;
        }
        let lost = |grade: &Grade| first_loss(grade).expect("a loss").task.name.clone();
        let losing: Vec<usize> = (0..grade.tasks.len())
            .filter(|i| first_loss_of(&grade.tasks[*i]).is_some())
            .collect();
        let &[first, .., last] = &losing[..] else {
            panic!("{losing:?}");
        };
        // of equal losses the first
        assert_eq!(lost(&grade), grade.tasks[first].name);
        grade.tasks[last].points = 3.9;
        assert_eq!(lost(&grade), grade.tasks[last].name);
        // but for the function from which it makes its motion
        let name = grade.tasks[first].name.clone();
        let mut checks = grade.tasks[last].checks.iter_mut();
        let check = checks.find(|check| has_lost(check)).expect("a lost check");
        check.next_step = Some(repair_first(&name));
        assert_eq!(lost(&grade), name);
    }

    #[test]
    fn a_file_that_does_not_build_has_no_place_of_its_own_to_look() {
        let mut grade = sample::graded().grade;
        assert!(place_to_look(&grade).is_some());
        for task in &mut grade.tasks {
            task.verdict = Verdict::DidNotBuild;
            task.stopped = Some(Stopped {
                message: "a `)` is missing".to_owned(),
                ..Stopped::default()
            });
        }
        assert_eq!(place_to_look(&grade), None);
        // in one task alone it is a function of it
        grade.tasks[0].stopped = None;
        assert!(place_to_look(&grade).is_some());
    }

    #[test]
    fn a_moment_is_a_fragment_of_an_address() {
        assert_eq!(fragment("move", 2.35), "#task=move&t=2.35");
        assert_eq!(fragment("move", 0.0), "#task=move&t=0");
        assert_eq!(
            fragment("a b&t=9#<\">", 1.0004),
            "#task=a%20b%26t%3D9%23%3C%22%3E&t=1.0004"
        );
        assert_eq!(
            fragment("größe\u{202E}", 1.0),
            "#task=gr%C3%B6%C3%9Fe%E2%9F%A8U%2B202E%E2%9F%A9&t=1"
        );
    }

    fn motion() -> TaskGrade {
        let mut graded = sample::graded();
        graded.grade.tasks.remove(3)
    }

    fn at(tick: u64) -> Option<Instant> {
        Some(Instant {
            tick,
            time_s: tick as f64 / 1000.0,
        })
    }

    fn stop(tick: Option<u64>) -> Stopped {
        let mut graded = sample::graded();
        let stopped = graded
            .grade
            .tasks
            .iter_mut()
            .find_map(|task| task.stopped.take());
        Stopped {
            tick,
            time_s: tick.map(|tick| tick as f64 / 1000.0),
            ..stopped.expect("a task that was stopped")
        }
    }

    #[test]
    fn the_first_loss_is_the_stop_or_the_earliest_of_all_checks_that_lost() {
        let mut task = motion();
        let first = |task: &TaskGrade| {
            let loss = first_loss_of(task).expect("a loss");
            (loss.fragment(), loss.check.map(|check| check.name.clone()))
        };
        // the saturation comes before the match in the lab, and came later in the run
        let expected = (
            "#task=move&t=0.62".to_owned(),
            Some("trajectory-match".to_owned()),
        );
        assert_eq!(first(&task), expected);
        // of one moment the costlier check
        task.checks[2].first_lost = at(620);
        assert_eq!(first(&task), expected);
        // a full check loses nothing, whatever is said about it
        task.checks[0].first_lost = at(1);
        assert_eq!(first(&task), expected);
        // the run ends with the tick before the call that failed
        task.stopped = Some(stop(Some(501)));
        assert_eq!(first(&task), ("#task=move&t=0.5".to_owned(), None));
        // what stopped it comes before what its run lost, whenever that was
        task.stopped = Some(stop(Some(3000)));
        assert_eq!(first(&task), ("#task=move&t=2.999".to_owned(), None));
    }

    #[test]
    fn a_loss_without_a_moment_leads_to_its_task() {
        let mut task = motion();
        for check in &mut task.checks {
            check.first_lost = None;
        }
        let loss = first_loss_of(&task).expect("a loss");
        assert_eq!(loss.fragment(), "#task=move");
        assert_eq!(
            loss.check.map(|check| check.name.as_str()),
            // the costliest
            Some("trajectory-match")
        );
        // nothing was run before the first call
        for tick in [None, Some(0)] {
            task.stopped = Some(stop(tick));
            assert_eq!(
                first_loss_of(&task).expect("a loss").fragment(),
                "#task=move"
            );
        }
        for check in &mut task.checks {
            check.outcome = Outcome::Full;
        }
        task.stopped = None;
        assert!(first_loss_of(&task).is_none());
    }
}
