//! `kinemark course page`: the class as a page to project, with names for course staff, and what is worth a conversation.

use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::class_pages::{CLASS_FILE, SIMILAR_FILE, STUDENTS_FILE, pages_path};
use kinemark_course::clusters::{self, Cluster};
use kinemark_course::course_file::CourseLab;
use kinemark_course::history::History;
use kinemark_course::page::{
    NamedStudent, PageHead, StaffPage, class_page, named_students, staff_page,
};
use kinemark_course::reports::page_path;
use kinemark_course::similarity::{
    self, Class, Finding, Material, class_files, default_numbers, earlier_files, folders,
    variants_of,
};
use kinemark_course::staffed_lab::{StaffedLab, engine_id};
use kinemark_course::standing::Standing;
use kinemark_course::standing_rows::StandingRow;
use kinemark_course::statistics::{self, LabStatistics};
use kinemark_grader::task::problem::LoadError;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::course_folder::{Course, CourseArgs, book_failure, index_failure};
use crate::failure::{Failure, USAGE};
use crate::output;

/// Write the pages of a class: how it went without names, and for course staff names and similar files
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course page 01-kinematics\n  kinemark course page 01-kinematics --names --similar\n  \
    kinemark course page 01-kinematics --similar --earlier ~/2025/lab1.zip\n\n\
    The pages are in book/pages/LAB, which is replaced as a whole. class.html has no names and no ids: it can be projected. \
    students.html (--names) and similar.html (--similar) are for course staff. What is similar is worth a conversation, and no verdict. \
    `kinemark view book` opens them.\n\
    Exit codes: 0 done, 2 usage, 3 the course or the lab is broken, 4 the book cannot be read or written."
)]
pub(crate) struct Args {
    /// A lab of the course
    pub(crate) lab: String,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Write the same page with names and ids, too: for course staff
    #[arg(long)]
    pub(crate) names: bool,
    /// Compare the files of the class, too: for course staff
    #[arg(long)]
    pub(crate) similar: bool,
    /// A folder, an archive or a book with files of an earlier year to compare with; may be given again
    #[arg(long, value_name = "DIR", requires = "similar")]
    pub(crate) earlier: Vec<PathBuf>,
    /// Print what was written and the numbers as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Files of a folder, by path and bytes.
type Files = Vec<(String, Vec<u8>)>;

/// What the pages are made of.
struct ClassOfLab<'c> {
    course: &'c Course,
    rules: &'c CourseLab,
    lab: StaffedLab,
    history: History,
    standings: Vec<Standing>,
    statistics: LabStatistics,
    clusters: Vec<Cluster>,
    students: Vec<NamedStudent>,
}

/// What was written, for programs.
#[derive(Debug, Serialize)]
struct Written<'a> {
    lab: &'a str,
    /// Files in the course's folder.
    files: Vec<String>,
    /// Names in the folder of the pages of what was there before and is not any more.
    removed: Vec<String>,
    statistics: &'a LabStatistics,
    /// With --similar: these have ids.
    #[serde(skip_serializing_if = "Option::is_none")]
    clusters: Option<&'a [Cluster]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    findings: Option<Vec<Finding>>,
}

/// Makes the pages and writes them.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let course = Course::open(&args.course)?;
    let rules = course.rules(&args.lab)?;
    let class = ClassOfLab::of(&course, rules)?;
    let head = PageHead {
        course: course.file.title.clone(),
        lab_title: class.lab.lab.title.clone(),
        engine: engine_id(),
    };
    let page = |names| class_page(&class.statistics, &class.clusters, &head, names).into_bytes();
    let mut files: Files = vec![(CLASS_FILE.to_owned(), page(None))];
    if args.names {
        files.push((STUDENTS_FILE.to_owned(), page(Some(&class.students))));
    }
    let mut findings = None;
    if args.similar {
        let (found, similar) = class.similar(&args.earlier, &head)?;
        files.extend(similar);
        findings = Some(found);
    }
    let removed = course
        .book
        .put_class_pages(&rules.name, &files)
        .map_err(book_failure)?;
    let folder = course.book.root().join(pages_path(&rules.name));
    let path = |name: &String| output::path(&folder.join(name));
    let written = Written {
        lab: &rules.name,
        files: files.iter().map(|(name, _)| path(name)).collect(),
        removed,
        statistics: &class.statistics,
        clusters: args.similar.then_some(&class.clusters),
        findings,
    };
    if args.json {
        output::print_formatted(&written)?;
    } else {
        let book = output::path(course.book.root());
        let next = format!("{} kinemark view {book}\n", "next:".cyan());
        output::print(&(text(&written, &path) + next.as_str()))?;
    }
    Ok(ExitCode::SUCCESS)
}

