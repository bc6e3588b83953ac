//! A page as it is served: as it lies on the disk, and where the report is written again and again, with a small script that
//! loads it anew.

use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};

use super::files::HTML;

/// Where an open page asks whether it is still the newest, seen from the report.
pub(super) const CHANGES: &str = "/kinemark/changes";

/// Waits for a newer report, and loads it with the place and the moment that are looked at.
const SCRIPT: &str = include_str!("reload.js");
/// The SHA-256 of [`SCRIPT`] for the page's policy: what else is in the page stays without rights.
const SCRIPT_DIGEST: &str = include_str!("reload.js.sha256");

/// What a page may do that somebody may have sent: run what is in it, and nothing else. In a sandbox it has an origin of its own, so
/// that it can neither read what else lies on this server nor keep anything in the browser.
const ALONE: &str = "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; \
                     img-src data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// A list sorts and filters, and shows pictures of reports: its own policy names the one script that runs.
const LIST: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self'; base-uri 'none'; \
                         form-action 'none'; frame-ancestors 'none'";
/// What a page of ours may do that follows: its own policy lets the scripts run that it names, and no others.
const FOLLOWING: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; \
                         connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A page as it lies on the disk.
pub(super) fn alone(page: impl IntoResponse) -> Response {
    answer(page, ALONE)
}

/// The list of reports, or that of a book.
pub(super) fn sorted_list(page: String) -> Response {
    answer(page.into_bytes(), LIST)
}

/// A page of ours with the script that follows; `seen` is the count of the report.
pub(super) fn following(page: Vec<u8>, seen: u64) -> Response {
    match with_script(page, seen) {
        Ok(page) => answer(page.into_bytes(), FOLLOWING),
        // what has no policy of its own to be widened is no page of ours
        Err(page) => alone(page),
    }
}

fn answer(page: impl IntoResponse, policy: &'static str) -> Response {
    let mut answer = page.into_response();
    let headers = answer.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(HTML));
    headers.insert(
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(policy),
    );
    answer
}

/// The page with the script at its end and the rights it needs in its policy; as it was where it is no text or has no policy.
fn with_script(page: Vec<u8>, seen: u64) -> Result<String, Vec<u8>> {
    let mut page = String::from_utf8(page).map_err(std::string::FromUtf8Error::into_bytes)?;
    let before = "http-equiv=\"Content-Security-Policy\" content=\"";
    let from = page.find(before).map(|at| at + before.len());
    let found = from.and_then(|from| Some(from..from + page[from..].find('"')?));
    let Some(found) = found else {
        return Err(page.into_bytes());
    };
    let policy = with_rights(&page[found.clone()]);
    page.replace_range(found, &policy);
    let at = page.rfind("</body>").unwrap_or(page.len());
    page.insert_str(
        at,
        &format!("<script data-seen=\"{seen}\">{SCRIPT}</script>\n"),
    );
    Ok(page)
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
        use base64::Engine as _;
        use sha2::Digest as _;
        let digest = base64::engine::general_purpose::STANDARD.encode(sha2::Sha256::digest(SCRIPT));
        if SCRIPT_DIGEST.trim() != digest && std::env::var_os("KINEMARK_BLESS").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/serve/reload.js.sha256");
            std::fs::write(path, format!("{digest}\n")).unwrap();
        }
        assert_eq!(
            SCRIPT_DIGEST.trim(),
            digest,
            "not that of the script: KINEMARK_BLESS=1 cargo test writes it (docs/tests.md)"
        );
        assert!(
            !SCRIPT.contains("</") && !SCRIPT.contains("<!--"),
            "it would end in the middle"
        );
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
        let served = with_script(page.into(), 7).unwrap();
        assert!(
            served.contains("</pre><script data-seen=\"7\">"),
            "{served}"
        );
        assert!(served.ends_with("</script>\n</body></html>"), "{served}");
        assert!(served.contains("connect-src 'self'\"><body>"), "{served}");
        // bytes that are no text stay as they are, and so does what has no policy
        assert_eq!(with_script(vec![0xff], 7), Err(vec![0xff]));
        assert_eq!(with_script(b"<p>".to_vec(), 7), Err(b"<p>".to_vec()));
    }
}
