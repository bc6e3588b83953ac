//! The grade, shown: text for a terminal, plots as SVG, and a page that holds everything.

mod goal;
pub mod html;
mod number;
pub mod plot;
#[cfg(test)]
pub(crate) mod sample;
pub mod text;
mod theme;
mod visible;

pub(crate) use goal::current_goal;
pub(crate) use visible::{shortened, visible};
