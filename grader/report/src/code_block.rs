//! Programs of a brief with their parts in colour: keywords, numbers, text, comments, names of functions.
//!
//! Who asks for the page says where the parts are, since a report knows no language.

use std::ops::Range;

use maud::{PreEscaped, html};
use pulldown_cmark::{CodeBlockKind, CowStr, Event, Tag, TagEnd};

/// What a part of a program is called, and its bytes.
pub type CodePart = (&'static str, Range<usize>);

/// Finds the parts of a program, in its order and apart.
pub type CodeParts<'a> = &'a dyn Fn(&str) -> Vec<CodePart>;

/// What a block of a script is marked with: `rust`, which other readers of Markdown colour well enough.
const SCRIPT: &str = "rust";
/// What a block in Python is marked with. Right behind one of a script it is the same in the other language.
const PYTHON: &str = "python";

/// The events of a brief, with each program in one event: that of a script has its parts in spans, and two languages are two tabs, of which
/// Python is in front if `python_first`.
pub(crate) fn coloured<'e>(
    events: impl Iterator<Item = Event<'e>>,
    parts: CodeParts<'_>,
    python_first: bool,
) -> Vec<Event<'e>> {
    let mut shown = Vec::new();
    let mut events = events.peekable();
    let mut tabs = 0;
    while let Some(event) = events.next() {
        if !begins(&event, SCRIPT) {
            shown.push(event);
            continue;
        }
        let script = block(&text(&mut events), SCRIPT, parts);
        let has_python = events.next_if(|event| begins(event, PYTHON)).is_some();
        shown.push(Event::Html(CowStr::from(match has_python {
            true => {
                tabs += 1;
                let python = block(&text(&mut events), PYTHON, &|_: &str| Vec::new());
                in_tabs(tabs, &script, &python, python_first)
            }
            false => script,
        })));
    }
    shown
}

fn begins(event: &Event<'_>, language: &str) -> bool {
    matches!(event, Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(of))) if of.as_ref() == language)
}

/// The text of a block that has begun, to its end.
fn text<'e>(events: &mut impl Iterator<Item = Event<'e>>) -> String {
    let inside = events.take_while(|event| !matches!(event, Event::End(TagEnd::CodeBlock)));
    let texts = inside.filter_map(|event| match event {
        Event::Text(text) => Some(text.into_string()),
        _ => None,
    });
    texts.collect()
}

/// The same program in two languages, of which one shows; a printed page has both. Without scripts: the tabs are a choice of one.
fn in_tabs(number: usize, script: &str, python: &str, python_first: bool) -> String {
    let (rhai, other) = (format!("tab-{number}-rhai"), format!("tab-{number}-python"));
    let name = format!("tab-{number}");
    let shown = html! {
        div class="tabs" role="group" aria-label="The same in two languages" {
            input type="radio" name=(name) id=(rhai) checked[!python_first];
            label for=(rhai) { "Rhai" }
            input type="radio" name=(name) id=(other) checked[python_first];
            label for=(other) { "Python" }
            (PreEscaped(script))
            (PreEscaped(python))
        }
    };
    format!("{}\n", shown.into_string())
}

fn block(program: &str, language: &str, parts: CodeParts<'_>) -> String {
    let mut plain_from = 0;
    let mut pieces: Vec<(Option<&'static str>, &str)> = Vec::new();
    for (name, at) in parts(program) {
        // what is no part of the program, or out of order, stays plain
        let (Some(plain), Some(part)) = (
            program.get(plain_from..at.start),
            program.get(at.start..at.end),
        ) else {
            continue;
        };
        pieces.push((None, plain));
        pieces.push((Some(name), part));
        plain_from = at.end;
    }
    pieces.push((None, &program[plain_from..]));
    let shown = html! {
        pre {
            code class=(format!("language-{language}")) {
                @for (name, text) in pieces {
                    @match name {
                        Some(name) => span class=(format!("code-{name}")) { (text) },
                        None => (text),
                    }
                }
            }
        }
        "\n"
    };
    shown.into_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left without tags, as a browser reads it.
    fn text(html: &str) -> String {
        let mut text = String::new();
        let mut rest = html;
        while let Some((before, tag)) = rest.split_once('<') {
            text.push_str(before);
            rest = tag.split_once('>').expect("a tag ends").1;
        }
        text.push_str(rest);
        text.replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&quot;", "\"")
            .replace("&amp;", "&")
    }

    #[test]
    fn parts_have_spans_and_the_rest_is_plain() {
        let parts = |_: &str| vec![("keyword", 0..3), ("number", 8..9)];
        assert_eq!(
            block("let a = 1 < b;\n", SCRIPT, &parts),
            "<pre><code class=\"language-rust\"><span class=\"code-keyword\">let</span> a = <span class=\"code-number\">1</span> &lt; b;\n</code></pre>\n"
        );
    }

    /// Whatever the parts are said to be, the text stays the program's, byte for byte.
    #[test]
    fn without_its_tags_a_block_is_the_program() {
        let program = "fn f() { \"<é>\" && `a ${1}` } // 😀\r\n\t&amp;\n";
        let mut state = 99_u64;
        let mut next = |below: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as usize % below
        };
        for _ in 0..5_000 {
            let count = next(6);
            let parts: Vec<CodePart> = (0..count)
                .map(|_| ("text", next(program.len() + 3)..next(program.len() + 3)))
                .collect();
            let shown = block(program, SCRIPT, &|_: &str| parts.clone());
            assert_eq!(text(&shown), format!("{program}\n"), "{parts:?}");
        }
    }

    #[test]
    fn a_program_in_two_languages_is_two_tabs() {
        let page = |text: &str, python_first| {
            let mut page = String::new();
            let events = pulldown_cmark::Parser::new(text);
            let events = coloured(events, &|_: &str| Vec::new(), python_first);
            pulldown_cmark::html::push_html(&mut page, events.into_iter());
            page
        };
        let both = "```rust\nlet a = 1;\n```\n\n```python\na = 1\n```\n\nthen\n";
        let shown = page(both, false);
        assert!(shown.contains("id=\"tab-1-rhai\" checked>"), "{shown}");
        assert!(
            shown.contains("<code class=\"language-python\">a = 1\n</code>"),
            "{shown}"
        );
        assert!(shown.ends_with("<p>then</p>\n"), "{shown}");
        assert!(page(both, true).contains("id=\"tab-1-python\" checked>"));
        // words between them: two programs, each by itself
        let apart = page("```rust\na\n```\n\nor\n\n```python\nb\n```\n", false);
        assert!(!apart.contains("tabs"), "{apart}");
        assert!(
            apart.contains("<code class=\"language-python\">b\n</code>"),
            "{apart}"
        );
    }
}
