//! The tokens of a program, each with its bytes, as the language's own lexer finds them. Comments and texts are tokens of their own.

use std::ops::Range;

use rhai::{Engine, Token};

/// A token and its bytes.
pub(super) type Placed = (Token, Range<usize>);

/// The tokens of a program in its order, each without the blanks around it. From the first character that the language does not have
/// there are none. Where a token ends is known from what is left, which is counted after every token: long programs take long.
pub(super) fn tokens(program: &str) -> Vec<Placed> {
    let engine = Engine::new_raw();
    let programs = [program];
    let (mut stream, control) = engine.lex(&programs);
    stream.state.include_comments = true;
    let mut found = Vec::new();
    // braces that are open since each `$` of a text that goes on behind them
    let mut braces: Vec<usize> = Vec::new();
    let mut end = 0;
    while let Some((token, _)) = stream.next() {
        let begin = end;
        // characters that were looked at and put back are still to come
        let buffered = stream.stream.buf.iter().flatten().map(|c| c.len_utf8());
        let streamed = stream.stream.streams.iter().flat_map(Clone::clone);
        let left: usize = buffered.chain(streamed.map(char::len_utf8)).sum();
        end = program.len().saturating_sub(left).max(begin);
        let Some(text) = program.get(begin..end) else {
            break;
        };
        let start = end - text.trim_start().len();
        let stop = start + text.trim().len();
        match &token {
            Token::EOF | Token::LexError(_) => break,
            Token::InterpolatedString(_) => braces.push(0),
            Token::LeftBrace | Token::MapStart => {
                if let Some(open) = braces.last_mut() {
                    *open += 1;
                }
            }
            Token::RightBrace => match braces.last_mut() {
                Some(1) => {
                    braces.pop();
                    // the lexer goes on in the text that the expression stands in
                    control.borrow_mut().is_within_text = true;
                }
                Some(open) => *open = open.saturating_sub(1),
                None => {}
            },
            _ => {}
        }
        // a comment that never ends comes again and again
        if end == begin {
            break;
        }
        found.push((token, start..stop));
    }
    found
}

/// Whether a token may be a name.
pub(super) fn is_name(token: &Token) -> bool {
    match token {
        Token::Identifier(_) => true,
        // the language keeps `print` and some others for itself
        Token::Reserved(word) => word.as_str() != "this" && is_word(word),
        _ => false,
    }
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}
