//! Programs of a brief with their parts in colour: keywords, numbers, text, comments, names of functions.
//!
//! Who asks for the page says where the parts are, since a report knows no language.

use std::ops::Range;

use maud::html;
use pulldown_cmark::{CodeBlockKind, CowStr, Event, Tag, TagEnd};

/// What a part of a program is called, and its bytes.
pub type CodePart = (&'static str, Range<usize>);

/// Finds the parts of a program, in its order and apart.
pub type CodeParts<'a> = &'a dyn Fn(&str) -> Vec<CodePart>;

/// What a block of a program is marked with: `rust`, which other readers of Markdown colour well enough.
const LANGUAGE: &str = "rust";

/// The events of a brief, with each program in one event that has its parts in spans.
pub(crate) fn coloured<'e>(
    events: impl Iterator<Item = Event<'e>>,
    parts: CodeParts<'_>,
) -> impl Iterator<Item = Event<'e>> {
    let mut program: Option<String> = None;
    events.filter_map(move |event| match (&event, &mut program) {
        (Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language))), _)
            if language.as_ref() == LANGUAGE =>
        {
            program = Some(String::new());
            None
        }
        (Event::Text(text), Some(program)) => {
            program.push_str(text);
            None
        }
        (Event::End(TagEnd::CodeBlock), Some(text)) => {
            let shown = block(text, parts);
            program = None;
            Some(Event::Html(CowStr::from(shown)))
        }
        _ => Some(event),
    })
}

fn block(program: &str, parts: CodeParts<'_>) -> String {
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
            code class="language-rust" {
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
            block("let a = 1 < b;\n", &parts),
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
            let shown = block(program, &|_: &str| parts.clone());
            assert_eq!(text(&shown), format!("{program}\n"), "{parts:?}");
        }
    }
}
