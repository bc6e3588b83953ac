//! One file per subcommand: its arguments, whose comments are its help, and what it does.

pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod eval;
pub(crate) mod export;
pub(crate) mod grade;
pub(crate) mod lab_check;
pub(crate) mod labs;
pub(crate) mod new;
pub(crate) mod scene_check;
pub(crate) mod show;
pub(crate) mod variant;
pub(crate) mod verify;
pub(crate) mod view;
pub(crate) mod watch;
