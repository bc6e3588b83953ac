//! A robot's description in any format, read once, of which robots are built: a robot file with its dimensions, or a file of another
//! format, which has none and makes one robot.

use std::sync::Arc;

use super::joint_string;
use super::robot_format::{ReadFile, ReadOptions, detect};
use super::robot_problem::{KIND, RobotError, RobotProblem};
use super::robot_toml::RobotFile;
use crate::model::robot::Robot;
use crate::part::values::changed_dimensions;
use crate::text::{Dimension, Dimensions, Source};

/// A robot's description, its meshes read.
#[derive(Debug, Clone)]
pub enum RobotDescription {
    /// A robot file: TOML.
    File(Box<RobotFile>),
    /// A file without dimensions, such as a URDF.
    Fixed(FixedDescription),
    /// A row of joints such as `RzTxRy`, which has no file.
    Row(RowDescription),
}

/// A row of joints. Its dimensions are `base_height`, the height of the first joint \[m\]; `link1` and on, each from a joint to the next
/// \[m\]; and `density`, of the links that move \[kg/m³\].
#[derive(Debug, Clone)]
pub struct RowDescription {
    source: Source,
    dimensions: Dimensions,
}

/// A description without dimensions.
#[derive(Debug, Clone)]
pub struct FixedDescription {
    source: Source,
    options: ReadOptions,
    robot: Arc<Robot>,
    dimensions: Dimensions,
}

impl RobotDescription {
    /// Reads a description in the format that it looks like, with the meshes it names; `options` count where the format has them.
    ///
    /// # Errors
    /// Whatever makes it no robot, with its dimensions as they stand.
    pub fn read(
        source: Source,
        options: &ReadOptions,
        read_mesh: &mut ReadFile<'_>,
    ) -> Result<Self, RobotError> {
        if joint_string::looks_like_one(source.text()) {
            return Self::of_row(source.text());
        }
        let format = detect(&source);
        if !format.is_of_ros {
            let file = RobotFile::parse(source)?.with_meshes(read_mesh)?;
            return Ok(Self::File(Box::new(file)));
        }
        let robot = (format.read)(source.clone(), options, read_mesh)?;
        Ok(Self::Fixed(FixedDescription {
            source,
            options: *options,
            robot: Arc::new(robot),
            dimensions: Dimensions::default(),
        }))
    }

    /// The robot of a row of joints, such as `RzTxRy` (R turns about an axis, T or P slides along it), with links of one metre along z.
    ///
    /// # Errors
    /// A letter that does not fit.
    pub fn of_row(row: &str) -> Result<Self, RobotError> {
        let source = Source::new("row of joints", row);
        let dimensions = joint_string::dimensions(&source)?;
        Ok(Self::Row(RowDescription { source, dimensions }))
    }

    /// Whether it is a row of joints, which is not a file.
    pub fn is_row(&self) -> bool {
        matches!(self, Self::Row(_))
    }

    /// The text it was read from.
    pub fn source(&self) -> &Source {
        match self {
            Self::File(file) => file.source(),
            Self::Fixed(fixed) => &fixed.source,
            Self::Row(row) => &row.source,
        }
    }

    /// How it was read.
    pub fn options(&self) -> ReadOptions {
        match self {
            Self::File(_) | Self::Row(_) => ReadOptions::default(),
            Self::Fixed(fixed) => fixed.options,
        }
    }

    /// Its dimensions, as [`RobotFile::dimensions`]; none where the format has none.
    pub fn dimensions(&self) -> &Dimensions {
        match self {
            Self::File(file) => file.dimensions(),
            Self::Fixed(fixed) => &fixed.dimensions,
            Self::Row(row) => &row.dimensions,
        }
    }

