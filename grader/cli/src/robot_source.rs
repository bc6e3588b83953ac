//! The robot that a person names on the command line: a robot file, a URDF, a joint string, or a robot of the labs.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use kinemark_grader::task::robot::LabRobot;
use kinemark_grader::task::robot::{RobotOptions, robot_names};
use kinemark_sim::format::{MeshLocation, ReadOptions, RobotError, detect, joint_string};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::unphysical::OnUnphysical;
use kinemark_sim::text::suggest;

use crate::disk::{self, MOST_MESH_BYTES, bytes_of};
use crate::error_record::ErrorCode;
use crate::failure::{BROKEN, Failure, USAGE};
use crate::labs_folder::{self, LabsFolderArgs};

/// Which robot, and how it is read.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct RobotArgs {
    /// A robot file (.toml or .urdf), the name of a robot of the labs, or a joint string such as RzRyRz
    pub(crate) robot: OsString,
    /// Height of the first joint of a joint string, in metres [default: 0]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub(crate) base: Option<f64>,
    /// Links of a joint string: one lx,ly,lz per joint, in metres, separated by semicolons
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub(crate) links: Option<String>,
    /// Density of the links of a joint string, in kg/m³; 0 for links without mass [default: 2700, aluminium]
    #[arg(long, value_name = "KG_M3", allow_negative_numbers = true)]
    pub(crate) density: Option<f64>,
    #[command(flatten)]
    pub(crate) urdf: UrdfArgs,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// How a URDF is read.
#[derive(Debug, Clone, Default, clap::Args)]
pub(crate) struct UrdfArgs {
    /// Folder of a ROS package that the mesh paths of a URDF name; may be given several times
    #[arg(long = "package", value_name = "NAME=DIR", value_parser = package)]
    pub(crate) packages: Vec<(String, PathBuf)>,
    /// Give the mimic joints of a URDF their own entries in q
    #[arg(long)]
    pub(crate) ignore_mimic: bool,
    /// Take inertia tensors of a URDF that no body can have as they are
    #[arg(long, conflicts_with = "balance")]
    pub(crate) accept_unphysical: bool,
    /// Make all three principal moments of such a tensor their mean, as MuJoCo's `balanceinertia` does
    #[arg(long)]
    pub(crate) balance: bool,
}

/// Reads `NAME=DIR`.
fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => {
            Ok((name.to_owned(), PathBuf::from(folder)))
        }
        _ => Err(
            "write the package's name, `=` and its folder, such as ur_description=../ur".to_owned(),
        ),
    }
}

/// Above this a file is no robot's description.
const MOST_BYTES: u64 = 16 << 20;

/// A robot, and where the meshes lie that its description names.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) robot: Robot,
    /// Files by the names the description has for them; those inside the binary are not among them.
    pub(crate) meshes: BTreeMap<String, PathBuf>,
}

/// Reads the robot that `args` name.
///
/// # Errors
/// Exit code 2 for what was typed, 3 for a description that is no robot.
pub(crate) fn load(args: &RobotArgs) -> Result<Loaded, Failure> {
    let path = Path::new(&args.robot);
    if path.exists() || path.extension().is_some() || path.components().count() > 1 {
        return from_file(path, args);
    }
    let name = args.robot.to_string_lossy();
    let (files, folder) = labs_folder::open(&args.labs_folder)?;
    let options = RobotOptions::default();
    if let Some(robot) = LabRobot::load(files.as_ref(), &name, &options)? {
        let LabRobot { file, meshes, .. } = robot;
        let what = format!("`{name}` is a robot of the labs");
        refuse_joint_string_options(args, &what)?;
        refuse_urdf_options(args, &what)?;
        let robot = file.build(&[]).map_err(broken)?;
        let meshes = folder.iter().flat_map(|folder| {
            meshes.iter().filter_map(|mesh| {
                let inside = mesh.path.strip_prefix("robots/")?;
                Some((inside.to_owned(), folder.join(&mesh.path)))
            })
        });
        let meshes = meshes.collect();
        return Ok(Loaded { robot, meshes });
    }
    if joint_string_option(args).is_some() || joint_string::looks_like_one(&name) {
        return of_joint_string(&name, args);
    }
    let known = robot_names(files.as_ref());
    Err(Failure::usage(
        format!("there is no robot file or robot `{name}`"),
        &format!(
            "{}; a joint string is written like RzRyRz, with --links",
            suggest(&name, "robots", known.iter().map(String::as_str))
        ),
    )
    .coded(ErrorCode::UnknownName))
}

fn broken(error: RobotError) -> Failure {
    Failure::diagnostic(BROKEN, error)
}

