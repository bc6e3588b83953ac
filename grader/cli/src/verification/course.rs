//! What a report is compared with: the labs of the course and the course staff's part, never what the report brings along.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::GradeMode;
use kinemark_grader::task::files::Files;

use super::Wanted;
use crate::disk::{self, Folder};
use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::report_folder::Report;
use crate::staff_folder::{self, StaffArgs};
use crate::whose_labs::Found;
use crate::{chosen_variant, enclosing_course};

/// The course whose report it should be.
pub(crate) struct Course {
    pub(super) labs: Box<dyn Files>,
    /// The folder of the labs; none of those built in.
    pub(super) labs_folder: Option<PathBuf>,
    /// The course staff's part.
    pub(super) reference: Option<Folder>,
    /// What was asked for about it, with the salt of the course in whose folder this runs.
    pub(super) staff: StaffArgs,
}

impl Course {
    /// Finds it as `grade` does: what was named, else what the `course.toml` here or above names, else what is found.
    ///
    /// # Errors
    /// Folders that cannot be opened, or that are the report's own.
    pub(crate) fn find(
        report: &Report,
        labs: &LabsFolderArgs,
        staff: &StaffArgs,
        wanted: Wanted<'_>,
    ) -> Result<Self, Failure> {
        let (mut labs, mut staff) = (labs.clone(), staff.clone());
        let mut found = Found::default();
        if !staff.practice {
            let filled =
                enclosing_course::fill(&report.grade.lab.name, &mut labs, &mut staff.part)?;
            if let Some(filled) = filled {
                failure::note_in_words(&filled.note);
                found.course = Some(filled.root);
            }
        }
        let (files, folder) = labs_folder::open(&labs)?;
        let reference = staff_folder::open(&staff, folder.as_deref())?;
        refuse_own(report, folder.as_deref())?;
        refuse_own(report, reference.as_ref().map(Folder::path))?;
        if labs.labs.is_none() {
            found.labs.clone_from(&folder);
            let beside = reference.as_ref().filter(|_| folder.is_some());
            let beside = beside.filter(|_| staff.part.reference.is_none());
            found.reference = beside.map(|reference| reference.path().to_owned());
        }
        found.used.clone_from(&folder);
        refuse_handed_in(report, &found, wanted)?;
        Ok(Self {
            labs: files,
            labs_folder: folder,
            reference,
            staff,
        })
    }

    /// The course staff's part of a lab; why there is none, in words.
    pub(super) fn staff_of(&self, lab: &Lab) -> Result<Result<Staff, String>, Failure> {
        let part = &self.staff.part;
        let Some(reference) = &self.reference else {
            return Ok(Err(if self.staff.practice {
                "--practice leaves out the course staff's part".to_owned()
            } else {
                "the course staff's part was not found; give --reference DIR".to_owned()
            }));
        };
        match staff_folder::staff(reference, lab, part.salt())? {
            Some(staff) => Ok(Ok(staff)),
            None if part.reference.is_some() => Err(Failure::usage(
                staff_folder::no_solution(reference, lab),
                "check the folder, or use --practice to compare what is visible only",
            )),
            None => Ok(Err(staff_folder::no_solution(reference, lab))),
        }
    }

    /// The salt of the course for a lab; none in practice, and where there is no file with it.
    pub(super) fn salt(&self, lab: &str) -> Result<Option<String>, Failure> {
        if self.staff.practice {
            return Ok(None);
        }
        let reference = self.reference.as_ref();
        let reference = reference.map(|reference| reference as &dyn Files);
        chosen_variant::salt(reference, lab, &self.staff.part)
    }
}

/// Refuses what was found and may have been handed in with a report. With --graded that is all that lies in the folder around the
/// report: whoever is no course staff has the own report beside the labs.
fn refuse_handed_in(report: &Report, found: &Found, wanted: Wanted<'_>) -> Result<(), Failure> {
    let help = "run the command in the course's own folder, such as `kinemark verify handed-in/out --graded`, or name what is meant \
        with --labs DIR and --reference DIR";
    if report.grade.mode == GradeMode::Graded {
        found.refuse_in(&report.folder, "the report", help)?;
    }
    if wanted.graded {
        let real = disk::real(&report.folder);
        // as it was named, and where it is if that was a link
        let around = [report.folder.parent(), real.parent()];
        for folder in around.into_iter().flatten() {
            let folder = match folder.as_os_str().is_empty() {
                true => Path::new("."),
                false => folder,
            };
            found.refuse_in(folder, "the report", help)?;
        }
    }
    Ok(())
}

/// Refuses labs or a staff part that lie in the report: compared with itself every report is right.
fn refuse_own(report: &Report, folder: Option<&Path>) -> Result<(), Failure> {
    let report = disk::real(&report.folder);
    match folder {
        Some(folder) if disk::real(folder).starts_with(&report) => Err(Failure::usage(
            format!(
                "`{}` lies in the report that it should be compared with",
                folder.display()
            ),
            "name the course's own folders with --labs DIR and --reference DIR, or stand in another folder",
        )),
        _ => Ok(()),
    }
}