    /// This description with the dimensions `changed` for good, as [`RobotFile::with_dimensions`].
    ///
    /// # Errors
    /// A dimension that the file does not have, or has in another shape.
    pub fn with_dimensions(self, changed: &[(String, Dimension)]) -> Result<Self, RobotError> {
        match self {
            Self::File(file) => Ok(Self::File(Box::new(file.with_dimensions(changed)?))),
            Self::Fixed(fixed) => {
                fixed.refuse(changed)?;
                Ok(Self::Fixed(fixed))
            }
            Self::Row(mut row) => {
                row.dimensions = row.changed(changed)?;
                Ok(Self::Row(row))
            }
        }
    }

    /// Makes the robot, with the dimensions `changed` instead of the file's, as [`RobotFile::build`].
    ///
    /// # Errors
    /// As [`RobotFile::build`].
    pub fn build(&self, changed: &[(String, Dimension)]) -> Result<Robot, RobotError> {
        match self {
            Self::File(file) => file.build(changed),
            Self::Fixed(fixed) => {
                fixed.refuse(changed)?;
                Ok(Robot::clone(&fixed.robot))
            }
            Self::Row(row) => joint_string::robot_of_dimensions(&row.source, row.changed(changed)?),
        }
    }

    /// As [`RobotDescription::build`]; `None` where nothing is changed.
    ///
    /// # Errors
    /// As [`RobotDescription::build`].
    pub fn build_changed(
        &self,
        changed: &[(String, Dimension)],
    ) -> Result<Option<Robot>, RobotError> {
        let is_changed = !changed.is_empty();
        is_changed.then(|| self.build(changed)).transpose()
    }
}

impl RowDescription {
    fn changed(&self, changed: &[(String, Dimension)]) -> Result<Dimensions, RobotError> {
        changed_dimensions(&self.source, KIND, &self.dimensions, changed)
            .map_err(|error| error.map(RobotProblem::Part))
    }
}

impl FixedDescription {
    /// Refuses any dimension, for there is none to change.
    fn refuse(&self, changed: &[(String, Dimension)]) -> Result<(), RobotError> {
        let known = changed_dimensions(&self.source, KIND, &self.dimensions, changed);
        known
            .map(|_| ())
            .map_err(|error| error.map(RobotProblem::Part))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::forward_kinematics;

    #[test]
    fn a_row_of_joints_has_a_dimension_for_every_link() {
        let row = RobotDescription::of_row("RzTxRy").unwrap();
        let names: Vec<&str> = row.dimensions().names().collect();
        assert_eq!(names, ["base_height", "link1", "link2", "link3", "density"]);
        let changed = [
            ("base_height".to_owned(), Dimension::Number(0.5)),
            ("link3".to_owned(), Dimension::List(vec![0.3, 0.0, 0.0])),
        ];
        let robot = row.build(&changed).unwrap();
        assert_eq!((robot.name(), robot.n()), ("RzTxRy", 3));
        let at = |robot: &Robot| {
            let poses = forward_kinematics(robot, &robot.positions(&[0.0, 0.25, 0.0]).unwrap());
            poses.world_from(robot.tcp()).translation.vector
        };
        assert_eq!(at(&robot), nalgebra::Vector3::new(0.55, 0.0, 2.5));
        let kept = row.clone().with_dimensions(&changed).unwrap();
        assert_eq!(at(&kept.build(&[]).unwrap()), at(&robot));
        let long = [("link4".to_owned(), Dimension::List(vec![0.3, 0.0, 0.0]))];
        assert!(row.build(&long).is_err() && row.with_dimensions(&long).is_err());
        assert!(RobotDescription::of_row("RzTq").is_err());
    }

    #[test]
    fn a_row_is_read_like_any_description() {
        let read = |text: &str| {
            let source = Source::new("robot", text);
            RobotDescription::read(source, &ReadOptions::default(), &mut |_| Err(String::new()))
        };
        assert!(read("RzRy").unwrap().is_row());
        assert!(read("RzR").is_err());
        assert!(
            !read("format = 1\nname = \"a\"\nlinks = [{ name = \"base\" }]")
                .unwrap()
                .is_row()
        );
    }
}
