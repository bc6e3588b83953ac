//! Connections: so many at once, and none that only waits. Whoever can reach the port can open one, and needs no address for that.

use std::convert::Infallible;
use std::io::ErrorKind;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Body;
use axum::extract::Request;
use axum::response::Response;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_io_timeout::TimeoutStream;

/// What a client may take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Connections that are open at once. A browser opens six; open pages of `kinemark watch` wait on one each.
    most_open: usize,
    /// A request must be whole after this, and the next one on a connection begin and be whole.
    longest_request: Duration,
    /// A client must read something in this time.
    longest_unread: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            most_open: 128,
            longest_request: Duration::from_secs(10),
            longest_unread: Duration::from_secs(30),
        }
    }
}

/// How long nothing is accepted after the system refused a connection: it may have run out of descriptors.
const REST: Duration = Duration::from_secs(1);

/// Answers every request with `answer`, for ever.
pub(super) async fn accept<F, A>(listener: TcpListener, limits: Limits, answer: F)
where
    F: Fn(Request) -> A + Clone + Send + 'static,
    A: Future<Output = Response> + Send,
{
    let open = Arc::new(Semaphore::new(limits.most_open));
    loop {
        // what comes meanwhile waits in the system's queue
        let Ok(place) = Arc::clone(&open).acquire_owned().await else {
            return;
        };
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(error) if is_of_client(error.kind()) => continue,
            Err(_) => {
                tokio::time::sleep(REST).await;
                continue;
            }
        };
        let answer = answer.clone();
        tokio::spawn(async move {
            serve(stream, limits, answer).await;
            drop(place);
        });
    }
}

/// Answers the requests of one connection, until one of its ends closes it.
async fn serve<F, A>(stream: TcpStream, limits: Limits, answer: F)
where
    F: Fn(Request) -> A + Send,
    A: Future<Output = Response> + Send,
{
    let mut stream = TimeoutStream::new(stream);
    stream.set_write_timeout(Some(limits.longest_unread));
    let service = service_fn(move |request: hyper::Request<Incoming>| {
        let answered = answer(request.map(Body::new));
        async { Ok::<_, Infallible>(answered.await) }
    });
    // a client that goes away, or waits too long, is its own fault
    let _ = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.longest_request)
        .serve_connection(TokioIo::new(Box::pin(stream)), service)
        .await;
}

/// Whether the client gave up before it was accepted.
fn is_of_client(kind: ErrorKind) -> bool {
    [
        ErrorKind::ConnectionAborted,
        ErrorKind::ConnectionRefused,
        ErrorKind::ConnectionReset,
    ]
    .contains(&kind)
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};
    use std::net::TcpStream as Client;
    use std::sync::Mutex;

    use axum::response::IntoResponse as _;

    use super::*;

    /// Far longer than anything here takes: what never ends fails.
    const LONGEST: Duration = Duration::from_secs(60);
    /// Long enough for a busy machine to write a whole request in.
    const SHORT: Duration = Duration::from_millis(500);

    /// A server with short limits, and what it is asked in this order.
    fn with_server<T>(
        most_open: usize,
        seen: &Arc<Mutex<Vec<String>>>,
        test: impl FnOnce(&dyn Fn(&str) -> Client) -> T,
    ) -> T {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .unwrap();
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0")).unwrap();
        let address = listener.local_addr().unwrap();
        let limits = Limits {
            most_open,
            longest_request: SHORT,
            longest_unread: SHORT,
        };
        let seen = Arc::clone(seen);
        let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
        runtime.spawn(accept(listener, limits, move |request: Request| {
            let seen = Arc::clone(&seen);
            async move {
                let path = request.uri().path().to_owned();
                if path == "/busy" {
                    // others could come in meanwhile
                    for _ in 0..10_000 {
                        tokio::task::yield_now().await;
                    }
                }
                let answer = match path.as_str() {
                    "/large" => vec![0_u8; 64 << 20].into_response(),
                    _ => "hello".into_response(),
                };
                seen.lock().unwrap().push(path);
                answer
            }
        }));
        let server = std::thread::spawn(move || {
            // dropped, not sent
            let _ = runtime.block_on(stopped);
        });
        let ended = test(&|text| {
            let mut client = Client::connect(address).unwrap();
            client.set_read_timeout(Some(LONGEST)).unwrap();
            client.write_all(text.as_bytes()).unwrap();
            client
        });
        drop(stop);
        server.join().unwrap();
        ended
    }

    fn request(path: &str) -> String {
        format!("GET {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
    }

    fn read(mut client: Client) -> String {
        let mut text = String::new();
        client.read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn whoever_only_waits_is_sent_away() {
        let seen = Arc::default();
        with_server(100, &seen, |send| {
            for half in ["", "GET / HT", "GET / HTTP/1.1\r\nHost: x\r\n"] {
                let answer = read(send(half));
                assert!(!answer.contains("hello"), "{half}: {answer}");
            }
            // a connection that stays open for the next request
            let answer = read(send("GET /kept HTTP/1.1\r\nHost: x\r\n\r\n"));
            assert!(answer.ends_with("hello"), "{answer}");
        });
        assert_eq!(*seen.lock().unwrap(), ["/kept"]);
    }

    #[test]
    fn of_those_that_come_at_once_some_wait_for_others() {
        let seen = Arc::default();
        with_server(1, &seen, |send| {
            let (first, second) = (send(&request("/busy")), send(&request("/next")));
            assert!(read(second).ends_with("hello") && read(first).ends_with("hello"));
            // one that reads nothing of what it asked for has its place no longer than the next one waits
            let unread = send(&request("/large"));
            assert!(read(send(&request("/after"))).ends_with("hello"));
            drop(unread);
        });
        assert_eq!(
            *seen.lock().unwrap(),
            ["/busy", "/next", "/large", "/after"]
        );
    }
}
