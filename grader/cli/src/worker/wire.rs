//! The messages between grader and worker: length-prefixed postcard over two pipes.
//!
//! The grader believes nothing that a worker sends. Frames have a size, lists a length, and values no depth while they are read, so that
//! no message can cost more memory or stack than an honest one. There is no word in them for a fault of the grader, for a limit of the
//! machine or for an interruption: those are the grader's to say.

use std::io::{Read, Write};
use std::marker::PhantomData;

use kinemark_grader::record::grade::FurtherMistake;
use kinemark_grader::submission::controller::{
    Answer, Budget, Call, Mistake, Namesake, Opening, PrintedLine, Said, SourcePosition, Stop,
    Value,
};
use serde::de::{DeserializeOwned, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// What the grader asks for.
#[derive(Serialize)]
pub(super) enum Request<'r> {
    /// Open a submission for a task, in place of what was open before.
    Open(&'r Opening),
    /// Answer a call.
    Call(&'r Call),
    /// Try what it gave up.
    Try,
}

/// A [`Request`] as the worker has it: the same bytes.
#[derive(Deserialize)]
pub(super) enum Received {
    Open(Box<Opening>),
    Call(Box<Call>),
    Try,
}

/// What the worker sends.
#[derive(Serialize, Deserialize)]
pub(super) enum Reply {
    /// Once, before the first request: which layers are on.
    Ready(u8),
    /// The submission is open.
    Opened,
    /// A call has an answer.
    Answered(WireAnswer),
    /// An opening or a call was stopped.
    Stopped(WireStop, WireSaid),
    /// What it tried, and whether that was refused.
    Tried(Vec<(Attempt, bool)>),
}

/// What a worker tries, to show that it cannot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Attempt {
    /// To read a file that everybody can read.
    ReadFile,
    /// To list a folder.
    ListFolder,
    /// To write a file.
    WriteFile,
    /// To reach another machine.
    Connect,
    /// To start a process.
    StartProcess,
    /// To signal the grader.
    SignalGrader,
    /// To take more memory than it may.
    TakeMemory,
}

impl Attempt {
    /// What it is, for people.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::ReadFile => "read a file",
            Self::ListFolder => "list a folder",
            Self::WriteFile => "write a file",
            Self::Connect => "open a connection",
            Self::StartProcess => "start a process",
            Self::SignalGrader => "signal the grader",
            Self::TakeMemory => "take a gigabyte of memory",
        }
    }
}

/// A frame for a worker is from the grader, and has the lab's meshes in it.
const MOST_REQUEST_BYTES: u32 = 256 << 20;
/// The largest frame of a worker: several times what the budgets of output allow in one call.
const MOST_REPLY_BYTES: u32 = 4 << 20;
/// The most elements of a list in it: several times what a value, the lines of a call or its samples can have.
const MOST_ELEMENTS: usize = 60_000;
/// The deepest value: of lists in lists, deeper than anything that the language parses or a check reads.
const DEEPEST: usize = 128;

pub(super) fn send(out: &mut impl Write, message: &impl Serialize) -> std::io::Result<()> {
    let bytes = postcard::to_stdvec(message).map_err(std::io::Error::other)?;
    let length = u32::try_from(bytes.len()).map_err(std::io::Error::other)?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&bytes)?;
    out.flush()
}

/// A request, as the worker reads it.
pub(super) fn receive_request(input: &mut impl Read) -> std::io::Result<Received> {
    receive(input, MOST_REQUEST_BYTES)
}

/// A reply, as the grader reads it.
pub(super) fn receive_reply(input: &mut impl Read) -> std::io::Result<Reply> {
    receive(input, MOST_REPLY_BYTES)
}

fn receive<T: DeserializeOwned>(input: &mut impl Read, most: u32) -> std::io::Result<T> {
    let mut length = [0; 4];
    input.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    let broken = |why: &str| std::io::Error::new(std::io::ErrorKind::InvalidData, why);
    if length > most {
        return Err(broken("a message that is too long"));
    }
    let mut bytes = vec![0; length as usize];
    input.read_exact(&mut bytes)?;
    match postcard::take_from_bytes(&bytes) {
        Ok((message, [])) => Ok(message),
        Ok(_) => Err(broken("a message with something behind it")),
        Err(_) => Err(broken("a message that cannot be read")),
    }
}

