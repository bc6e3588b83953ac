//! What happened in a run: limits, motion that is not resolved, singular configurations, contacts, falls.

mod bodies;
mod contacts;
pub mod event;
mod event_sentence;
mod joints;
mod resolution;
mod run_watch;
mod singularity;

pub use contacts::ContactSpan;
pub use event_sentence::Names;
pub use resolution::ResolutionWatch;
pub use run_watch::Watch;
