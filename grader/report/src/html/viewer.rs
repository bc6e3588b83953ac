//! What makes a replay in a page: its place, its data, the viewer's code, and the rule that lets this code run and no other.

use maud::{Markup, PreEscaped, html};

use crate::moment::fragment;
use crate::visible::visible;

/// The viewer, built from `grader/web`.
const CODE: &str = include_str!("../../../web/dist/viewer.js");
/// Base64 of the SHA-256 of [`CODE`].
const DIGEST: &str = include_str!("../../../web/dist/viewer.js.sha256");
/// How the viewer looks.
const STYLE: &str = include_str!("../../../web/dist/viewer.css");

/// Where a page has the viewer's code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewerCode<'a> {
    /// In the page, which is then one file with everything in it.
    Inside,
    /// In a file that pages share: its address, seen from the page.
    Beside(&'a str),
}

impl ViewerCode<'_> {
    /// The code, for the file that pages share.
    pub fn text() -> &'static str {
        CODE
    }
}

/// What a browser may load for a page: its own styles, and the viewer's code where it has replays.
pub(crate) fn policy(has_replays: bool, code: ViewerCode<'_>) -> String {
    let (script, images) = match (has_replays, code) {
        (true, ViewerCode::Inside) => (
            format!("script-src 'sha256-{}'; ", DIGEST.trim()),
            "data: blob:",
        ),
        // a page that was opened as a file has no origin of its own
        (true, ViewerCode::Beside(_)) => ("script-src 'self' file:; ".to_owned(), "data: blob:"),
        (false, _) => (String::new(), "data:"),
    };
    format!(
        "default-src 'none'; {script}style-src 'unsafe-inline'; img-src {images}; base-uri 'none'; form-action 'none'"
    )
}

/// What a browser may load for a page with the viewer in it whose pictures lie beside it.
pub(crate) fn policy_with_pictures() -> String {
    let inside = policy(true, ViewerCode::Inside);
    inside.replace("img-src ", "img-src 'self' file: ")
}

/// The viewer's style sheet, where there are replays.
pub(crate) fn style(has_replays: bool) -> Markup {
    PreEscaped(if has_replays { STYLE } else { "" }.to_owned())
}

fn id(index: usize) -> String {
    format!("replay-{}", index + 1)
}

/// Where the viewer puts the replay of the task of this index; empty, and without room, until then.
pub(crate) fn place(index: usize, task: &str) -> Markup {
    html! { div class="replay" data-replay=(id(index)) data-task=(visible(task)) {} }
}

/// The data of a replay.
pub(crate) fn data(index: usize, json: &str) -> Markup {
    html! { script type="application/json" id=(id(index)) { (PreEscaped(json)) } }
}

/// The one arm of a page: its id, and the class by which it is drawn.
const ARM: &str = "arm";

/// Where the viewer puts an arm that its reader moves; empty, and without room, until then.
pub(crate) fn arm_place() -> Markup {
    html! { div class=(ARM) data-arm=(ARM) {} }
}

/// The data of that arm.
pub(crate) fn arm_data(json: &str) -> Markup {
    html! { script type="application/json" id=(ARM) { (PreEscaped(json)) } }
}

/// The viewer, once, after all data.
pub(crate) fn script(code: ViewerCode<'_>) -> Markup {
    match code {
        ViewerCode::Inside => html! { script { (PreEscaped(CODE)) } },
        ViewerCode::Beside(address) => html! { script src=(address) {} },
    }
}

/// A page whose viewer's code is at `address`, with the code in it instead: the same bytes as a page that was made so.
pub fn whole(page: &str, address: &str) -> String {
    let beside = ViewerCode::Beside(address);
    let meta =
        |code| html! { meta http-equiv="Content-Security-Policy" content=(policy(true, code)); };
    let pairs = [
        (meta(beside), meta(ViewerCode::Inside)),
        (script(beside), script(ViewerCode::Inside)),
    ];
    pairs.into_iter().fold(page.to_owned(), |page, (from, to)| {
        // the last one: text before it may show the same characters
        match page.rsplit_once(&from.0) {
            Some((before, after)) => format!("{before}{}{after}", to.0),
            None => page,
        }
    })
}

/// Words that lead to a moment of a task's replay.
pub(crate) fn seek(task: &str, time_s: f64, words: &str) -> Markup {
    seek_with(task, time_s, &html! { (words) })
}

/// Anything that leads to a moment of a task's replay.
pub(crate) fn seek_with(task: &str, time_s: f64, shown: &Markup) -> Markup {
    html! { a class="seek" href=(fragment(task, time_s)) { (shown) } }
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use sha2::Digest as _;

    use super::*;

    #[test]
    fn the_viewer_cannot_end_its_own_element() {
        let code = CODE.to_ascii_lowercase();
        assert!(!code.contains("</script") && !code.contains("<!--") && !code.contains("<script"));
        assert!(!STYLE.to_ascii_lowercase().contains("</style") && !STYLE.contains("url(http"));
    }

    /// A browser runs no code but that of the digest.
    #[test]
    fn the_digest_is_the_codes() {
        let digest = sha2::Sha256::digest(CODE);
        assert_eq!(STANDARD.encode(digest), DIGEST.trim());
    }

    #[test]
    fn a_page_without_replays_runs_nothing() {
        assert!(!policy(false, ViewerCode::Inside).contains("script-src"));
        assert!(policy(true, ViewerCode::Inside).contains("script-src 'sha256-"));
        assert_eq!(style(false).into_string(), "");
    }
}
