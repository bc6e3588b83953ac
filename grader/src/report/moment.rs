//! Links to a moment of a run: the part of an address after the page, by which a report's replay goes there.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::visible::visible;
use crate::grade::{Grade, Outcome, TaskGrade};
use crate::quantity::trimmed;

/// What does not stand for itself in a part of an address (RFC 3986, section 2.3).
pub const ADDRESS_PART: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'_')
    .remove(b'.')
    .remove(b'~');

/// The fragment of a moment of a task, such as `#task=move&t=2.35`; characters that steer an address are written as `%XX`.
pub fn fragment(task: &str, time_s: f64) -> String {
    let task = visible(task);
    let task = utf8_percent_encode(&task, ADDRESS_PART);
    // a step shorter than a tenth of a millisecond is no lab's
    format!("#task={task}&t={}", trimmed(time_s.max(0.0), 4))
}

/// Where points were first lost: the earliest moment told of the first check that lost some.
pub fn first_loss(grade: &Grade) -> Option<String> {
    grade.tasks.iter().find_map(first_loss_of)
}

fn first_loss_of(task: &TaskGrade) -> Option<String> {
    let lost = task.checks.iter();
    let mut lost = lost.filter(|check| matches!(check.outcome, Outcome::Partial | Outcome::None));
    let told = lost.find_map(|check| {
        let times = check.evidence.iter().filter_map(|fact| fact.time_s);
        times.min_by(f64::total_cmp)
    });
    let stopped = task.stopped.as_ref().and_then(|stopped| stopped.time_s);
    Some(fragment(&task.name, stopped.or(told)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

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

    #[test]
    fn the_first_loss_is_the_earliest_moment_of_the_first_check_that_lost() {
        let graded = sample::graded();
        assert_eq!(
            first_loss(&graded.grade).as_deref(),
            Some("#task=move&t=3.2")
        );
    }
}
