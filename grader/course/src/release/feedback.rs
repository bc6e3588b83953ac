//! Feedback in a few lines, the same in every form: the total, lateness, points by hand with their reasons, and the first losses with
//! evidence, next step and hints. It has no path of a machine and no number of a hidden case.

use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::hints::Hints;
use kinemark_report::html::feedback::{FeedbackPage, feedback_page};
use kinemark_report::moment::{has_lost, lost_points};
use kinemark_report::visible::shortened;

use super::decided::{Decided, decided};
use super::machine_path::without_paths;
use super::number::points_text;
use super::shell_word::shell_word;
use super::{Material, Row};
use crate::standing::{ByHand, Standing};

/// The most characters of the text.
pub(super) const MOST_CHARACTERS: usize = 2000;

/// What every feedback begins with. A comment in the LMS that begins otherwise was written by a person.
const MARK: &str = "Kinemark, ";

/// Changes by hand that are listed one by one.
const MOST_BY_HAND: usize = 4;

/// Whether a comment in the LMS is one that this program wrote.
pub(super) fn is_ours(comment: &str) -> bool {
    comment.starts_with(MARK)
}

/// Text from outside, for a person: what hides or steers is written out, paths are cut, and it has at most `most` characters.
pub(super) fn plain(text: &str, most: usize) -> String {
    shortened(&without_paths(text.trim()), most)
}

/// What lost points.
struct Loss {
    /// What and why, and the next step.
    line: String,
    /// The hints behind the next step, to be added to the line where there is room.
    hints: String,
    /// How many points.
    points: f64,
}

/// The feedback of one student.
pub(super) struct Feedback<'a> {
    title: &'a str,
    decided: Decided<'a>,
    total: String,
    /// Lateness, and points by hand.
    facts: Vec<String>,
    /// What lost points, in the lab's order.
    losses: Vec<Loss>,
    /// How to see the replay.
    replay: Option<String>,
}

impl<'a> Feedback<'a> {
    /// The feedback of a row; none where there is no decided grade.
    pub(super) fn of(material: &Material<'a>, row: &Row<'a>) -> Option<Self> {
        let decided = decided(row)?;
        let mut facts: Vec<String> = lateness(row.standing).into_iter().collect();
        facts.extend(by_hand(&decided));
        let grade = decided.grade;
        Some(Self {
            title: material.title,
            decided,
            total: total(material, row.standing, &decided),
            facts,
            losses: losses(&decided),
            replay: grade.map(|grade| {
                let word = |text: &str, other: &str| {
                    let is_shown = plain(text, 60) == text;
                    let word = shell_word(text).filter(|_| is_shown);
                    word.unwrap_or_else(|| other.to_owned())
                };
                format!(
                    "To see the runs: kinemark grade {} {}",
                    word(material.lab, "LAB"),
                    word(&grade.submission.name, "submission.rhai")
                )
            }),
        })
    }

    /// Its lines, of at most [`MOST_CHARACTERS`] characters with `joint` between them.
    fn lines(&self, joint: usize) -> Vec<String> {
        let length = |line: &str| line.chars().count() + joint;
        let mut lines = vec![self.total.clone()];
        lines.extend(self.facts.iter().cloned());
        let tail = self.replay.iter().cloned();
        let tail: Vec<String> = tail.collect();
        // room for the line that counts what is left out
        let mut left = MOST_CHARACTERS - 80;
        for line in lines.iter().chain(&tail) {
            left = left.saturating_sub(length(line));
        }
        let mut shown = 0;
        for loss in &self.losses {
            if length(&loss.line) > left {
                break;
            }
            left -= length(&loss.line);
            shown += 1;
        }
        let (shown, others) = self.losses.split_at(shown);
        // hints cost no other loss its line
        for Loss { line, hints, .. } in shown {
            let has_room = hints.chars().count() <= left;
            let hints = if has_room { hints.as_str() } else { "" };
            left -= hints.chars().count();
            lines.push(format!("{line}{hints}"));
        }
        if !others.is_empty() {
            let lost: f64 = others.iter().map(|loss| loss.points).sum();
            let what = if others.len() == 1 { "loss" } else { "losses" };
            lines.push(format!(
                "- {} more {what} of {} points: see the report",
                others.len(),
                points_text(lost)
            ));
        }
        lines.extend(tail);
        lines
    }

    /// The text, of at most [`MOST_CHARACTERS`] characters.
    pub(super) fn text(&self) -> String {
        self.lines(1).join("\n") + "\n"
    }

    /// One line.
    pub(super) fn line(&self) -> String {
        self.lines(3).join(" | ")
    }

    /// HTML on one line, for a comment in the LMS.
    pub(super) fn html(&self) -> String {
        let lines = self.lines(1);
        let escaped: Vec<String> = lines.iter().map(|line| escaped(line)).collect();
        escaped.join("<br>")
    }

    /// The page.
    pub(super) fn page(&self) -> String {
        feedback_page(&FeedbackPage {
            title: self.title,
            points: self.decided.points,
            max_points: self.decided.max_points,
            facts: &self.facts,
            replay: self.replay.as_deref(),
            grade: self.decided.grade,
            hints: self.decided.hints,
        })
    }
}

