//! Text from outside: sources with positions, expressions over named numbers, and errors that point into the text; and numbers in
//! text for people.

mod cut_line;
mod dimensions;
pub mod expression;
mod linear;
mod marked_numbers;
pub mod number;
mod source;
mod spanned;
mod suggest;
mod toml_refusal;
mod typed_table;

pub use cut_line::CutLine;
pub use dimensions::{Dimension, Dimensions};
pub use linear::Linear;
pub use marked_numbers::{MarkedNumbersProblem, read_with_marked_numbers};
pub use source::{Located, Problem, Source};
pub use spanned::Spanned;
pub use suggest::{LONGEST_TYPO, nearest, suggest};
pub use toml_refusal::TomlRefusal;
pub use typed_table::TypedTable;
