//! A robot's description in any format, read once, of which robots are built: a robot file with its dimensions, or a file of another
//! format, which has none and makes one robot.

use std::sync::Arc;

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

    /// The text it was read from.
    pub fn source(&self) -> &Source {
        match self {
            Self::File(file) => file.source(),
            Self::Fixed(fixed) => &fixed.source,
        }
    }

    /// How it was read.
    pub fn options(&self) -> ReadOptions {
        match self {
            Self::File(_) => ReadOptions::default(),
            Self::Fixed(fixed) => fixed.options,
        }
    }

    /// Its dimensions, as [`RobotFile::dimensions`]; none where the format has none.
    pub fn dimensions(&self) -> &Dimensions {
        match self {
            Self::File(file) => file.dimensions(),
            Self::Fixed(fixed) => &fixed.dimensions,
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

impl FixedDescription {
    /// Refuses any dimension, for there is none to change.
    fn refuse(&self, changed: &[(String, Dimension)]) -> Result<(), RobotError> {
        let known = changed_dimensions(&self.source, KIND, &self.dimensions, changed);
        known
            .map(|_| ())
            .map_err(|error| error.map(RobotProblem::Part))
    }
}
