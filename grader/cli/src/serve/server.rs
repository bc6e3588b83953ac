//! A report folder, or a book, on this machine's own address, for the browser of whoever started it: read only, nothing beside the
//! folder, for no other site and no other user.

use std::io::{ErrorKind, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use axum::Router;
use axum::body::Body;
use axum::extract::{Path as Wanted, Query, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse as _, Response};
use axum::routing::get;
use hyper::service::Service as _;
use hyper_util::service::TowerToHyperService;
use kinemark_report::output::PAGE_FILE;
use tokio::io::AsyncReadExt as _;
use tokio::sync::watch;
use tokio_util::io::ReaderStream;

use super::book::ServedBook;
use super::connections::{self, Limits};
use super::files::{OpenFile, Unread};
use super::token::Token;
use super::{files, guard, index, page};
use crate::disk::plain;
use crate::error_record::ErrorCode;
use crate::failure::Failure;

/// How much of a file is read at once.
const PIECE_BYTES: usize = 128 << 10;

/// Where a report is served.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct ServeArgs {
    /// Port to serve the report on [default: a free one]
    #[arg(long, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) port: Option<u16>,
    /// Print the address without opening a browser
    #[arg(long)]
    pub(crate) no_open: bool,
}

/// What is served, and to whom.
#[derive(Debug)]
struct Site {
    folder: PathBuf,
    port: u16,
    token: Token,
    /// How often the report was written, where it is written again and again.
    changes: Option<watch::Receiver<u64>>,
    /// The book of a course, of which only a list and pages are served.
    book: Option<ServedBook>,
}

/// A server that has its address and answers nobody yet.
#[derive(Debug)]
pub(crate) struct Server {
    listener: TcpListener,
    site: Site,
}

impl Server {
    /// Takes a port of this machine: the one asked for, else a free one. With `changes` open pages follow what it counts.
    pub(crate) fn bind(
        folder: &Path,
        port: Option<u16>,
        changes: Option<watch::Receiver<u64>>,
    ) -> Result<Self, Failure> {
        let asked = SocketAddr::from((Ipv4Addr::LOCALHOST, port.unwrap_or(0)));
        let listener = TcpListener::bind(asked).map_err(|error| match error.kind() {
            ErrorKind::AddrInUse => Failure::usage(
                format!("port {} is taken", asked.port()),
                "choose another port, or leave --port out to use a free one",
            )
            .coded(ErrorCode::Port),
            ErrorKind::PermissionDenied => Failure::usage(
                format!("port {} needs rights that you do not have", asked.port()),
                "choose one from 1024 on, or leave --port out to use a free one",
            )
            .coded(ErrorCode::Port),
            _ => unserved(&error),
        })?;
        let port = listener
            .local_addr()
            .map_err(|error| unserved(&error))?
            .port();
        Ok(Self {
            listener,
            site: Site {
                folder: folder.to_owned(),
                port,
                token: Token::fresh()?,
                changes,
                book: None,
            },
        })
    }

    /// The same server, of a book instead of a report.
    pub(crate) fn of_book(mut self, book: ServedBook) -> Self {
        self.site.book = Some(book);
        self
    }

    /// The address to open: whoever has it can read what is served.
    pub(crate) fn address(&self) -> String {
        let token = self.site.token.of_all();
        format!("http://127.0.0.1:{}/{token}/", self.site.port)
    }

    /// Answers until `stop` says so.
    pub(crate) fn run(self, mut stop: watch::Receiver<bool>) -> Result<(), Failure> {
        let unserved = |error: std::io::Error| unserved(&error);
        self.listener.set_nonblocking(true).map_err(unserved)?;
        // one thread is plenty for one reader
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .map_err(unserved)?;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(self.listener).map_err(unserved)?;
            let site = Arc::new(self.site);
            let routes = TowerToHyperService::new(routes(Arc::clone(&site)));
            let answer = move |request: Request| {
                let (site, routes) = (Arc::clone(&site), routes.clone());
                async move {
                    let answered = match guard::admit(request, site.port, &site.token) {
                        Ok(request) => routes
                            .call(request)
                            .await
                            .unwrap_or_else(|never| match never {}),
                        Err(refusal) => refusal.into_response(),
                    };
                    guard::with_headers(answered)
                }
            };
            tokio::spawn(connections::accept(listener, Limits::default(), answer));
            // whoever could say so being gone is as good; open connections end with the runtime
            let _ = stop.wait_for(|stop| *stop).await;
            Ok(())
        });
        // a disk that does not answer is not waited for
        runtime.shutdown_background();
        served
    }
}

fn unserved(error: &std::io::Error) -> Failure {
    Failure::fault(
        format!("cannot listen on 127.0.0.1: {}", plain(error)),
        "open report.html from the folder instead",
    )
}

