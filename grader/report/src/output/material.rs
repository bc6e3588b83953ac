//! What outputs are made from, and what they are: files with their bytes.

use kinemark_grader::record::graded::{GradedRun, TaskRun};

use super::ReportRequest;
use crate::plot::{Plot, plots};

/// Texts and files that a report copies.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// The name of the submission's copy, by what the submission is.
    pub submission_file: &'a str,
    /// The submission.
    pub submission: &'a [u8],
    /// The sources beside a module, by their paths.
    pub module_sources: &'a [(String, Vec<u8>)],
    /// `lab.toml`.
    pub lab: &'a str,
    /// The robot's file.
    pub robot: &'a str,
    /// The texts of the robots that tasks have in its place, by the names of the tasks.
    pub own_robots: &'a [(&'a str, &'a str)],
    /// Every file that the lab was read from, by its path in a folder of labs.
    pub lab_files: &'a [(String, Vec<u8>)],
}

/// Whether pictures are drawn in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pixels {
    /// PNG files have their bytes.
    Drawn,
    /// In place of a PNG file is the SVG that it shows: whoever compares it with another one compares pixels ([`shows`]), for they may
    /// differ between processors.
    Undrawn,
}

/// Whether a PNG shows what `drawing`, an SVG, draws; a build without the feature `png` does not know.
///
/// # Errors
/// [`OutputError::Png`] where the drawing is of a size that is not drawn.
pub fn shows(file: &[u8], drawing: &[u8]) -> Result<Option<bool>, OutputError> {
    #[cfg(feature = "png")]
    return Ok(Some(crate::png::shows(
        file,
        &String::from_utf8_lossy(drawing),
    )?));
    #[cfg(not(feature = "png"))]
    {
        let _ = (file, drawing);
        Ok(None)
    }
}

/// What outputs are made from.
#[derive(Debug)]
pub struct Material<'a> {
    pub(super) graded: &'a GradedRun,
    pub(super) sources: Sources<'a>,
    pub(super) request: &'a ReportRequest,
    /// `grade.json`.
    pub(super) record: String,
    /// The plots of each run.
    plots: Vec<Vec<Plot>>,
    pixels: Pixels,
}

impl<'a> Material<'a> {
    /// Gathers it; record and plots are made once for all outputs.
    ///
    /// # Errors
    /// [`OutputError::Json`] where the record has no JSON form.
    pub fn new(
        graded: &'a GradedRun,
        sources: Sources<'a>,
        request: &'a ReportRequest,
        pixels: Pixels,
    ) -> Result<Self, OutputError> {
        Ok(Self {
            graded,
            sources,
            request,
            record: super::json(&graded.grade)?,
            plots: graded.runs.iter().map(plots).collect(),
            pixels,
        })
    }

    /// The plots of each run, in the order of the runs.
    pub(super) fn plots(&self) -> &[Vec<Plot>] {
        &self.plots
    }

    /// Each plot of each run as a file of its own: its name and its SVG, which says in a line at its foot where it is from.
    pub(super) fn captioned_plots(&self) -> impl Iterator<Item = (&str, String)> {
        self.runs_with_plots().flat_map(|(run, plots)| {
            let caption = format!("{} \u{b7} {}", self.graded.grade.lab.name, run.task);
            plots
                .iter()
                .map(move |plot| (plot.name.as_str(), plot.captioned(&caption)))
        })
    }

    fn runs_with_plots(&self) -> impl Iterator<Item = (&TaskRun, &[Plot])> {
        let plots = self.plots.iter().map(Vec::as_slice);
        self.graded.runs.iter().zip(plots)
    }

    /// A drawing in pixels.
    ///
    /// # Errors
    /// [`OutputError::Png`] where it is of a size that is not drawn, [`OutputError::NoPng`] in a build that draws none.
    pub(super) fn pixels_of(&self, svg: &str) -> Result<Vec<u8>, OutputError> {
        match self.pixels {
            Pixels::Undrawn => Ok(svg.as_bytes().to_owned()),
            #[cfg(feature = "png")]
            Pixels::Drawn => Ok(crate::png::png(svg)?),
            #[cfg(not(feature = "png"))]
            Pixels::Drawn => {
                let _ = svg;
                Err(OutputError::NoPng)
            }
        }
    }
}

/// One file of a report folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutFile {
    /// Its path inside the folder, with `/` between names.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Whether it is a picture in pixels, the only kind of file whose bytes may differ between processors.
    pub is_pixels: bool,
}

impl OutFile {
    pub(super) fn new(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self {
            path: path.into(),
            bytes: bytes.into(),
            is_pixels: false,
        }
    }

    pub(super) fn pixels(path: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            path: path.into(),
            bytes,
            is_pixels: true,
        }
    }
}

/// Why an output cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A record has no JSON form.
    #[error("a value could not be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A log was refused by its writer.
    #[cfg(feature = "log")]
    #[error("the log of task `{task}` failed: {error}")]
    Log {
        /// The task.
        task: String,
        /// Why.
        error: crate::log::LogError,
    },
    /// A picture cannot be drawn in pixels.
    #[cfg(feature = "png")]
    #[error(transparent)]
    Png(#[from] crate::png::PngError),
    /// This build draws none.
    #[cfg(not(feature = "png"))]
    #[error("pictures in pixels need a build with the feature `png`")]
    NoPng,
}
