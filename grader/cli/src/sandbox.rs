//! Grading only where workers are sealed.

use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::worker::probe;

/// Whether a sealed worker is asked for.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct SandboxArgs {
    /// Refuse to grade where this machine does not seal workers: see `kinemark doctor`
    #[arg(long)]
    pub(crate) require_sandbox: bool,
}

/// How a submission is run.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct RunArgs {
    /// Run the submission in this process: for profiling trusted code
    #[arg(long, conflicts_with = "require_sandbox")]
    pub(crate) in_process: bool,
    #[command(flatten)]
    pub(crate) sandbox: SandboxArgs,
}

impl SandboxArgs {
    /// Refuses where a layer is missing that was asked for.
    ///
    /// # Errors
    /// Exit code 2 with the layers that are missing, and 4 where no worker starts.
    pub(crate) fn demand(self) -> Result<(), Failure> {
        if !self.require_sandbox {
            return Ok(());
        }
        let probe = probe().map_err(|why| Failure::fault(why, "see `kinemark doctor`"))?;
        let missing: Vec<&str> = probe.sealed.missing().map(|layer| layer.name()).collect();
        if missing.is_empty() {
            return Ok(());
        }
        Err(Failure::usage(
            format!(
                "--require-sandbox: this machine does not seal workers; missing: {}",
                missing.join("; ")
            ),
            "grade on Linux 6.12 or later, where Landlock and seccomp are not switched off, or leave the option out",
        ).coded(ErrorCode::Sandbox))
    }
}
