//! A grade for editors: a line for each thing that went wrong, as compilers write them, `FILE:LINE:COLUMN: KIND: WORDS`.

use kinemark_grader::record::grade::{Grade, Stopped, TaskGrade};
use kinemark_grader::record::quantity::points;

use crate::moment::has_lost;
use crate::stop_words::stop_of_whole_file;
use crate::visible::visible;

/// A grade in lines; `file` is the submission as it was named.
///
/// What stopped a submission is an `error` at its place. A check that lost points is a `warning` in the first line, because no line of
/// the submission is known for it. The last line has the points.
pub fn short_text(grade: &Grade, file: &str) -> String {
    let mut lines = Vec::new();
    match stop_of_whole_file(grade) {
        // it is the same in all tasks
        Some(stop) => {
            let place = stop.line.zip(stop.column);
            lines.push(line(file, place, "error", &stop.message));
            of_further(file, stop, &mut lines);
        }
        None => {
            for task in &grade.tasks {
                of_task(file, task, &mut lines);
            }
        }
    }
    lines.push(format!(
        "{} of {} points, {}",
        points(grade.points),
        points(grade.max_points),
        grade.verdict.name()
    ));
    lines.join("\n") + "\n"
}

fn of_task(file: &str, task: &TaskGrade, lines: &mut Vec<String>) {
    if let Some(stop) = &task.stopped {
        let words = format!("{}: {}", task.name, stop.message);
        lines.push(line(file, stop.line.zip(stop.column), "error", &words));
        of_further(file, stop, lines);
    }
    for check in task.checks.iter().filter(|check| has_lost(check)) {
        let why = check.evidence.first();
        let why = why.map_or("", |fact| fact.message.as_str());
        let words = format!(
            "{}/{}: {} of {} points: {why}",
            task.name,
            check.name,
            points(check.points),
            points(check.max_points)
        );
        lines.push(line(file, None, "warning", &words));
    }
}

/// What else is wrong in the file, each at the beginning of its lines.
fn of_further(file: &str, stop: &Stopped, lines: &mut Vec<String>) {
    for further in &stop.further {
        let places = further.lines.iter().map(|number| Some((*number, 1)));
        lines.extend(places.map(|place| line(file, place, "error", &further.help)));
    }
}

fn line(file: &str, place: Option<(usize, usize)>, kind: &str, words: &str) -> String {
    let (line, column) = place.unwrap_or((1, 1));
    format!("{file}:{line}:{column}: {kind}: {}", visible(words))
}
