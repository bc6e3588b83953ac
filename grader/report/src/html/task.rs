//! One task: what stopped it, what the mistake may be, every check with its evidence, cases, plots, and what was printed.

use maud::{Markup, html};

use super::band::{gauge, outcome, told};
use super::figure::figure;
use super::head::{anchor, earned, meaning, verdict};
use super::viewer::{place, seek};
use super::{foreign, prose};
use crate::moment::{FirstLoss, first_loss_of, last_before};
use crate::plot::Plot;
use crate::standing::stands;
use crate::text::untold;
use crate::visible::{file_stem, shortened, visible};
use kinemark_grader::record::grade::{
    CaseGrade, CheckGrade, ContactRecord, Diagnosis, Divergence, EventRecord, Evidence,
    HiddenClass, LogEntry, Outcome, Stopped, TaskGrade, TaskKind,
};
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::seconds;
use kinemark_grader::record::quantity::with_unit;
use kinemark_grader::record::verdict::Verdict;

/// Lines of the log that are shown.
const MOST_LINES: usize = 200;
/// Characters of a line that are shown.
const MOST_CHARACTERS: usize = 1000;
/// Cases that are shown.
const MOST_CASES: usize = 200;

/// The section of a task.
pub(super) fn section(
    index: usize,
    task: &TaskGrade,
    run: Option<(&TaskRun, &[Plot])>,
    has_replay: bool,
) -> Markup {
    let id = anchor(index);
    let plots = run.map_or(&[][..], |(_, plots)| plots);
    let of = Of {
        name: &task.name,
        kind: task.kind,
        run: run.map(|(run, _)| run),
        has_replay,
        stopped: task.stopped.is_some(),
    };
    let passed = task.verdict == Verdict::Passed;
    html! {
        section class="task" id=(id) data-task=(visible(&task.name)) aria-labelledby={ (id) "-title" } {
            div class="title" id={ "task=" (visible(&task.name)) } {
                h2 id={ (id) "-title" } { (foreign(&task.title)) }
                p { (verdict(task.verdict)) " " (earned(task.points, task.max_points)) }
            }
            p class="lead" { (meaning(task.verdict, task.checks.iter())) }
            @if let Some(loss) = first_loss_of(task) { (first_lost(&loss, &of)) }
            @if let Some(stop) = &task.stopped { (stopped(stop, &of)) }
            @for diagnosis in &task.diagnoses { (diagnosed(diagnosis, task.kind)) }
            @if has_replay { (place(index, &task.name)) }
            // a task without a mistake is read by who wants to know more
            @if passed {
                details class="more" { summary { (contents(task, plots)) } (told_of(&id, task, plots, &of)) }
            } @else {
                (told_of(&id, task, plots, &of))
            }
        }
    }
}

/// What is folded away of a task without a mistake.
fn contents(task: &TaskGrade, plots: &[Plot]) -> String {
    let all = [
        (!task.checks.is_empty(), "checks"),
        (!task.cases.is_empty(), "cases"),
        (!plots.is_empty(), "plots"),
        (
            !(task.events.is_empty() && task.contacts.is_empty()),
            "what happened",
        ),
        (!task.log.is_empty(), "printed lines"),
    ];
    let parts: Vec<&str> = all
        .into_iter()
        .filter_map(|(is_there, part)| is_there.then_some(part))
        .collect();
    let text = match parts.as_slice() {
        [parts @ .., last] if !parts.is_empty() => format!("{} and {last}", parts.join(", ")),
        parts => parts.concat(),
    };
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => "More".to_owned(),
    }
}

