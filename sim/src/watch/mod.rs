//! What happened in a run: limits, singular configurations, contacts, falls.

mod bodies;
mod contacts;
pub mod event;
mod event_sentence;
mod joints;
mod run_watch;
mod singularity;

pub use contacts::ContactSpan;
pub use event_sentence::Names;
pub use run_watch::Watch;
