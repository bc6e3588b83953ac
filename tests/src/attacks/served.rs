//! Attacks on what serves a report: requests as they come over a connection, clients that only wait, and what is answered.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::Duration;

use crate::case::{Step, Waiting};
use crate::folder::filled;
use crate::testbed::{Serving, TestBed};

/// Far longer than a server lets anybody wait for others: the end of a test that would hang.
const LONGEST: Duration = Duration::from_secs(120);

/// Starts the command that serves, asks in turn, and stops it.
pub(crate) fn ask(step: &Step, bed: &TestBed) {
    let words: Vec<String> = step.serve.iter().map(|word| filled(word)).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (serving, _) = Serving::start(bed, &words);
    let waiting = step.wait.iter().flat_map(|waiting| come(waiting, &serving));
    let waiting: Vec<TcpStream> = waiting.collect();
    for ask in &step.ask {
        let request = sent(&ask.send, &serving);
        let answer = answer(&serving.host, &request, ask.by_byte);
        let code = answer.split(' ').nth(1).and_then(|code| code.parse().ok());
        assert_eq!(code.unwrap_or(0), ask.code, "{request:?}: {answer}");
        for words in &ask.says {
            assert!(answer.contains(words), "no `{words}` in {answer}");
        }
        for words in &ask.never {
            assert!(!answer.contains(words), "`{words}` in {answer}");
        }
    }
    assert_eq!(serving.stop(), Some(0), "it ends as it should");
    // not before the end of the server
    drop(waiting);
}

/// What is sent, with the places that only a server knows.
fn sent(text: &str, serving: &Serving) -> String {
    text.replace("{host}", &serving.host)
        .replace("{path}", &serving.root)
        .replace('\n', "\r\n")
}

/// Clients that have sent what they send.
fn come(waiting: &Waiting, serving: &Serving) -> Vec<TcpStream> {
    let text = sent(&waiting.send, serving);
    let client = || {
        let mut client = TcpStream::connect(&serving.host).expect("a connection");
        client.write_all(text.as_bytes()).expect("sent");
        client
    };
    (0..waiting.clients).map(|_| client()).collect()
}

/// What comes back until the server closes the connection.
fn answer(host: &str, request: &str, by_byte: bool) -> String {
    let mut stream = TcpStream::connect(host).expect("a connection");
    stream.set_nodelay(true).expect("a socket");
    stream.set_read_timeout(Some(LONGEST)).expect("a socket");
    let request = format!("{request}\r\nConnection: close\r\n\r\n");
    let together = if by_byte { 1 } else { request.len() };
    for bytes in request.as_bytes().chunks(together) {
        // a server may close the connection before it has read all
        let _ = stream.write_all(bytes);
    }
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}
