//! A run, written down for other tools: an MCAP log with everything that moved, a layout to open it with, and any such log as
//! tables.

mod annotations;
mod bodies;
mod columns;
mod csv;
mod json;
mod layout;
mod mcap;
mod message;
mod messages;
mod motion;
mod names;
mod protobuf;
mod read;
mod scene;
mod schema;
mod signals;
mod tree;
mod wide;

pub use csv::{Table, Tables, tables, write_csv};
pub use layout::layout;
pub use mcap::{Attachment, LogError, mcap};
pub use read::ReadError;
pub use wide::{Wide, write_wide};