/// What is told of a task below its replay: checks, those that lost points first and each with the picture of what it judged; then
/// cases, hidden ones, the other pictures, and what happened.
fn told_of(id: &str, task: &TaskGrade, plots: &[Plot], of: &Of<'_>) -> Markup {
    let (full, lost): (Vec<&CheckGrade>, Vec<&CheckGrade>) = task
        .checks
        .iter()
        .partition(|check| check.outcome == Outcome::Full);
    let judged = |check: &CheckGrade| {
        let name = format!("{}-check-{}", file_stem(&task.name), file_stem(&check.name));
        plots.iter().find(|plot| plot.name == name)
    };
    let beside: Vec<&Plot> = lost.iter().filter_map(|check| judged(check)).collect();
    let others = || plots.iter().filter(|plot| !beside.contains(plot));
    let has_others = others().next().is_some();
    html! {
        @if let Some(differs) = &task.divergence { (differing(differs, of)) }
        @if !task.checks.is_empty() { h3 { "Checks" } }
        @if !lost.is_empty() {
            ul class="checks" { @for check in &lost { li { (checked(check, judged(check), id, of)) } } }
        }
        @if !full.is_empty() {
            @let list = html! { ul class="checks" { @for check in &full { li { (checked(check, None, id, of)) } } } };
            @if lost.is_empty() {
                (list)
            } @else {
                details class="more" {
                    summary { @if full.len() == 1 { "1 check" } @else { (full.len()) " checks" } " with all points" }
                    (list)
                }
            }
        }
        @if !task.cases.is_empty() { (cases(&task.cases)) }
        @if !task.hidden.is_empty() { (hidden(id, task)) }
        @if has_others {
            h3 { "Plots" }
            div class="plots" { @for plot in others() { (figure(plot, &task.name)) } }
        }
        @if !task.events.is_empty() { (events(&task.events, of)) }
        @if !task.contacts.is_empty() { (contacts(&task.contacts, of)) }
        @if !task.log.is_empty() { (log(task, of)) }
    }
}

/// The task that something is told of.
struct Of<'a> {
    name: &'a str,
    kind: TaskKind,
    run: Option<&'a TaskRun>,
    has_replay: bool,
    /// Whether something stopped the submission.
    stopped: bool,
}

impl Of<'_> {
    /// Words that lead to a moment, where there is a replay to lead to.
    fn moment(&self, time_s: f64, words: &str) -> Markup {
        if self.has_replay {
            seek(self.name, time_s, words)
        } else {
            html! { (words) }
        }
    }

    /// A tick as its time, where that is known.
    fn tick(&self, tick: u64) -> Markup {
        match self.run {
            Some(run) => {
                let time_s = tick as f64 * run.trace.step_s;
                self.moment(time_s, &format!("{time_s:.3} s"))
            }
            None => html! { "tick " (tick) },
        }
    }
}

/// The moment at which the first points were lost, and the check; a stop has a note of its own.
fn first_lost(loss: &FirstLoss<'_>, of: &Of<'_>) -> Markup {
    html! {
        @if let (Some(at), Some(check)) = (loss.at, loss.check) {
            p class="quiet" { "The first points were lost at " (of.moment(at.time_s, &seconds(at.time_s))) ": " (foreign(&check.title)) "." }
        }
    }
}

/// What stopped the submission, with the line it happened in.
fn stopped(stop: &Stopped, of: &Of<'_>) -> Markup {
    html! {
        div class="note bad" {
            h3 { "What stopped it" }
            p { (prose(&stop.message)) }
            p class="where" {
                @if let Some(line) = stop.line {
                    span { "line " (line) @if let Some(column) = stop.column { ", column " (column) } }
                }
                @if let Some(t_s) = stop.time_s {
                    // what is shown ends with the tick before
                    span { "at " @match last_before(stop) { Some(last) => (of.moment(last.time_s, &seconds(t_s))), None => (seconds(t_s)) } }
                }
                @if let Some(tick) = stop.tick { span { "tick " (tick) } }
                @if let Some(case) = &stop.case { span { "case " (foreign(case)) } }
            }
            @if let Some(line) = &stop.source_line { (pointed(line, stop.line, stop.column)) }
            @if let Some(help) = &stop.help { p class="next" { strong { "Next: " } (prose(help)) } }
        }
    }
}

