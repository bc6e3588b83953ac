//! Where to look first: what cost points first, in a few words, with a link to its moment.

use kinemark_sim::text::number::seconds;
use maud::{Markup, html};

use super::beyond::{has_full_marks, success};
use super::head::anchor;
use super::task_check::is_of_hidden_run;
use super::viewer::seek;
use super::{foreign, kept_with_units, prose};
use crate::moment::{last_before, look_first};
use crate::stop_words::stop_of_whole_file;
use kinemark_grader::record::grade::{CheckGrade, Evidence, Grade};
use kinemark_grader::record::quantity::points;

/// A card that shows what cost points first, or that nothing did; nothing where nothing is decided.
pub(super) fn look(grade: &Grade, has_replay: impl Fn(usize) -> bool) -> Markup {
    if has_full_marks(grade) {
        return success(grade, has_replay);
    }
    // what kept the whole file from being run stands below the head, alone
    let is_shown = grade.verdict.is_decided() && stop_of_whole_file(grade).is_none();
    let first = look_first(grade).filter(|_| is_shown);
    let Some(loss) = first else {
        return html! {};
    };
    let task = loss.task;
    let i = grade
        .tasks
        .iter()
        .position(|other| std::ptr::eq(other, task));
    let i = i.unwrap_or_default();
    // a stop costs everything after it
    let stop = task.stopped.as_ref();
    let at = match stop {
        Some(stop) => last_before(stop),
        None => loss.at,
    };
    html! {
        div class="note bad look" role="region" aria-labelledby="look-title" {
            h2 id="look-title" { "Look here first" }
            @if let Some(stop) = stop {
                p {
                    strong { (foreign(&task.title)) } " lost " (share(task.max_points - task.points, task.max_points)) ": "
                    (prose(&stop.message))
                    @if let Some(line) = stop.line { " (line " (line) ")" }
                }
                @if let (Some(help), true) = (&stop.help, task.diagnoses.is_empty()) { p { (next(help)) } }
            } @else if let Some(check) = loss.check {
                p {
                    strong { (foreign(&check.title)) } " lost " (share(check.max_points - check.points, check.max_points))
                    @if let Some(fact) = earliest_fact(check) { ": " (prose(&kept_with_units(&fact.message))) } @else { "." }
                }
                @if let (Some(step), true) = (&check.next_step, task.diagnoses.is_empty()) { p { (next(step)) } }
            }
            @if let Some(diagnosis) = task.diagnoses.first() { p { "It looks like this: " (prose(&diagnosis.says)) } }
            p class="go" {
                @match at {
                    Some(at) if has_replay(i) => { (seek(&task.name, at.time_s, &format!("See it at {}", seconds(at.time_s)))) }
                    _ => { a href={ "#" (anchor(i)) } { "Go to " (foreign(&task.title)) } }
                }
            }
        }
    }
}

/// What to do next.
fn next(step: &str) -> Markup {
    let mut letters = step.chars();
    let step: String = match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    };
    html! { b { "Next: " } (prose(&kept_with_units(&step))) }
}

fn share(lost: f64, of: f64) -> String {
    format!("{} of {} points", points(lost), points(of))
}

/// The fact of a check that says most about its first loss: its cause, else the earliest that has a time, else the first.
fn earliest_fact(check: &CheckGrade) -> Option<&Evidence> {
    let timed = check
        .evidence
        .iter()
        .filter_map(|fact| Some((fact, fact.time_s?)));
    let cause = check.evidence.first().filter(|fact| fact.is_cause);
    let earliest = timed
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(fact, _)| fact);
    // where only hidden runs lost points, one of them says more than what the visible run earns
    let hidden = check.evidence.iter().find(|fact| is_of_hidden_run(fact));
    cause.or(earliest).or(hidden).or(check.evidence.first())
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::{Instant, Outcome, Stopped};
    use kinemark_grader::record::sample;
    use kinemark_grader::record::verdict::Verdict;

    /// The sample with its last task alone, a motion task that lost points.
    fn moving() -> Grade {
        let mut grade = sample::graded().grade;
        grade.tasks.drain(..3);
        grade.tasks[0].stopped = None;
        grade.tasks[0].verdict = Verdict::Missed;
        grade.verdict = Verdict::Missed;
        grade
    }

    #[test]
    fn the_card_shows_the_earliest_moment_of_all_checks_that_lost_points() {
        let mut grade = moving();
        let last = grade.tasks[0].checks.len() - 1;
        let check = &mut grade.tasks[0].checks[last];
        check.outcome = Outcome::Partial;
        check.title = "The last one".to_owned();
        check.first_lost = Some(Instant {
            tick: 10,
            time_s: 0.01,
        });
        check.evidence = vec![Evidence {
            message: "it was `late`".to_owned(),
            tick: Some(10),
            time_s: Some(0.01),
            ..Evidence::default()
        }];
        let card = look(&grade, |_| true).into_string();
        for part in [
            "<strong><bdi>The last one</bdi></strong> lost ",
            "it was <code>late</code>",
            "<a class=\"seek\" href=\"#task=move&amp;t=0.01\">See it at 0.01 s</a>",
        ] {
            assert!(card.contains(part), "{part}: {card}");
        }
        // without a replay it leads to the section
        let card = look(&grade, |_| false).into_string();
        assert!(card.contains("href=\"#task-1\""), "{card}");
    }

    #[test]
    fn what_stopped_a_task_is_shown_before_its_checks() {
        let mut grade = moving();
        grade.tasks[0].stopped = Some(Stopped {
            further: Vec::new(),
            kept: None,
            message: "`q` has no `x`".to_owned(),
            help: None,
            line: Some(7),
            column: Some(3),
            source_line: Some("  q.x".to_owned()),
            source_column: None,
            tick: Some(1200),
            time_s: Some(1.2),
            case: None,
        });
        let card = look(&grade, |_| true).into_string();
        for part in [
            "<code>q</code> has no <code>x</code>",
            "(line 7)",
            "href=\"#task=move&amp;t=1.199\">See it at 1.199 s",
        ] {
            assert!(card.contains(part), "{part}: {card}");
        }
    }

    #[test]
    fn nothing_is_shown_where_nothing_was_lost_or_decided() {
        let mut grade = moving();
        grade.verdict = Verdict::HostLimit;
        assert!(look(&grade, |_| true).into_string().is_empty());
        let mut grade = moving();
        grade.tasks[0]
            .checks
            .retain(|check| check.outcome == Outcome::Full);
        assert!(look(&grade, |_| true).into_string().is_empty());
    }
}
