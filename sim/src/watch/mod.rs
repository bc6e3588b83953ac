//! What happened in a run: limits, singular configurations, contacts, falls.

mod bodies;
mod contacts;
pub mod event;
pub mod event_words;
mod joints;
mod run_watch;
mod singularity;

pub use contacts::ContactSpan;
pub use run_watch::Watch;