/// A line of the submission with a caret under the column. What is written out in the line moves the caret along with it.
fn pointed(line: &str, number: Option<usize>, column: Option<usize>) -> Markup {
    let before: String = line
        .chars()
        .take(column.unwrap_or(1).saturating_sub(1))
        .collect();
    // a long line is shown from shortly before the column
    let skipped = before.chars().count().saturating_sub(60);
    let shown: String = line.chars().skip(skipped).take(160).collect();
    let indent: String = before.chars().skip(skipped).collect();
    let number = number.map(|number| number.to_string()).unwrap_or_default();
    let gutter = " ".repeat(number.len());
    let lead = if skipped > 0 { "…" } else { "" };
    let tail = if line.chars().count() > skipped + 160 {
        "…"
    } else {
        ""
    };
    let spaces = " ".repeat(visible(&indent).chars().count() + lead.chars().count());
    html! {
        pre class="code" tabindex="0" {
            span class="gutter" { (number) " │ " } code { (lead) (visible(&shown)) (tail) }
            @if column.is_some() { "\n" span class="gutter" aria-hidden="true" { (gutter) " │ " } span class="caret" aria-hidden="true" { (spaces) "^" } }
        }
    }
}

fn diagnosed(diagnosis: &Diagnosis, kind: TaskKind) -> Markup {
    let told_by = match kind {
        TaskKind::Function => "answers in",
        TaskKind::Motion => "moments at",
    };
    html! {
        div class="note hint" {
            h3 { "It looks like this" }
            p { (prose(&diagnosis.says)) }
            p class="where" {
                span { (diagnosis.agreeing) " of the " (diagnosis.telling) " " (told_by) " which this mistake would show agree with it" }
            }
        }
    }
}

/// Where to look first; no statement that anything is wrong there.
fn differing(differs: &Divergence, of: &Of<'_>) -> Markup {
    html! {
        div class="note hint" {
            h3 { "Where it first differs" }
            p { (prose(&differs.message)) }
            p class="where" {
                span { "at " (of.moment(differs.time_s, &seconds(differs.time_s))) }
                span { "tick " (differs.tick) }
                span { "signal " code { (foreign(&differs.signal)) } }
                span { "less than " (visible(&with_unit(differs.tolerance, &differs.unit))) " apart counts as the same" }
            }
            p { "This is where to look first, and no mistake by itself: another path, or another time, may be as right." }
        }
    }
}

/// A check, with the picture of what it judged beside it.
fn checked(check: &CheckGrade, plot: Option<&Plot>, id: &str, of: &Of<'_>) -> Markup {
    let is_hidden = |fact: &&Evidence| of.kind == TaskKind::Motion && is_of_hidden_run(fact);
    let told: Vec<&Evidence> = check
        .evidence
        .iter()
        .filter(|fact| !is_hidden(fact))
        .collect();
    let hides = told.len() < check.evidence.len();
    let visible = !told.is_empty();
    html! {
        article class=(if plot.is_some() { "check pictured" } else { "check" }) {
            div class="title" {
                h4 { (foreign(&check.title)) }
                p { (outcome(check)) " " (earned(check.points, check.max_points)) }
            }
            div class="told" {
                @if let Some(measure) = &check.measure {
                    @let told = self::told(measure);
                    div class="measure" {
                        p {
                            (prose(&measure.quantity)) ": " b { (told.value) }
                            @if let Some(margin) = told.margin { ", " (margin) }
                            br; small { (told.band) }
                        }
                        (gauge(measure))
                    }
                } @else if check.outcome == Outcome::NotJudged {
                    p class="quiet" {
                        "Not judged: "
                        @if of.stopped { "the submission was stopped before." }
                        @else if check.next_step.is_some() { "a check that it needs earned nothing." }
                        @else { "nothing is decided." }
                    }
                }
                @if !told.is_empty() {
                    ul class="evidence" { @for fact in told { li { (evidence(fact, of)) } } }
                }
                @if hides { p class="where" { a href={ "#" (id) "-hidden" } { "Points were lost in hidden runs" @if visible { ", too" } } } }
                @if let Some(next) = &check.next_step { p class="next" { strong { "Next: " } (prose(next)) } }
            }
            @if let Some(first) = untold(check) {
                p class="where" { span { "points are lost from " (of.moment(first.time_s, &seconds(first.time_s))) " on" } span { "tick " (first.tick) } }
            }
            @if let Some(plot) = plot { div class="plots" { (figure(plot, of.name)) } }
        }
    }
}

