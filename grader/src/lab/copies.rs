//! The files of a lab as it was loaded, held in memory: copied into reports, and read again with other numbers.

use kinemark_sim::control::Mode;
use kinemark_sim::text::{Dimension, Dimensions};

use super::load::tables;
use super::model::{Lab, TaskWork};
use super::practice::{self, PRACTICE_FILE, Practice};
use super::variant::{VARIANT_FILE, Variant};
use crate::task::files::Files;
use crate::task::problem::LoadError;

/// Files by path, in the shape of a labs folder.
#[derive(Debug, Clone, Default)]
pub struct Copies(Vec<(String, Vec<u8>)>);

impl Copies {
    /// Texts by path, for labs that are made in memory.
    pub fn from_texts<'t>(texts: impl IntoIterator<Item = (&'t str, &'t str)>) -> Self {
        let mut copies = Self::default();
        for (path, text) in texts {
            copies.add(path, text);
        }
        copies
    }

    /// Paths with their bytes, each path once.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.0
            .iter()
            .map(|(path, bytes)| (path.as_str(), bytes.as_slice()))
    }

    /// Adds a file; one that is there already stays.
    pub fn add(&mut self, path: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        let path = path.into();
        if !self.0.iter().any(|(known, _)| *known == path) {
            self.0.push((path, bytes.into()));
        }
    }
}

impl Files for Copies {
    fn name(&self) -> String {
        "the files of this lab".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let found = self.0.iter().find(|(known, _)| known == path);
        Ok(found.map(|(_, bytes)| bytes.clone()))
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let prefix = if folder.is_empty() {
            String::new()
        } else {
            format!("{folder}/")
        };
        let inside = self
            .0
            .iter()
            .filter_map(|(path, _)| path.strip_prefix(&prefix));
        let mut names: Vec<String> = inside
            .filter_map(|path| Some(path.split('/').next()?.to_owned()))
            .collect();
        names.sort();
        names.dedup();
        names
    }
}

impl Lab {
    /// Copies of all files it was read from, `variant.toml` among them where it is a variant.
    pub fn copies(&self) -> Copies {
        self.copies_with(self.source.text(), &self.practice)
    }

    /// The copies that a report holds: of the hints they have the questions alone.
    pub fn graded_copies(&self) -> Copies {
        self.copies_with(&self.graded_text, &self.practice)
    }

    fn copies_with(&self, lab_text: &str, practice: &Practice) -> Copies {
        let mut copies = Copies::default();
        copies.add(self.source.name(), lab_text);
        // a row of joints stands in the lab itself
        if !self.robot_file.is_row() {
            let robot = self.robot_file.source();
            copies.add(robot.name(), robot.text());
        }
        let form = practice::form(self.variant.as_ref(), practice.clone());
        // a value that JSON has no number for was not read from JSON
        if let Ok(text) = practice::file_text(&[form])
            && !text.is_empty()
        {
            copies.add(format!("{}/{PRACTICE_FILE}", self.name), text);
        }
        for scene in &self.scenes {
            let source = scene.file.source();
            copies.add(source.name(), source.text());
        }
        let own = || self.tasks.iter().filter_map(|task| task.own.as_deref());
        for own in own().filter(|own| !own.robot_file.is_row()) {
            let robot = own.robot_file.source();
            copies.add(robot.name(), robot.text());
        }
        let meshes = self.scenes.iter().flat_map(|scene| &scene.meshes);
        let meshes = meshes.chain(own().flat_map(|own| &own.robot_meshes));
        for mesh in self.robot_meshes.iter().chain(meshes) {
            copies.add(mesh.path.as_str(), mesh.bytes.as_slice());
        }
        if let Some(variant) = &self.variant {
            copies.add(format!("{}/{VARIANT_FILE}", self.name), variant.text());
        }
        copies
    }

    /// This lab with the numbers `changed` instead; its other parameters stay as they are.
    ///
    /// # Errors
    /// [`LoadError`] where a parameter is none of this lab, or where these numbers make no lab.
    pub fn with_parameters(&self, changed: &[(String, Dimension)]) -> Result<Self, LoadError> {
        let current = self.parameters.iter();
        let mut parameters =
            Dimensions::from_pairs(current.map(|(name, value)| (name.to_owned(), value.clone())));
        for (name, value) in changed {
            parameters.set(name.clone(), value.clone());
        }
        let pairs: Vec<(String, Dimension)> = parameters
            .iter()
            .map(|(name, value)| (name.to_owned(), value.clone()))
            .collect();
        let student = self.variant.as_ref().and_then(Variant::student);
        let variant = Variant::new(&self.name, student, &pairs)?;
        // other numbers have values of their own
        let copies = self.copies_with(self.source.text(), &Practice::default());
        Self::load_variant(&copies, &self.name, Some(&variant))
    }

    /// This lab with half the physics step in every simulated motion task; the servo's period and that of `control` stay as they are.
    ///
    /// # Errors
    /// [`LoadError`] where that makes no lab: a task of too many steps.
    pub fn with_half_step(&self) -> Result<Self, LoadError> {
        let mut table: toml::Table = tables(&self.source)?;
        let tasks = table.get_mut("tasks").and_then(toml::Value::as_array_mut);
        for (typed, task) in tasks.into_iter().flatten().zip(&self.tasks) {
            let motion = typed.get_mut("motion");
            let motion = motion.and_then(toml::Value::as_table_mut);
            let (Some(typed), TaskWork::Motion(work, _)) = (motion, &task.work) else {
                continue;
            };
            if work.servo.mode == Mode::Prescribed {
                continue;
            }
            let periods = &work.periods;
            let mut set = |key: &str, time_s: f64| {
                typed.insert(key.to_owned(), toml::Value::Float(1000.0 * time_s));
            };
            set("physics_step_ms", 0.5 * periods.step_s);
            set(
                "servo_period_ms",
                periods.step_s * f64::from(periods.ticks_per_servo.get()),
            );
        }
        let copies = self.copies_with(&table.to_string(), &self.practice);
        Self::load_variant(&copies, &self.name, self.variant.as_ref())
    }
}
