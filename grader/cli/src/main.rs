//! The command `kinemark`: reads what was typed, calls the grader, prints, and returns the documented exit code.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory as _, Parser as _};
use kinemark_report::visible::visible;

use crate::error_record::ErrorRecord;

mod bands_page;
mod beneath;
mod brief_plots;
mod build_info;
mod chosen_variant;
mod command_line;
mod commands;
mod course_folder;
mod course_intake;
mod course_log;
mod disk;
mod enclosing_course;
mod environment;
mod error_record;
mod failure;
mod fresh_folder;
mod hand_in_warnings;
mod handed_out_lab;
mod history;
mod interrupt;
mod lab_check_text;
mod lab_counts;
mod lab_from;
mod lab_tries;
mod labs_folder;
mod last_report;
mod listed_folder;
mod mutation_text;
mod named_submission;
mod one_processor;
mod operator;
mod output;
mod parallel;
mod pool;
mod practice_variants;
mod project;
mod report_folder;
mod response_pictures;
mod robot_source;
mod sandbox;
mod saves;
mod scene_source;
mod scenes_to_check;
mod serve;
mod shard;
mod shown_diagnostic;
mod slurm_queue;
mod slurm_run;
mod slurm_script;
mod staff_folder;
mod typed_numbers;
mod typed_path;
mod typed_refusal;
mod typed_words;
mod unfinished;
mod unfolded_hints;
mod verification;
mod visible_expected;
mod whose_labs;
mod worker;
mod working_lab;
mod wrapping;

/// With the allocator of glibc the labs with many small messages take a tenth longer (docs/performance.md).
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let words = typed_words::heeded(std::env::args_os().collect());
    if let Err(failure) = command_line::refuse_renamed(words.get(1).map(AsRef::as_ref)) {
        return failure.report();
    }
    // every submission waits for a worker: it reads its own options alone, since setting up the whole command line takes 0.8 ms
    if words.get(1).is_some_and(|command| command == "worker")
        && let Ok(line) = worker::Line::try_parse_from(&words[1..])
    {
        // in the first thread, with no other beside it: what it gives up, every later thread lacks
        return worker::serve(&line.args);
    }
    let args = match command_line::CommandLine::try_parse_from(&words) {
        Ok(args) => args,
        Err(error) => {
            // help and version are no errors; anything else is a matter of usage
            let code = if error.use_stderr() {
                failure::USAGE
            } else {
                0
            };
            // a closed pipe is no reason to fail
            let error = as_shown(&words, error);
            let error = typed_refusal::in_plain_words(error, &command_line::CommandLine::command());
            let _ = error.print();
            if error.use_stderr() {
                failure::print_record(ErrorRecord::of_typed(&error));
            }
            return ExitCode::from(code);
        }
    };
    let command = std::thread::Builder::new()
        // submissions that run in this process (mutants, --in-process) may nest as deep as their budgets allow
        .stack_size(2 * kinemark_grader::submission::rhai::STACK_BYTES)
        .spawn(|| match args.run() {
            Ok(code) => code,
            Err(failure) => failure.report(),
        });
    let ended = command.map(std::thread::JoinHandle::join);
    // a panic has printed its own message; without a thread there is nothing to report
    ended.map_or(ExitCode::from(failure::FAULT), |code| {
        code.unwrap_or(ExitCode::from(failure::FAULT))
    })
}

/// The same error about what was typed as a terminal may show it: a shell types the names of files, which may be a student's.
fn as_shown(words: &[OsString], error: clap::Error) -> clap::Error {
    let shown = words
        .iter()
        .map(|word| visible(&word.to_string_lossy()).into_owned());
    command_line::CommandLine::try_parse_from(shown)
        .err()
        .unwrap_or(error)
}
