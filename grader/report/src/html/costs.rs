//! What the lost points come from, the most costly first: checks that share a cause are one row, with what it would bring to fix it.

use maud::{Markup, html};

use super::foreign;
use super::head::anchor;
use crate::moment::lost_points;
use crate::stop_words::stop_of_whole_file;
use crate::visible::file_stem;
use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome, TaskGrade};
use kinemark_grader::record::quantity::points;

/// Rows that are shown.
const MOST_ROWS: usize = 6;
/// Less than this is rounding \[points\].
const LEAST: f64 = 0.005;

/// The anchor of a check in the section `task_id`.
pub(super) fn check_anchor(task_id: &str, check: &CheckGrade) -> String {
    format!("{task_id}-check-{}", file_stem(&check.name))
}

/// Lost points with one cause.
#[derive(Debug, PartialEq)]
struct Cost<'a> {
    lost: f64,
    /// Where to begin: the title of the check, or of the task that was stopped.
    title: &'a str,
    address: String,
    /// What stopped the whole task.
    stop: Option<&'a str>,
    /// The other checks that lost points with it.
    with: Vec<&'a str>,
}

/// The rows of the checks of one task.
fn costs_of(index: usize, task: &TaskGrade) -> Vec<Cost<'_>> {
    let id = anchor(index);
    if let Some(stop) = &task.stopped {
        return vec![Cost {
            lost: task.max_points - task.points,
            title: &task.title,
            address: format!("#{id}"),
            stop: Some(&stop.message),
            with: Vec::new(),
        }];
    }
    let mut costs: Vec<(usize, Cost<'_>)> = Vec::new();
    for (i, check) in task.checks.iter().enumerate() {
        if check.outcome == Outcome::AtHandIn || lost_points(check) < LEAST {
            continue;
        }
        let root = root(&task.checks, i);
        let known = costs.iter().position(|(of, _)| *of == root);
        let at = known.unwrap_or_else(|| {
            let first = &task.checks[root];
            let cost = Cost {
                lost: 0.0,
                title: &first.title,
                address: format!("#{}", check_anchor(&id, first)),
                stop: None,
                with: Vec::new(),
            };
            costs.push((root, cost));
            costs.len() - 1
        });
        let cost = &mut costs[at].1;
        cost.lost += lost_points(check);
        if i != root {
            cost.with.push(&check.title);
        }
    }
    costs.into_iter().map(|(_, cost)| cost).collect()
}

/// The check whose mistake costs check `at` its points, too: the one that it needs or leads to, else the first with the same cause, else
/// itself.
fn root(checks: &[CheckGrade], at: usize) -> usize {
    let mut root = at;
    // each step leads to another check; more steps than checks would be a circle
    for _ in checks {
        let first = checks[root].look_first_at.as_ref();
        let named = first.and_then(|name| checks.iter().position(|other| other.name == *name));
        match named.filter(|i| lost_points(&checks[*i]) >= LEAST) {
            Some(next) => root = next,
            None => break,
        }
    }
    let cause = |check: &CheckGrade| {
        let first = check.evidence.first().filter(|fact| fact.is_cause);
        first.map(|fact| fact.message.clone())
    };
    let own = cause(&checks[root]);
    let mut same = checks.iter().map(cause);
    let first = own.and_then(|own| same.position(|other| other.as_ref() == Some(&own)));
    first.unwrap_or(root)
}

/// The rows, below the meter whose lost part they divide; nothing where one card says it all.
pub(super) fn costs(grade: &Grade) -> Markup {
    let is_shown = grade.verdict.is_decided() && stop_of_whole_file(grade).is_none();
    let tasks = grade.tasks.iter().enumerate().filter(|_| is_shown);
    let mut costs: Vec<Cost<'_>> = tasks.flat_map(|(i, task)| costs_of(i, task)).collect();
    costs.retain(|cost| cost.lost >= LEAST);
    costs.sort_by(|a, b| b.lost.total_cmp(&a.lost));
    if costs.is_empty() || costs.len() == 1 && costs[0].with.is_empty() {
        return html! {};
    }
    // a single one left over needs no more room than the line that counts it
    let shown = if costs.len() == MOST_ROWS + 1 {
        MOST_ROWS + 1
    } else {
        MOST_ROWS
    };
    let rest: f64 = costs.iter().skip(shown).map(|cost| cost.lost).sum();
    let share = |points: f64| 100.0 * points / grade.max_points.max(LEAST);
    let mut left = grade.max_points;
    let rows: Vec<_> = costs
        .iter()
        .take(shown)
        .map(|cost| {
            left -= cost.lost;
            (cost, share(left), share(cost.lost))
        })
        .collect();
    html! {
        div class="costs" role="group" aria-labelledby="costs-title" {
            h2 id="costs-title" { "What the lost points come from" }
            ol {
                @for (cost, from, width) in rows { li { (row(cost, from, width)) } }
            }
            @if costs.len() > shown {
                p class="quiet" { "and " (points(rest)) " points in " (costs.len() - shown) " other places: see the scores" }
            }
        }
    }
}

