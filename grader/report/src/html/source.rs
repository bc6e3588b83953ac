//! The submission in the page: every line with its number and an anchor, and below a line what went wrong there and what it printed.

use maud::{Markup, PreEscaped, html};
use unicode_width::UnicodeWidthStr as _;

use super::printed::Printed;
use super::{foreign, prose};
use crate::visible::{shortened, visible};
use kinemark_grader::record::grade::{Grade, Stopped};

/// The anchor of the section.
const SOURCE: &str = "source";
/// Lines of a file that are shown.
const MOST_LINES: usize = 3_000;
/// Characters of a line that are shown.
const MOST_CHARACTERS: usize = 300;
/// Bytes of all files that are shown: a page stays small.
const MOST_BYTES: usize = 150_000;
/// Lines before and after the line of a mistake.
const AROUND: usize = 1;

/// The lines of a submission that is a script, in the page that shows them.
#[derive(Debug)]
pub(super) struct ScriptLines<'a> {
    lines: Vec<&'a str>,
    is_whole: bool,
}

impl<'a> ScriptLines<'a> {
    /// The lines of a script; none of what is no text.
    pub(super) fn of(bytes: &'a [u8]) -> Option<Self> {
        let (lines, is_whole) = lines(bytes, &mut MOST_BYTES.clone())?;
        Some(Self { lines, is_whole })
    }

    /// A line, from one.
    fn line(&self, number: usize) -> Option<&'a str> {
        self.lines.get(number.checked_sub(1)?).copied()
    }

    /// Words that lead to a line, if the page shows it.
    pub(super) fn link(&self, number: usize, words: &str) -> Markup {
        match self.line(number) {
            Some(_) => html! { a href=(format!("#line-{number}")) { (words) } },
            None => html! { (words) },
        }
    }
}

/// The lines of a text that are shown, and whether they are all; `room` is what is left of the page's bytes.
fn lines<'a>(bytes: &'a [u8], room: &mut usize) -> Option<(Vec<&'a str>, bool)> {
    let text = std::str::from_utf8(bytes).ok()?;
    let text = text.strip_suffix('\n').unwrap_or(text);
    let all = text.split('\n').count();
    let shown = text.split('\n').take(MOST_LINES).take_while(|line| {
        let has_room = *room >= line.len();
        *room = room.saturating_sub(line.len());
        has_room
    });
    let shown: Vec<&str> = shown
        .map(|line| line.strip_suffix('\r').unwrap_or(line))
        .collect();
    let is_whole = shown.len() == all;
    Some((shown, is_whole))
}

/// A sentence from outside whose words `line 26` lead to that line, where the page shows it.
pub(super) fn prose_with_lines(text: &str, script: Option<&ScriptLines<'_>>) -> Markup {
    let plain = prose(text).into_string();
    let Some(script) = script else {
        return PreEscaped(plain);
    };
    let mut linked = String::with_capacity(plain.len());
    let mut rest = plain.as_str();
    while let Some(at) = rest.find("line ") {
        let digits = rest[at + 5..]
            .bytes()
            .take_while(u8::is_ascii_digit)
            .count();
        let is_word = !rest[..at].ends_with(|c: char| c.is_alphanumeric());
        let end = at + 5 + digits;
        linked.push_str(&rest[..at]);
        match rest[at + 5..end].parse() {
            Ok(number) if is_word => {
                linked.push_str(&script.link(number, &rest[at..end]).into_string());
            }
            _ => linked.push_str(&rest[at..end]),
        }
        rest = &rest[end..];
    }
    linked.push_str(rest);
    PreEscaped(linked)
}

/// The line of a mistake with its neighbours and a caret under its column. What is written out in the line moves the caret along with
/// it. Without the submission there is the line alone, as the record has it.
pub(super) fn pointed(stop: &Stopped, script: Option<&ScriptLines<'_>>) -> Markup {
    let Some(line) = stop.source_line.as_deref() else {
        return html! {};
    };
    let column = stop.column_in_source_line();
    let before: String = line
        .chars()
        .take(column.unwrap_or(1).saturating_sub(1))
        .collect();
    let spaces = " ".repeat(visible(&before).width());
    let at = stop.line.unwrap_or_default();
    let near = |number: usize| Some((number, script?.line(number)?));
    let first = at.saturating_sub(AROUND);
    let above: Vec<_> = (first..at).filter_map(near).collect();
    let below: Vec<_> = match stop.line {
        Some(at) => (at + 1..=at + AROUND).filter_map(near).collect(),
        None => Vec::new(),
    };
    let widest = below.last().map_or(at, |(number, _)| *number);
    let width = stop.line.map_or(0, |_| widest.to_string().len());
    let gutter = |number: Option<usize>| {
        let number = number.map(|number| number.to_string()).unwrap_or_default();
        html! { span class="gutter" { (format!("{number:>width$} │ ")) } }
    };
    let neighbour = |(number, line): &(usize, &str)| {
        html! { (gutter(Some(*number))) code { (shortened(line, MOST_CHARACTERS)) } }
    };
    html! {
        pre class="code" tabindex="0" {
            @for line in &above { (neighbour(line)) "\n" }
            (gutter(stop.line)) code { (visible(line)) }
            @if column.is_some() {
                "\n" span aria-hidden="true" { (gutter(None)) span class="caret" { (spaces) "^" } }
            }
            @for line in &below { "\n" (neighbour(line)) }
        }
    }
}

