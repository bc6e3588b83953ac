//! A run, written down for other tools: an MCAP log with everything that moved, and a layout to open it with.

mod bodies;
mod layout;
mod mcap;
mod message;
mod names;
mod scene;
mod schema;
mod topics;
mod tree;

pub use layout::layout;
pub use mcap::{Attachment, LogError, mcap};