fn of_joint_string(text: &str, args: &RobotArgs) -> Result<Loaded, Failure> {
    refuse_urdf_options(args, &format!("`{text}` is a joint string"))?;
    // it was typed, so what is wrong with it is a matter of usage
    let usage = |error| Failure::diagnostic(USAGE, error);
    let count = joint_string::joint_count(text).map_err(usage)?;
    let Some(links) = &args.links else {
        let example = vec!["0,0,1"; count.clamp(1, 8)].join("; ");
        return Err(Failure::usage(
            format!("`{text}` gives joints but no links"),
            &format!("add one lx,ly,lz per joint, in metres: --links \"{example}\""),
        ));
    };
    let base_m = args.base.unwrap_or(0.0);
    let density_kg_m3 = args.density.unwrap_or(joint_string::ALUMINIUM_KG_M3);
    let robot = joint_string::robot(text, base_m, links, density_kg_m3).map_err(usage)?;
    let meshes = BTreeMap::new();
    Ok(Loaded { robot, meshes })
}

/// The first option given that is for joint strings alone.
fn joint_string_option(args: &RobotArgs) -> Option<&'static str> {
    let given = [
        (args.links.is_some(), "--links"),
        (args.base.is_some(), "--base"),
        (args.density.is_some(), "--density"),
    ];
    given
        .iter()
        .find(|(given, _)| *given)
        .map(|(_, name)| *name)
}

/// Options of joint strings would have no effect elsewhere.
fn refuse_joint_string_options(args: &RobotArgs, what: &str) -> Result<(), Failure> {
    let Some(given) = joint_string_option(args) else {
        return Ok(());
    };
    Err(Failure::usage(
        format!("{given} is for joint strings such as RzRyRz, but {what}"),
        &format!("leave {given} out"),
    ))
}

impl UrdfArgs {
    /// An option that was given, with what a robot file has in its place.
    pub(crate) fn given(&self) -> Option<(&'static str, &'static str)> {
        if self.ignore_mimic {
            Some((
                "--ignore-mimic",
                "; in a robot file, remove `mimic` from the joint",
            ))
        } else if self.accept_unphysical {
            Some((
                "--accept-unphysical",
                "; in a robot file, write `accept_unphysical = true` in the link's `inertia`",
            ))
        } else if self.balance {
            Some((
                "--balance",
                "; in a robot file, write `balance = true` in the link's `inertia`",
            ))
        } else if !self.packages.is_empty() {
            Some((
                "--package",
                "; in a robot file, paths of meshes start at its own folder",
            ))
        } else {
            None
        }
    }

    fn read_options(&self) -> ReadOptions {
        ReadOptions {
            ignore_mimic: self.ignore_mimic,
            on_unphysical: match (self.accept_unphysical, self.balance) {
                (true, _) => OnUnphysical::Accept,
                (false, true) => OnUnphysical::Balance,
                (false, false) => OnUnphysical::Refuse,
            },
        }
    }
}

/// `--package`, `--ignore-mimic`, `--accept-unphysical` and `--balance` belong to URDFs.
fn refuse_urdf_options(args: &RobotArgs, what: &str) -> Result<(), Failure> {
    let Some((given, instead)) = args.urdf.given() else {
        return Ok(());
    };
    Err(Failure::usage(
        format!("{given} is for URDFs, but {what}"),
        &format!("leave {given} out{instead}"),
    ))
}

fn from_file(path: &Path, args: &RobotArgs) -> Result<Loaded, Failure> {
    let shown = path.display();
    refuse_xacro(path)?;
    let source = disk::read(path, "a robot file", MOST_BYTES)?;
    let format = detect(&source);
    refuse_joint_string_options(args, &format!("`{shown}` is a file"))?;
    if format.is_of_ros {
        refuse_missing_packages(&args.urdf.packages)?;
    } else {
        refuse_urdf_options(args, &format!("`{shown}` is {}", format.name))?;
    }
    let options = args.urdf.read_options();
    let folder = folder_of(path);
    let mut meshes = BTreeMap::new();
    let mut read = |name: &str| {
        let candidates =
            mesh_candidates((format.mesh_location)(name), &folder, &args.urdf.packages)?;
        let (path, bytes) = first_of(&candidates)?;
        meshes.insert(name.to_owned(), path);
        Ok(bytes)
    };
    let robot = (format.read)(source, &options, &mut read).map_err(broken)?;
    Ok(Loaded { robot, meshes })
}

fn refuse_xacro(path: &Path) -> Result<(), Failure> {
    let is_xacro = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("xacro"));
    if !is_xacro || !path.is_file() {
        return Ok(());
    }
    let shown = path.display();
    let plain = path.with_extension("");
    let plain = plain.file_name().unwrap_or_default().to_string_lossy();
    let stem = plain.trim_end_matches(".urdf");
    Err(Failure::usage(
        format!("`{shown}` is a xacro file; convert it to a URDF first"),
        &format!("run `xacro {shown} > {stem}.urdf`, and name {stem}.urdf here"),
    ))
}

