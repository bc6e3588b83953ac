//! `kinemark doctor`: what this machine is to Kinemark, and how far a worker is sealed here.

use std::process::ExitCode;

use kinemark_course::staffed_lab::engine_id;
use kinemark_toolbox::styled_text::StyledText;
use serde::Serialize;

use crate::failure::{Failure, LOST};
use crate::worker::{Layer, Probe, probe};
use crate::{one_processor, output, pool};

/// Say how far the code of students is sealed off on this machine
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  kinemark doctor\n\n\
    Starts a worker, the process that runs submissions, lists the layers that it is sealed with here, and lets it try what it gave up.\n\
    docs/security.md says what each layer is and what each platform has.\n\
    Exit codes: 0 every layer is on, 1 some are not, 4 no worker starts.")]
pub(crate) struct Args {
    /// Print everything as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// What was found.
#[derive(Serialize)]
struct Report {
    engine: String,
    system: String,
    processors: usize,
    sealed: bool,
    layers: Vec<LayerRow>,
    tried: Vec<TriedRow>,
}

/// A layer.
#[derive(Serialize)]
struct LayerRow {
    name: &'static str,
    on: bool,
}

/// What a worker tried.
#[derive(Serialize)]
struct TriedRow {
    what: &'static str,
    refused: bool,
}

/// Looks and reports.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let Probe { sealed, tried } = probe().map_err(|why| {
        Failure::fault(
            why,
            "nothing can be graded here: does something keep this program from starting processes?",
        )
    })?;
    let report = Report {
        engine: engine_id(),
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        processors: match one_processor::processors().len() {
            0 => pool::default_jobs(),
            count => count,
        },
        sealed: sealed.missing().next().is_none(),
        layers: Layer::ALL
            .into_iter()
            .map(|layer| LayerRow {
                name: layer.name(),
                on: sealed.has(layer),
            })
            .collect(),
        tried: tried
            .into_iter()
            .map(|(attempt, refused)| TriedRow {
                what: attempt.name(),
                refused,
            })
            .collect(),
    };
    if args.json {
        output::print_formatted(&report)?;
    } else {
        output::print_styled(&text(&report))?;
    }
    Ok(ExitCode::from(if report.sealed { 0 } else { LOST }))
}

fn text(report: &Report) -> StyledText {
    let mut text = StyledText::default();
    text.plain(format!(
        "{}\n{}, {} processors\n\nThe worker that runs submissions:\n",
        report.engine, report.system, report.processors
    ));
    for layer in &report.layers {
        let sign = if layer.on { "on " } else { "OFF" };
        text.plain(format!("  {sign}  {}\n", layer.name));
    }
    text.plain("\nWhat a worker tried here:\n");
    for row in &report.tried {
        let sign = if row.refused { "refused " } else { "POSSIBLE" };
        text.plain(format!("  {sign}  {}\n", row.what));
    }
    if !report.sealed {
        text.plain(
            "\nBudgets are counted and submissions run in a process of their own, but this machine does not close everything to it.\n\
             Grade the work of strangers in a container, or on Linux 6.12 or later.\n",
        );
    }
    text
}
