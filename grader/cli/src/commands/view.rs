//! `kinemark view`: a report folder in the browser, served to this machine until Ctrl-C.

use std::process::ExitCode;

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::serve::{self, Server};
use crate::{interrupt, output};

/// Serves the folder.
pub(crate) fn run(args: &ViewArgs) -> Result<ExitCode, Failure> {
    let shown = output::path(&args.folder);
    if !args.folder.is_dir() {
        return Err(Failure::usage(
            format!("there is no folder `{shown}`"),
            "name the folder that `kinemark grade` wrote",
        ));
    }
    if !serve::index::has_reports(&args.folder) {
        return Err(Failure::broken(
            format!("`{shown}` holds no report, and neither do the folders in it"),
            "name the folder that `kinemark grade` wrote, or a folder of several",
        ));
    }
    let (stop, stopped) = tokio::sync::watch::channel(false);
    interrupt::listen_and(move || {
        // nobody listening any more is the end, too
        let _ = stop.send(true);
    });
    let server = Server::bind(&args.folder, args.serve.port, None)?;
    let address = server.address();
    if args.json {
        let line = serde_json::json!({ "folder": shown, "address": address });
        output::print(&format!("{line}\n"))?;
    } else {
        output::print(&format!("{shown} is open at {address}\nend with Ctrl-C\n"))?;
    }
    if !args.serve.no_open {
        serve::open(&address);
    }
    server.run(stopped)?;
    Ok(ExitCode::SUCCESS)
}
