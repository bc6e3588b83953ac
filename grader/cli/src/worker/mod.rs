//! Submissions in a process of their own: the same binary, sealed before it reads anything of the submission.
//!
//! The parent keeps simulator, truth and grade; a worker can lie only about its own answers. Messages, and what the parent believes of
//! them, are in [`wire`]; what a worker gives up is in [`seal`]; how it answers is in [`child`]; how the parent starts, watches and ends
//! it is in [`process`], and how long one serves in [`host`].

mod child;
mod host;
mod process;
mod seal;
mod wire;

pub(crate) use child::{Args, serve};
pub(crate) use host::WorkerHost;
pub(crate) use process::{Probe, probe};
pub(crate) use seal::Layer;

/// The command line of a worker, without the name of the program.
#[derive(Debug, clap::Parser)]
pub(crate) struct Line {
    #[command(flatten)]
    pub(crate) args: Args,
}
