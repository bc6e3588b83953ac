//! A paragraph to send to a student who asks about hidden points: classes, counts, checks and the next step, and no hidden number.
//!
//! Every word of it is in what the student has anyway: the lab, and the report. Of the hidden cases and runs it takes counts alone.

use super::stop_words::{
    is_missing_function, message_with_line, moment_of_stop, sentence, stop_of_whole_file,
};
use super::text::hidden_word;
use super::visible::visible;
use kinemark_grader::record::explanation::{DrawCheck, ExplainedDraw, ExplainedTask, Explanation};
use kinemark_grader::record::grade::{Stopped, TaskGrade, TaskKind};
use kinemark_grader::record::hints::Hints;
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
    if let Some(stopped) = stop_of_whole_file(grade) {
        sentences.extend(nothing_ran(stopped));
        return sentences.join(" ");
    }
    let mut said = Said::new(&explanation.hints);
    for task in &explanation.tasks {
        if let Some(record) = grade.tasks.iter().find(|record| record.name == task.name) {
            said.task(task, record);
        }
    }
    if said.stops.is_empty() && said.losses.is_empty() {
        sentences.push("The hidden cases and runs cost you no point.".to_owned());
        if grade.points < grade.max_points {
            sentences.push("Your report shows where the others are lost.".to_owned());
        }
    }
    let has_losses = !said.losses.is_empty();
    sentences.extend(said.stops);
    if has_losses {
        sentences.push(
            "Some points are lost where your code is graded with other numbers. These numbers stay hidden, for everybody, but this is what happens there."
                .to_owned(),
        );
        sentences.extend(said.losses);
    }
    sentences.extend(next_steps(said.steps));
    if has_losses {
        sentences.push(
            "The name of a class says what is different: try such numbers with your own code, and ask again if something stays unclear."
                .to_owned(),
        );
    }
    sentences.join(" ")
}

/// What is to be said of the tasks.
struct Said<'h> {
    hints: &'h Hints,
    /// What stopped the submission, where students see it too.
    stops: Vec<String>,
    /// What happens in hidden cases and runs.
    losses: Vec<String>,
    /// Next steps, with the title of the task that each is for.
    steps: Vec<(String, String)>,
}

/// Of a file of which nothing could be run: why, once for all tasks, and the next step.
fn nothing_ran(stopped: &Stopped) -> [String; 3] {
    let step = match &stopped.help {
        Some(help) => visible(help).into_owned(),
        None => "mend this, and run `kinemark grade` on the file before you hand it in".to_owned(),
    };
    [
        sentence(&format!(
            "Nothing of it could be run: {}",
            message_with_line(stopped)
        )),
        "That is why every case and every run is lost, those that you can see and the hidden ones."
            .to_owned(),
        sentence(&format!("A next step: {step}")),
    ]
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
        sentence(&format!("A next step{place}: {step}"))
    };
    once.into_iter().map(sentence).collect()
}

impl<'h> Said<'h> {
    fn new(hints: &'h Hints) -> Self {
        Self {
            hints,
            stops: Vec::new(),
            losses: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Adds what a task lost by a stop and in its hidden cases or runs, and the next step.
    fn task(&mut self, task: &ExplainedTask, record: &TaskGrade) {
        let title = visible(&task.title);
        let (stops, steps) = (self.stops.len(), self.losses.len());
        let mut checks: Vec<&str> = Vec::new();
        if let Some(stopped) = &record.stopped {
            self.stops.push(stop(&title, record, stopped));
        }
        if is_missing_function(record) {
            // nothing was called, so no case says more
        } else if task.counts {
            checks = self.classes(task, record);
        } else {
            self.stops.push(format!(
                "The hidden runs of the task \"{title}\" were not tried, because the visible run did not reach its end."
            ));
        }
        if (self.stops.len(), self.losses.len()) != (stops, steps) {
            let step = next_step(record, &checks, self.hints);
            let place = format!("\"{title}\"");
            self.steps.extend(step.map(|step| (step, place)));
        }
    }

    /// Adds what happens in the classes; those in which the same happens are one sentence. Gives the names of the checks that lose.
    fn classes<'a>(&mut self, task: &'a ExplainedTask, record: &TaskGrade) -> Vec<&'a str> {
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
        let title = visible(&task.title);
        let sentences = happened.into_iter().map(|(what, places)| {
            let places = listed(&places);
            format!("In the task \"{title}\", in {places}, {what}.")
        });
        self.losses.extend(sentences);
        checks
    }
}

/// What stopped a task, with its moment and its line. Of a hidden case or run the record has neither.
fn stop(title: &str, record: &TaskGrade, stopped: &Stopped) -> String {
    let why = message_with_line(stopped);
    let words = if is_missing_function(record) {
        format!("The task \"{title}\" earns no point, because {why}")
    } else {
        let moment = moment_of_stop(record, stopped);
        format!("In the task \"{title}\", your code fails{moment}: {why}")
    };
    sentence(&words)
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
        TaskKind::Function => wrong_answers(&listed(&judged), lost),
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

/// What is wrong with the answers to cases: too far off, or nothing to compare.
fn wrong_answers(titles: &str, lost: &[&ExplainedDraw]) -> String {
    let none = "your function gives no answer that can be compared";
    let off = format!("your answer is off by more than the full points of {titles} allow");
    let without = lost.iter().filter(|draw| has_no_answer(draw)).count();
    match without {
        0 => off,
        _ if without == lost.len() => none.to_owned(),
        _ => format!("{off}, and in some {none}"),
    }
}

/// Whether the answer to a case is missing, or not one that could be compared: what is wrong with it is then all that it says.
fn has_no_answer(draw: &ExplainedDraw) -> bool {
    let Some(case) = &draw.case else {
        return false;
    };
    let facts = draw.checks.iter().flat_map(|check| &check.evidence);
    let mut facts = facts.map(|fact| fact.message.as_str());
    facts.any(|message| message == case.answer)
}

fn loses(titles: &[String]) -> &'static str {
    match titles {
        [_] => "loses",
        _ => "lose",
    }
}

/// The next step that the student's report gives for one of the checks called `lost`, with all hints behind it, or the mistake that it
/// names.
fn next_step(record: &TaskGrade, lost: &[&str], hints: &Hints) -> Option<String> {
    if let Some(diagnosis) = record.diagnoses.first() {
        return Some(visible(&diagnosis.says).into_owned());
    }
    let stopped = record.stopped.as_ref();
    let help = stopped.and_then(|stopped| stopped.help.as_ref());
    let mut checks = record.checks.iter();
    let step = checks.find_map(|check| {
        let is_lost = lost.contains(&check.name.as_str());
        let next = check.next_step.as_ref().filter(|_| is_lost)?;
        let steps = hints.behind_next_step(&record.name, check);
        let all: Vec<&str> = [next]
            .into_iter()
            .chain(steps)
            .map(String::as_str)
            .collect();
        Some(all.join(" "))
    });
    Some(visible(&help.cloned().or(step)?).into_owned())
}

/// `a`, `a and b`, `a, b and c`.
fn listed(parts: &[String]) -> String {
    match parts {
        [parts @ .., last] if !parts.is_empty() => format!("{} and {last}", parts.join(", ")),
        parts => parts.concat(),
    }
}
