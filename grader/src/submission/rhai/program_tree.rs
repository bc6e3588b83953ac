//! What a program is made of, with the bytes of every part. The engine's own tree says where a part begins, and not where it ends: the
//! parts are made from the tokens of its lexer and from its precedences, and a test compares the two.

use std::collections::BTreeSet;
use std::ops::Range;

use rhai::Token;

use super::tokens::{Placed, is_name, tokens};

/// Bytes of a program.
pub type Bytes = Range<usize>;

/// A part of a program.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// A number as it is written, with the `-` that stands directly before it where that is no difference.
    Number {
        /// The number.
        at: Bytes,
        /// Its value.
        value: f64,
        /// Whether it is written without a decimal point.
        is_whole: bool,
    },
    /// A variable or a constant.
    Name {
        /// The name.
        at: Bytes,
    },
    /// What stands behind a point, and is not called.
    Property {
        /// Its name.
        at: Bytes,
        /// All of it, from what it is a property of.
        whole: Bytes,
    },
    /// Two operands with an operator between them.
    Operator {
        /// The operator.
        at: Bytes,
        /// What is before it.
        left: Bytes,
        /// What is behind it.
        right: Bytes,
    },
    /// The sign of an operand, such as the first character of `-x`.
    Minus {
        /// The sign.
        at: Bytes,
    },
    /// An operator that changes a variable, such as `+=`.
    Change {
        /// The operator.
        at: Bytes,
    },
    /// A call.
    Call {
        /// The name of the function.
        name: Bytes,
        /// All of it, with what it is called on.
        whole: Bytes,
        /// Its arguments.
        arguments: Vec<Bytes>,
    },
    /// What stands in the brackets of an index.
    Index {
        /// The index.
        at: Bytes,
    },
    /// A list.
    List {
        /// Its elements.
        elements: Vec<Bytes>,
    },
    /// The condition of an `if` or a loop.
    Condition {
        /// The condition.
        at: Bytes,
    },
    /// The declaration of a variable or a constant with a value.
    Declaration {
        /// Its name.
        name: Bytes,
        /// Its value.
        value: Bytes,
        /// Whether it is a constant.
        is_constant: bool,
    },
}

/// A function of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FunctionPart {
    /// The name in its definition.
    pub name: Bytes,
    /// How many parameters it has.
    pub parameters: usize,
    /// All of it, from `fn` to the `}` at its end.
    pub whole: Bytes,
    /// Every name in it.
    pub mentions: BTreeSet<String>,
}

/// The parts of a program.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramTree {
    /// Its parts.
    pub parts: Vec<Part>,
    /// Its functions, in their order.
    pub functions: Vec<FunctionPart>,
    /// Its comments.
    pub comments: Vec<Bytes>,
}

impl ProgramTree {
    /// Reads a program; `None` if its brackets do not match. A program that the engine compiles has all its parts.
    pub fn read(program: &str) -> Option<Self> {
        let is_comment = |(token, _): &Placed| matches!(token, Token::Comment(_));
        let (comments, tokens) = tokens(program).into_iter().partition(is_comment);
        let comments: Vec<Placed> = comments;
        let mut reader = Reader {
            program,
            pairs: pairs(&tokens)?,
            tokens,
            tree: Self::default(),
        };
        reader.items(0, reader.tokens.len());
        reader.tree.comments = comments.into_iter().map(|(_, at)| at).collect();
        Some(reader.tree)
    }
}

/// For every opening bracket the position of the one that closes it; `None` if one is missing.
fn pairs(tokens: &[Placed]) -> Option<Vec<usize>> {
    let mut pairs = vec![0; tokens.len()];
    let mut open = Vec::new();
    for (i, (token, _)) in tokens.iter().enumerate() {
        match token {
            Token::LeftBrace
            | Token::LeftParen
            | Token::LeftBracket
            | Token::QuestionBracket
            | Token::MapStart => open.push(i),
            Token::RightBrace | Token::RightParen | Token::RightBracket => {
                pairs[open.pop()?] = i;
            }
            _ => {}
        }
    }
    open.is_empty().then_some(pairs)
}

/// Goes through the tokens without comments. A range of them is given by the first and by the one behind the last.
struct Reader<'p> {
    program: &'p str,
    tokens: Vec<Placed>,
    pairs: Vec<usize>,
    tree: ProgramTree,
}

