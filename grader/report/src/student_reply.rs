//! A paragraph to send to a student who asks about hidden points: classes, counts, checks and the next step, and no hidden number.
//!
//! Every word of it is in what the student has anyway: the lab, and the report. Of the hidden cases and runs it takes counts alone.

use super::text::hidden_word;
use super::visible::visible;
use kinemark_grader::record::explanation::{DrawCheck, ExplainedDraw, ExplainedTask, Explanation};
use kinemark_grader::record::grade::{TaskGrade, TaskKind};
use kinemark_grader::record::quantity::points;

/// The paragraph.
pub fn paragraph(explanation: &Explanation) -> String {
    let graded = &explanation.graded;
    let grade = &graded.grade;
    let mut sentences = vec![format!(
        "Your submission earns {} of {} points in \"{}\".",
        points(grade.points),
        points(grade.max_points),
        visible(&graded.title)
    )];
    let mut lost = Vec::new();
    let mut steps = Vec::new();
    for task in &explanation.tasks {
        let Some(record) = grade.tasks.iter().find(|record| record.name == task.name) else {
            continue;
        };
        let (of_task, step) = of_task(task, record);
        lost.extend(of_task);
        steps.extend(step.map(|step| (step, format!("\"{}\"", visible(&task.title)))));
    }
    if lost.is_empty() {
        sentences.push("The hidden cases and runs cost you no point.".to_owned());
        if grade.points < grade.max_points {
            sentences.push("Your report shows where the others are lost.".to_owned());
        }
    } else {
        sentences.push(
            "Some points are lost where your code is graded with other numbers. These numbers stay hidden, for everybody, but this is what happens there."
                .to_owned(),
        );
        sentences.extend(lost);
        sentences.extend(next_steps(steps));
        sentences.push(
            "The name of a class says what is different: try such numbers with your own code, and ask again if something stays unclear."
                .to_owned(),
        );
    }
    sentences.join(" ")
}

/// Each next step once, with the tasks that it is for.
fn next_steps(steps: Vec<(String, String)>) -> Vec<String> {
    let mut once: Vec<(String, Vec<String>)> = Vec::new();
    for (step, task) in steps {
        match once.iter_mut().find(|(known, _)| *known == step) {
            Some((_, tasks)) => tasks.push(task),
            None => once.push((step, vec![task])),
        }
    }
    let several = once.len() > 1;
    let sentence = |(step, tasks): (String, Vec<String>)| {
        let place = if several {
            format!(" in {}", listed(&tasks))
        } else {
            String::new()
        };
        format!("A next step{place}: {step}")
    };
    once.into_iter().map(sentence).collect()
}

/// What a task lost in its hidden cases or runs, and the next step.
fn of_task(task: &ExplainedTask, record: &TaskGrade) -> (Vec<String>, Option<String>) {
    let title = visible(&task.title);
    if !task.counts {
        let why = format!(
            "The hidden runs of the task \"{title}\" were not tried, because the visible run did not reach its end."
        );
        return (vec![why], next_step(record, &[]));
    }
    // classes in which the same happens are one sentence
    let mut happened: Vec<(String, Vec<String>)> = Vec::new();
    let mut checks: Vec<&str> = Vec::new();
    for (class, draws) in task.classes() {
        let lost = draws.iter().copied().filter(|draw| is_lost(draw));
        let lost: Vec<&ExplainedDraw> = lost.collect();
        if lost.is_empty() {
            continue;
        }
        let of_class = lost.iter().flat_map(|draw| lost_checks(draw));
        checks.extend(of_class.map(|check| check.name.as_str()));
        let what = what_happens(task.kind, &lost, record);
        let count = format!("{} of {}", lost.len(), draws.len());
        let kind = hidden_word(task.kind);
        let place = format!("{count} hidden {kind} of the class \"{}\"", visible(class));
        match happened.iter_mut().find(|(known, _)| *known == what) {
            Some((_, places)) => places.push(place),
            None => happened.push((what, vec![place])),
        }
    }
    let step = (!happened.is_empty()).then(|| next_step(record, &checks));
    let sentences = happened.into_iter().map(|(what, places)| {
        let places = listed(&places);
        format!("In the task \"{title}\", in {places}, {what}.")
    });
    (sentences.collect(), step.flatten())
}

fn is_lost(draw: &ExplainedDraw) -> bool {
    !draw.good || draw.checks.iter().any(DrawCheck::is_lost)
}

fn lost_checks(draw: &ExplainedDraw) -> impl Iterator<Item = &DrawCheck> {
    draw.checks.iter().filter(|check| check.is_lost())
}

/// What went wrong in the lost draws of a class.
fn what_happens(kind: TaskKind, lost: &[&ExplainedDraw], record: &TaskGrade) -> String {
    let stopped = lost.iter().filter(|draw| draw.stopped.is_some()).count();
    if stopped == lost.len() {
        return "your program was stopped before its end".to_owned();
    }
    let titles = |judged: bool| {
        let is_one = |name: &str| {
            let mut checks = lost.iter().flat_map(|draw| lost_checks(draw));
            checks.any(|check| check.name == name && check.score.is_some() == judged)
        };
        let found = record.checks.iter().filter(|check| is_one(&check.name));
        let titles = found.map(|check| format!("\"{}\"", visible(&check.title)));
        titles.collect::<Vec<_>>()
    };
    let [judged, unjudged] = [titles(true), titles(false)];
    let mut what = match kind {
        TaskKind::Function => {
            let titles = listed(&judged);
            format!("your answer is off by more than the full points of {titles} allow")
        }
        TaskKind::Motion => format!("{} {} points", listed(&judged), loses(&judged)),
    };
    if !unjudged.is_empty() && !judged.is_empty() {
        let others = match unjudged.len() {
            1 => "1 check that needs more than that is".to_owned(),
            many => format!("{many} checks that need more than that are"),
        };
        what += &format!(" ({others} not judged)");
    }
    if stopped > 0 {
        what += ", and in some your program was stopped before its end";
    }
    what
}

fn loses(titles: &[String]) -> &'static str {
    match titles {
        [_] => "loses",
        _ => "lose",
    }
}

/// The next step that the student's report gives for one of the checks called `lost`, or the mistake that it names.
fn next_step(record: &TaskGrade, lost: &[&str]) -> Option<String> {
    if let Some(diagnosis) = record.diagnoses.first() {
        return Some(visible(&diagnosis.says).into_owned());
    }
    let stopped = record.stopped.as_ref();
    let help = stopped.and_then(|stopped| stopped.help.as_ref());
    let mut checks = record.checks.iter();
    let step = checks.find_map(|check| {
        let is_lost = lost.contains(&check.name.as_str());
        check.next_step.as_ref().filter(|_| is_lost)
    });
    Some(visible(help.or(step)?).into_owned())
}

/// `a`, `a and b`, `a, b and c`.
fn listed(parts: &[String]) -> String {
    match parts {
        [parts @ .., last] if !parts.is_empty() => format!("{} and {last}", parts.join(", ")),
        parts => parts.concat(),
    }
}
