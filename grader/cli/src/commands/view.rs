//! `kinemark view`: a report folder, or the book of a course, in the browser, served to this machine until Ctrl-C.

use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::course_file::COURSE_FILE;

use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::serve::{self, ServeArgs, ServedBook, Server};
use crate::unfinished::is_there_or_restored;
use crate::{interrupt, output};

/// Open a report, or the book of a course, in the browser
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark view\n  kinemark view feedback --no-open --port 8000\n  kinemark view book\n\n\
    Serves the folder to this machine only, read only, until Ctrl-C. A folder of several reports is listed with the points \
    of each. The book of a course is listed with everybody in every lab, sorted and filtered; of a book only pages are served. Only who \
    has the address can read them: it has a random part, another at each start.\n\
    Exit codes: 0 ended by Ctrl-C, 2 usage, 3 the folder has no report, 4 the port cannot be used."
)]
pub(crate) struct Args {
    /// The output folder of `kinemark grade` or `kinemark compare`, a folder of several, or the folder of a course or its book
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) serve: ServeArgs,
    /// Print folder and address as a line of JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Serves the folder.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let shown = output::path(&args.folder);
    if !is_there_or_restored(&args.folder) {
        return Err(Failure::usage(
            format!("there is no folder `{shown}`"),
            "name the folder that `kinemark grade` wrote",
        )
        .coded(ErrorCode::NoFile));
    }
    let book = ServedBook::find(&args.folder);
    if book.is_none() && args.folder.join(COURSE_FILE).is_file() {
        return Err(Failure::broken(
            format!("the course in `{shown}` has no book yet"),
            "`kinemark course grade` writes it",
        )
        .coded(ErrorCode::NoBook));
    }
    if book.is_none() && !serve::index::has_reports(&args.folder) {
        return Err(Failure::broken(
            format!("`{shown}` contains no report, and neither do the folders in it"),
            "name the folder that `kinemark grade` wrote, or a folder of several",
        )
        .coded(ErrorCode::NoReport));
    }
    let (stop, stopped) = tokio::sync::watch::channel(false);
    interrupt::listen_and(move || {
        // nobody listening any more is the end, too
        let _ = stop.send(true);
    });
    let folder = book
        .as_ref()
        .map_or(args.folder.as_path(), ServedBook::root);
    let mut server = Server::bind(folder, args.serve.port, None)?;
    if let Some(book) = book {
        server = server.of_book(book);
    }
    let address = server.address();
    if args.json {
        let line = serde_json::json!({ "format": output::JSON_FORMAT, "folder": shown, "address": address });
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
