//! Who is answered: this machine's own browser, asking for this server by its own name, at an address that it was given. A page of
//! another site that gives its own name this address (DNS rebinding) is not, and another user of this machine is not.

use axum::extract::Request;
use axum::http::uri::PathAndQuery;
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use percent_encoding::percent_decode_str;

use super::token::Token;

/// What whoever has no address reads.
const NO_ADDRESS: &str = "This address opens nothing. Open the whole address that `kinemark view` or `kinemark watch` printed, with \
                          everything behind the port; each start has another one.\n";

/// Why a request is not answered.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// It names another server than the one on this port.
    OtherServer(u16),
    /// It has no address that was given out.
    NoAddress,
    /// The end of the address is missing, to which what is there is relative: this is the whole one.
    Unfinished(String),
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        match self {
            Self::OtherServer(port) => {
                let words = format!("this address answers as 127.0.0.1:{port} alone\n");
                (StatusCode::MISDIRECTED_REQUEST, words).into_response()
            }
            Self::NoAddress => (StatusCode::FORBIDDEN, NO_ADDRESS).into_response(),
            Self::Unfinished(whole) => {
                (StatusCode::TEMPORARY_REDIRECT, [(header::LOCATION, whole)]).into_response()
            }
        }
    }
}

/// The request as the routes see it, without the token.
pub(super) fn admit(mut request: Request, port: u16, token: &Token) -> Result<Request, Refusal> {
    if !is_ours(request.headers(), port) {
        return Err(Refusal::OtherServer(port));
    }
    let path = request.uri().path();
    let path = path.strip_prefix('/').unwrap_or(path);
    let (part, rest) = path.split_once('/').unwrap_or((path, ""));
    let folder = rest.split('/').next().unwrap_or_default();
    let folder = percent_decode_str(folder).decode_utf8_lossy();
    if !token.opens(part, &folder) {
        return Err(Refusal::NoAddress);
    }
    if !path.contains('/') {
        return Err(Refusal::Unfinished(format!("/{part}/")));
    }
    let query = request.uri().query();
    let query = query.map_or(String::new(), |query| format!("?{query}"));
    let inside: PathAndQuery = format!("/{rest}{query}")
        .parse()
        .map_err(|_| Refusal::NoAddress)?;
    *request.uri_mut() = Uri::from(inside);
    Ok(request)
}

/// Puts what browsers are to know on every answer.
pub(super) fn with_headers(mut answer: Response) -> Response {
    let headers = answer.headers_mut();
    for (name, value) in [
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (
            header::HeaderName::from_static("cross-origin-resource-policy"),
            "same-origin",
        ),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    answer
}
/// Whether a request names this server, once, by a name that no other site can have.
fn is_ours(headers: &HeaderMap, port: u16) -> bool {
    let mut hosts = headers.get_all(header::HOST).iter();
    let (Some(host), None) = (hosts.next(), hosts.next()) else {
        return false;
    };
    let Ok(host) = host.to_str() else {
        return false;
    };
    ["127.0.0.1", "localhost", "[::1]"].into_iter().any(|name| {
        let rest = host
            .get(..name.len())
            .filter(|own| own.eq_ignore_ascii_case(name));
        match rest.map(|_| &host[name.len()..]) {
            // browsers leave the usual port out
            Some("") => port == 80,
            Some(rest) => rest.strip_prefix(':') == Some(port.to_string().as_str()),
            None => false,
        }
    })
}

#[cfg(test)]
mod tests {
    use axum::body::Body;

    use super::*;

    #[test]
    fn routes_see_what_stands_behind_the_token() {
        let token = Token::fresh().unwrap();
        let all = token.of_all();
        let ask = |path: &str| {
            let request = Request::builder()
                .uri(path)
                .header(header::HOST, "127.0.0.1:8080")
                .body(Body::empty());
            admit(request.unwrap(), 8080, &token)
        };
        let seen = |path: &str| ask(path).unwrap().uri().to_string();
        assert_eq!(seen(&format!("/{all}/")), "/");
        assert_eq!(seen(&format!("/{all}/a%20b/c?d=e")), "/a%20b/c?d=e");
        assert_eq!(seen(&format!("/{all}//etc/passwd")), "//etc/passwd");
        assert_eq!(
            seen(&format!("http://127.0.0.1:8080/{all}/a")),
            "/a",
            "as a proxy would ask"
        );
        let one = token.of_folder("s 1");
        assert_eq!(
            seen(&format!("/{one}/s%201/report.html")),
            "/s%201/report.html"
        );
        let refused = |path: &str| ask(path).unwrap_err();
        let whole = format!("/{all}/");
        assert_eq!(refused(&format!("/{all}")), Refusal::Unfinished(whole));
        for path in [
            "/".to_owned(),
            "/report.html".to_owned(),
            format!("//{all}/"),
            format!("/{}/", &all[1..]),
            format!("/{one}/"),
            format!("/{one}"),
            format!("/{one}/s2/report.html"),
            format!("/{one}/s%201%2f../s2"),
        ] {
            assert_eq!(refused(&path), Refusal::NoAddress, "{path}");
        }
    }

    #[test]
    fn only_this_machine_by_its_own_names_is_answered() {
        let with = |hosts: &[&str]| {
            let mut headers = HeaderMap::new();
            for host in hosts {
                headers.append(header::HOST, HeaderValue::from_str(host).unwrap());
            }
            is_ours(&headers, 8080)
        };
        for ours in [
            "127.0.0.1:8080",
            "localhost:8080",
            "LocalHost:8080",
            "[::1]:8080",
        ] {
            assert!(with(&[ours]), "{ours}");
        }
        for other in [
            "evil.example:8080",
            "127.0.0.1",
            "127.0.0.1:8081",
            "127.0.0.1:08080",
            "127.0.0.1.evil.example:8080",
            "localhost.evil.example:8080",
            "127.0.0.1:8080.evil.example",
            "",
        ] {
            assert!(!with(&[other]), "{other}");
        }
        assert!(!with(&[]));
        assert!(!with(&["127.0.0.1:8080", "evil.example"]));
    }
}
