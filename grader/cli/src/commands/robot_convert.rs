//! `kinemark robot convert`: any robot as a robot file, on standard output or in a file that is whole or not there.

use std::path::{Component, Path, PathBuf};
use std::process::ExitCode;

use kinemark_sim::format::detect;
use kinemark_sim::text::Source;
use kinemark_toolbox::robot_convert::{Converted, converted};

use crate::error_record::ErrorCode;
use crate::failure::{self, Failure};
use crate::output;
use crate::robot_source::{self, RobotArgs};

/// Write any robot as a robot file (TOML)
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark robot convert panda.urdf --out panda.toml\n  \
    kinemark robot convert RzRyRz --base 2 --links \"0,0,4; 3,0,0; 1,0,0\"\n\n\
    Meshes are not copied: the new file has their paths relative to its own folder. Warnings go to standard error.\n\
    Exit codes: 0 written, 2 usage, 3 the robot is broken, 4 the file cannot be written."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// File to write [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// Writes the description.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let folder = match &args.out {
        None => Path::new("."),
        Some(out) => {
            refuse_itself(Path::new(&args.robot.robot), out)?;
            refuse_taken(out, args.force)?;
            match out.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            }
        }
    };
    // by its name alone: there is no text yet
    let name = args
        .out
        .as_ref()
        .map_or_else(String::new, |out| out.to_string_lossy().into_owned());
    let format = detect(&Source::new(name, ""));
    let Some(write) = format.write else {
        return Err(Failure::usage(
            format!("robots cannot be written as {}", format.name),
            "name a file that ends in .toml",
        ));
    };
    let loaded = robot_source::load(&args.robot)?;
    let Converted { text, warnings } = converted(&loaded.robot, write, |name| {
        let path = loaded.meshes.get(name)?;
        Some(seen_from(folder, path))
    });
    for warning in &warnings {
        failure::warn_alone(warning);
    }
    match &args.out {
        None => output::print(&text)?,
        Some(out) => {
            output::write_file(out, text.as_bytes(), "choose another path with --out")?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Checks that a robot is not written over the file it is read from, where its own format would be lost.
fn refuse_itself(robot: &Path, out: &Path) -> Result<(), Failure> {
    match (robot.canonicalize(), out.canonicalize()) {
        (Ok(from), Ok(to)) if from == to => Err(Failure::usage(
            format!("`{}` is the robot's own file", out.display()),
            "name another file: the original is kept",
        )),
        _ => Ok(()),
    }
}

/// Checks, before anything is read, that `out` may be written.
fn refuse_taken(out: &Path, force: bool) -> Result<(), Failure> {
    if out.is_dir() {
        return Err(Failure::usage(
            format!("`{}` is a folder", out.display()),
            "name the file to write, such as robot.toml",
        ));
    }
    // a device, a pipe, a link to nowhere: what is there and no file is never replaced
    let there = out.symlink_metadata().is_ok();
    if there && (!force || !out.is_file()) {
        return Err(Failure::usage(
            format!("`{}` already exists", out.display()),
            if out.is_file() {
                "name another file, or replace it with --force"
            } else {
                "name another file"
            },
        )
        .coded(ErrorCode::Exists));
    }
    Ok(())
}

/// The path of `file` as a robot file in `folder` writes it: relative, with `/`; absolute where no relative one leads there.
fn seen_from(folder: &Path, file: &Path) -> String {
    let (Some(folder), Some(file)) = (whole(folder), whole(file)) else {
        return file.display().to_string();
    };
    let shared = folder
        .components()
        .zip(file.components())
        .take_while(|(a, b)| a == b)
        .count();
    if shared == 0 {
        // another drive
        return file.display().to_string();
    }
    let up = folder.components().skip(shared).map(|_| "..".to_owned());
    let down = file.components().skip(shared);
    let down = down.map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<String>>().join("/")
}

/// An absolute path without `.` and `..`. Links on the way are followed as far as the path exists, so that `..` means what it does
/// on the disk.
fn whole(path: &Path) -> Option<PathBuf> {
    if let Ok(real) = path.canonicalize() {
        return Some(real);
    }
    let mut plain = PathBuf::new();
    for part in std::path::absolute(path).ok()?.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    Some(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_from_the_new_file_to_the_mesh() {
        for (folder, file, expected) in [
            ("/a/b", "/a/b/c.stl", "c.stl"),
            ("/a/b", "/a/b/m/c.stl", "m/c.stl"),
            ("/a/b", "/a/m/c.stl", "../m/c.stl"),
            ("/a/b/../x", "/a/m/./c.stl", "../m/c.stl"),
            ("/", "/a/c.stl", "a/c.stl"),
        ] {
            assert_eq!(seen_from(Path::new(folder), Path::new(file)), expected);
        }
    }
}
