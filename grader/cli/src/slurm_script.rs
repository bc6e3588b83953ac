//! The scripts of a lab graded on a Slurm cluster, and the paths in them and in the options of `sbatch`.

use std::path::Path;

use crate::disk::plain;
use crate::failure::Failure;
use crate::output;
use crate::shard::Shard;

/// What the jobs of a run do.
pub(crate) struct Work<'w> {
    /// The course's folder.
    pub(crate) course: &'w Path,
    pub(crate) lab: &'w str,
    /// The parts with something to grade.
    pub(crate) parts: &'w [Shard],
    /// Submissions graded at once in each part; as many as Slurm gives it processors where nobody says.
    pub(crate) jobs: Option<usize>,
    /// Whether each part refuses a machine that does not seal workers.
    pub(crate) require_sandbox: bool,
    pub(crate) reports: bool,
    /// More options of `sbatch`.
    pub(crate) options: &'w [String],
}

/// The two scripts of a run.
pub(crate) struct Scripts {
    pub(crate) part: String,
    pub(crate) join: String,
}

impl Scripts {
    pub(crate) fn new(work: &Work<'_>) -> Result<Self, Failure> {
        let program = std::env::current_exe().map_err(|error| {
            let what = format!("the path of kinemark is not known: {}", plain(&error));
            Failure::fault(what, "call it by its whole path")
        })?;
        let course = work.course.canonicalize();
        let course = course.unwrap_or_else(|_| work.course.to_owned());
        Ok(Self::of(text_of(&program)?, text_of(&course)?, work))
    }

    fn of(program: &str, course: &str, work: &Work<'_>) -> Self {
        let (program, course, lab) = (quoted(program), quoted(course), quoted(work.lab));
        let count = work.parts.first().map_or(1, |part| part.count());
        let jobs = match work.jobs {
            Some(jobs) => jobs.to_string(),
            None => "\"${SLURM_CPUS_ON_NODE:-1}\"".to_owned(),
        };
        let reports = if work.reports { "" } else { " --no-reports" };
        let sandbox = if work.require_sandbox {
            " --require-sandbox"
        } else {
            ""
        };
        let script = |what: &str, shard: &str| {
            format!(
                "#!/bin/sh\n# {what}; written by `kinemark course grade --slurm`\ncd {course} || exit 4\n\
                 exec {program} course grade{shard} --jobs {jobs}{reports}{sandbox} -- {lab}\n"
            )
        };
        Self {
            part: script(
                &format!("Grades one of {count} parts of a class"),
                &format!(" --shard \"$SLURM_ARRAY_TASK_ID/{count}\""),
            ),
            join: script("Joins the parts, and grades what they left open", ""),
        }
    }
}

/// A word of a shell that means itself.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// A path as text: a script and an option can say no other.
pub(crate) fn text_of(path: &Path) -> Result<&str, Failure> {
    path.to_str().ok_or_else(|| {
        Failure::usage(
            format!(
                "`{}` is not UTF-8, so no job script can name it",
                output::path(path)
            ),
            "rename the folder",
        )
    })
}

/// The option of `sbatch` for the log `name` of the folder `folder`. In it `%` begins a pattern, such as `%a` for the number of a task,
/// and a backslash ends all patterns.
pub(crate) fn log_option(folder: &Path, name: &str) -> Result<String, Failure> {
    let text = text_of(folder)?;
    if text.contains('\\') {
        return Err(Failure::usage(
            format!(
                "`{}` has a backslash, so Slurm can write no log there",
                output::path(folder)
            ),
            "rename the folder",
        ));
    }
    Ok(format!("--output={}/{name}", text.replace('%', "%%")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn work(parts: &[Shard]) -> Work<'_> {
        Work {
            course: Path::new("."),
            lab: "01-kinematics",
            parts,
            jobs: None,
            require_sandbox: false,
            reports: true,
            options: &[],
        }
    }

    #[test]
    fn scripts_quote_what_they_name() {
        let parts = ["2/4".parse().unwrap(), "3/4".parse().unwrap()];
        let scripts = Scripts::of(
            "/opt/kine mark",
            "/courses/Anna's $1 \"robots\"",
            &work(&parts),
        );
        assert_eq!(
            scripts.part,
            "#!/bin/sh\n# Grades one of 4 parts of a class; written by `kinemark course grade --slurm`\n\
             cd '/courses/Anna'\\''s $1 \"robots\"' || exit 4\n\
             exec '/opt/kine mark' course grade --shard \"$SLURM_ARRAY_TASK_ID/4\" --jobs \"${SLURM_CPUS_ON_NODE:-1}\" -- '01-kinematics'\n"
        );
        assert!(
            scripts
                .join
                .ends_with("course grade --jobs \"${SLURM_CPUS_ON_NODE:-1}\" -- '01-kinematics'\n"),
            "{}",
            scripts.join
        );
        let fixed = Work {
            jobs: Some(8),
            require_sandbox: true,
            reports: false,
            ..work(&parts)
        };
        let script = Scripts::of("k", "c", &fixed).part;
        assert!(
            script.contains(" --jobs 8 --no-reports --require-sandbox -- "),
            "{script}"
        );
    }

    /// What a shell makes of a quoted word is the word.
    #[cfg(unix)]
    #[test]
    fn a_shell_reads_a_quoted_word_as_it_is() {
        for word in ["", "a b", "it's", "''", "$HOME `ls` \\ \"x\"", "é\n*", "-n"] {
            let script = format!("printf %s {}", quoted(word));
            let ran = std::process::Command::new("sh")
                .args(["-c", &script])
                .output();
            assert_eq!(ran.unwrap().stdout, word.as_bytes(), "{word:?}");
        }
    }

    #[test]
    fn the_folder_of_a_log_is_no_pattern() {
        let option = |folder| log_option(Path::new(folder), "part-%a.log");
        assert_eq!(
            option("/a b/100%a").unwrap(),
            "--output=/a b/100%%a/part-%a.log"
        );
        assert!(option("/a\\b").is_err());
    }
}