/// A list with no more than [`MOST_ELEMENTS`], of which no more are read.
#[derive(Serialize, Default)]
#[serde(transparent)]
pub(super) struct Bounded<T>(Vec<T>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Bounded<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Elements<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Elements<T> {
            type Value = Vec<T>;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a list that is not too long")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Vec<T>, A::Error> {
                // no room in advance: the length is the worker's word
                let mut list = Vec::new();
                while let Some(element) = elements.next_element()? {
                    if list.len() == MOST_ELEMENTS {
                        return Err(serde::de::Error::custom("a list that is too long"));
                    }
                    list.push(element);
                }
                Ok(list)
            }
        }
        let elements = deserializer.deserialize_seq(Elements(PhantomData))?;
        Ok(Self(elements))
    }
}

/// One step through a value: a leaf, or how many values follow that are its own.
#[derive(Serialize, Deserialize)]
enum Token {
    Nothing,
    Boolean(bool),
    Number(f64),
    Text(String),
    Other(String),
    List(u32),
    /// Its entries are a text each and a value.
    Map(u32),
}

/// An [`Answer`] whose value is flat.
#[derive(Serialize, Deserialize)]
pub(super) struct WireAnswer {
    value: Bounded<Token>,
    said: WireSaid,
    operations: u64,
}

/// Output of a call.
#[derive(Serialize, Deserialize, Default)]
pub(super) struct WireSaid {
    /// Texts, and the lines of the script that printed them.
    log: Bounded<(String, Option<usize>)>,
    plots: Bounded<(String, f64)>,
}

/// The stops that a worker can report: what the submission did.
#[derive(Serialize, Deserialize)]
pub(super) enum WireStop {
    DidNotBuild(WireMistake),
    Missing {
        function: String,
        help: Option<String>,
        namesake: Option<Namesake>,
    },
    Crashed(WireMistake),
    OverBudget {
        budget: Budget,
        limit: u64,
        place: Option<SourcePosition>,
        function: Option<String>,
    },
}

/// A [`Mistake`].
#[derive(Serialize, Deserialize)]
pub(super) struct WireMistake {
    message: String,
    place: Option<SourcePosition>,
    help: Option<String>,
    further: Bounded<WireFurther>,
}

/// A [`FurtherMistake`].
#[derive(Serialize, Deserialize)]
struct WireFurther {
    lines: Bounded<usize>,
    help: String,
}

impl WireAnswer {
    pub(super) fn of(answer: Answer) -> Self {
        let mut tokens = Vec::new();
        flatten(answer.value, &mut tokens);
        Self {
            value: Bounded(tokens),
            said: WireSaid::of(answer.said),
            operations: answer.operations,
        }
    }

    /// The answer; `None` if its value is not one, or too deep.
    pub(super) fn answer(self) -> Option<Answer> {
        let mut tokens = self.value.0.into_iter();
        let value = grown(&mut tokens, 0)?;
        tokens.next().is_none().then_some(Answer {
            value,
            said: self.said.said(),
            operations: self.operations,
        })
    }
}

fn flatten(value: Value, tokens: &mut Vec<Token>) {
    let count = |elements: usize| u32::try_from(elements).unwrap_or(u32::MAX);
    match value {
        Value::Nothing => tokens.push(Token::Nothing),
        Value::Boolean(boolean) => tokens.push(Token::Boolean(boolean)),
        Value::Number(number) => tokens.push(Token::Number(number)),
        Value::Text(text) => tokens.push(Token::Text(text)),
        Value::Other(name) => tokens.push(Token::Other(name)),
        Value::List(items) => {
            tokens.push(Token::List(count(items.len())));
            for item in items {
                flatten(item, tokens);
            }
        }
        Value::Map(entries) => {
            tokens.push(Token::Map(count(entries.len())));
            for (name, value) in entries {
                tokens.push(Token::Text(name));
                flatten(value, tokens);
            }
        }
    }
}

