//! What is worth a conversation: files that have something in common which is hard to come by independently. For course staff alone;
//! it is in no gradebook and in no feedback, and it decides nothing.
//!
//! Three kinds of things are looked for:
//!
//! - [`foreign_numbers`]: numbers of another student's variant in a file, and not its own student's. Only a course with variants has
//!   them. It cannot see numbers that were turned into others first, nor integers and numbers of one digit, which anybody writes.
//! - [`passages`]: long passages that are equal token by token, names and the words of comments included, and that few share; with
//!   comments, those that up to half of the class share. Renaming a variable in every line hides them; JPlag and Dolos look for that
//!   ([`folders`] writes what they read).
//! - [`earlier`]: the same with last year's files and public solutions.
//!
//! What everybody was given (starter, brief, files of the lab) and, within the class, the reference solution are taken out first. Each
//! finding says how many of the class share it: a base rate of 34 of 120 is a common way to write it, not a copy.

mod class_file;
mod coverage;
pub mod earlier;
mod earlier_source;
mod finding;
pub mod folders;
pub mod foreign_numbers;
mod material;
pub mod passages;
mod search;
mod token;

pub use self::class_file::{ClassFile, VariantNumbers, class_files, default_numbers, variants_of};
pub use self::earlier_source::earlier_files;
pub use self::finding::{Finding, Found, Kind, Whose};
pub use self::material::Material;
pub use self::search::{Class, findings};
