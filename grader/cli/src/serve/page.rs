//! A page as it is served: as it lies on the disk, and where the report is written again and again, with a small script that
//! loads it anew.

use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse as _, Response};

use super::files::HTML;

/// Where an open page asks whether it is still the newest.
pub(super) const CHANGES: &str = "/kinemark/changes";

/// Waits for a newer report, and loads it with the place and the moment that are looked at.
const SCRIPT: &str = include_str!("reload.js");
/// The SHA-256 of [`SCRIPT`] for the page's policy: what else is in the page stays without rights.
const SCRIPT_DIGEST: &str = include_str!("reload.js.sha256");

/// What any page may do at most, whatever it says of itself: one that somebody sent may not tell others what it finds here.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A page, with the script if open pages follow; `seen` is the count of the report.
pub(super) fn answer(page: Vec<u8>, seen: Option<u64>) -> Response {
    let page = match seen {
        Some(seen) => following(page, seen),
        None => page,
    };
    let mut answer = page.into_response();
    let headers = answer.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(HTML));
    headers.insert(
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(POLICY),
    );
    answer
}

/// The page with the script at its end and the rights it needs in its policy.
fn following(page: Vec<u8>, seen: u64) -> Vec<u8> {
    // what is no text is no page of ours
    let mut page = match String::from_utf8(page) {
        Ok(page) => page,
        Err(error) => return error.into_bytes(),
    };
    let at = page.rfind("</body>").unwrap_or(page.len());
    page.insert_str(
        at,
        &format!("<script data-seen=\"{seen}\">{SCRIPT}</script>\n"),
    );
    let before = "http-equiv=\"Content-Security-Policy\" content=\"";
    if let Some(from) = page.find(before).map(|at| at + before.len())
        && let Some(length) = page[from..].find('"')
    {
        let policy = with_rights(&page[from..from + length]);
        page.replace_range(from..from + length, &policy);
    }
    page.into_bytes()
}

/// A policy that lets the script run and ask this server, besides what it lets already.
fn with_rights(policy: &str) -> String {
    let digest = format!("'sha256-{}'", SCRIPT_DIGEST.trim());
    let mut parts: Vec<String> = policy
        .split(';')
        .map(|part| part.trim().to_owned())
        .filter(|part| !part.is_empty())
        .collect();
    for (name, value) in [("script-src", digest.as_str()), ("connect-src", "'self'")] {
        let is_it = |part: &&mut String| part.split(' ').next() == Some(name);
        match parts.iter_mut().find(is_it) {
            // 'none' holds only by itself
            Some(part) if part.ends_with("'none'") => *part = format!("{name} {value}"),
            Some(part) => *part += &format!(" {value}"),
            None => parts.push(format!("{name} {value}")),
        }
    }
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digest is that of the script; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_digest_is_that_of_the_script() {
        use sha2::Digest as _;
        let digest = base64(&sha2::Sha256::digest(SCRIPT));
        if std::env::var_os("KINEMARK_BLESS").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/serve/reload.js.sha256");
            std::fs::write(path, format!("{digest}\n")).unwrap();
            return;
        }
        assert_eq!(
            SCRIPT_DIGEST.trim(),
            digest,
            "run KINEMARK_BLESS=1 cargo test"
        );
        assert!(
            !SCRIPT.contains("</") && !SCRIPT.contains("<!--"),
            "it would end in the middle"
        );
    }

    fn base64(bytes: &[u8]) -> String {
        let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut text = String::new();
        for three in bytes.chunks(3) {
            let get = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
            let bits = get(0) << 16 | get(1) << 8 | get(2);
            for i in 0..4 {
                text.push(if i <= three.len() {
                    letters[(bits >> (18 - 6 * i)) as usize & 63] as char
                } else {
                    '='
                });
            }
        }
        text
    }

    #[test]
    fn a_policy_gains_two_rights_and_loses_none() {
        let digest = SCRIPT_DIGEST.trim();
        assert_eq!(
            with_rights("default-src 'none'; img-src data:"),
            format!(
                "default-src 'none'; img-src data:; script-src 'sha256-{digest}'; connect-src 'self'"
            )
        );
        assert_eq!(
            with_rights("default-src 'none'; script-src 'sha256-a='; connect-src 'none'"),
            format!(
                "default-src 'none'; script-src 'sha256-a=' 'sha256-{digest}'; connect-src 'self'"
            )
        );
    }

    #[test]
    fn the_script_stands_at_the_end_of_the_page() {
        let page = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'\"><body><pre>x</pre></body></html>";
        let served = String::from_utf8(following(page.into(), 7)).unwrap();
        assert!(
            served.contains("</pre><script data-seen=\"7\">"),
            "{served}"
        );
        assert!(served.ends_with("</script>\n</body></html>"), "{served}");
        assert!(served.contains("connect-src 'self'\"><body>"), "{served}");
        // bytes that are no text stay as they are
        assert_eq!(following(vec![0xff], 7), [0xff]);
    }
}
