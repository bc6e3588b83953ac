//! What a task is made of before anybody tries it: the robot, the scene, what is asked for; and the files they come from.

pub mod files;
pub mod grant;
pub mod jacobian;
pub mod joint_units;
pub(crate) mod law;
pub mod mesh_file;
pub mod model;
pub mod problem;
pub(crate) mod reporter;
pub mod robot;
pub mod scene;
pub mod tcp;
pub mod value;
pub mod watched;
pub mod workcell;
