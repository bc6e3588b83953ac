//! What a task is made of before anybody tries it: the robot, the scene, what is asked for; and the files they come from.

pub mod entry;
pub mod files;
pub mod grant;
pub mod jacobian;
pub mod joint_units;
pub(crate) mod law;
pub mod mesh_file;
pub mod model;
pub mod pose;
pub(crate) mod pose_target;
pub mod problem;
pub(crate) mod push;
pub mod quantity;
pub(crate) mod reporter;
pub mod robot;
pub mod scene;
pub mod task_joints;
pub mod tcp;
pub mod value;
pub mod watched;
pub mod workcell;
