//! Whose labs a submission is graded with: what a person named, or what was found around the folder in which the command runs. A hand-in
//! can hold labs, a course staff's part and a course.toml, too; what may be part of one grades nothing.

use std::path::{Path, PathBuf};

use kinemark_course::course_file::COURSE_FILE;

use crate::disk::real;
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::labs_folder::{is_labs, relative};
use crate::output;

/// What is used and was found, and not named on the command line.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// The labs folder that is used, however it was found.
    pub(crate) used: Option<PathBuf>,
    /// The labs folder, where it was found in a folder here or above.
    pub(crate) labs: Option<PathBuf>,
    /// The course staff's part, where it was found beside those labs.
    pub(crate) reference: Option<PathBuf>,
    /// The folder of the course from whose course.toml something was filled in.
    pub(crate) course: Option<PathBuf>,
}

impl Found {
    /// Refuses to grade `submission` with what may have been handed in with it: what lies in its folder, and what lies below other labs
    /// or another course, of which one may be the true one.
    ///
    /// # Errors
    /// Exit code 2 with the way out.
    pub(crate) fn refuse_handed_in(&self, submission: &Path) -> Result<(), Failure> {
        self.refuse_in(folder_of(submission), "the submission", HELP)
    }

    /// The same for `folder` as what was handed in, which is that of `whose`; with what to do.
    ///
    /// # Errors
    /// Exit code 2 with the way out.
    pub(crate) fn refuse_in(&self, folder: &Path, whose: &str, help: &str) -> Result<(), Failure> {
        let course = self.course.as_ref();
        // `.` is no part of a name for people
        let course = course.map(|root| root.strip_prefix(".").unwrap_or(root).join(COURSE_FILE));
        let found = [
            ("labs folder", &self.labs),
            ("course staff's part", &self.reference),
            ("course", &course),
        ];
        let found = found
            .into_iter()
            .filter_map(|(what, path)| Some((what, path.as_ref()?)));
        let handed_in = real(folder);
        for (what, path) in found {
            let shown = output::path(path);
            // where it lies, and where it leads to if it is a link
            if [place(path), real(path)]
                .iter()
                .any(|path| path.starts_with(&handed_in))
            {
                return Err(Failure::usage(
                    format!(
                        "the {what} `{shown}` may be part of what was handed in: it lies in the folder of {whose}"
                    ),
                    help,
                ).coded(ErrorCode::HandedIn));
            }
            if let Some(outer) = self.outer(path) {
                let here = real(Path::new("."));
                let outer = output::path(&relative(&outer, &here));
                return Err(Failure::usage(
                    format!(
                        "the {what} `{shown}` may be part of what was handed in: above it there is `{outer}`"
                    ),
                    help,
                ).coded(ErrorCode::HandedIn));
            }
        }
        Ok(())
    }

    /// Labs or a course above the folder in which `found` lies, other than those that are used.
    fn outer(&self, found: &Path) -> Option<PathBuf> {
        let folder = place(found).parent()?.to_owned();
        let used = self.used.as_deref().map(real);
        let is_other = |labs: &PathBuf| is_labs(labs) && Some(real(labs)) != used;
        folder.ancestors().skip(1).find_map(|above| {
            let labs = Some(above.join("labs")).filter(is_other);
            let course = Some(above.join(COURSE_FILE)).filter(|course| course.is_file());
            labs.or(course)
        })
    }
}

/// What to do where labs may be a student's.
const HELP: &str = "run the command in the course's own folder, such as `kinemark grade LAB hand-ins/s1/submission.rhai`, or name what \
    is meant with --labs DIR and --reference DIR; --practice grades visible cases alone";

