//! `kinemark lab schema`: the JSON schema of a file that people write, for an editor that completes and underlines.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use kinemark_course::course_file::CourseFile;
use kinemark_grader::audit::Accepted;
use kinemark_grader::lab::schema::{hidden_schema, lab_schema, mutants_schema, variant_schema};
use kinemark_sim::format::{RobotFile, SceneFile};
use schemars::Schema;

use crate::failure::Failure;
use crate::output;

/// Print the JSON schema of a kind of file, for editors: for course staff
#[derive(Debug, Clone, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab schema lab --out lab.schema.json\n  kinemark lab schema robot\n\n\
    An editor that reads the schema completes keys and underlines mistakes while you type. The first line of a file says where its schema is: \
    `#:schema ../schema/lab.schema.json`. `kinemark lab new` writes that line and the schemas. docs/lab-format.md, \"In an editor\", \
    says how an editor is set up.\n\
    Exit codes: 0 done, 2 usage, 4 the file cannot be written."
)]
pub(crate) struct Args {
    /// The kind of file
    pub(crate) kind: SchemaKind,
    /// File to write, replaced if it exists [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON, which a schema always is
    #[arg(long)]
    pub(crate) json: bool,
}

/// A kind of file that people write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaKind {
    /// `lab.toml`: tasks, checks, points, visible cases
    Lab,
    /// `hidden.toml`: hidden cases and runs, for course staff
    Hidden,
    /// `mutants.toml`: misconceptions in words, for course staff
    Mutants,
    /// `accepted.toml`: doubts of `lab check` that are right, for course staff
    Accepted,
    /// A robot in `labs/robots`
    Robot,
    /// A scene in `labs/scenes`
    Scene,
    /// `variant.toml`: a student's numbers
    Variant,
    /// `course.toml`: labs and rules of a course
    Course,
}

impl SchemaKind {
    fn schema(self) -> Schema {
        match self {
            Self::Lab => lab_schema(),
            Self::Hidden => hidden_schema(),
            Self::Mutants => mutants_schema(),
            Self::Accepted => Accepted::schema(),
            Self::Robot => RobotFile::schema(),
            Self::Scene => SceneFile::schema(),
            Self::Variant => variant_schema(),
            Self::Course => CourseFile::schema(),
        }
    }

    /// The word by which it is asked for.
    pub(crate) fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or(String::new(), |value| value.get_name().to_owned())
    }

    /// The schema as a file.
    pub(crate) fn text(self) -> String {
        format!("{:#}\n", self.schema().as_value())
    }
}

/// Prints or writes.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let text = args.kind.text();
    match &args.out {
        None => output::print(&text)?,
        Some(path) => output::write_file(path, text.as_bytes(), "choose another path with --out")?,
    }
    Ok(ExitCode::SUCCESS)
}
