//! How solids are drawn: faces, outlines, and the shorter forms of viewers that know a solid by itself. One file per primitive, and
//! one line in [`drawn`].

mod block;
mod capsule;
mod cylinder;
mod drawn;
mod faces;
mod mesh;
mod outline;
mod sphere;
mod surface;
mod thinned;

#[cfg(feature = "log")]
pub(crate) use drawn::LogForm;
pub(crate) use drawn::{ReplayForm, drawn};
pub(crate) use faces::{Detail, Faces};
pub(crate) use surface::Surface;
