//! Why a form cannot be made: what was given, what was expected, and what to do.

use super::number::points_text;

/// Why a form cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum ReleaseError {
    /// The LMS's own file was not given.
    #[error("`{form}` fills in a file of the LMS, and none was given")]
    #[diagnostic(
        code(release::no_export),
        help("download {what}, and name the file with --export FILE")
    )]
    NoExport {
        /// The form.
        form: &'static str,
        /// The file that it fills in.
        what: &'static str,
    },
    /// Something was named that the form has no use for.
    #[error("the form `{form}` has no use for {option}")]
    #[diagnostic(
        code(release::unused_option),
        help("leave it out, or choose a form that uses it: {forms}")
    )]
    UnusedOption {
        /// The form.
        form: &'static str,
        /// The option.
        option: &'static str,
        /// The forms that use it.
        forms: String,
    },
    /// A column of the LMS's file was named, and no file.
    #[error("{option} names a column of a file, and no file was given")]
    #[diagnostic(
        code(release::column_of_no_file),
        help("name the file with --export: {what}")
    )]
    ColumnOfNoFile {
        /// The option.
        option: &'static str,
        /// The file that it fills in.
        what: &'static str,
    },
    /// A spreadsheet or an archive, not a table of text.
    #[error("{name} is not a CSV file: {why}")]
    #[diagnostic(
        code(release::not_csv),
        help("save it as CSV, in UTF-8 where there is a choice, or download it again")
    )]
    NotCsv {
        /// The file.
        name: String,
        /// What it is, or what is wrong with it.
        why: String,
    },
    /// A column that has to be there.
    #[error("{name} has no column for {wanted}; found: {}", .found.join(" | "))]
    #[diagnostic(code(release::no_column), help("{help}"))]
    NoColumn {
        /// The file.
        name: String,
        /// What the column holds.
        wanted: String,
        /// The headers.
        found: Vec<String>,
        /// What to do.
        help: String,
    },
    /// Two columns, and no way to know which is meant.
    #[error("{name} has several columns for {wanted}: {}", .found.join(" | "))]
    #[diagnostic(
        code(release::several_columns),
        help("name the one that is meant with --column, or delete the others")
    )]
    SeveralColumns {
        /// The file.
        name: String,
        /// What the column holds.
        wanted: String,
        /// Their headers.
        found: Vec<String>,
    },
    /// A row that has another number of cells than the header.
    #[error("{name}, line {line}: {cells} cells, and the header has {expected}")]
    #[diagnostic(
        code(release::row_width),
        help(
            "a cell with a comma or a semicolon needs quotes; download the file again rather than repair it"
        )
    )]
    RowWidth {
        /// The file.
        name: String,
        /// The line, from one.
        line: usize,
        /// Cells of the row.
        cells: usize,
        /// Cells of the header.
        expected: usize,
    },
    /// The LMS counts to another maximum than the lab.
    #[error("{name}, line {line}: the maximum is {} there, and {} in the lab", points_text(*.theirs), points_text(*.ours))]
    #[diagnostic(
        code(release::maximum),
        help("set the maximum of the assignment to {} and download the file again; points are not scaled", points_text(*.ours))
    )]
    Maximum {
        /// The file.
        name: String,
        /// The line, from one.
        line: usize,
        /// The maximum in the LMS.
        theirs: f64,
        /// The maximum of the lab.
        ours: f64,
    },
    /// The assignment is graded with words.
    #[error("{name}: the assignment is graded on a scale of words, not with points")]
    #[diagnostic(
        code(release::scale),
        help("set the type of its grade to points and download the worksheet again")
    )]
    Scale {
        /// The file.
        name: String,
    },
    /// A column that the LMS computes itself.
    #[error("{name}: the column `{column}` is read-only in the LMS")]
    #[diagnostic(
        code(release::read_only),
        help("name the column of the assignment, such as `Lab 1 (4314282)`")
    )]
    ReadOnly {
        /// The file.
        name: String,
        /// The column.
        column: String,
    },
    /// The archive could not be written.
    #[error("the archive of feedback files cannot be written: {why}")]
    #[diagnostic(code(release::archive), help("release in parts, by section"))]
    Archive {
        /// Why.
        why: String,
    },
}