/// What a submission says of its lines, each once, in the order of the tasks.
fn remarks(grade: &Grade) -> Vec<(usize, &str)> {
    let mut all: Vec<(usize, &str)> = Vec::new();
    for stop in grade.tasks.iter().filter_map(|task| task.stopped.as_ref()) {
        let own = stop.line.map(|line| (line, stop.message.as_str()));
        let further = stop.further.iter().flat_map(|further| {
            let lines = further.lines.iter();
            lines.map(|line| (*line, further.help.as_str()))
        });
        for remark in own.into_iter().chain(further) {
            if !all.contains(&remark) {
                all.push(remark);
            }
        }
    }
    all
}

/// The section with the submission: a script with what went wrong at its lines and what they printed, or the sources beside a module.
pub(super) fn source(
    grade: &Grade,
    script: Option<&ScriptLines<'_>>,
    module_sources: &[(String, Vec<u8>)],
    printed: &Printed<'_>,
) -> Markup {
    let mut room = MOST_BYTES;
    let files = module_sources.iter().enumerate().filter_map(|(i, file)| {
        let (lines, is_whole) = lines(&file.1, &mut room)?;
        Some((format!("file-{}-", i + 1), file.0.as_str(), lines, is_whole))
    });
    let files: Vec<_> = files.collect();
    if script.is_none() && files.is_empty() {
        return html! {};
    }
    let remarks = remarks(grade);
    html! {
        section id=(SOURCE) class="source" aria-labelledby="source-title" {
            h2 id="source-title" { "Your submission" }
            @if let Some(script) = script {
                (fold(&grade.submission.name, "", (&script.lines, script.is_whole), &remarks, printed))
            }
            @for (anchor, name, lines, is_whole) in &files {
                (fold(name, anchor, (lines, *is_whole), &[], &Printed::default()))
            }
        }
    }
}

