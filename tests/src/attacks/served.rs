//! Attacks on what serves a report: requests as they come over a connection, and what is answered.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;

use crate::case::Step;
use crate::folder::filled;
use crate::testbed::{Serving, TestBed};

/// Starts the command that serves, asks in turn, and stops it.
pub(crate) fn ask(step: &Step, bed: &TestBed) {
    let words: Vec<String> = step.serve.iter().map(|word| filled(word)).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (serving, _) = Serving::start(bed, &words);
    for ask in &step.ask {
        let request = ask
            .send
            .replace("{host}", &serving.host)
            .replace("{path}", &serving.root);
        let answer = answer(&serving.host, &request);
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
}

/// What comes back until the server closes the connection.
fn answer(host: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(host).expect("a connection");
    let request = format!(
        "{}\r\nConnection: close\r\n\r\n",
        request.replace('\n', "\r\n")
    );
    // a server may close the connection before it has read all
    let _ = stream.write_all(request.as_bytes());
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}
