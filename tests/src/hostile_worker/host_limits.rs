//! A worker that comes to a limit of the machine: the limit ends it, and is named rightly.

use std::time::Duration;

use kinemark_grader::submission::controller::{HostLimit, Stop};
use kinemark_grader::submission::host::Host as _;
use rustix::process::{Pid, Resource, Rlimit, prlimit};

use crate::testbed::until;
use crate::worker::{LIMIT, host, opening};

/// Above the CPU time of everything here, which the machine may be long about.
const LONGEST: Duration = Duration::from_secs(60);

/// How a worker comes to a limit, as the text of its submission says.
pub(crate) fn come_to(limit: &str) -> ! {
    match limit {
        "greedy" => {
            let all = vec![1_u8; 1 << 30];
            panic!("{} bytes", all.len());
        }
        "busy" => loop {
            std::hint::spin_loop();
        },
        other => panic!("no limit `{other}`"),
    }
}

pub(crate) fn the_end_of_cpu_time_is_a_limit_of_time() {
    // where the hard limit is the soft one, as `ulimit -t` sets both, the system kills at once, as where it has no memory left
    for hard in [2, 1] {
        let opened = std::thread::scope(|scope| {
            let opened = scope.spawn(|| stop_of("busy"));
            shorten_cpu_time(hard);
            opened.join().expect("an answer")
        });
        assert_eq!(opened, Stop::HostLimit(HostLimit::Time), "{hard} s");
    }
}

pub(crate) fn the_end_of_memory_is_a_limit_of_memory() {
    assert_eq!(stop_of("greedy"), Stop::HostLimit(HostLimit::Memory));
}

fn stop_of(how: &str) -> Stop {
    let opened = host(LONGEST).open(&opening(LIMIT, how.to_owned()));
    opened.err().expect("a stop").stop
}

/// Gives the worker that runs one second of CPU time, and as many as `hard` until it is killed, once it has limits of its own.
fn shorten_cpu_time(hard: u64) {
    let mut worker = None;
    until(|| {
        worker = sealed_worker();
        worker.is_some()
    });
    let limit = Rlimit {
        current: Some(1),
        maximum: Some(hard),
    };
    prlimit(worker, Resource::Cpu, limit).expect("a limit");
}

/// The worker of this process that has put on its limits.
pub(crate) fn sealed_worker() -> Option<Pid> {
    let wanted = format!("worker\0--parent={}\0", std::process::id());
    let processes = std::fs::read_dir("/proc").ok()?.flatten();
    let mut workers = processes.filter(|process| {
        let read = |name| std::fs::read_to_string(process.path().join(name)).unwrap_or_default();
        let is_limited = |line: &str| {
            let words: Vec<&str> = line.split_whitespace().collect();
            words.starts_with(&["Max", "open", "files", "0", "0"])
        };
        read("cmdline").contains(&wanted) && read("limits").lines().any(is_limited)
    });
    let id = workers.next()?.file_name().into_string().ok()?;
    Pid::from_raw(id.parse().ok()?)
}
