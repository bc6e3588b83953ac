//! A report folder served to the browser on this machine.

mod files;
mod guard;
pub(crate) mod index;
mod page;
mod server;

pub(crate) use server::{ServeArgs, Server, open};