/// The folder that is all of what was handed in, as far as a path shows: the submission itself where it is a folder, else its folder.
fn folder_of(submission: &Path) -> &Path {
    if submission.is_dir() {
        return submission;
    }
    match submission.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Where a path itself lies: links on the way to it are followed, and it is not.
fn place(path: &Path) -> PathBuf {
    match (path.parent(), path.file_name()) {
        (Some(folder), Some(name)) if !folder.as_os_str().is_empty() => real(folder).join(name),
        (_, Some(name)) => real(Path::new(".")).join(name),
        (_, None) => real(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder with labs, the course staff's part or a course.toml in folders of it.
    fn bed(labs: &[&str], courses: &[&str]) -> tempfile::TempDir {
        let bed = tempfile::tempdir().unwrap();
        for folder in labs {
            let folder = bed.path().join(folder);
            std::fs::create_dir_all(folder.join("labs/robots")).unwrap();
            std::fs::create_dir_all(folder.join("reference")).unwrap();
        }
        for folder in courses {
            std::fs::create_dir_all(bed.path().join(folder)).unwrap();
            std::fs::write(bed.path().join(folder).join(COURSE_FILE), "").unwrap();
        }
        bed
    }

    /// Whether a submission is refused with the labs and the course of these folders.
    fn is_refused(
        bed: &tempfile::TempDir,
        labs: Option<&str>,
        course: Option<(&str, &str)>,
        submission: &str,
    ) -> bool {
        let of = |folder: &str, name: &str| bed.path().join(folder).join(name);
        let found = Found {
            used: labs
                .or(course.map(|(_, labs)| labs))
                .map(|folder| of(folder, "labs")),
            labs: labs.map(|folder| of(folder, "labs")),
            reference: labs.map(|folder| of(folder, "reference")),
            course: course.map(|(folder, _)| of(folder, "")),
        };
        let submission = bed.path().join(submission);
        std::fs::create_dir_all(submission.parent().unwrap()).unwrap();
        std::fs::write(&submission, "").unwrap();
        found.refuse_handed_in(&submission).is_err()
    }

    #[test]
    fn labs_of_the_course_grade_what_lies_below_them() {
        let bed = bed(&["c"], &[]);
        for submission in [
            "c/hand-ins/s1/submission.rhai",
            "c/s1/submission.rhai",
            "c/reference/01-kinematics/solution.rhai",
            "c/labs/01-kinematics/starter.rhai",
            "elsewhere/submission.rhai",
        ] {
            assert!(
                !is_refused(&bed, Some("c"), None, submission),
                "{submission}"
            );
        }
    }

    #[test]
    fn labs_in_the_folder_of_a_submission_grade_nothing() {
        let bed = bed(&["h", "h/inner"], &["h"]);
        assert!(is_refused(&bed, Some("h"), None, "h/submission.rhai"));
        assert!(is_refused(&bed, Some("h/inner"), None, "h/submission.rhai"));
        assert!(is_refused(
            &bed,
            None,
            Some(("h", "h")),
            "h/submission.rhai"
        ));
    }

    #[test]
    fn labs_below_other_labs_or_another_course_grade_nothing() {
        let nested = "c/hand-ins/s1/src/submission.rhai";
        let labs = bed(&["c", "c/hand-ins/s1"], &["c/hand-ins/s1"]);
        assert!(is_refused(&labs, Some("c/hand-ins/s1"), None, nested));
        let course = Some(("c/hand-ins/s1", "c/hand-ins/s1"));
        assert!(is_refused(&labs, None, course, nested));
        let courses = bed(&["c/hand-ins/s1"], &["c", "c/hand-ins/s1"]);
        assert!(is_refused(&courses, Some("c/hand-ins/s1"), None, nested));
        assert!(is_refused(&courses, None, course, nested));
        // a course that uses the labs above it
        let below = bed(&["repo"], &["repo/courses/w26"]);
        let course = Some(("repo/courses/w26", "repo"));
        let submission = "repo/courses/w26/hand-ins/s1/submission.rhai";
        assert!(!is_refused(&below, None, course, submission));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_hides_no_folder() {
        let bed = bed(&["c", "h/real"], &[]);
        let link = |from: &str, to: &str| {
            std::fs::create_dir_all(bed.path().join(to).parent().unwrap()).unwrap();
            std::os::unix::fs::symlink(bed.path().join(from), bed.path().join(to)).unwrap();
        };
        // labs elsewhere, linked into the folder of the submission, and the other way round
        link("h/real/labs", "h/s1/labs");
        assert!(is_refused(&bed, Some("h/s1"), None, "h/s1/submission.rhai"));
        link("h/real", "way");
        assert!(is_refused(
            &bed,
            Some("way"),
            None,
            "h/real/submission.rhai"
        ));
        link("c", "home");
        assert!(!is_refused(
            &bed,
            Some("home"),
            None,
            "c/s1/submission.rhai"
        ));
    }
}
