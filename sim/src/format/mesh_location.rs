//! Where a mesh lies that a description names: in a package, at a full path, or beside the description. No file is opened here.

/// Where a description says that a mesh lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshLocation<'a> {
    /// `package://NAME/PATH` (or `model://`): `PATH` below the folder of the package `NAME`.
    Package {
        /// The package.
        name: &'a str,
        /// The path below its folder; empty where none is given.
        path: &'a str,
    },
    /// `file:///PATH`, or a path that starts with `/`.
    Absolute(&'a str),
    /// A path from the folder of the description.
    Relative(&'a str),
    /// Another scheme, such as `https`: nothing that can be read.
    Unsupported {
        /// The scheme.
        scheme: &'a str,
    },
}

/// Reads the address of a mesh as ROS writes it. Percent signs stand for themselves: ROS decodes none.
pub(super) fn mesh_location(filename: &str) -> MeshLocation<'_> {
    match filename.split_once("://") {
        Some(("package" | "model", rest)) => {
            let (name, path) = rest.split_once('/').unwrap_or((rest, ""));
            MeshLocation::Package { name, path }
        }
        Some(("file", path)) if path.starts_with('/') => MeshLocation::Absolute(path),
        // `file://meshes/a.stl` has a host by the letter of the standard, and means a path wherever it is written
        Some(("file", path)) => MeshLocation::Relative(path),
        Some((scheme, _)) => MeshLocation::Unsupported { scheme },
        None if filename.starts_with('/') => MeshLocation::Absolute(filename),
        None => MeshLocation::Relative(filename),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_is_distinguished() {
        let package = |name, path| MeshLocation::Package { name, path };
        for (filename, expected) in [
            ("package://arm/meshes/a.stl", package("arm", "meshes/a.stl")),
            ("model://arm/a.stl", package("arm", "a.stl")),
            ("package://arm", package("arm", "")),
            ("file:///opt/a.stl", MeshLocation::Absolute("/opt/a.stl")),
            ("file://a.stl", MeshLocation::Relative("a.stl")),
            ("/opt/a.stl", MeshLocation::Absolute("/opt/a.stl")),
            ("meshes/a.stl", MeshLocation::Relative("meshes/a.stl")),
            (
                "https://x/a.stl",
                MeshLocation::Unsupported { scheme: "https" },
            ),
        ] {
            assert_eq!(mesh_location(filename), expected, "{filename}");
        }
    }
}
