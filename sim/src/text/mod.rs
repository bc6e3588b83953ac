//! Text from outside: sources with positions, expressions over named numbers, and errors that point into the text; and numbers in
//! text for people.

mod cut_line;
mod dimensions;
pub mod expression;
mod file_format;
mod linear;
mod marked_numbers;
mod mistakes;
pub mod number;
pub mod schema;
mod source;
mod spanned;
mod suggest;
mod toml_refusal;
mod toml_slips;
mod typed_table;

pub use cut_line::CutLine;
pub use dimensions::{Dimension, Dimensions, ParameterSchema};
pub use file_format::{FORMAT, FileFormat, FormatProblem, format_of};
pub use linear::Linear;
pub use marked_numbers::{MarkedNumbersProblem, read_with_marked_numbers, refused_parts};
pub use mistakes::Mistakes;
pub use source::{Located, Problem, Source};
pub use spanned::Spanned;
pub use suggest::{LONGEST_TYPO, nearest, suggest};
pub use toml_refusal::TomlRefusal;
pub use typed_table::TypedTable;
