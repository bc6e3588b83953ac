//! The cases of a function task as sketches of the arm, and numbers of wrong answers beside the right ones.

use maud::{Markup, PreEscaped, html};

use super::foreign;
use crate::plot::{case_legend, case_picture};
use crate::visible::{shortened, visible};
use kinemark_grader::record::grade::CaseGrade;
use kinemark_grader::record::quantity::with_unit;
use kinemark_grader::record::shown_case::{
    BranchCount, ComparedNumber, ComparedNumbers, ShownCase, ShownCases, ShownPlaces,
};
use kinemark_sim::text::number::trimmed;

/// Sketches of a task, and cases of it whose numbers are written out.
const MOST: usize = 6;
/// An answer that is wrong and no farther off than this is wrong in something else than its place \[m\].
const NOT_OFF_M: f64 = 1e-6;
/// Numbers of an entry that are written out.
const MOST_NUMBERS: usize = 64;

/// What can be drawn of the cases; nothing where they have neither places nor wrong numbers.
pub(super) fn drawn_cases(shown: &ShownCases, cases: &[CaseGrade]) -> Markup {
    let cases_of_places = shown.cases.iter();
    let cases_of_places = cases_of_places.filter_map(|case| Some((case, case.places.as_ref()?)));
    let sketched: Vec<(&ShownCase, &ShownPlaces)> = cases_of_places.take(MOST).collect();
    let numbers = shown.cases.iter().filter(|case| !case.numbers.is_empty());
    let numbers: Vec<&ShownCase> = numbers.take(MOST).collect();
    let legend = case_legend(sketched.iter().map(|(_, places)| *places));
    html! {
        @if !sketched.is_empty() {
            ul class="legend" aria-hidden="true" { @for (swatch, words) in &legend { li { (PreEscaped(swatch)) (words) } } }
            ul class="sketches" {
                @for (case, places) in &sketched { li { (sketch(case, places, cases)) } }
            }
        }
        @if !numbers.is_empty() {
            p class="quiet" { "Numbers of answers: crossed out what is wrong, below it what is right." }
            div class="entries" {
                @for case in numbers {
                    @for numbers in case.numbers.iter().filter(|numbers| numbers.numbers.iter().any(|number| !number.is_right)) {
                        (compared(&case.name, numbers))
                    }
                }
            }
        }
    }
}

fn sketch(case: &ShownCase, places: &ShownPlaces, cases: &[CaseGrade]) -> Markup {
    let svg = case_picture(&spoken(case, places), places);
    let (head, rest) = svg.split_once("<style>").unwrap_or((&svg, ""));
    let (_, tail) = rest.split_once("</style>").unwrap_or(("", rest));
    let off_m = cases
        .iter()
        .find(|known| known.name == case.name)
        .and_then(|known| known.error_m);
    html! {
        figure {
            (PreEscaped(head)) (PreEscaped(tail))
            figcaption {
                b { (foreign(&shortened(&case.name, 40))) } " "
                @if let Some((found, all)) = partly(places).filter(|_| case.is_good) {
                    span class="pill partial" { (found) " of " (all) " branches" }
                } @else if case.is_good {
                    span class="pill full" { "right" }
                    @if places.is_out_of_reach() { " nothing reaches it" }
                } @else {
                    span class="pill none" { "wrong" }
                    @if off_m.is_some_and(|off_m| off_m < NOT_OFF_M) { " though the place is right" }
                    @else if let Some(off_m) = off_m { " " (with_unit(off_m, "m")) " off" }
                    @else if places.answered.is_empty() { " no place was answered" }
                }
            }
        }
    }
}

/// How many right branches were answered, and how many there are, where some are missing.
fn partly(places: &ShownPlaces) -> Option<(u32, u32)> {
    let BranchCount { found, all } = places.branches?;
    (found < all).then_some((found, all))
}

/// A sketch in words.
fn spoken(case: &ShownCase, places: &ShownPlaces) -> String {
    let at = |p: &[f64; 3]| {
        let numbers: Vec<String> = p.iter().map(|x| trimmed(*x, 3)).collect();
        format!("({}) m", numbers.join(", "))
    };
    let answers = places.answered.iter().take(3).map(|place| at(&place.tcp_m));
    let answers: Vec<String> = answers.collect();
    let answers = match answers.as_slice() {
        [] => "nowhere".to_owned(),
        answers => answers.join(" and "),
    };
    let name = visible(&case.name);
    if places.is_out_of_reach() {
        let target = at(&places.right_m);
        return format!("{name}: nothing reaches {target}, the answer puts the TCP at {answers}");
    }
    match places.arm_m.is_empty() {
        true => format!(
            "{name}: the TCP should be at {}, the answer puts it at {answers}",
            at(&places.right_m)
        ),
        false => format!(
            "{name}: the TCP is at {}, the answer says {answers}",
            at(&places.right_m)
        ),
    }
}

/// The numbers of an answer in their rows; below a wrong one the right one.
fn compared(case: &str, numbers: &ComparedNumbers) -> Markup {
    let rows = numbers.numbers.len().min(MOST_NUMBERS);
    let title = match numbers.name.as_str() {
        "" => visible(case).into_owned(),
        name => format!("{}, {}", visible(case), visible(name)),
    };
    html! {
        div class="wide" tabindex="0" role="group" aria-label={ "Answer in " (title) } {
            table {
                caption { (foreign(&title)) }
                tbody {
                    @for row in numbers.numbers[..rows].chunks(numbers.columns) {
                        tr { @for number in row { (cell(number)) } }
                    }
                }
            }
        }
    }
}

fn cell(number: &ComparedNumber) -> Markup {
    let text = |x: f64| trimmed(x, 4);
    html! {
        @if number.is_right {
            td class="number" { (text(number.answered)) }
        } @else {
            td class="number wrong" {
                s { (text(number.answered)) }
                " " b { (text(number.right)) }
            }
        }
    }
}
