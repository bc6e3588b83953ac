//! A page without replays: the report's styles and the caller's, and at most one small script, which its digest lets run.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::palette::plot_css;
use crate::visible::visible;

/// What a page has besides its body.
#[derive(Debug, Clone, Copy)]
pub struct StaticPage<'a> {
    /// Its title.
    pub title: &'a str,
    /// The engine that made it.
    pub engine: &'a str,
    /// Rules beside those of the report.
    pub css: &'a str,
    /// The one script that may run, if there is one.
    pub script: Option<SmallScript<'a>>,
}

/// A script, and what a browser knows it by.
#[derive(Debug, Clone, Copy)]
pub struct SmallScript<'a> {
    /// Its code, without `</script`.
    pub code: &'a str,
    /// Base64 of the SHA-256 of the code.
    pub digest: &'a str,
}

impl StaticPage<'_> {
    /// The page around `body`. It asks nothing of the network; the same page gives the same bytes.
    pub fn around(&self, body: &Markup) -> String {
        self.with_pictures_from("data:", body)
    }

    /// The page around `body` as it is served, with pictures of the server that it comes from.
    pub fn around_with_pictures(&self, body: &Markup) -> String {
        self.with_pictures_from("'self' data:", body)
    }

    fn with_pictures_from(&self, images: &str, body: &Markup) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(self.policy(images));
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta name="referrer" content="no-referrer";
                    meta name="generator" content=(visible(self.engine));
                    title { (visible(self.title)) }
                    style { (PreEscaped(include_str!("page.css"))) (PreEscaped(self.css)) (PreEscaped(plot_css())) }
                }
                body {
                    (body)
                    @if let Some(script) = self.script { script { (PreEscaped(script.code)) } }
                }
            }
        };
        page.into_string()
    }

    fn policy(&self, images: &str) -> String {
        let script = self.script.map(|script| {
            let digest = script.digest.trim();
            format!("script-src 'sha256-{digest}'; ")
        });
        format!(
            "default-src 'none'; {}style-src 'unsafe-inline'; img-src {images}; base-uri 'none'; form-action 'none'",
            script.unwrap_or_default()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_runs_its_own_script_and_no_other() {
        let mut page = StaticPage {
            title: "A <class>\u{202E}",
            engine: "kinemark",
            css: ".own{color:red}",
            script: None,
        };
        let body = html! { p { "x" } };
        let still = page.around(&body);
        assert!(still.contains("<title>A &lt;class&gt;⟨U+202E⟩</title>"));
        assert!(still.contains(".own{color:red}") && still.contains("<p>x</p></body>"));
        assert!(!still.contains("script"));
        assert!(still.contains("img-src data:;"));
        assert!(
            page.around_with_pictures(&body)
                .contains("img-src 'self' data:;")
        );
        page.script = Some(SmallScript {
            code: "let a = 1 < 2;",
            digest: "abc=\n",
        });
        let moving = page.around(&body);
        assert!(moving.contains("script-src 'sha256-abc='; style-src"));
        assert!(moving.contains("<script>let a = 1 < 2;</script></body>"));
    }
}
