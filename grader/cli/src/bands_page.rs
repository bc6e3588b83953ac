//! The bands of a lab as a page: each with what the reference solution reaches over the variants, and what the mutants reach. A person
//! chooses a band from it.

use kinemark_grader::audit::{Audit, BandValues, Difficulty, Reached};
use kinemark_grader::record::quantity::{points, with_unit};
use maud::{Markup, html};

use kinemark_report::html::{StaticPage, foreign, prose};
use kinemark_report::visible::visible;

/// What the page shows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BandsPage<'a> {
    /// The engine that made it.
    pub(crate) engine: &'a str,
    /// What was tried.
    pub(crate) audit: &'a Audit,
}

const CSS: &str = ".band{border-top:1px solid var(--line);padding:1rem 0}.band:first-of-type{border-top:0}.band .title h3{margin:0}\
    .lanes{display:block;width:100%;max-width:60rem;height:auto;margin:.5rem 0;font:12px system-ui,sans-serif}\
    .lanes text{fill:var(--muted)}.lanes .name{fill:var(--ink)}\
    .lanes .is-full{fill:var(--full-bg)}.lanes .is-partial{fill:var(--partial-bg)}.lanes .is-none{fill:var(--none-bg)}\
    .lanes .edge{stroke:var(--muted);stroke-width:1}.lanes .variant{fill:var(--link);opacity:.35}\
    .lanes .own{fill:var(--link);stroke:var(--paper);stroke-width:1}.lanes .loses{fill:var(--none);opacity:.75}\
    .lanes .keeps{fill:none;stroke:var(--full);stroke-width:1.5}.lanes .hidden{fill:none;stroke:var(--none);stroke-width:1.5}.lanes .nearest{stroke:var(--ink);stroke-width:1.5}\
    .reach td,.reach th{font-size:.9rem;padding-top:.25rem;padding-bottom:.25rem}.problems li{margin-top:.5rem;white-space:pre-wrap}\
    .harder{display:block;width:100%;max-width:60rem;height:auto;font:12px system-ui,sans-serif}.harder text{fill:var(--muted)}\
    .harder circle{fill:var(--link);opacity:.5}.harder line{stroke:var(--line)}details table{margin-top:.5rem}";

/// Where a plot begins, and how wide it is \[units of the picture\].
const LEFT: f64 = 110.0;
const WIDTH: f64 = 780.0;
/// What is further inside than so many widths of the band, or further outside, is drawn at the edge.
const MOST_INSIDE: f64 = 1.5;
const OUTSIDE: f64 = 1.6;