impl Reader<'_> {
    fn token(&self, i: usize) -> &Token {
        self.tokens.get(i).map_or(&Token::EOF, |(token, _)| token)
    }

    fn is_name(&self, i: usize) -> bool {
        is_name(self.token(i))
    }

    fn at(&self, i: usize) -> Bytes {
        self.tokens.get(i).map_or(0..0, |(_, at)| at.clone())
    }

    fn bytes(&self, first: usize, end: usize) -> Bytes {
        self.at(first).start..self.at(end.saturating_sub(1).max(first)).end
    }

    /// Statements, elements or arguments, whatever is between them.
    fn items(&mut self, first: usize, end: usize) {
        let mut i = first;
        while i < end {
            let begins = i == first
                || matches!(
                    self.token(i - 1),
                    Token::SemiColon | Token::LeftBrace | Token::RightBrace
                );
            let next = match self.token(i) {
                Token::Fn => self.function(i, end),
                Token::Let | Token::Const => self.declaration(i, end),
                Token::For => (i..end)
                    .find(|i| *self.token(*i) == Token::In)
                    .map_or(end, |at| self.expression(at + 1, end, 0)),
                Token::While | Token::Until if *self.token(i + 1) != Token::LeftBrace => {
                    self.condition(i + 1, end)
                }
                Token::Catch if *self.token(i + 1) == Token::LeftParen => self.pairs[i + 1] + 1,
                Token::LeftBrace => self.group(i).unwrap_or(end),
                // an operator behind it begins another statement
                Token::If | Token::Switch if begins => self.operand(i, end),
                // a key of a map
                _ if self.is_name(i) && *self.token(i + 1) == Token::Colon => i + 2,
                token if is_change(token) => {
                    let at = self.at(i);
                    self.tree.parts.push(Part::Change { at });
                    i + 1
                }
                token if begins_operand(token) => self.expression(i, end, 0),
                _ => i + 1,
            };
            i = next.max(i + 1);
        }
    }

    fn function(&mut self, i: usize, end: usize) -> usize {
        let after = match self.token(i + 2) {
            Token::LeftParen => self.pairs[i + 2] + 1,
            _ => i + 3,
        };
        if after >= end || *self.token(after) != Token::LeftBrace {
            return i + 1;
        }
        let close = self.pairs[after];
        let parameters = (i + 3..after).filter(|i| self.is_name(*i)).count();
        let names = (i + 3..close).filter(|i| self.is_name(*i));
        let mentions = names.map(|i| self.program[self.at(i)].to_owned());
        self.tree.functions.push(FunctionPart {
            name: self.at(i + 1),
            parameters,
            mentions: mentions.collect(),
            whole: self.bytes(i, close + 1),
        });
        self.items(after + 1, close);
        close + 1
    }

    fn declaration(&mut self, i: usize, end: usize) -> usize {
        if *self.token(i + 2) != Token::Equals {
            return i + 2;
        }
        let after = self.expression(i + 3, end, 0);
        self.tree.parts.push(Part::Declaration {
            name: self.at(i + 1),
            value: self.bytes(i + 3, after),
            is_constant: *self.token(i) == Token::Const,
        });
        after
    }

    fn condition(&mut self, i: usize, end: usize) -> usize {
        let after = self.expression(i, end, 0);
        let at = self.bytes(i, after);
        self.tree.parts.push(Part::Condition { at });
        after
    }

    /// An expression whose operators bind more than one of precedence `above`; where it ends.
    fn expression(&mut self, first: usize, end: usize, above: u8) -> usize {
        let mut after = self.operand(first, end);
        while after < end {
            let token = self.token(after);
            let Some(precedence) = token.precedence().map(std::num::NonZero::get) else {
                break;
            };
            let binds = precedence > above || (precedence == above && token.is_bind_right());
            // a range without an end
            let is_open = matches!(token, Token::ExclusiveRange | Token::InclusiveRange)
                && !(after + 1 < end && begins_operand(self.token(after + 1)));
            if !binds || is_open {
                return if binds { after + 1 } else { after };
            }
            let right_end = self.expression(after + 1, end, precedence);
            self.tree.parts.push(Part::Operator {
                at: self.at(after),
                left: self.bytes(first, after),
                right: self.bytes(after + 1, right_end),
            });
            after = right_end;
        }
        after
    }

    /// An operand with what belongs to it; where it ends.
    fn operand(&mut self, i: usize, end: usize) -> usize {
        if i >= end {
            return end;
        }
        match self.token(i) {
            Token::Minus | Token::UnaryMinus => {
                let at = self.at(i);
                self.tree.parts.push(Part::Minus { at });
                self.operand(i + 1, end)
            }
            Token::Plus | Token::UnaryPlus | Token::Bang => self.operand(i + 1, end),
            Token::If => self.conditional(i, end),
            Token::Switch => {
                let after = self.expression(i + 1, end, 0);
                self.group(after).unwrap_or(after)
            }
            Token::LeftBrace => self.group(i).unwrap_or(end),
            Token::LeftParen | Token::MapStart => {
                let after = self.group(i).unwrap_or(end);
                self.postfix(i, after, end)
            }
            Token::LeftBracket => {
                let elements = self.elements(i);
                self.tree.parts.push(Part::List { elements });
                let after = self.group(i).unwrap_or(end);
                self.postfix(i, after, end)
            }
            Token::InterpolatedString(_) => {
                let after = self.text(i, end);
                self.postfix(i, after, end)
            }
            token => {
                let at = self.at(i);
                let part = match token {
                    Token::IntegerConstant(value) => Some(Part::Number {
                        at,
                        value: *value as f64,
                        is_whole: true,
                    }),
                    Token::FloatConstant(value) => Some(Part::Number {
                        at,
                        value: *value.0,
                        is_whole: false,
                    }),
                    token if is_name(token) && !self.is_called(i) => Some(Part::Name { at }),
                    _ => None,
                };
                self.tree.parts.extend(part);
                self.postfix(i, i + 1, end)
            }
        }
    }

    fn is_called(&self, i: usize) -> bool {
        self.is_name(i) && matches!(self.token(i + 1), Token::LeftParen | Token::Unit)
    }

    /// What is in the brackets that open at `i`; where they end. `None` where none open.
    fn group(&mut self, i: usize) -> Option<usize> {
        let is_open = matches!(
            self.token(i),
            Token::LeftBrace
                | Token::LeftParen
                | Token::LeftBracket
                | Token::QuestionBracket
                | Token::MapStart
        );
        if !is_open {
            return None;
        }
        let close = self.pairs[i];
        self.items(i + 1, close);
        Some(close + 1)
    }

    /// The elements between the brackets that open at `i`.
    fn elements(&self, i: usize) -> Vec<Bytes> {
        let close = self.pairs[i];
        let (mut elements, mut first, mut at) = (Vec::new(), i + 1, i + 1);
        while at <= close {
            if at == close || *self.token(at) == Token::Comma {
                if first < at {
                    elements.push(self.bytes(first, at));
                }
                first = at + 1;
            }
            at = self.pairs[at].max(at) + 1;
        }
        elements
    }

    /// A text with values in it.
    fn text(&mut self, i: usize, end: usize) -> usize {
        let mut after = i + 1;
        while after < end && *self.token(after) == Token::LeftBrace {
            after = self.group(after).unwrap_or(end) + 1;
            if !matches!(self.token(after - 1), Token::InterpolatedString(_)) {
                break;
            }
        }
        after.min(end)
    }

    /// Calls, indices and properties behind an operand; where they end.
    fn postfix(&mut self, first: usize, mut after: usize, end: usize) -> usize {
        while after < end {
            match self.token(after) {
                Token::LeftParen | Token::Unit if self.is_called(after - 1) => {
                    let (arguments, close) = match self.token(after) {
                        Token::Unit => (Vec::new(), after + 1),
                        _ => (self.elements(after), self.pairs[after] + 1),
                    };
                    self.tree.parts.push(Part::Call {
                        name: self.at(after - 1),
                        whole: self.bytes(first, close),
                        arguments,
                    });
                    self.group(after);
                    after = close;
                }
                Token::LeftBracket | Token::QuestionBracket => {
                    let close = self.pairs[after];
                    let at = self.bytes(after + 1, close);
                    self.tree.parts.push(Part::Index { at });
                    self.items(after + 1, close);
                    after = close + 1;
                }
                Token::Period | Token::Elvis => {
                    if self.is_name(after + 1) && !self.is_called(after + 1) {
                        self.tree.parts.push(Part::Property {
                            at: self.at(after + 1),
                            whole: self.bytes(first, after + 2),
                        });
                    }
                    after += 2;
                }
                _ => break,
            }
        }
        after.min(end)
    }

    /// An `if` with all that follows it.
    fn conditional(&mut self, i: usize, end: usize) -> usize {
        let after = self.condition(i + 1, end);
        let Some(after) = self.group(after) else {
            return after;
        };
        if after >= end || *self.token(after) != Token::Else {
            return after;
        }
        match self.token(after + 1) {
            Token::If => self.conditional(after + 1, end),
            _ => self.group(after + 1).unwrap_or(after + 1),
        }
    }
}

fn is_change(token: &Token) -> bool {
    matches!(
        token,
        Token::PlusAssign
            | Token::MinusAssign
            | Token::MultiplyAssign
            | Token::DivideAssign
            | Token::PowerOfAssign
            | Token::ModuloAssign
    )
}

fn begins_operand(token: &Token) -> bool {
    match token {
        Token::IntegerConstant(_)
        | Token::FloatConstant(_)
        | Token::CharConstant(_)
        | Token::StringConstant(_)
        | Token::InterpolatedString(_)
        | Token::True
        | Token::False
        | Token::Unit
        | Token::LeftParen
        | Token::LeftBracket
        | Token::LeftBrace
        | Token::MapStart
        | Token::If
        | Token::Switch
        | Token::Minus
        | Token::UnaryMinus
        | Token::Plus
        | Token::UnaryPlus
        | Token::Bang => true,
        Token::Reserved(word) if word.as_str() == "this" => true,
        token => is_name(token),
    }
}
