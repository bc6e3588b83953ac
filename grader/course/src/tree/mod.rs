//! A source as a tree of files, whether it is a folder or an archive: names made plain, limits kept, nothing followed, nothing written.
//!
//! | file | idea |
//! |---|---|
//! | `limits` | how much is read |
//! | `problem` | what can be wrong with a source and with a file of it |
//! | `entry_name` | a name as written to a path inside the source |
//! | `file_kind` | what a file is by its first bytes |
//! | `listing` | names collected: duplicates, names that are alike |
//! | `folder` | the files of a folder |
//! | `archive` | the files of a ZIP archive |
//! | `file_tree` | the tree that others read |

mod archive;
#[cfg(test)]
mod attacks;
mod entry_name;
mod file_kind;
mod file_tree;
mod folder;
mod limits;
mod listing;
mod problem;
#[cfg(test)]
pub(crate) mod sample;

pub use file_kind::file_kind;
pub use file_tree::Tree;
pub use limits::Limits;
pub use listing::{Entry, MisnamedEntry};
pub use problem::{EntryProblem, TreeError};
