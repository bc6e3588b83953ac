//! A lab written in a test: its files laid over the checkout's robots and scenes.

use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::{Files, Lab, LoadError, Staff};

use crate::testbed::{Folder, root};

/// The files of one lab by their paths, beside the checkout's.
pub(crate) struct Course(pub(crate) Vec<(&'static str, String)>);

impl Course {
    /// The lab these files hold.
    pub(crate) fn name(&self) -> &str {
        let lab = self
            .0
            .iter()
            .find_map(|(path, _)| path.strip_suffix("/lab.toml"));
        lab.expect("a lab.toml")
    }

    /// Loads the lab.
    pub(crate) fn load(&self) -> Result<Lab, LoadError> {
        assert_eq!(lab_names(self), [self.name()]);
        Lab::load(self, self.name())
    }

    /// The lab, which nothing is wrong with.
    pub(crate) fn lab(&self) -> Lab {
        self.load().unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// The staff's part of the lab, which nothing is wrong with.
    pub(crate) fn staff(&self, lab: &Lab) -> Option<Staff> {
        Staff::load(self, lab, None).unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// The same files with `from` replaced by `to` in one of them.
    pub(crate) fn with(&self, path: &str, from: &str, to: &str) -> Self {
        let mut found = false;
        let files = self.0.iter().map(|(name, text)| {
            if *name != path {
                return (*name, text.clone());
            }
            assert!(text.contains(from), "{path} has no {from:?}");
            found = true;
            (*name, text.replacen(from, to, 1))
        });
        let files = files.collect();
        assert!(found, "no {path}");
        Self(files)
    }
}

impl Files for Course {
    fn name(&self) -> String {
        "the course".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        match self.0.iter().find(|(name, _)| *name == path) {
            Some((_, text)) => Ok(Some(text.as_bytes().to_vec())),
            None => Folder(root().join("labs")).bytes(path),
        }
    }

    fn list(&self, folder: &str) -> Vec<String> {
        match folder {
            "" => vec![self.name().to_owned()],
            folder => Folder(root().join("labs")).list(folder),
        }
    }
}
