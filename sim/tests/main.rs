//! The simulator against independent numbers and against itself.

mod algorithms;
mod arms;
mod contact;
mod contact_scenes;
mod differential;
mod golden_robots;
mod golden_rrbot;
mod golden_steps;
mod golden_urdf;
mod inverse;
mod laws;
mod link_drag;
mod loops;
mod mesh_files;
mod mesh_solids;
mod robot_files;
mod runs;
mod sampled_loop;
mod scenes;
mod trajectories;
mod urdf;
mod urdf_mistakes;
