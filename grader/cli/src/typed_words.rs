//! What must be known of the words typed before they are read as a command: whether the answer is JSON, and when there is colour. A
//! refusal of the words themselves obeys both.

use std::ffi::OsString;
use std::sync::atomic::{AtomicBool, Ordering};

use anstream::ColorChoice;

/// Whether the command prints JSON.
static JSON: AtomicBool = AtomicBool::new(false);

/// When output has colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ColorWhen {
    /// On a terminal, unless the environment says otherwise
    Auto,
    /// Everywhere
    Always,
    /// Nowhere
    Never,
}

/// The option of colours, which every command has.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct ColorArgs {
    /// When output has colours; before a terminal is asked, `auto` looks at NO_COLOR, then FORCE_COLOR, then CLICOLOR_FORCE
    #[arg(
        long,
        global = true,
        value_enum,
        value_name = "WHEN",
        default_value = "auto",
        hide_possible_values = true,
        display_order = 1000
    )]
    color: ColorWhen,
}

/// Looks at the words, and gives them as they are read: `--color` may come before the command, too.
pub(crate) fn heeded(words: Vec<OsString>) -> Vec<OsString> {
    let mut options = words.iter().skip(1).take_while(|word| *word != "--");
    JSON.store(options.any(|word| word == "--json"), Ordering::Relaxed);
    color_of(&words, |name| std::env::var(name).ok()).write_global();
    with_color_behind(words)
}

/// Whether the command prints JSON.
pub(crate) fn is_json() -> bool {
    JSON.load(Ordering::Relaxed)
}

/// When there is colour: as `--color` has it, else the environment, in the order of docs/terminal.md.
fn color_of(words: &[OsString], variable: impl Fn(&str) -> Option<String>) -> ColorChoice {
    match typed_color(words).as_deref() {
        Some("always") => return ColorChoice::Always,
        Some("never") => return ColorChoice::Never,
        // what else there is gets refused later
        _ => {}
    }
    let set = |name| variable(name).filter(|value| !value.is_empty());
    if set("NO_COLOR").is_some() {
        return ColorChoice::Never;
    }
    match set("FORCE_COLOR").as_deref() {
        Some("0" | "false") => return ColorChoice::Never,
        Some(_) => return ColorChoice::Always,
        None => {}
    }
    match set("CLICOLOR_FORCE").as_deref() {
        None | Some("0") => ColorChoice::Auto,
        Some(_) => ColorChoice::Always,
    }
}

/// The word after the last `--color`.
fn typed_color(words: &[OsString]) -> Option<String> {
    let words = words.iter().map(|word| word.to_string_lossy());
    let words: Vec<_> = words.take_while(|word| word != "--").collect();
    let at = words
        .iter()
        .rposition(|word| word == "--color" || word.starts_with("--color="))?;
    match words[at].strip_prefix("--color=") {
        Some(when) => Some(when.to_owned()),
        None => words.get(at + 1).map(|when| when.clone().into_owned()),
    }
}

/// The words with a `--color` that stands before the command behind it: the options of the list of labs are not for commands, so
/// nothing else may stand there.
fn with_color_behind(mut words: Vec<OsString>) -> Vec<OsString> {
    let count = match words.get(1).map(|word| word.to_string_lossy()) {
        Some(word) if word == "--color" => 2,
        Some(word) if word.starts_with("--color=") => 1,
        _ => return words,
    };
    let command = words.get(1 + count).map(|word| word.to_string_lossy());
    if command.is_some_and(|word| !word.starts_with('-')) {
        words[1..2 + count].rotate_left(count);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<OsString> {
        let words = std::iter::once("kinemark").chain(text.split_whitespace());
        words.map(OsString::from).collect()
    }

    #[test]
    fn colour_is_as_typed_then_as_the_environment_has_it() {
        let color = |text: &str, environment: &[(&str, &str)]| {
            color_of(&words(text), |name| {
                let mut found = environment.iter().filter(|(known, _)| *known == name);
                found.next().map(|(_, value)| (*value).to_owned())
            })
        };
        let no = ("NO_COLOR", "1");
        let force = ("FORCE_COLOR", "1");
        let cli = ("CLICOLOR_FORCE", "1");
        assert_eq!(color("grade", &[]), ColorChoice::Auto);
        assert_eq!(color("grade --color always", &[no]), ColorChoice::Always);
        assert_eq!(color("--color=never grade", &[force]), ColorChoice::Never);
        assert_eq!(color("grade --color auto", &[no]), ColorChoice::Never);
        assert_eq!(color("grade", &[no, force, cli]), ColorChoice::Never);
        assert_eq!(
            color("grade", &[("FORCE_COLOR", "0"), cli]),
            ColorChoice::Never
        );
        assert_eq!(color("grade", &[force]), ColorChoice::Always);
        assert_eq!(color("grade", &[cli]), ColorChoice::Always);
        assert_eq!(
            color("grade", &[("CLICOLOR_FORCE", "0")]),
            ColorChoice::Auto
        );
        assert_eq!(color("grade", &[("NO_COLOR", "")]), ColorChoice::Auto);
        // a file may be called so
        assert_eq!(color("grade -- --color never", &[]), ColorChoice::Auto);
    }

    #[test]
    fn colour_may_come_before_the_command() {
        let read = |text: &str| with_color_behind(words(text));
        assert_eq!(
            read("--color never lab check 01"),
            words("lab --color never check 01")
        );
        assert_eq!(read("--color=never grade"), words("grade --color=never"));
        assert_eq!(read("--color never --json"), words("--color never --json"));
        assert_eq!(read("--color never"), words("--color never"));
        assert_eq!(read("grade --color never"), words("grade --color never"));
    }
}
