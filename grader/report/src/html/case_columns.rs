//! Named numbers of cases, `low = 1, high = 2`, as columns of a table, one for each name; or as lines of a cell, where cases have other names.

use maud::{Markup, html};

use super::foreign;
use crate::visible::shortened;

/// More columns do not fit a page.
const MOST_COLUMNS: usize = 6;
/// Characters of a cell.
const MOST_CHARACTERS: usize = 300;

/// The columns of one part of the cases: what is given, answered or expected.
#[derive(Debug, Clone, Default)]
pub(super) struct CaseColumns<'a> {
    /// Names of columns; none where the texts stand as they are.
    names: Vec<&'a str>,
}

impl<'a> CaseColumns<'a> {
    /// The names that all texts with names share, in their order; none where they differ.
    pub(super) fn of(texts: impl Iterator<Item = &'a str>) -> Self {
        let mut names: Option<Vec<&str>> = None;
        for parts in texts.filter_map(parts) {
            let here: Vec<&str> = parts.iter().map(|(name, _)| *name).collect();
            match &names {
                Some(known) if *known != here => return Self::default(),
                _ => names = Some(here),
            }
        }
        let names = names.unwrap_or_default();
        match names.len() <= MOST_COLUMNS {
            true => Self { names },
            false => Self::default(),
        }
    }

    /// How many columns there are.
    fn count(&self) -> usize {
        self.names.len().max(1)
    }

    /// Whether columns have names, in a row of their own.
    pub(super) fn is_named(&self) -> bool {
        !self.names.is_empty()
    }

    /// The heading over all of them; over a row of names where `is_above` says that there is one.
    pub(super) fn heading(&self, title: &str, is_above: bool) -> Markup {
        let rows = (is_above && !self.is_named()).then_some("2");
        let columns = (self.count() > 1).then(|| self.count().to_string());
        let scope = if columns.is_some() { "colgroup" } else { "col" };
        html! { th scope=(scope) colspan=[columns] rowspan=[rows] { (title) } }
    }

    /// The names, below the heading.
    pub(super) fn named(&self) -> Markup {
        html! { @for name in &self.names { th scope="col" { code { (foreign(name)) } } } }
    }

    /// The cells of a text: a number each, or all of it where it has other names; `is_wrong` says which names are marked.
    pub(super) fn cells(&self, text: &str, is_wrong: impl Fn(&str) -> bool) -> Markup {
        let cell = |text: &str| html! { code { (foreign(&shortened(text, MOST_CHARACTERS))) } };
        match parts(text) {
            Some(parts) if self.is_named() => html! {
                @for (name, value) in parts {
                    @if is_wrong(name) {
                        td class="wrong" { (cell(value)) " " span class="unseen" { "wrong" } }
                    } @else {
                        td { (cell(value)) }
                    }
                }
            },
            // of other names than another case has: a line each
            Some(parts) if parts.len() > 1 => html! {
                td { @for (name, value) in parts { div { (cell(&format!("{name} = {value}"))) } } }
            },
            _ => {
                let columns = (self.count() > 1).then(|| self.count().to_string());
                html! { td colspan=[columns] { (cell(text)) } }
            }
        }
    }
}

/// A text of named values in its parts: `b = -3, c = [1, 2]`; none of another.
fn parts(text: &str) -> Option<Vec<(&str, &str)>> {
    let mut found = Vec::new();
    let (mut depth, mut from) = (0_usize, 0);
    let mut ends: Vec<usize> = Vec::new();
    for (at, letter) in text.char_indices() {
        match letter {
            '[' | '(' => depth += 1,
            ']' | ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => ends.push(at),
            _ => {}
        }
    }
    ends.push(text.len());
    for end in ends {
        let (name, value) = text[from..end].trim().split_once(" = ")?;
        let is_name = !name.is_empty()
            && name
                .chars()
                .all(|c| c.is_alphanumeric() || matches!(c, '_' | '.'))
            && !name.starts_with(|c: char| c.is_ascii_digit());
        if !is_name || value.contains(" = ") {
            return None;
        }
        found.push((name, value));
        from = (end + 1).min(text.len());
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_of_named_values_has_parts_and_another_has_none() {
        assert_eq!(
            parts("b = -3, c = [1, [2, 3]], q_1 = 0.5 rad"),
            Some(vec![("b", "-3"), ("c", "[1, [2, 3]]"), ("q_1", "0.5 rad")])
        );
        assert_eq!(parts("q = [0, 1] rad"), Some(vec![("q", "[0, 1] rad")]));
        for other in [
            "",
            "[1, 2] m",
            "no answer",
            "a = 1, and more",
            "a text: x = 1",
            "a = 1,",
            "1 = 2",
        ] {
            assert_eq!(parts(other), None, "{other}");
        }
    }

    #[test]
    fn columns_are_made_of_names_that_all_share() {
        let of = |texts: &[&'static str]| CaseColumns::of(texts.iter().copied()).names;
        assert_eq!(of(&["a = 1, b = 2", "a = 3, b = 4"]), ["a", "b"]);
        // an answer that is none stands beside them
        assert_eq!(of(&["a = 1", "no answer"]), ["a"]);
        assert!(of(&["a = 1", "b = 1"]).is_empty());
        assert!(of(&["[1, 2] m"]).is_empty());
        assert!(of(&["a = 1, b = 1, c = 1, d = 1, e = 1, f = 1, g = 1"]).is_empty());
    }

    #[test]
    fn a_cell_is_a_value_and_a_wrong_one_is_marked_for_eyes_and_ears() {
        let columns = CaseColumns::of(["low = 1, high = <2>"].into_iter());
        let heading = columns.heading("Your answer", true).into_string();
        assert_eq!(
            heading,
            "<th scope=\"colgroup\" colspan=\"2\">Your answer</th>"
        );
        let cells = columns
            .cells("low = 1, high = <2>", |name| name == "high")
            .into_string();
        assert_eq!(cells.matches("<td").count(), 2, "{cells}");
        assert!(cells.contains("<td class=\"wrong\"><code><bdi>&lt;2&gt;</bdi></code>"));
        assert!(cells.contains("<span class=\"unseen\">wrong</span>"));
        let other = columns.cells("no answer", |_| true).into_string();
        assert!(other.starts_with("<td colspan=\"2\">"), "{other}");
        let plain = CaseColumns::default();
        assert_eq!(
            plain.heading("Given", true).into_string(),
            "<th scope=\"col\" rowspan=\"2\">Given</th>"
        );
        assert!(
            plain
                .cells("a = 1", |_| true)
                .into_string()
                .contains("a = 1")
        );
    }
}