/// Opens the address in the browser, unless it is not wanted; that there is none is no failure.
pub(crate) fn open(address: &str) {
    if open::that_detached(address).is_err() {
        // a reader that has gone away is no failure
        let _ = writeln!(
            anstream::stderr(),
            "no browser could be started; open the address yourself"
        );
    }
}

fn routes(site: Arc<Site>) -> Router {
    Router::new()
        .route("/", get(start))
        .route(page::CHANGES, get(changes))
        .route("/{*path}", get(file))
        .with_state(site)
}

/// What to look at first: the report, the comparison, or a list of the reports or of a book.
async fn start(State(site): State<Arc<Site>>) -> Response {
    if site.book.is_some() {
        let list = off_thread(move || site.book.as_ref().map(ServedBook::list)).await;
        return match list.flatten() {
            Some(list) => page::sorted_list(list),
            None => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
        };
    }
    let found = off_thread(move || {
        let first = index::FIRST
            .into_iter()
            .find(|name| files::is_there(&site.folder, name));
        first.map_or_else(|| Err(index::page(&site.folder, &site.token)), Ok)
    });
    match found.await {
        Some(Ok(name)) => {
            // seen from the folder, whose address has the token
            let to = [(header::LOCATION, name)];
            (StatusCode::TEMPORARY_REDIRECT, to).into_response()
        }
        Some(Err(list)) => page::sorted_list(list),
        None => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

/// What is sent of a file.
enum Content {
    /// As it is on the disk, piece by piece.
    File(OpenFile),
    /// A page that is another than on the disk.
    Page(Vec<u8>),
}

async fn file(State(site): State<Arc<Site>>, Wanted(path): Wanted<String>) -> Response {
    // looked at before the file: a report written in between is loaded once more, never missed
    let seen = site.changes.as_ref().map(|changes| *changes.borrow());
    // what is graded again and again is our own writing; any other page is whoever's
    let seen = seen.filter(|_| path == PAGE_FILE);
    let kind = files::media_type(&path);
    let read = off_thread(move || match &site.book {
        Some(book) => book.page(&path).map(Content::Page),
        None => match seen.map(|_| files::read(&site.folder, &path)) {
            // one that is too large follows nothing
            None | Some(Err(Unread::TooLarge)) => {
                files::open(&site.folder, &path).map(Content::File)
            }
            Some(read) => read.map(Content::Page),
        },
    })
    .await;
    let content = match read {
        Some(Ok(content)) => content,
        Some(Err(Unread::Absent)) => {
            return (
                StatusCode::NOT_FOUND,
                "there is no such file in the report\n",
            )
                .into_response();
        }
        Some(Err(Unread::TooLarge)) => {
            return (
                StatusCode::PAYLOAD_TOO_LARGE,
                "open this file from its folder\n",
            )
                .into_response();
        }
        None => return StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    };
    let file = match (content, seen) {
        (Content::Page(page), Some(seen)) => return page::following(page, seen),
        (Content::Page(page), None) => return page::alone(page),
        (Content::File(file), _) => file,
    };
    let bytes = file.bytes;
    // what is written to it meanwhile is not part of it
    let pieces = tokio::fs::File::from_std(file.file).take(bytes);
    let body = Body::from_stream(ReaderStream::with_capacity(pieces, PIECE_BYTES));
    let length = [(header::CONTENT_LENGTH, bytes)];
    if kind == files::HTML {
        return page::alone((length, body));
    }
    let mut answer = (length, body).into_response();
    let headers = answer.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(kind));
    if kind == files::SVG {
        // a picture opened by itself is a document, and could run scripts
        headers.insert(
            header::CONTENT_SECURITY_POLICY,
            HeaderValue::from_static("default-src 'none'; style-src 'unsafe-inline'; sandbox"),
        );
    }
    answer
}

/// The version of the report that an open page shows.
#[derive(serde::Deserialize)]
struct PageVersion {
    #[serde(default)]
    seen: u64,
}

/// Answers when the report is another than the one seen.
async fn changes(
    State(site): State<Arc<Site>>,
    Query(PageVersion { seen }): Query<PageVersion>,
) -> Response {
    let Some(mut changes) = site.changes.clone() else {
        return (StatusCode::NOT_FOUND, "this report stays as it is\n").into_response();
    };
    match changes.wait_for(|now| *now != seen).await {
        Ok(now) => {
            let kind = [(header::CONTENT_TYPE, "application/json")];
            (kind, format!("{{\"version\":{}}}\n", *now)).into_response()
        }
        Err(_) => StatusCode::GONE.into_response(),
    }
}

/// Does what reads the disk beside the answers that wait.
async fn off_thread<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    tokio::task::spawn_blocking(work).await.ok()
}
