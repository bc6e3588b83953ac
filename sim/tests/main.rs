//! The simulator against independent numbers and against itself.

mod algorithms;
mod arms;
mod golden_rrbot;
mod golden_steps;
mod laws;
mod robot_files;
mod trajectories;