fn refuse_missing_packages(packages: &[(String, PathBuf)]) -> Result<(), Failure> {
    let missing = packages.iter().find(|(_, folder)| !folder.is_dir());
    let Some((name, folder)) = missing else {
        return Ok(());
    };
    Err(Failure::usage(
        format!(
            "the folder `{}` of package `{name}` does not exist",
            folder.display()
        ),
        "give the folder that holds the package's package.xml",
    ))
}

/// The folder a file lies in; `.` for a bare name.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Where the mesh may lie that a description in `folder` says to be at `location`, the best first.
fn mesh_candidates(
    location: MeshLocation<'_>,
    folder: &Path,
    packages: &[(String, PathBuf)],
) -> Result<Vec<PathBuf>, String> {
    let (package, inside) = match location {
        MeshLocation::Absolute(path) | MeshLocation::Relative(path) => {
            return Ok(vec![folder.join(path)]);
        }
        MeshLocation::Unsupported { scheme } => {
            return Err(format!(
                "`{scheme}://` addresses are not supported; save the file beside the URDF and use its path there"
            ));
        }
        MeshLocation::Package { path: "", .. } => {
            return Err("the address names a package but no file in it".to_owned());
        }
        MeshLocation::Package { name, path } => (name, path),
    };
    // the last one given wins, as with other options
    let given = packages.iter().rev().find(|(name, _)| name == package);
    if let Some((_, given)) = given {
        return Ok(vec![given.join(inside)]);
    }
    // a URDF usually lies in `NAME/urdf/`
    let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let mut candidates = Vec::new();
    for above in whole.ancestors() {
        if above.file_name().is_some_and(|name| name == package) {
            candidates.push(above.join(inside));
        }
        if above.join(package).is_dir() {
            candidates.push(above.join(package).join(inside));
        }
    }
    candidates.push(folder.join(inside));
    if candidates.iter().any(|path| path.is_file()) {
        return Ok(candidates);
    }
    Err(format!(
        "no package `{package}` with this file was found around the URDF, and no `{}`; \
         give the package's folder: --package {package}=DIR",
        folder.join(inside).display()
    ))
}

/// The first of `paths` that is a file, read whole.
fn first_of(paths: &[PathBuf]) -> Result<(PathBuf, Vec<u8>), String> {
    match paths.iter().find(|path| path.is_file()) {
        Some(path) => Ok((path.clone(), bytes_of(path, MOST_MESH_BYTES)?)),
        None => {
            let tried: Vec<String> = paths.iter().map(|p| format!("`{}`", p.display())).collect();
            Err(format!("there is no file {}", tried.join(" or ")))
        }
    }
}

#[cfg(test)]
mod tests {
    use kinemark_sim::text::Source;

    use super::*;

    #[test]
    fn meshes_are_looked_for_where_ros_keeps_them() {
        let bed = tempfile::tempdir().unwrap();
        let package = bed.path().join("arm_description");
        let urdf = package.join("urdf");
        std::fs::create_dir_all(package.join("meshes")).unwrap();
        std::fs::create_dir_all(&urdf).unwrap();
        std::fs::write(package.join("meshes/hand.stl"), "x").unwrap();
        let format = detect(&Source::new("arm.urdf", ""));
        let find = |name: &str, packages: &[(String, PathBuf)]| {
            let location = (format.mesh_location)(name);
            first_of(&mesh_candidates(location, &urdf, packages)?).map(|(path, _)| path)
        };
        let inside = "package://arm_description/meshes/hand.stl";
        // by the folder around the URDF
        assert_eq!(find(inside, &[]).unwrap(), package.join("meshes/hand.stl"));
        // by the option, which wins even where it leads nowhere
        let elsewhere = [("arm_description".to_owned(), bed.path().to_owned())];
        let why = find(inside, &elsewhere).unwrap_err();
        assert!(why.contains("there is no file"), "{why}");
        let other = [("other".to_owned(), package.clone())];
        let named = "package://other/meshes/hand.stl";
        assert_eq!(
            find(named, &other).unwrap(),
            package.join("meshes/hand.stl")
        );
        let why = find(named, &[]).unwrap_err();
        assert!(why.contains("--package other=DIR"), "{why}");
        // by plain paths
        assert!(find("../meshes/hand.stl", &[]).is_ok());
        let whole = format!("file://{}", package.join("meshes/hand.stl").display());
        assert!(find(&whole, &[]).is_ok());
        assert!(find("https://example.org/hand.stl", &[]).is_err());
        assert!(find("package://arm_description", &[]).is_err());
    }
}