impl<'c> ClassOfLab<'c> {
    /// Reads the lab, and brings the index up to date.
    fn of(course: &'c Course, rules: &'c CourseLab) -> Result<Self, Failure> {
        let lab = course.lab(rules)?;
        let history = course.history()?;
        let mut index = course.index(&history)?;
        let standings = course.put_standings(&history, &mut index)?;
        let standings: Vec<Standing> = standings
            .into_iter()
            .filter(|standing| standing.lab == rules.name)
            .collect();
        let statistics = statistics::of_lab(&index, &rules.name, &standings, &course.roster);
        let clusters = clusters::of_lab(&index, &rules.name, &standings);
        let rows = standings.iter().map(StandingRow::from);
        let report = |row: &StandingRow| {
            let key = row.record.as_deref()?;
            let has_page = course.book.has_page(&row.lab, key);
            // from the folder of the lab's pages
            has_page.then(|| format!("../../{}", page_path(&row.lab, key)))
        };
        Ok(Self {
            students: named_students(rows, &course.roster, report),
            statistics: statistics.map_err(index_failure)?,
            clusters: clusters.map_err(index_failure)?,
            course,
            rules,
            lab,
            history,
            standings,
        })
    }

    /// What is worth a conversation, as findings, and as the page and the folders of it.
    fn similar(
        &self,
        earlier: &[PathBuf],
        head: &PageHead,
    ) -> Result<(Vec<Finding>, Files), Failure> {
        let course = self.course;
        let lab = &self.rules.name;
        let files = class_files(
            &course.book,
            &self.history,
            &course.roster,
            lab,
            &self.standings,
        )
        .map_err(book_failure)?;
        let mut material = Material::of_lab(&self.lab, course.handed_out(self.rules)?);
        let mut of_earlier = 0;
        for source in earlier {
            let found = earlier_files(source).map_err(|error| Failure::diagnostic(USAGE, error))?;
            if found.is_empty() {
                return Err(Failure::usage(
                    format!("`{}` has no submission in it", output::path(source)),
                    "name a folder with scripts (.rhai), what the LMS exported, or a book",
                ));
            }
            of_earlier += found.len();
            material.earlier.extend(found);
        }
        material.add_public(&files);
        let variants = variants_of(&self.lab, &course.roster)
            .map_err(|error| Failure::from(LoadError::from(error)))?;
        let findings = similarity::findings(&Class {
            files: &files,
            variants: &variants,
            default: &default_numbers(&self.lab),
            material: &material,
        });
        let page = StaffPage {
            lab,
            findings: &findings,
            clusters: &self.clusters,
            students: &self.students,
            compared_with: &compared_with(of_earlier),
        };
        let mut made: Files = vec![(
            SIMILAR_FILE.to_owned(),
            staff_page(&page, head).into_bytes(),
        )];
        for (folder, files) in [
            ("jplag", folders::jplag(&files, &material)),
            ("dolos", folders::dolos(&files, &material)),
        ] {
            let inside = files.into_iter();
            made.extend(inside.map(|(path, bytes)| (format!("{folder}/{path}"), bytes)));
        }
        Ok((findings, made))
    }
}

/// What the class was compared with, in words.
fn compared_with(earlier: usize) -> String {
    let public = "the reference solutions of Kinemark's repository";
    match earlier {
        0 => public.to_owned(),
        1 => format!("1 earlier file and {public}"),
        count => format!("{count} earlier files and {public}"),
    }
}

/// A line for each page and folder, and one for what went.
fn text(written: &Written<'_>, path: &impl Fn(&String) -> String) -> String {
    let mut out = String::new();
    let folders = ["jplag", "dolos"].map(|name| path(&name.to_owned()));
    let is_inside = |file: &&String| !folders.iter().any(|folder| file.starts_with(folder));
    for file in written.files.iter().filter(is_inside) {
        let what = match file.rsplit(['/', '\\']).next() {
            Some(CLASS_FILE) => "the class, without names",
            Some(STUDENTS_FILE) => "with names, for course staff",
            _ => "similar files, for course staff",
        };
        out += &format!("{file}: {what}\n");
    }
    if let Some(findings) = &written.findings {
        for (folder, what) in folders.iter().zip(["JPlag", "Dolos"]) {
            out += &format!("{folder}: the files as {what} reads them\n");
        }
        out += &match findings.len() {
            0 => "nothing is worth a conversation\n".to_owned(),
            1 => "1 finding is worth a conversation\n".to_owned(),
            count => format!("{count} findings are worth a conversation\n"),
        };
    }
    if !written.removed.is_empty() {
        out += &format!(
            "{} {} of an earlier time removed: --names and --similar write them anew\n",
            "note:".yellow(),
            written.removed.join(", ")
        );
    }
    out
}
