//! Bytes of a frame between grader and worker, as a reply and as a request: never a panic, and what is read is written as it was meant.
#![no_main]

#[path = "../../../grader/cli/src/worker/wire.rs"]
mod wire;

use kinemark_grader::attempt::ended::record_of;
use libfuzzer_sys::fuzz_target;
use wire::{Received, Reply, Request, WireAnswer, WireSaid, WireStop};

/// A request comes from the grader, so that its values may be as deep as a lab makes them: a longer one would try the stack alone.
const MOST_REQUEST_BYTES: usize = 1_000;
/// The longest text in the record of a stop: what a message of the language can have, with a few words around it.
const MOST_CHARACTERS: usize = 8_200;
/// What the record quotes from.
const SCRIPT: &str = "fn control(o) {\n    o.q[2]\n}\n";

fuzz_target!(|bytes: &[u8]| {
    let _error = wire::receive_reply(&mut &*bytes);
    let framed = framed(bytes);
    if let Ok(reply) = wire::receive_reply(&mut framed.as_slice()) {
        let written = sent(&reply);
        let again = wire::receive_reply(&mut written.as_slice()).expect("what was written is read");
        assert_eq!(sent(&again), written);
        believed(reply, &written);
    }
    if bytes.len() <= MOST_REQUEST_BYTES
        && let Ok(request) = wire::receive_request(&mut framed.as_slice())
    {
        let written = sent(&as_asked(&request));
        let again =
            wire::receive_request(&mut written.as_slice()).expect("what was written is read");
        assert_eq!(sent(&as_asked(&again)), written);
    }
});

/// What the grader makes of a reply; an answer is written as it was read.
fn believed(reply: Reply, written: &[u8]) {
    match reply {
        Reply::Answered(answer) => {
            if let Some(answer) = answer.answer() {
                assert_eq!(sent(&Reply::Answered(WireAnswer::of(answer))), written);
            }
        }
        Reply::Stopped(stop, said) => {
            let (stop, said) = (stop.stop(), said.said());
            let record = record_of(&stop, SCRIPT);
            record.column_in_source_line();
            let further = record.further.iter().map(|further| &further.help);
            for text in further.chain(&record.help).chain([&record.message]) {
                assert!(text.chars().count() <= MOST_CHARACTERS);
            }
            let again = WireStop::of(stop).expect("a stop of a worker");
            let _cut = sent(&Reply::Stopped(again, WireSaid::of(said)));
        }
        Reply::Tried(tried) => tried.iter().for_each(|(attempt, _)| {
            attempt.name();
        }),
        Reply::Ready(_) | Reply::Opened => {}
    }
}

/// A request as the grader sends it.
fn as_asked(request: &Received) -> Request<'_> {
    match request {
        Received::Open(opening) => Request::Open(opening),
        Received::Call(call) => Request::Call(call),
        Received::Try => Request::Try,
    }
}

fn framed(bytes: &[u8]) -> Vec<u8> {
    let length = u32::try_from(bytes.len()).expect("an input of the fuzzer");
    [&length.to_le_bytes(), bytes].concat()
}

fn sent(message: &impl serde::Serialize) -> Vec<u8> {
    let mut bytes = Vec::new();
    wire::send(&mut bytes, message).expect("a list of bytes takes everything");
    bytes
}
