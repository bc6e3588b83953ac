//! A report folder, or the book of a course, served to the browser on this machine.

mod book;
mod connections;
mod files;
mod guard;
pub(crate) mod index;
mod page;
mod server;
mod token;

pub(crate) use book::ServedBook;
pub(crate) use server::{ServeArgs, Server, open};
