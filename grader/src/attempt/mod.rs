//! A submission tried on one task: its answers to the cases of a function task, or its run of a motion task.

pub mod function;
pub mod motion;
pub mod stopped;