fn grown(tokens: &mut std::vec::IntoIter<Token>, depth: usize) -> Option<Value> {
    if depth > DEEPEST {
        return None;
    }
    Some(match tokens.next()? {
        Token::Nothing => Value::Nothing,
        Token::Boolean(boolean) => Value::Boolean(boolean),
        Token::Number(number) => Value::Number(number),
        Token::Text(text) => Value::Text(text),
        Token::Other(name) => Value::Other(name),
        // each element takes a token at least: a count beyond them ends there
        Token::List(count) => {
            let items = (0..count).map(|_| grown(tokens, depth + 1));
            Value::List(items.collect::<Option<_>>()?)
        }
        Token::Map(count) => {
            let entries = (0..count).map(|_| match tokens.next()? {
                Token::Text(name) => Some((name, grown(tokens, depth + 1)?)),
                _ => None,
            });
            Value::Map(entries.collect::<Option<_>>()?)
        }
    })
}

impl WireSaid {
    pub(super) fn of(said: Said) -> Self {
        let lines = said.log.into_iter();
        Self {
            log: Bounded(lines.map(|printed| (printed.text, printed.line)).collect()),
            plots: Bounded(said.plots),
        }
    }

    pub(super) fn said(self) -> Said {
        let lines = self.log.0.into_iter();
        Said {
            log: lines
                .map(|(text, line)| PrintedLine { text, line })
                .collect(),
            plots: self.plots.0,
        }
    }
}

impl WireStop {
    /// What is sent of a stop; the words of one that a worker has no message for.
    pub(super) fn of(stop: Stop) -> Result<Self, String> {
        Ok(match stop {
            Stop::DidNotBuild(mistake) => Self::DidNotBuild(WireMistake::of(mistake)),
            Stop::Crashed(mistake) => Self::Crashed(WireMistake::of(mistake)),
            Stop::Missing {
                function,
                help,
                namesake,
            } => Self::Missing {
                function,
                help,
                namesake,
            },
            Stop::OverBudget {
                budget,
                limit,
                place,
                function,
            } => Self::OverBudget {
                budget,
                limit,
                place,
                function,
            },
            Stop::GraderFault(words) => return Err(words),
            Stop::HostLimit(_) | Stop::Interrupted => {
                return Err("a stop that is not a worker's".to_owned());
            }
        })
    }

    /// The stop, with words that are not longer than a report can show.
    pub(super) fn stop(self) -> Stop {
        match self {
            Self::DidNotBuild(mistake) => Stop::DidNotBuild(mistake.mistake()),
            Self::Crashed(mistake) => Stop::Crashed(mistake.mistake()),
            Self::Missing {
                function,
                help,
                namesake,
            } => Stop::Missing {
                function: short(function),
                help: help.map(short),
                namesake,
            },
            Self::OverBudget {
                budget,
                limit,
                place,
                function,
            } => Stop::OverBudget {
                budget,
                limit,
                place,
                function: function.map(short),
            },
        }
    }
}

/// The most further mistakes of a file that a report lists.
const MOST_FURTHER: usize = 100;

impl WireMistake {
    fn of(mistake: Mistake) -> Self {
        let further = mistake.further.into_iter();
        let further = further.map(|FurtherMistake { lines, help }| WireFurther {
            lines: Bounded(lines),
            help,
        });
        Self {
            message: mistake.message,
            place: mistake.place,
            help: mistake.help,
            further: Bounded(further.collect()),
        }
    }

    fn mistake(self) -> Mistake {
        let further = self.further.0.into_iter().take(MOST_FURTHER);
        Mistake {
            message: short(self.message),
            place: self.place,
            help: self.help.map(short),
            further: further
                .map(|WireFurther { lines, help }| FurtherMistake {
                    lines: lines.0,
                    help: short(help),
                })
                .collect(),
        }
    }
}

