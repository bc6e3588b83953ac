//! One attempt and all it needs to know, as text that reaches a worker as a submission, and another process as an argument.

use std::net::TcpListener;
use std::os::linux::net::SocketAddrExt as _;
use std::os::unix::net::{SocketAddr, UnixListener};
use std::os::unix::process::ExitStatusExt as _;
use std::process::{Command, ExitCode, Output};
use std::sync::OnceLock;

use crate::attempts::{ATTEMPTS, Attempt};
use crate::testbed::{TestBed, root};
use crate::worker::put_on;
use crate::worker::seal::Layer;

/// What must not leave the process of the grader.
static SECRET: [u8; 16] = *b"a grader's words";
/// What is in the environment of a process that runs an errand.
const VARIABLE: &str = "SECRET_OF_THE_ENVIRONMENT";

/// What an attempt needs to know.
pub(crate) struct Errand {
    attempt: String,
    /// A folder of its own, with `a-file` in it.
    pub(crate) folder: String,
    /// A folder of the checkout.
    pub(crate) checkout: String,
    /// The process of the grader: that of the tests.
    pub(crate) grader: usize,
    /// Where [`SECRET`] is in it.
    pub(crate) secret: usize,
    /// A descriptor of `a-file` that the grader has left open.
    pub(crate) descriptor: usize,
    /// A port on this machine at which somebody listens.
    pub(crate) port: u16,
    /// The abstract name of a socket at which somebody listens.
    pub(crate) socket: String,
}

/// How an errand ended.
#[derive(Debug)]
pub(crate) enum Ended {
    /// The attempt got this.
    Got(String),
    /// The system refused it, or ended the process.
    Refused(String),
    /// This system has no such layer.
    Absent,
}

impl Errand {
    /// The errand as text.
    fn text(&self) -> String {
        let Self {
            attempt,
            folder,
            checkout,
            grader,
            secret,
            descriptor,
            port,
            socket,
        } = self;
        [
            attempt.as_str(),
            folder,
            checkout,
            &grader.to_string(),
            &secret.to_string(),
            &descriptor.to_string(),
            &port.to_string(),
            socket,
        ]
        .join("\n")
    }

    /// The errand that a text is.
    pub(crate) fn read(text: &str) -> Self {
        let lines: Vec<&str> = text.split('\n').collect();
        let [
            attempt,
            folder,
            checkout,
            grader,
            secret,
            descriptor,
            port,
            socket,
        ] = lines[..]
        else {
            panic!("no errand: {text}");
        };
        let number = |text: &str| text.parse().expect("a number");
        Self {
            attempt: attempt.to_owned(),
            folder: folder.to_owned(),
            checkout: checkout.to_owned(),
            grader: number(grader),
            secret: number(secret),
            descriptor: number(descriptor),
            port: port.parse().expect("a port"),
            socket: socket.to_owned(),
        }
    }

    /// Makes the attempt, and says in words how it ended.
    pub(crate) fn outcome(&self) -> String {
        let attempt = ATTEMPTS.iter().find(|known| known.name == self.attempt);
        match (attempt.expect("an attempt").make)(self) {
            Ok(got) => format!("got: {got}"),
            Err(error) => format!("refused: {error}"),
        }
    }

    /// The file of its folder.
    pub(crate) fn file(&self) -> String {
        format!("{}/a-file", self.folder)
    }
}

impl Ended {
    /// What these words of [`Errand::outcome`] say; `None` if they are others.
    pub(crate) fn of(words: &str) -> Option<Self> {
        let got = words.strip_prefix("got: ");
        let refused = words.strip_prefix("refused: ");
        got.map(|words| Self::Got(words.to_owned()))
            .or_else(|| refused.map(|words| Self::Refused(words.to_owned())))
    }
}

/// Gives an attempt what it needs, and runs it by `run`.
pub(crate) fn with_errand<T>(attempt: &Attempt, run: impl FnOnce(String) -> T) -> T {
    static LISTENING: OnceLock<(TcpListener, UnixListener, String)> = OnceLock::new();
    let (tcp, _, socket) = LISTENING.get_or_init(|| {
        let tcp = TcpListener::bind("127.0.0.1:0").expect("a port");
        let name = format!("kinemark-test-{}", std::process::id());
        let address = SocketAddr::from_abstract_name(&name).expect("a name");
        let abstract_ = UnixListener::bind_addr(&address).expect("a socket");
        (tcp, abstract_, name)
    });
    let bed = TestBed::new();
    bed.write("a-file", "what is in a file");
    std::fs::create_dir(bed.path("gone")).expect("a folder");
    let mut options = std::fs::OpenOptions::new();
    let file = options.read(true).write(true).open(bed.path("a-file"));
    let file = file.expect("a file");
    // left open on purpose
    rustix::io::fcntl_setfd(&file, rustix::io::FdFlags::empty()).expect("a descriptor");
    let text = |path: std::path::PathBuf| path.into_os_string().into_string().expect("UTF-8");
    let errand = Errand {
        attempt: attempt.name.to_owned(),
        folder: text(bed.path("")).trim_end_matches('/').to_owned(),
        checkout: text(root().join("labs")),
        grader: std::process::id() as usize,
        secret: crate::system_call::address(&SECRET),
        descriptor: std::os::fd::AsRawFd::as_raw_fd(&file) as usize,
        port: tcp.local_addr().expect("an address").port(),
        socket: socket.clone(),
    };
    run(errand.text())
}

/// The process of an attempt without a seal, or with one layer alone.
pub(crate) fn run_unsealed(layer: &str, errand: &str) -> ExitCode {
    let errand = Errand::read(errand);
    let layer = Layer::ALL.into_iter().find(|known| known.name() == layer);
    if layer.is_some_and(|layer| !put_on(layer)) {
        println!("absent");
    } else {
        println!("{}", errand.outcome());
    }
    ExitCode::SUCCESS
}

/// Makes an attempt in a process of its own, without a seal or with one layer alone.
pub(crate) fn unsealed(attempt: &Attempt, layer: Option<Layer>) -> Ended {
    with_errand(attempt, |errand| {
        let name = layer.map_or("none", Layer::name);
        let ran = Command::new(std::env::current_exe().expect("this test"))
            .args(["errand", name, &errand])
            .env(VARIABLE, "1")
            .output();
        ended(&ran.expect("it runs"))
    })
}

fn ended(ran: &Output) -> Ended {
    let words = String::from_utf8_lossy(&ran.stdout);
    match (words.trim_end(), ran.status.signal()) {
        ("absent", _) => Ended::Absent,
        (_, Some(signal)) => Ended::Refused(format!("signal {signal}")),
        // another program runs in the process
        ("", None) if ran.status.success() => Ended::Got("another program".to_owned()),
        (words, None) => Ended::of(words).unwrap_or_else(|| panic!("{ran:?}")),
    }
}
