//! Formulas of a brief, `$...$` and `$$...$$` in LaTeX, as MathML: browsers draw it without a script, a font or the network.

use std::fmt;
use std::ops::Range;

use math_core::{LatexToMathML, MathDisplay};
use maud::html;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd};

/// How a brief is read: as Markdown with tables and formulas.
pub(crate) const MARKDOWN: Options = Options::ENABLE_TABLES.union(Options::ENABLE_MATH);

/// A formula that cannot be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FormulaProblem {
    /// Its first line in the brief, from one.
    pub line: usize,
    /// The formula as typed, with its dollar signs.
    pub formula: String,
    /// What is wrong with it.
    pub why: String,
}

impl fmt::Display for FormulaProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, formula, why } = self;
        write!(
            f,
            "line {line}: the formula `{formula}` cannot be read: {why}"
        )
    }
}

/// The formulas of a brief that cannot be drawn, in its order.
pub fn formula_problems(brief: &str) -> Vec<FormulaProblem> {
    let mut problems = Vec::new();
    let mut is_code = false;
    let mut known_to = 0;
    for (event, at) in Parser::new_ext(brief, MARKDOWN).into_offset_iter() {
        let problem = match &event {
            Event::Start(Tag::CodeBlock(_)) | Event::End(TagEnd::CodeBlock) => {
                is_code = matches!(event, Event::Start(_));
                None
            }
            Event::Text(_) if !is_code && at.start >= known_to => unpaired(brief, at),
            event => formula(event).and_then(|(latex, display)| {
                let why = mathml(latex, display).err()?;
                Some((at, why))
            }),
        };
        if let Some((at, why)) = problem {
            known_to = at.end;
            problems.push(FormulaProblem {
                line: brief[..at.start].matches('\n').count() + 1,
                formula: brief[at].to_owned(),
                why,
            });
        }
    }
    problems
}

/// The first dollar sign of a text that neither belongs to a formula nor follows a backslash, to the next one in its line: what was to
/// be a formula, as Markdown takes none whose braces are not in pairs.
fn unpaired(brief: &str, text: Range<usize>) -> Option<(Range<usize>, String)> {
    let mut signs = brief[text.clone()].match_indices('$');
    let is_free = |start: &usize| !brief[..*start].ends_with('\\');
    let start = signs.find_map(|(at, _)| Some(text.start + at).filter(is_free))?;
    let line = brief[start..].lines().next().unwrap_or_default();
    let end = line[1..].find('$').map_or(line.len(), |at| at + 2);
    let why = "its braces or its dollar signs are not in pairs".to_owned();
    Some((start..start + end, why))
}

/// A part of a brief with its formula drawn; one that cannot be drawn is shown as it was typed.
pub(crate) fn drawn(event: Event<'_>) -> Event<'_> {
    let Some((latex, display)) = formula(&event) else {
        return event;
    };
    let signs = match display {
        MathDisplay::Inline => "$",
        MathDisplay::Block => "$$",
    };
    let shown = match (mathml(latex, display), display) {
        (Ok(mathml), MathDisplay::Inline) => mathml,
        // a wide formula scrolls by itself, the page does not
        (Ok(mathml), MathDisplay::Block) => format!(
            "<span class=\"formula\" tabindex=\"0\" role=\"group\" aria-label=\"Formula\">{mathml}</span>"
        ),
        (Err(_), _) => html! { code class="unread" { (signs) (latex) (signs) } }.into_string(),
    };
    Event::InlineHtml(CowStr::from(shown))
}

/// The LaTeX of a formula, and whether it stands in a line or by itself; none for any other part of a brief.
fn formula<'e>(event: &'e Event<'_>) -> Option<(&'e str, MathDisplay)> {
    match event {
        Event::InlineMath(latex) => Some((latex, MathDisplay::Inline)),
        Event::DisplayMath(latex) => Some((latex, MathDisplay::Block)),
        _ => None,
    }
}

