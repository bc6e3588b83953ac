//! The grade, shown: text for a terminal, plots as SVG and PNG, and a page that holds everything.

pub mod brief_page;
pub mod compare_text;
pub(crate) mod goal;
pub mod html;
mod measured;
pub mod moment;
mod number;
pub mod plot;
#[cfg(not(target_family = "wasm"))]
pub mod png;
pub mod replay;
#[cfg(test)]
pub(crate) mod sample;
mod standing;
pub mod storyboard;
pub mod text;
mod theme;
pub mod visible;
