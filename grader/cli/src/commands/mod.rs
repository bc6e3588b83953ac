//! One file per subcommand: its arguments, whose comments are its help, and what it does.

pub(crate) mod autograder;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod course_check;
pub(crate) mod course_explain;
pub(crate) mod course_forget;
pub(crate) mod course_grade;
pub(crate) mod course_regrade;
pub(crate) mod course_release;
pub(crate) mod course_status;
pub(crate) mod grade;
pub(crate) mod lab_check;
pub(crate) mod lab_draws;
pub(crate) mod lab_list;
pub(crate) mod lab_pack;
pub(crate) mod lab_variant;
pub(crate) mod log_export;
pub(crate) mod new;
pub(crate) mod robot_convert;
pub(crate) mod robot_eval;
pub(crate) mod robot_show;
pub(crate) mod scene_check;
pub(crate) mod submit;
pub(crate) mod verify;
pub(crate) mod view;
pub(crate) mod watch;