fn row(cost: &Cost<'_>, from: f64, width: f64) -> Markup {
    html! {
        p {
            span class="gain" { "fix this: " @if !cost.with.is_empty() { "up to " } b { "+" (points(cost.lost)) } } " "
            a href=(cost.address) { (foreign(cost.title)) }
            @if cost.stop.is_some() { " was stopped" }
            @if !cost.with.is_empty() {
                " " small {
                    "and with it "
                    @for (i, title) in cost.with.iter().enumerate() { @if i > 0 { "; " } (foreign(title)) }
                }
            }
        }
        svg class="fall" viewBox="0 0 100 2" preserveAspectRatio="none" aria-hidden="true" focusable="false" {
            rect class="rest" width="100" height="2" {}
            rect class="lost" x=(format!("{from:.2}")) width=(format!("{width:.2}")) height="2" {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::Evidence;
    use kinemark_grader::record::sample;
    use kinemark_grader::record::verdict::Verdict;

    fn check(title: &str, points: f64, max_points: f64) -> CheckGrade {
        let mut check = sample::graded().grade.tasks[3].checks[0].clone();
        check.name = title.to_lowercase().replace(' ', "-");
        check.title = title.to_owned();
        (check.points, check.max_points) = (points, max_points);
        check.outcome = Outcome::Partial;
        check.evidence.clear();
        check.look_first_at = None;
        check
    }

    fn needs(title: &str, need: &str) -> CheckGrade {
        let mut check = check(title, 0.0, 4.0);
        check.outcome = Outcome::NotJudged;
        check.look_first_at = Some(need.to_lowercase().replace(' ', "-"));
        check
    }

    /// The sample with one task of these checks.
    fn grade(checks: Vec<CheckGrade>) -> Grade {
        let mut grade = sample::graded().grade;
        grade.tasks.drain(..3);
        grade.verdict = Verdict::Missed;
        let task = &mut grade.tasks[0];
        task.stopped = None;
        task.points = checks.iter().map(|check| check.points).sum();
        task.max_points = checks.iter().map(|check| check.max_points).sum();
        task.checks = checks;
        (grade.points, grade.max_points) = (task.points, task.max_points);
        grade
    }

    #[test]
    fn a_chain_of_needs_is_one_row_and_the_most_costly_is_first() {
        let grade = grade(vec![
            check("Near", 1.0, 2.0),
            check("On the line", 0.0, 3.0),
            needs("Fast", "On the line"),
            needs("Smooth", "Fast"),
        ]);
        let found = costs_of(0, &grade.tasks[0]);
        let line = found
            .iter()
            .find(|cost| cost.title == "On the line")
            .unwrap();
        assert_eq!(line.with, ["Fast", "Smooth"]);
        assert!((line.lost - 11.0).abs() < 1e-9, "{}", line.lost);
        let shown = costs(&grade).into_string();
        let first = shown.find("On the line").unwrap();
        assert!(first < shown.find("Near").unwrap(), "{shown}");
        assert!(shown.contains("fix this: up to <b>+11</b>"), "{shown}");
        assert!(
            shown.contains("href=\"#task-1-check-on-the-line\""),
            "{shown}"
        );
    }

    #[test]
    fn what_leads_to_another_check_is_in_its_row() {
        let mut fall = check("The can falls", 0.0, 5.0);
        fall.look_first_at = Some("near".to_owned());
        let grade = grade(vec![check("Near", 1.0, 2.0), fall]);
        let found = costs_of(0, &grade.tasks[0]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].title, found[0].lost), ("Near", 6.0));
    }

    #[test]
    fn the_bars_fall_from_all_points_to_those_earned() {
        let grade = grade(vec![check("One", 1.0, 6.0), check("Other", 1.0, 4.0)]);
        let shown = costs(&grade).into_string();
        // five of ten points, then three: two are left
        for bar in ["x=\"50.00\" width=\"50.00\"", "x=\"20.00\" width=\"30.00\""] {
            assert!(shown.contains(bar), "{bar}: {shown}");
        }
    }

    #[test]
    fn checks_with_the_same_cause_are_one_row() {
        let cause = |title| {
            let mut check = check(title, 0.0, 2.0);
            check.evidence.push(Evidence {
                message: "angles in degrees".to_owned(),
                is_cause: true,
                ..Evidence::default()
            });
            check
        };
        let grade = grade(vec![cause("One"), check("Other", 0.0, 2.0), cause("Third")]);
        let found = costs_of(0, &grade.tasks[0]);
        let titles: Vec<_> = found
            .iter()
            .map(|cost| (cost.title, cost.with.len()))
            .collect();
        assert_eq!(titles, [("One", 1), ("Other", 0)]);
    }

    #[test]
    fn a_stopped_task_is_one_row_and_one_row_alone_is_not_repeated() {
        let mut grade = grade(vec![check("One", 0.0, 2.0), check("Other", 0.0, 2.0)]);
        grade.tasks[0].stopped = Some(kinemark_grader::record::grade::Stopped {
            message: "division by zero".to_owned(),
            ..Default::default()
        });
        let found = costs_of(0, &grade.tasks[0]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].lost, found[0].address.as_str()), (4.0, "#task-1"));
        assert!(costs(&grade).into_string().is_empty(), "the card says it");
    }

    #[test]
    fn rows_that_are_left_out_are_counted_and_a_single_one_is_not_left_out() {
        let rows = |many: usize| {
            let checks = (0..many).map(|i| check(&format!("Check {i}"), 1.0, 2.0));
            let shown = costs(&grade(checks.collect())).into_string();
            (
                shown.matches("<li>").count(),
                shown.contains("other places"),
            )
        };
        assert_eq!(rows(6), (6, false));
        assert_eq!(rows(7), (7, false));
        assert_eq!(rows(8), (6, true));
    }

    #[test]
    fn checks_that_need_each_other_are_no_endless_chain() {
        let grade = grade(vec![needs("One", "Other"), needs("Other", "One")]);
        let lost: f64 = costs_of(0, &grade.tasks[0])
            .iter()
            .map(|cost| cost.lost)
            .sum();
        assert!((lost - 8.0).abs() < 1e-9, "every point once: {lost}");
    }
}