/// One file, folded; each line has the anchor `line-26`, with `prefix` before it.
fn fold(
    name: &str,
    prefix: &str,
    (lines, is_whole): (&[&str], bool),
    remarks: &[(usize, &str)],
    printed: &Printed<'_>,
) -> Markup {
    let of_line = |number: usize| {
        let here = remarks.iter().filter(move |(line, _)| *line == number);
        here.map(|(_, words)| *words)
    };
    let count = lines.len();
    html! {
        details {
            summary {
                (foreign(name)) ", " @if !is_whole { "the first " } (count) @if count == 1 { " line" } @else { " lines" }
            }
            div class="wide" tabindex="0" role="group" aria-label={ "Lines of " (visible(name)) } {
                ol class="lines" {
                    @for (i, line) in lines.iter().enumerate() {
                        @let number = i + 1;
                        li id=(format!("{prefix}line-{number}")) class=[of_line(number).next().map(|_| "marked")] {
                            code { (shortened(line, MOST_CHARACTERS)) }
                            @for words in of_line(number) { p class="remark" { (prose(words)) } }
                            (printed.at(number))
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
    use kinemark_grader::record::grade::FurtherMistake;
    use kinemark_grader::record::sample;

    const TEXT: &[u8] = b"fn f(q) {\r\n    let s = sin(q;\n    s < 1 && \"</code>\"\n}\n";

    fn stop() -> Stopped {
        Stopped {
            message: "a `)` is missing before this".to_owned(),
            line: Some(2),
            column: Some(18),
            source_line: Some("    let s = sin(q;".to_owned()),
            ..Stopped::default()
        }
    }

    #[test]
    fn a_mistake_has_its_neighbours_and_the_caret_under_its_column() {
        let script = ScriptLines::of(TEXT).unwrap();
        let shown = pointed(&stop(), Some(&script)).into_string();
        let mut text = String::new();
        for part in shown.split('<').skip(1) {
            text.push_str(part.split_once('>').unwrap().1);
        }
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert!(lines[0].starts_with("1 │ fn f(q) {"), "{text}");
        assert_eq!(lines[1], "2 │     let s = sin(q;");
        let columns = |line: &str, of: char| line.chars().position(|c| c == of);
        assert_eq!(columns(lines[2], '^'), columns(lines[1], ';'));
        assert!(lines[3].starts_with("3 │     s &lt; 1"), "{text}");
        // without the submission
        let alone = pointed(&stop(), None).into_string();
        assert!(
            alone.contains("sin(q;") && !alone.contains("fn f"),
            "{alone}"
        );
    }

    #[test]
    fn every_line_has_its_anchor_and_what_went_wrong_at_it() {
        let mut grade = sample::graded().grade;
        let mut stop = stop();
        stop.further = vec![FurtherMistake {
            lines: vec![3],
            help: "write `and`".to_owned(),
        }];
        for task in &mut grade.tasks {
            task.stopped = Some(stop.clone());
        }
        let script = ScriptLines::of(TEXT).unwrap();
        let shown = source(&grade, Some(&script), &[], &Printed::default()).into_string();
        for number in 1..=4 {
            assert!(
                shown.contains(&format!("<li id=\"line-{number}\"")),
                "{shown}"
            );
        }
        assert!(!shown.contains("line-5") && !shown.contains('\r'));
        let marked = "<li id=\"line-2\" class=\"marked\"><code>    let s = sin(q;</code><p class=\"remark\">";
        assert!(shown.contains(marked), "{shown}");
        assert_eq!(
            shown.matches("is missing before this").count(),
            1,
            "said once"
        );
        assert!(shown.contains("write <code>and</code>"));
        assert!(shown.contains("&lt;/code&gt;"), "a line is text");
    }

    #[test]
    fn a_line_has_what_it_printed_below_it() {
        let graded = sample::graded();
        let script = ScriptLines::of(TEXT).unwrap();
        let printed = Printed::of(&graded, |_| false);
        let shown = source(&graded.grade, Some(&script), &[], &printed).into_string();
        let (_, of_three) = shown.split_once("id=\"line-3\"").unwrap();
        let (of_three, _) = of_three.split_once("</li>").unwrap();
        assert!(of_three.contains("case bent: q12 = 1.2"), "{of_three}");
        let (of_one, _) = shown.split_once("id=\"line-2\"").unwrap();
        assert!(!of_one.contains("class=\"printed\""), "{of_one}");
    }

    #[test]
    fn words_that_name_a_line_lead_to_it() {
        let script = ScriptLines::of(TEXT).unwrap();
        let linked = |text| prose_with_lines(text, Some(&script)).into_string();
        assert_eq!(
            linked("see line 3, not line 99 or outline 3"),
            "<bdi>see <a href=\"#line-3\">line 3</a>, not line 99 or outline 3</bdi>"
        );
        assert_eq!(linked("line </b>"), "<bdi>line &lt;/b&gt;</bdi>");
        assert!(
            !prose_with_lines("line 3", None)
                .into_string()
                .contains("href")
        );
    }

    #[test]
    fn a_long_file_is_cut_and_what_is_no_text_is_not_shown() {
        let long = "x = 1;\n".repeat(MOST_LINES + 5);
        let grade = sample::graded().grade;
        let script = ScriptLines::of(long.as_bytes()).unwrap();
        let shown = source(&grade, Some(&script), &[], &Printed::default()).into_string();
        assert!(shown.contains("the first 3000 lines"), "said");
        let wide = "y".repeat(200_000);
        assert!(ScriptLines::of(wide.as_bytes()).unwrap().lines.is_empty());
        assert!(ScriptLines::of(b"\xff\xfe\x00").is_none());
        assert!(
            source(&grade, None, &[], &Printed::default())
                .into_string()
                .is_empty()
        );
    }

    #[test]
    fn the_sources_beside_a_module_have_anchors_of_their_own() {
        let grade = sample::graded().grade;
        let files = [
            ("src/lib.rs".to_owned(), b"mod arm;\n".to_vec()),
            ("src/arm.rs".to_owned(), b"// <i>\n".to_vec()),
        ];
        let shown = source(&grade, None, &files, &Printed::default()).into_string();
        for part in [
            "id=\"file-1-line-1\"",
            "id=\"file-2-line-1\"",
            "// &lt;i&gt;",
            "src/arm.rs",
        ] {
            assert!(shown.contains(part), "{part}: {shown}");
        }
    }
}
