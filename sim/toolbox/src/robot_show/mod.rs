//! A robot as text for people and as JSON for programs.

mod link_table;
mod link_tree;
mod robot_record;
mod robot_text;

pub use robot_record::robot_record;
pub use robot_text::robot_text;