/// A formula as MathML; why it has none, in words.
fn mathml(latex: &str, display: MathDisplay) -> Result<String, String> {
    if latex.contains("<!--") {
        return Err(
            "a mark or a comment stands in it; put the number beside the formula".to_owned(),
        );
    }
    let converter = LatexToMathML::default();
    match converter.convert_with_local_state(latex, display) {
        Ok(converted) => Ok(converted.mathml),
        Err(error) => {
            let why = error.error_message();
            let why = why.trim_end_matches('.');
            let mut letters = why.chars();
            let first = letters.next().map(|first| first.to_lowercase());
            Err(first.into_iter().flatten().chain(letters).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn shown(brief: &str) -> String {
        let mut page = String::new();
        let events = Parser::new_ext(brief, MARKDOWN).map(drawn);
        pulldown_cmark::html::push_html(&mut page, events);
        page
    }

    #[test]
    fn formulas_of_robotics_are_drawn() {
        for latex in [
            r"\tau = K_p (q_d - q) + K_i \int_0^t (q_d - q)\,dt - K_d \dot q",
            r"J(q) = \begin{pmatrix} -l_1 s_1 & -l_2 s_{12} \\ l_1 c_1 & l_2 c_{12} \end{pmatrix}",
            r"M(q)\,\ddot q + h(q, \dot q) = \tau + J^\top f",
            r"\dot q = J^\mathsf{T} \left(J J^\mathsf{T} + \lambda^2 I\right)^{-1} v",
            r"q_2 = \pm\arccos\frac{x^2 + y^2 - l_1^2 - l_2^2}{2\, l_1 l_2}",
            r"q_1 = \operatorname{atan2}(y, x), \quad |q_1| \le 180^\circ",
            r"\begin{aligned} x &= l_1 \cos q_1 \\ y &= l_1 \sin q_1 \end{aligned}",
            r"{}^{0}T_{2} = {}^{0}T_{1}\,{}^{1}T_{2}",
            r"\omega_n = \sqrt{k_p / J}, \quad 1.5\,\mathrm{rad/s}",
            "ζ ≤ 1",
        ] {
            let brief = format!("So ${latex}$ and\n\n$${latex}$$\n");
            assert_eq!(formula_problems(&brief), [], "{latex}");
            let page = shown(&brief);
            assert_eq!(page.matches("<math").count(), 2, "{page}");
            assert!(page.contains("aria-label=\"Formula\"><math display=\"block\">"));
            assert!(!page.contains('$') && !page.contains("unread"), "{page}");
        }
    }

    #[test]
    fn a_formula_that_cannot_be_read_is_shown_and_reported() {
        let brief = "# Lab\n\nFirst $a^2$, then\n$\\frac{a<b}{2$ and\n\n$$\n\\nosuch{x}\n$$\n\n$l = 1.0<!-- = l -->$\n";
        let problems: Vec<String> = formula_problems(brief)
            .iter()
            .map(ToString::to_string)
            .collect();
        assert_eq!(
            problems,
            [
                "line 4: the formula `$\\frac{a<b}{2$` cannot be read: its braces or its dollar signs are not in pairs",
                "line 6: the formula `$$\n\\nosuch{x}\n$$` cannot be read: unknown command \"\\nosuch\"",
                "line 10: the formula `$l = 1.0<!-- = l -->$` cannot be read: a mark or a comment stands in it; put the number beside the formula",
            ]
        );
        let page = shown(brief);
        assert!(page.contains("then\n$\\frac{a&lt;b}{2$ and"), "{page}");
        let unread = "<code class=\"unread\">$$\n\\nosuch{x}\n$$</code>";
        assert!(page.contains(unread), "{page}");
        assert!(page.contains("<msup><mi>a</mi><mn>2</mn></msup>"), "{page}");
    }

    #[test]
    fn dollars_that_are_no_formula_stay() {
        for (brief, expected) in [
            (
                "`$HOME` and `$x$`",
                "<p><code>$HOME</code> and <code>$x$</code></p>\n",
            ),
            ("5 \\$ or \\$x\\$", "<p>5 $ or $x$</p>\n"),
            ("```\n$x$\n```", "<pre><code>$x$\n</code></pre>\n"),
        ] {
            assert_eq!(shown(brief), expected);
            assert_eq!(formula_problems(brief), []);
        }
    }

    #[test]
    fn a_dollar_sign_alone_is_reported_once() {
        let problems = formula_problems("It costs 5 $ and\n\n- more.\n");
        assert_eq!(problems.len(), 1);
        assert_eq!((problems[0].line, &*problems[0].formula), (1, "$ and"));
    }

    #[test]
    fn a_formula_writes_no_html_of_its_own() {
        let page = shown(r"$a < b > \text{<b onload=1>}$ and $\href{javascript:x}{y}$");
        assert!(!page.contains("<b ") && !page.contains("href=\""), "{page}");
        assert!(page.contains("&lt;"), "{page}");
    }

    proptest! {
        #[test]
        fn any_formula_is_drawn_or_refused(latex in r"([a-z0-9{}^_&\\ ]|\\frac|\\left|\\right|\\begin\{pmatrix\}|\\end\{pmatrix\}|\\dot|\\text|é){0,12}") {
            let page = shown(&format!("${latex}$ and more"));
            prop_assert!(page.starts_with("<p>"));
            for display in [MathDisplay::Inline, MathDisplay::Block] {
                let drawn = mathml(&latex, display);
                prop_assert!(drawn.is_err() || drawn.is_ok_and(|drawn| drawn.starts_with("<math")));
            }
        }
    }
}
