//! Who is answered: this machine's own browser, asking for this server by its own name. A page of another site that gives its
//! own name this address (DNS rebinding) is not.

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};

/// Looks at every request before, and puts what browsers are to know on every answer.
pub(super) async fn guard(State(port): State<u16>, request: Request, next: Next) -> Response {
    let mut answer = if is_ours(request.headers(), port) {
        next.run(request).await
    } else {
        let words = format!("this address answers as 127.0.0.1:{port} alone\n");
        (StatusCode::MISDIRECTED_REQUEST, words).into_response()
    };
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
    use super::*;

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
