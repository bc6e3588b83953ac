//! The grade, shown: text for a terminal, plots as SVG and PNG, and a page that holds everything.

#![cfg_attr(
    test,
    expect(
        clippy::float_cmp,
        reason = "tests state exact values where exactness is the claim"
    )
)]

pub mod brief_page;
mod check_text;
pub mod code_block;
pub mod compare_text;
pub mod explain_text;
pub mod formula;
pub(crate) mod goal;
pub mod html;
mod initial_contact;
#[cfg(feature = "log")]
pub mod log;
pub mod log_request;
mod measured;
pub mod moment;
pub mod output;
mod palette;
pub mod plot;
#[cfg(feature = "png")]
pub mod png;
pub mod replay;
pub mod response_page;
pub mod short_text;
mod shown_unit;
mod solid;
mod stop_words;
pub mod storyboard;
pub mod student_reply;
pub mod text;
pub mod visible;