impl BandsPage<'_> {
    /// The page. It asks nothing of the network; the same audit gives the same bytes.
    pub(crate) fn html(&self) -> String {
        let audit = self.audit;
        let title = format!("Bands of {}", audit.lab);
        let body = html! {
            header class="head" {
                p class="eyebrow" { "Kinemark · course staff" }
                h1 { (foreign(&title)) }
                p class="by" { (self.summary()) }
            }
            main {
                (self.problems())
                (legend())
                @for task in tasks(audit) {
                    section {
                        h2 { (foreign(task)) }
                        @for band in audit.bands.iter().filter(|band| band.task == task) { (section(band)) }
                    }
                }
                @if let Some(difficulty) = &audit.difficulty { (variants(difficulty)) }
            }
            footer {
                p class="quiet" { "Made by " (foreign(self.engine)) ". It shows what is hidden from students." }
            }
        };
        let page = StaticPage {
            title: &title,
            engine: self.engine,
            css: CSS,
            script: None,
        };
        page.around(&body)
    }

    fn summary(&self) -> String {
        let audit = self.audit;
        let problems = match audit.problems().count() {
            0 => "nothing is wrong".to_owned(),
            1 => "1 problem".to_owned(),
            count => format!("{count} problems"),
        };
        let left_out = match audit.left_out.is_empty() {
            true => String::new(),
            false => format!("; not looked at: {}", audit.left_out.join("; ")),
        };
        format!(
            "{} points; {} tried, {problems}{left_out}",
            points(audit.max_points),
            audit.rows.len()
        )
    }

    fn problems(&self) -> Markup {
        html! {
            @if self.audit.problems().next().is_some() {
                section {
                    h2 { "Problems" }
                    ul class="problems" {
                        @for row in self.audit.problems() {
                            li {
                                b { (row.tried.name()) " " (foreign(&row.name)) " " (foreign(row.task.as_deref().unwrap_or_default())) }
                                " " (foreign(row.problem.as_deref().unwrap_or_default()))
                                @if let Some(help) = &row.help { " " span class="quiet" { (foreign(help)) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The tasks that have bands, in the lab's order.
fn tasks(audit: &Audit) -> Vec<&str> {
    let mut tasks: Vec<&str> = Vec::new();
    for band in &audit.bands {
        if !tasks.contains(&&band.task[..]) {
            tasks.push(&band.task);
        }
    }
    tasks
}

fn legend() -> Markup {
    html! {
        section {
            h2 { "How to read it" }
            p {
                "A strip is a band: green earns all points, yellow some, red none. Above it stands what the reference solution reaches, a dot for \
                 each variant and a larger one for the lab's own numbers; below it what the mutants reach in the visible run or cases: full dots \
                 lose points by it, green rings lose none, red rings in hidden ones alone. The nearest mutant that loses has a rim. What is further away than the plot is drawn at its edge."
            }
            p class="quiet" {
                "A band is right where the reference solution has room, and the mutants that should lose are well outside of the green. Where \
                 the band depends on the reference, it is drawn with the lab's own numbers, and every dot by its margin in its own band."
            }
        }
    }
}

/// Where a margin lies: 0 at the edge of full points, 1 where nothing is earned.
fn x_of(margin: f64) -> f64 {
    let share = (-margin).clamp(-MOST_INSIDE, OUTSIDE);
    LEFT + WIDTH * (share + MOST_INSIDE) / (MOST_INSIDE + OUTSIDE)
}

fn section(band: &BandValues) -> Markup {
    html! {
        div class="band" {
            div class="title" {
                h3 { (foreign(&band.title)) }
                small { (foreign(&band.check)) @if !band.quantity.is_empty() { " · " (prose(&band.quantity)) } }
            }
            (lanes(band))
            (reach(band))
        }
    }
}

/// The band as a strip with dots.
fn lanes(band: &BandValues) -> Markup {
    let nearest = band.nearest_mutant();
    let (full, none) = (x_of(0.0), x_of(-1.0));
    let end = LEFT + WIDTH;
    let [all, nothing] = [band.full, band.zero].map(|end| with_unit(end, &band.unit));
    let label = format!(
        "{}: all points up to {all}, none from {nothing}",
        band.title
    );
    let dot = |reached: &Reached, y: f64, radius: f64, class: &str| {
        let words = format!(
            "{}: {}",
            name(reached),
            with_unit(reached.value, &band.unit)
        );
        html! {
            circle class=(class) cx=(rounded(x_of(reached.margin))) cy=(y) r=(radius) { title { (visible(&words)) } }
        }
    };
    html! {
        svg class="lanes" viewBox="0 0 900 118" role="img" aria-label=(visible(&label)) {
            rect class="is-full" x=(LEFT) y="44" width=(rounded(full - LEFT)) height="20" {}
            rect class="is-partial" x=(rounded(full)) y="44" width=(rounded(none - full)) height="20" {}
            rect class="is-none" x=(rounded(none)) y="44" width=(rounded(end - none)) height="20" {}
            line class="edge" x1=(rounded(full)) x2=(rounded(full)) y1="40" y2="68" {}
            line class="edge" x1=(rounded(none)) x2=(rounded(none)) y1="40" y2="68" {}
            text class="name" x="0" y="30" { "reference" }
            text class="name" x="0" y="58" { "band" }
            text class="name" x="0" y="90" { "mutants" }
            text x=(rounded(full)) y="112" text-anchor="middle" { (visible(&all)) }
            text x=(rounded(none)) y="112" text-anchor="middle" { (visible(&nothing)) }
            @for reached in band.reference.iter().filter(|reached| !reached.of.is_empty()) { (dot(reached, 26.0, 4.0, "variant")) }
            @for reached in band.reference.iter().filter(|reached| reached.of.is_empty()) { (dot(reached, 26.0, 6.0, "own")) }
            @for reached in &band.mutants {
                @if nearest == Some(reached) { (dot(reached, 86.0, 6.0, "loses nearest")) }
                @else if reached.loses && reached.margin >= 0.0 { (dot(reached, 86.0, 4.5, "hidden")) }
                @else if reached.loses { (dot(reached, 86.0, 5.0, "loses")) }
                @else { (dot(reached, 86.0, 4.5, "keeps")) }
            }
        }
    }
}

fn name(reached: &Reached) -> &str {
    if reached.of.is_empty() {
        "the lab's own numbers"
    } else {
        &reached.of
    }
}

fn rounded(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

/// The numbers from which a band is chosen.
fn reach(band: &BandValues) -> Markup {
    let keeping = band.mutants.iter().filter(|mutant| !mutant.loses).count();
    let losing = band.mutants.len() - keeping;
    let row = |what: &str, reached: &Reached| {
        html! {
            tr {
                th scope="row" { (what) }
                td { (foreign(name(reached))) }
                td class="number" { (foreign(&with_unit(reached.value, &band.unit))) }
                td class="number" { (percent(reached.margin)) }
            }
        }
    };
    html! {
        div class="wide" {
            table class="reach" {
                thead { tr { th {} th scope="col" { "of" } th scope="col" class="number" { "value" } th scope="col" class="number" { "margin" } } }
                tbody {
                    @if let Some(worst) = band.worst() { (row("reference, worst", worst)) }
                    @if let Some(best) = band.best().filter(|_| band.spread() > 0.0) { (row("reference, best", best)) }
                    @if let Some(nearest) = band.nearest_mutant() { (row("nearest mutant that loses", nearest)) }
                }
            }
        }
        p class="quiet" { (losing) " mutants lose here, " (keeping) " do not." }
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// How much the variants differ.
fn variants(difficulty: &Difficulty) -> Markup {
    let most = difficulty
        .variants
        .iter()
        .map(|variant| variant.harder.abs());
    let most = most.fold(0.01, f64::max);
    let x = |harder: f64| rounded(LEFT + WIDTH * (harder / most + 1.0) / 2.0);
    html! {
        section {
            h2 { "Difficulty of " (difficulty.variants.len()) " variants" }
            p {
                "They differ most in " code { (foreign(&format!("{}/{}", difficulty.task, difficulty.check))) } ": the reference solution has least \
                 room with the numbers of " (foreign(&difficulty.hardest_there)) ", and " (percent(difficulty.spread)) " of the band's width more with \
                 those of " (foreign(&difficulty.easiest_there)) "."
            }
            svg class="harder" viewBox="0 0 900 70" role="img" aria-label="How much harder each variant is" {
                line x1=(LEFT) x2=(LEFT + WIDTH) y1="26" y2="26" {}
                line x1=(x(0.0)) x2=(x(0.0)) y1="12" y2="40" {}
                @for variant in &difficulty.variants {
                    circle cx=(x(variant.harder)) cy="26" r="5" { title { (visible(&format!("{}: {}", variant.student, variant.numbers))) } }
                }
                text x=(x(-most)) y="60" text-anchor="middle" { "easier by " (percent(most)) }
                text x=(x(0.0)) y="60" text-anchor="middle" { "as the others" }
                text x=(x(most)) y="60" text-anchor="end" { "harder by " (percent(most)) }
            }
            p class="quiet" {
                "By how much the reference solution's margins are below those in the middle of all variants, in widths of a band, on the mean over \
                 all checks."
            }
            details {
                summary { "Every variant" }
                div class="wide" {
                    table {
                        thead { tr {
                            th scope="col" { "student" } th scope="col" class="number" { "harder by" } th scope="col" { "most in" }
                            th scope="col" class="number" { "there" } th scope="col" { "numbers" }
                        } }
                        tbody {
                            @for variant in &difficulty.variants {
                                tr {
                                    td { (foreign(&variant.student)) }
                                    td class="number" { (percent(variant.harder)) }
                                    td { (foreign(&variant.most_in)) }
                                    td class="number" { (percent(variant.most)) }
                                    td { (foreign(&variant.numbers)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(of: &str, value: f64, loses: bool) -> Reached {
        Reached {
            of: of.to_owned(),
            value,
            margin: (2.0 - value) / 2.0,
            loses,
        }
    }

    #[test]
    fn a_page_draws_the_band_with_everybody_in_it_and_no_markup_of_others() {
        let audit = Audit {
            lab: "94-<b>".to_owned(),
            max_points: 4.0,
            rows: Vec::new(),
            rooms: Vec::new(),
            bands: vec![BandValues {
                task: "line".to_owned(),
                check: "speed".to_owned(),
                title: "The <i>speed".to_owned(),
                quantity: "speed".to_owned(),
                unit: "m/s".to_owned(),
                full: 2.0,
                zero: 4.0,
                reference: vec![reached("", 1.0, false), reached("student 1", 1.5, false)],
                mutants: vec![
                    reached("slow", 3.0, true),
                    reached("slower", 99.0, true),
                    reached("right", 1.2, false),
                ],
            }],
            difficulty: None,
            left_out: vec!["practice.json".to_owned()],
        };
        let page = BandsPage {
            engine: "kinemark 1",
            audit: &audit,
        };
        let page = page.html();
        assert!(page.contains("94-&lt;b&gt;") && page.contains("The &lt;i&gt;speed"));
        assert_eq!(page.matches("class=\"loses nearest\"").count(), 1);
        assert_eq!(page.matches("class=\"keeps\"").count(), 1);
        let value = with_unit(3.0, "m/s");
        let row = format!(
            "<bdi>slow</bdi></td><td class=\"number\"><bdi>{value}</bdi></td><td class=\"number\">-50.0 %</td>"
        );
        assert!(page.contains(&row), "{row} in {page}");
        assert!(page.contains("not looked at: practice.json"));
        // far outside, at the edge
        assert!(page.contains("cx=\"890\""));
        assert!(
            ["<script", " src=", "https://"]
                .iter()
                .all(|part| !page.contains(part))
        );
    }
}
