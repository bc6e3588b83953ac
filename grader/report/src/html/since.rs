//! What changed since an earlier report of the same lab: the points of each check, better and worse.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::costs::check_anchor;
use super::foreign;
use super::head::anchor;
use kinemark_grader::record::grade::{CheckGrade, Grade, GradeMode, Outcome};
use kinemark_grader::record::quantity::points;

/// What an earlier report earned; points are integer numbers of hundredths.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Earlier {
    /// What the report is called.
    pub name: String,
    /// Whether hidden cases took part.
    pub mode: GradeMode,
    /// Points earned.
    pub hundredths: i64,
    /// The checks, in the lab's order.
    pub checks: Vec<EarlierCheck>,
}

/// What one check earned.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EarlierCheck {
    /// The task's name.
    pub task: String,
    /// The check's name.
    pub check: String,
    /// Points earned.
    pub hundredths: i64,
}

fn hundredths(points: f64) -> i64 {
    (100.0 * points).round() as i64
}

impl Earlier {
    /// What the report `name` with this grade earned.
    pub fn of(name: &str, grade: &Grade) -> Self {
        let checks = grade.tasks.iter().flat_map(|task| {
            let checks = task.checks.iter().filter(|check| is_judged(check));
            checks.map(|check| EarlierCheck {
                task: task.name.clone(),
                check: check.name.clone(),
                hundredths: hundredths(check.points),
            })
        });
        Self {
            name: name.to_owned(),
            mode: grade.mode,
            hundredths: hundredths(grade.points),
            checks: checks.collect(),
        }
    }
}

/// Points of a check that waits for the hand-in are nobody's yet.
fn is_judged(check: &CheckGrade) -> bool {
    check.outcome != Outcome::AtHandIn
}

/// A check whose points changed.
struct Changed<'a> {
    title: &'a str,
    address: String,
    before: Option<i64>,
    now: i64,
}

impl Changed<'_> {
    fn change(&self) -> i64 {
        self.now - self.before.unwrap_or_default()
    }
}

/// The checks whose points changed, better ones first, each kind by how much.
fn changed<'a>(grade: &'a Grade, earlier: &Earlier) -> Vec<Changed<'a>> {
    let mut all = Vec::new();
    for (i, task) in grade.tasks.iter().enumerate() {
        for check in task.checks.iter().filter(|check| is_judged(check)) {
            let mut known = earlier.checks.iter();
            let known = known.find(|known| known.task == task.name && known.check == check.name);
            let found = Changed {
                title: &check.title,
                address: format!("#{}", check_anchor(&anchor(i), check)),
                before: known.map(|known| known.hundredths),
                now: hundredths(check.points),
            };
            if found.change() != 0 || found.before.is_none() {
                all.push(found);
            }
        }
    }
    all.sort_by_key(|found| (found.change() < 0, -found.change().abs()));
    all
}

/// The section; `has_sections` says whether the page has the checks to link to.
pub(super) fn since(grade: &Grade, earlier: &Earlier, has_sections: bool) -> Markup {
    let changed = changed(grade, earlier);
    let total = hundredths(grade.points) - earlier.hundredths;
    let shown = |hundredths: i64| points(hundredths as f64 / 100.0);
    html! {
        section id="since" aria-labelledby="since-title" {
            h2 id="since-title" { "Since the earlier report" }
            p {
                b { (shown(hundredths(grade.points))) "\u{a0}points" } ", "
                @match total {
                    0 => "as many as",
                    more if more > 0 => { (shown(more)) " more than" },
                    less => { (shown(-less)) " fewer than" },
                }
                " in " (foreign(&earlier.name)) "."
                @if earlier.mode != grade.mode {
                    " One of the two had hidden cases and the other had not, so their points do not compare exactly."
                }
            }
            @if changed.is_empty() {
                p class="quiet" { "No check earns more or less than before." }
            } @else {
                div class="wide" tabindex="0" role="group" aria-label="Checks whose points changed" {
                    table {
                        caption class="unseen" { "Checks whose points changed since the earlier report" }
                        thead { tr {
                            th scope="col" { "Check" }
                            th scope="col" class="number" { "Before" }
                            th scope="col" class="number" { "Now" }
                            th scope="col" class="number" { "Change" }
                            th scope="col" { "" span class="unseen" { "Direction" } }
                        } }
                        tbody { @for found in &changed { (row(found, has_sections)) } }
                    }
                }
            }
        }
    }
}

fn row(found: &Changed<'_>, has_sections: bool) -> Markup {
    let shown = |hundredths: i64| points(hundredths as f64 / 100.0);
    let (class, word, sign) = match (found.before, found.change()) {
        (None, _) => ("unjudged", "new check", "+"),
        (_, change) if change > 0 => ("full", "better", "+"),
        _ => ("none", "worse", "\u{2212}"),
    };
    html! {
        tr {
            th scope="row" { @if has_sections { a href=(found.address) { (foreign(found.title)) } } @else { (foreign(found.title)) } }
            td class="number" { (found.before.map_or_else(|| "–".to_owned(), shown)) }
            td class="number" { (shown(found.now)) }
            td class="number" { (sign) (shown(found.change().abs())) }
            td { span class={ "pill " (class) } { (word) } }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    #[test]
    fn what_got_better_and_worse_is_shown_and_the_rest_is_not() {
        let grade = sample::graded().grade;
        let mut earlier = Earlier::of("first try", &grade);
        let own = |grade: &Grade| since(grade, &earlier, true).into_string();
        assert!(
            own(&grade).contains("No check earns more or less"),
            "the same"
        );
        let last = earlier.checks.len() - 1;
        earlier.checks[0].hundredths -= 150;
        earlier.checks[last].hundredths += 25;
        earlier.hundredths -= 125;
        let shown = since(&grade, &earlier, true).into_string();
        assert_eq!(shown.matches("<tr>").count(), 3, "{shown}");
        for part in [
            "1.25 more than",
            "<bdi>first try</bdi>",
            ">+1.5<",
            ">\u{2212}0.25<",
        ] {
            assert!(shown.contains(part), "{part}: {shown}");
        }
        let better = shown.find(">better<").expect("better");
        assert!(
            better < shown.find(">worse<").expect("worse"),
            "better first"
        );
        assert!(shown.contains("href=\"#task-1-check-"), "{shown}");
        assert!(
            !since(&grade, &earlier, false)
                .into_string()
                .contains("href")
        );
    }

    #[test]
    fn a_new_check_and_another_mode_are_said() {
        let grade = sample::graded().grade;
        let mut earlier = Earlier::of("<b>", &grade);
        earlier.checks.remove(0);
        earlier.mode = match grade.mode {
            GradeMode::Practice => GradeMode::Graded,
            GradeMode::Graded => GradeMode::Practice,
        };
        let shown = since(&grade, &earlier, true).into_string();
        assert!(shown.contains("new check") && shown.contains("do not compare exactly"));
        assert!(!shown.contains("<b></bdi>") && shown.contains("&lt;b&gt;"));
    }

    #[test]
    fn what_is_kept_of_an_earlier_report_is_read_back_as_it_was() {
        let earlier = Earlier::of("a", &sample::graded().grade);
        let text = serde_json::to_string(&earlier).unwrap();
        assert_eq!(serde_json::from_str::<Earlier>(&text).unwrap(), earlier);
    }
}