/// Text in HTML. A backslash is written as a reference, because Moodle's reader takes one before a quote for an escape.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\\' => out += "&#92;",
            c => out.push(c),
        }
    }
    out
}

fn total(material: &Material<'_>, standing: &Standing, decided: &Decided<'_>) -> String {
    let of = match decided.max_points {
        Some(maximum) => format!(" of {}", points_text(maximum)),
        None => String::new(),
    };
    let auto = match standing.record_points {
        Some(points) if !decided.by_hand.is_empty() => {
            format!(" ({} from the checks)", points_text(points))
        }
        _ => String::new(),
    };
    format!(
        "{MARK}{}: {}{of} points{auto}.",
        plain(material.title, 100),
        points_text(decided.points)
    )
}

/// Lateness as a fact; nothing where it was in time, or where that is not known.
fn lateness(standing: &Standing) -> Option<String> {
    match standing.late_s {
        Some(late_s) if late_s > 0 => Some(format!(
            "Handed in {} after the due time.",
            duration(late_s)
        )),
        None if standing.marked_late => Some("Marked as late by the LMS.".to_owned()),
        _ => None,
    }
}

/// A time in its two greatest units.
fn duration(seconds: i64) -> String {
    let parts = [
        (seconds / 86_400, "d"),
        (seconds / 3600 % 24, "h"),
        (seconds / 60 % 60, "min"),
        (seconds % 60, "s"),
    ];
    let mut shown = parts.iter().skip_while(|(count, _)| *count == 0).take(2);
    let mut words = Vec::new();
    for (count, unit) in shown.by_ref().filter(|(count, _)| *count > 0) {
        words.push(format!("{count}\u{a0}{unit}"));
    }
    words.join(" ")
}

/// Points by hand, each with its reason. A change that does not count any more is of no use to the student.
fn by_hand(decided: &Decided<'_>) -> Vec<String> {
    let counts = |by_hand: &&ByHand| by_hand.change != 0.0 || !by_hand.is_stale;
    let all: Vec<&ByHand> = decided.by_hand.iter().filter(counts).collect();
    let mut lines: Vec<String> = all
        .iter()
        .take(MOST_BY_HAND)
        .map(|by_hand| {
            let what = match &by_hand.check {
                None => "the total".to_owned(),
                Some(check) => plain(decided.title(check).unwrap_or(check), 60),
            };
            format!(
                "By hand: {} for {what}: {}",
                change(by_hand.change),
                plain(&by_hand.why, 150)
            )
        })
        .collect();
    if let Some(rest) = all.get(MOST_BY_HAND..).filter(|rest| !rest.is_empty()) {
        let sum: f64 = rest.iter().map(|by_hand| by_hand.change).sum();
        lines.push(format!("By hand: {} for {} more", change(sum), rest.len()));
    }
    lines
}

/// A change of points with its sign.
pub(super) fn change(points: f64) -> String {
    let size = points_text(points.abs());
    if points < 0.0 {
        format!("−{size}")
    } else {
        format!("+{size}")
    }
}

/// What lost points, in the lab's order: what stopped a task, then its checks.
fn losses(decided: &Decided<'_>) -> Vec<Loss> {
    let tasks = decided.grade.into_iter().flat_map(|grade| &grade.tasks);
    tasks
        .flat_map(|task| of_task(task, decided.hints))
        .collect()
}

fn of_task(task: &TaskGrade, hints: &Hints) -> Vec<Loss> {
    let mut losses = Vec::new();
    let title = plain(&task.title, 60);
    if let Some(stopped) = &task.stopped {
        let line = stopped.line.map(|line| format!(" in line {line}"));
        let lost = (task.max_points - task.points).max(0.0);
        let what = format!(
            "- {title} was stopped{}: {}",
            line.unwrap_or_default(),
            plain(&stopped.message, 200)
        );
        losses.push(Loss {
            line: with_next(what, stopped.help.as_deref()),
            hints: String::new(),
            points: lost,
        });
    }
    for check in task.checks.iter().filter(|check| has_lost(check)) {
        let mut loss = format!(
            "- {title}, {}: {} of {} points.",
            plain(&check.title, 60),
            points_text(check.points),
            points_text(check.max_points)
        );
        if let Some(fact) = check.evidence.first() {
            loss += &format!(" {}.", plain(&fact.message, 200).trim_end_matches('.'));
        }
        // points of a stopped task are counted with the stop
        let lost = match task.stopped {
            Some(_) => 0.0,
            None => lost_points(check),
        };
        let hints = hints.behind_next_step(&task.name, check).iter();
        losses.push(Loss {
            line: with_next(loss, check.next_step.as_deref()),
            hints: hints.map(|hint| format!(" {}", plain(hint, 300))).collect(),
            points: lost,
        });
    }
    losses
}

fn with_next(loss: String, next: Option<&str>) -> String {
    match next {
        Some(next) => format!("{loss} Next: {}", plain(next, 180)),
        None => loss,
    }
}

#[cfg(test)]
mod tests;
