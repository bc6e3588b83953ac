//! After full marks: a card in place of "look here first", the run in pictures, and figures that can still be better and earn nothing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

use super::foreign;
use super::viewer::seek;
use crate::storyboard::storyboard;
use kinemark_grader::record::grade::{Grade, GradeMode, TaskGrade};
use kinemark_grader::record::graded::{GradedRun, TaskRun};
use kinemark_grader::record::run_figures::RunFigures;
use kinemark_grader::record::verdict::Verdict;

/// The anchor of [`beyond`].
const BEYOND: &str = "beyond";

/// Whether there is nothing left to earn.
pub(super) fn has_full_marks(grade: &Grade) -> bool {
    grade.verdict == Verdict::Passed
}

/// The card at the top of a page with full marks.
pub(super) fn success(grade: &Grade, has_replay: impl Fn(usize) -> bool) -> Markup {
    let last = grade.tasks.iter().enumerate().rev();
    let mut replayed = last.filter(|(i, _)| has_replay(*i));
    html! {
        div class="note good look" role="region" aria-labelledby="look-title" {
            h2 id="look-title" { "Full marks" }
            @if grade.mode == GradeMode::Practice { p { code { "kinemark submit" } " writes the file to hand in." } }
            @if let Some((_, task)) = replayed.next() {
                p class="go" { (seek(&task.name, 0.0, &format!("Watch {}", task.name))) }
            }
            @if figures(grade).next().is_some() {
                p class="go" { a href={ "#" (BEYOND) } { "What could still be better" } }
            }
        }
    }
}

/// The tasks with figures.
fn figures(grade: &Grade) -> impl Iterator<Item = (&TaskGrade, RunFigures)> {
    let tasks = grade.tasks.iter();
    tasks.filter_map(|task| Some((task, task.figures?)))
}

/// The section after full marks; nothing on other pages. Pictures are for students who practise: a class has too many pages for them.
/// Where the tasks have their `chapters`, those are the pictures.
pub(super) fn beyond(graded: &GradedRun, has_chapters: bool) -> Markup {
    let grade = &graded.grade;
    if !has_full_marks(grade) || figures(grade).next().is_none() {
        return html! {};
    }
    let drawn = match grade.mode {
        GradeMode::Practice if !has_chapters => graded.runs.last(),
        GradeMode::Practice | GradeMode::Graded => None,
    };
    let task = drawn.and_then(|run| grade.tasks.iter().find(|task| task.name == run.task));
    html! {
        section id=(BEYOND) aria-labelledby="beyond-title" tabindex="-1" {
            h2 id="beyond-title" { "Beyond full marks" }
            @if let (Some(run), Some(task)) = (drawn, task) { (picture(run, task)) }
            p { "What your runs took. It is worth no points, and lower is better: " code { "kinemark grade" } " in your folder shows your own best beside it." }
            div class="wide" tabindex="0" role="group" aria-label="Figures of the runs" {
                table {
                    caption class="unseen" { "Figures of the runs that earned all points" }
                    thead { tr {
                        th scope="col" { "Task" }
                        th scope="col" class="number" { "At rest after" }
                        th scope="col" class="number" { "Work of the motors" }
                        th scope="col" class="number" { "Peak effort" }
                        th scope="col" class="number" { "Jerk of the TCP" }
                    } }
                    tbody {
                        @for (task, figures) in figures(grade) {
                            tr {
                                th scope="row" { (foreign(&task.title)) }
                                @for wanted in ["at-rest", "work", "peak-effort", "jerk"] {
                                    td class="number" { (shown(&figures, wanted)) }
                                }
                            }
                        }
                    }
                }
            }
            p class="quiet" { "Jerk is how suddenly the acceleration changes: its root mean square over the run, from the positions at every call of control. Work counts every motor that pushes or brakes." }
        }
    }
}

fn shown(figures: &RunFigures, wanted: &str) -> String {
    let all = figures.named();
    let found = all.iter().find(|(name, ..)| *name == wanted);
    found.map_or_else(
        || "–".to_owned(),
        |(_, _, value, unit)| RunFigures::shown(*value, unit),
    )
}

/// The storyboard of a run as a picture of its own: its names and styles reach nothing else of the page.
fn picture(run: &TaskRun, task: &TaskGrade) -> Markup {
    let svg = STANDARD.encode(storyboard(run, task));
    html! {
        figure class="board" {
            img src={ "data:image/svg+xml;base64," (svg) } alt={ "Six moments of the run of " (task.name) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    /// The sample as if all of it were right.
    fn passed(mode: GradeMode) -> GradedRun {
        let mut graded = sample::graded();
        graded.grade.verdict = Verdict::Passed;
        graded.grade.mode = mode;
        for task in &mut graded.grade.tasks {
            let run = graded.runs.iter().find(|run| run.task == task.name);
            task.figures = run.and_then(|run| RunFigures::of(&run.trace, 10, &run.effort_limits));
        }
        graded
    }

    #[test]
    fn full_marks_show_the_run_and_what_it_took() {
        let graded = passed(GradeMode::Practice);
        let section = beyond(&graded, false).into_string();
        for part in [
            "Beyond full marks",
            "data:image/svg+xml;base64,",
            " J</td>",
            "of the limit",
            "m/s³",
        ] {
            assert!(section.contains(part), "{part}: {section}");
        }
        let card = success(&graded.grade, |_| true).into_string();
        assert!(
            card.contains("Full marks") && card.contains("href=\"#beyond\""),
            "{card}"
        );
    }

    #[test]
    fn chapters_of_the_tasks_are_not_repeated() {
        let section = beyond(&passed(GradeMode::Practice), true).into_string();
        assert!(section.contains("Beyond full marks") && !section.contains("data:image"));
    }

    #[test]
    fn a_class_has_the_figures_without_pictures() {
        let section = beyond(&passed(GradeMode::Graded), false).into_string();
        assert!(section.contains("Beyond full marks"), "{section}");
        assert!(!section.contains("data:image"), "{section}");
    }

    #[test]
    fn lost_points_show_nothing_of_it() {
        let mut graded = passed(GradeMode::Practice);
        graded.grade.verdict = Verdict::Missed;
        assert!(beyond(&graded, false).into_string().is_empty());
        assert!(!has_full_marks(&graded.grade));
    }
}