/// Whether a fact of a motion task tells of hidden runs, by their class.
fn is_of_hidden_run(fact: &Evidence) -> bool {
    fact.tick.is_none() && fact.case.is_some()
}

fn evidence(fact: &Evidence, of: &Of<'_>) -> Markup {
    html! {
        p { (prose(&fact.message)) }
        p class="where" {
            @if let Some(t_s) = fact.time_s { span { "at " (of.moment(t_s, &seconds(t_s))) } }
            @if let Some(tick) = fact.tick { span { "tick " (tick) } }
            @if let Some(run) = &fact.run { span { "run " (foreign(run)) } }
            @if let Some(case) = &fact.case { span { "case " (foreign(case)) } }
            @if !fact.signal.is_empty() { span { "signal " code { (foreign(&fact.signal)) } } }
            @if let Some(value) = fact.value { span { "value " (visible(&with_unit(value, &fact.unit))) } }
            @if let Some(limit) = fact.limit { span { "limit " (visible(&with_unit(limit, &fact.unit))) } }
        }
    }
}

fn cases(cases: &[CaseGrade]) -> Markup {
    let tells = cases.iter().any(|case| case.expected.is_some());
    html! {
        h3 { "Visible cases" }
        div class="wide" tabindex="0" role="group" aria-label="Visible cases" {
            table class="cases" {
                thead {
                    tr {
                        th scope="col" { "Case" }
                        th scope="col" { "Given" }
                        th scope="col" { "Your answer" }
                        @if tells { th scope="col" { "Expected" } }
                        th scope="col" class="number" { "Error" }
                        th scope="col" { "Good" }
                    }
                }
                tbody {
                    @for case in cases.iter().take(MOST_CASES) {
                        tr {
                            th scope="row" { (foreign(&case.name)) }
                            td { code { (foreign(&shortened(&case.given, 300))) } }
                            td { code { (foreign(&shortened(&case.answer, 300))) } }
                            @if tells { td { @if let Some(expected) = &case.expected { code { (foreign(&shortened(expected, 300))) } } } }
                            td class="number" { @match (case.error_m, case.relative_error) { (Some(error_m), _) => (with_unit(error_m, "m")), (_, Some(relative)) => (with_unit(relative, "")), _ => "–" } }
                            td { @if case.good { span class="pill full" { "yes" } } @else { span class="pill none" { "no" } } }
                        }
                    }
                }
            }
        }
        @if cases.len() > MOST_CASES { p class="quiet" { "The first " (MOST_CASES) " of " (cases.len()) " cases." } }
    }
}

/// Hidden cases or runs by class: only their number is told, and of runs the checks that lost points in them.
fn hidden(id: &str, task: &TaskGrade) -> Markup {
    let what = match task.kind {
        TaskKind::Function => "Hidden cases",
        TaskKind::Motion => "Hidden runs",
    };
    let lost_in = |class: &HiddenClass| -> Vec<&str> {
        let lost = task.checks.iter().filter(|check| {
            let mut facts = check.evidence.iter();
            facts.any(|fact| is_of_hidden_run(fact) && fact.case.as_ref() == Some(&class.class))
        });
        lost.map(|check| check.title.as_str()).collect()
    };
    let tells =
        task.kind == TaskKind::Motion && task.hidden.iter().any(|class| !lost_in(class).is_empty());
    html! {
        h3 id={ (id) "-hidden" } { (what) }
        div class="wide" tabindex="0" role="group" aria-label=(what) {
            table class="hidden" {
                thead {
                    tr {
                        th scope="col" { "Class" }
                        th scope="col" class="number" { "Good" }
                        th scope="col" class="number" { "Of" }
                        @if tells { th scope="col" { "Points lost by" } }
                    }
                }
                tbody {
                    @for class in &task.hidden {
                        tr {
                            th scope="row" { (foreign(&class.class)) }
                            td class="number" { (class.good) }
                            td class="number" { (class.total) }
                            @if tells { td { (foreign(&lost_in(class).join("; "))) } }
                        }
                    }
                }
            }
        }
    }
}

