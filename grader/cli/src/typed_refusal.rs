//! Refusals of numbers on the command line, in words that nobody has to look up.

use std::error::Error as _;
use std::num::{IntErrorKind, ParseIntError};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

/// The same error, reworded where it is about a number; others as they are.
pub(crate) fn in_plain_words(error: Error, command: &Command) -> Error {
    match words(&error) {
        Some(words) => Error::raw(error.kind(), words).with_cmd(command),
        None => error,
    }
}

fn words(error: &Error) -> Option<String> {
    let context = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    let option = context(ContextKind::InvalidArg)?;
    match error.kind() {
        // no option begins with a digit
        ErrorKind::UnknownArgument if option.parse::<f64>().is_ok() => Some(format!(
            "'{option}' is no option, and a number below zero is none of the values here\n"
        )),
        ErrorKind::ValueValidation => {
            let value = context(ContextKind::InvalidValue)?;
            let source = error.source()?;
            let needed = match source.downcast_ref::<ParseIntError>() {
                Some(why) if *why.kind() == IntErrorKind::Empty => {
                    "nothing is there, and an integer is needed".to_owned()
                }
                Some(_) => "an integer is needed, such as 3".to_owned(),
                None => range(&source.to_string())?,
            };
            Some(format!("'{value}' is no value of '{option}': {needed}\n"))
        }
        _ => None,
    }
}

/// `1001 is not in 0..=1000` as a sentence.
fn range(text: &str) -> Option<String> {
    let (_, range) = text.split_once(" is not in ")?;
    let (least, most) = range.split_once("..")?;
    let most: i128 = match most.strip_prefix('=') {
        Some(most) => most.parse().ok()?,
        None => most.parse::<i128>().ok()? - 1,
    };
    Some(format!("it can be from {least} to {most}"))
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory as _, Parser as _};

    use super::*;
    use crate::command_line::CommandLine;

    #[test]
    fn numbers_are_refused_without_jargon() {
        for (typed, expected) in [
            (
                "lab check x --salts 1.5",
                "error: '1.5' is no value of '--salts <N>': an integer is needed, such as 3",
            ),
            (
                "lab check x --salts 1001",
                "error: '1001' is no value of '--salts <N>': it can be from 0 to 1000",
            ),
            (
                "lab check x --jobs 0",
                "error: '0' is no value of '--jobs <N>': it can be from 1 to 65535",
            ),
            (
                "lab check x --salts -1",
                "error: '-1' is no option, and a number below zero is none of the values here",
            ),
            (
                "lab check x --salts 99999999999999999999",
                "error: '99999999999999999999' is no value of '--salts <N>': an integer is needed, such as 3",
            ),
            (
                "lab check x --saltz 3",
                "error: unexpected argument '--saltz' found",
            ),
        ] {
            let words = std::iter::once("kinemark").chain(typed.split(' '));
            let error = CommandLine::try_parse_from(words).expect_err(typed);
            let error = in_plain_words(error, &CommandLine::command());
            let text = error.to_string();
            assert_eq!(text.lines().next(), Some(expected), "{typed}: {text}");
        }
    }
}
