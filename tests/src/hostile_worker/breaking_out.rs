//! Every attempt works in a process that is not sealed, is refused by each layer that must refuse it by itself, and by a sealed worker.

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::time::Duration;

use kinemark_grader::submission::host::Host as _;

use crate::attempts::{ATTEMPTS, Attempt, Unsealed};
use crate::errand::{Ended, unsealed, with_errand};
use crate::every_case::every_case;
use crate::worker::seal::Layer;
use crate::worker::{ERRAND, host, opening, probe, words_of};

/// Far above what an attempt takes.
const LONGEST: Duration = Duration::from_secs(60);

/// The layers that refuse an attempt of this user, each by itself.
fn refusing(attempt: &Attempt) -> Vec<Layer> {
    let for_users: &[Layer] = match rustix::process::geteuid().is_root() {
        true => &[],
        false => attempt.for_users,
    };
    [attempt.alone, for_users].concat()
}

fn attempts() -> Vec<(String, &'static Attempt)> {
    let named = ATTEMPTS
        .iter()
        .map(|attempt| (attempt.name.to_owned(), attempt));
    named.collect()
}

pub(crate) fn every_layer_has_attempts() {
    let names: BTreeSet<&str> = ATTEMPTS.iter().map(|attempt| attempt.name).collect();
    assert_eq!(names.len(), ATTEMPTS.len(), "a name stands twice");
    for layer in Layer::ALL {
        let own = ATTEMPTS.iter().filter(|attempt| {
            attempt.unsealed == Unsealed::Works && attempt.alone.contains(&layer)
        });
        assert!(own.count() >= 2, "{} is not tried", layer.name());
    }
}

pub(crate) fn unsealed_attempts_work() {
    let not_here = Mutex::new(BTreeSet::new());
    every_case(&attempts(), |attempt| match attempt.unsealed {
        Unsealed::Never => {}
        Unsealed::Works => {
            let ended = unsealed(attempt, None);
            assert!(matches!(ended, Ended::Got(_)), "{ended:?}");
        }
        Unsealed::MayWork => {
            if let Ended::Refused(why) = unsealed(attempt, None) {
                let line = format!("{}: {why}", attempt.name);
                not_here.lock().expect("lines").insert(line);
            }
        }
    });
    for line in not_here.into_inner().expect("lines") {
        println!("refused without a seal, too: {line}");
    }
}

pub(crate) fn each_layer_refuses_by_itself() {
    let absent = Mutex::new(BTreeSet::new());
    every_case(&attempts(), |attempt| {
        for layer in refusing(attempt) {
            match unsealed(attempt, Some(layer)) {
                Ended::Refused(_) => {}
                Ended::Absent => {
                    absent.lock().expect("layers").insert(layer.name());
                }
                Ended::Got(got) => panic!("with {}: {got}", layer.name()),
            }
        }
    });
    for layer in absent.into_inner().expect("layers") {
        println!("NOT TRIED: {layer}, which this system does not have");
    }
}

pub(crate) fn a_sealed_worker_cannot_get_out() {
    let sealed = probe().expect("a worker").sealed;
    for layer in sealed.missing() {
        println!("NOT ON: {}, as `kinemark doctor` says", layer.name());
    }
    every_case(&attempts(), |attempt| {
        let layers = refusing(attempt);
        // what no layer refuses, no worker is given
        let must = layers.is_empty() || layers.iter().any(|layer| sealed.has(*layer));
        let said = with_errand(attempt, |errand| {
            let mut host = host(LONGEST);
            match host.open(&opening(ERRAND, errand)) {
                Ok(_) => "it was opened".to_owned(),
                Err(failed) => words_of(failed.stop),
            }
        });
        let refused = matches!(Ended::of(&said), Some(Ended::Refused(_)))
            // the system ended it
            || said.contains("signal: ");
        assert!(refused || !must, "{said}");
    });
}