/// A text cut to what a message of the language can have.
fn short(text: String) -> String {
    const LONGEST: usize = 8_000;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(value: Value) -> Answer {
        Answer {
            value,
            said: Said {
                log: vec![PrintedLine {
                    text: "a".to_owned(),
                    line: Some(3),
                }],
                plots: vec![("p".to_owned(), 1.5)],
            },
            operations: 7,
        }
    }

    fn sent_back(reply: &Reply) -> std::io::Result<Reply> {
        let mut bytes = Vec::new();
        send(&mut bytes, reply).expect("written");
        receive_reply(&mut bytes.as_slice())
    }

    #[test]
    fn an_answer_comes_back_as_it_was() {
        let value = Value::Map(vec![
            (
                "a".to_owned(),
                Value::List(vec![Value::Number(1.5), Value::Nothing]),
            ),
            ("b".to_owned(), Value::Map(vec![])),
            ("c".to_owned(), Value::Text("d".to_owned())),
            ("e".to_owned(), Value::Boolean(true)),
            ("f".to_owned(), Value::Other("timer".to_owned())),
        ]);
        let there = answer(value);
        let reply = Reply::Answered(WireAnswer::of(there.clone()));
        let Ok(Reply::Answered(back)) = sent_back(&reply) else {
            panic!("no answer");
        };
        assert_eq!(back.answer(), Some(there));
    }

    /// Ten million lists in each other are no more than a count that ends.
    #[test]
    fn depth_and_length_are_limited_while_a_message_is_read() {
        let deep = |depth: usize| {
            let mut tokens: Vec<Token> = (0..depth).map(|_| Token::List(1)).collect();
            tokens.push(Token::Nothing);
            WireAnswer {
                value: Bounded(tokens),
                said: WireSaid::default(),
                operations: 0,
            }
        };
        assert!(deep(DEEPEST).answer().is_some());
        assert!(deep(DEEPEST + 1).answer().is_none());
        assert!(sent_back(&Reply::Answered(deep(10_000_000))).is_err());
        assert!(sent_back(&Reply::Answered(deep(MOST_ELEMENTS))).is_err());

        let lines = WireSaid {
            log: Bounded(vec![(String::new(), None); MOST_ELEMENTS + 1]),
            plots: Bounded::default(),
        };
        let stop = WireStop::Missing {
            function: String::new(),
            help: None,
            namesake: None,
        };
        assert!(sent_back(&Reply::Stopped(stop, lines)).is_err());
    }

    #[test]
    fn values_that_do_not_add_up_are_no_answer() {
        let of = |tokens: Vec<Token>| WireAnswer {
            value: Bounded(tokens),
            said: WireSaid::default(),
            operations: 0,
        };
        assert!(of(vec![]).answer().is_none());
        assert!(of(vec![Token::Nothing, Token::Nothing]).answer().is_none());
        assert!(of(vec![Token::List(u32::MAX)]).answer().is_none());
        assert!(
            of(vec![Token::Map(1), Token::Nothing, Token::Nothing])
                .answer()
                .is_none()
        );
    }

    #[test]
    fn a_frame_has_a_length() {
        let frame = |length: u32| {
            let mut bytes = length.to_le_bytes().to_vec();
            bytes.resize(bytes.len() + 16, 0);
            receive_reply(&mut bytes.as_slice()).map(|_| ())
        };
        // a message of one byte, and fifteen behind it
        assert!(frame(16).is_err());
        assert!(frame(u32::MAX).is_err());
        assert!(frame(MOST_REPLY_BYTES + 1).is_err());
    }

    #[test]
    fn a_worker_has_no_word_for_what_is_not_its_to_say() {
        assert!(WireStop::of(Stop::Interrupted).is_err());
        assert!(WireStop::of(Stop::GraderFault("x".to_owned())).is_err());
        let long = "é".repeat(100_000);
        let further = FurtherMistake {
            lines: vec![3, 5],
            help: long.clone(),
        };
        let long = Stop::Crashed(Mistake {
            message: long.clone(),
            place: None,
            help: Some(long),
            further: vec![further; 1_000],
        });
        let Ok(Stop::Crashed(mistake)) = WireStop::of(long).map(WireStop::stop) else {
            panic!("no crash");
        };
        let is_short = |text: &str| text.chars().count() == 8_001;
        assert!(is_short(&mistake.message) && mistake.help.is_some_and(|help| is_short(&help)));
        assert_eq!(mistake.further.len(), MOST_FURTHER);
        for further in mistake.further {
            assert!(is_short(&further.help) && further.lines == [3, 5]);
        }
    }
}