fn events(events: &[EventRecord], of: &Of<'_>) -> Markup {
    // what stood on another before the arm moved is no news; it is told below
    let resting: Vec<(u64, String)> = of.run.map_or_else(Vec::new, |run| {
        let names = run.names();
        let standing = run
            .trace
            .events
            .iter()
            .filter(|event| stands(&event.kind, event.tick, run));
        standing
            .map(|event| (event.tick, names.event(&event.kind)))
            .collect()
    });
    let rests = |event: &&EventRecord| {
        let mut resting = resting.iter();
        resting.any(|(tick, words)| *tick == event.tick && *words == event.message)
    };
    let (resting, news): (Vec<_>, Vec<_>) = events.iter().partition(rests);
    html! {
        details class="log" {
            summary { "What happened: " (news.len()) @if news.len() == 1 { " event" } @else { " events" } }
            div class="wide" tabindex="0" role="group" aria-label="Events" {
                table {
                    thead { tr { th scope="col" class="number" { "At" } th scope="col" { "Event" } th scope="col" { "What" } } }
                    tbody {
                        @for event in news {
                            tr {
                                td class="number" { (of.moment(event.time_s, &format!("{:.3} s", event.time_s))) }
                                td { (visible(&event.event)) }
                                td { (prose(&event.message)) }
                            }
                        }
                    }
                }
            }
            @if !resting.is_empty() {
                p class="quiet" {
                    "Before anything moved: "
                    @for (i, event) in resting.iter().enumerate() { @if i > 0 { "; " } (prose(&event.message)) }
                    "."
                }
            }
        }
    }
}

fn contacts(contacts: &[ContactRecord], of: &Of<'_>) -> Markup {
    // those of the arm first, each in the order of time
    let is_link = |name: &String| {
        let mut links = of.run.into_iter().flat_map(|run| run.robot.links());
        links.any(|link| link.name == *name)
    };
    let mut contacts: Vec<&ContactRecord> = contacts.iter().collect();
    contacts.sort_by_key(|contact| !contact.parties.iter().any(is_link));
    html! {
        details class="log" {
            summary { "Contact: " (contacts.len()) @if contacts.len() == 1 { " time" } @else { " times" } }
            div class="wide" tabindex="0" role="group" aria-label="Contacts" {
                table {
                    thead {
                        tr {
                            th scope="col" { "Between" }
                            th scope="col" class="number" { "From" }
                            th scope="col" class="number" { "Until" }
                            th scope="col" class="number" { "Peak force" }
                            th scope="col" class="number" { "Impulse" }
                        }
                    }
                    tbody {
                        @for contact in contacts {
                            tr {
                                th scope="row" { (foreign(&contact.parties[0])) " and " (foreign(&contact.parties[1])) }
                                td class="number" { (of.tick(contact.first_tick)) }
                                td class="number" { (of.tick(contact.last_tick)) }
                                td class="number" { (format!("{:.3} N", contact.peak_force_n)) }
                                td class="number" { (format!("{:.4} N s", contact.impulse_n_s)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn log(task: &TaskGrade, of: &Of<'_>) -> Markup {
    let all = of
        .run
        .map_or(0, |run| run.trace.log.len())
        .max(task.log.len());
    let shown = task.log.len().min(MOST_LINES);
    let at = |entry: &LogEntry| match of.kind {
        TaskKind::Motion => of.tick(entry.at),
        TaskKind::Function => html! { "case " (entry.at) },
    };
    html! {
        details class="log" {
            summary {
                "Printed by the submission: " (all) @if all == 1 { " line" } @else { " lines" }
                @if all > shown { ", the first " (shown) " shown" }
            }
            div class="wide" tabindex="0" role="group" aria-label="Printed lines" {
                table {
                    thead { tr { th scope="col" class="number" { "At" } th scope="col" { "Text" } } }
                    tbody {
                        @for entry in task.log.iter().take(MOST_LINES) {
                            tr { td class="number" { (at(entry)) } td { code { (foreign(&shortened(&entry.text, MOST_CHARACTERS))) } } }
                        }
                    }
                }
            }
        }
    }
}
