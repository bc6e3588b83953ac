//! Text from outside: sources with places, expressions over named numbers, and refusals that point into the text.

mod dimensions;
pub mod expression;
mod source;
mod suggest;
mod toml_refusal;

pub use dimensions::{Dimension, Dimensions};
pub use source::{Located, Problem, Source};
pub use suggest::{nearest, suggest};
pub use toml_refusal::TomlRefusal;
