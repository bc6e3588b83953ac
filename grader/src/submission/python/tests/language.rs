//! What of Python there is, and that nothing of it varies or looks outside.

use super::*;

#[test]
fn there_is_nothing_outside() {
    for (line, words) in [
        (
            "import os",
            "ModuleNotFoundError: No module named 'os': there are no files and no system",
        ),
        (
            "import time",
            "ModuleNotFoundError: No module named 'time': there is no clock",
        ),
        (
            "import random",
            "ModuleNotFoundError: No module named 'random': there is no chance",
        ),
        (
            "from . import other",
            "ImportError: a submission is one file",
        ),
        (
            "import numpyy",
            "ModuleNotFoundError: No module named 'numpyy': did you mean 'numpy'?",
        ),
        (
            "open('x')",
            "NameError: name 'open' is not there: there are no files",
        ),
        ("eval('1')", "NameError: name 'eval' is not there"),
        ("exec('1')", "NameError: name 'exec' is not there"),
    ] {
        let stop = failed(&format!("{line}\n")).stop;
        let (message, ..) = mistake(stop);
        assert!(message.starts_with(words), "{line}: {message}");
    }
}

#[test]
fn what_python_people_use_can_be_imported() {
    let source = "from __future__ import annotations\n\nimport itertools\nimport math\nfrom collections import deque, namedtuple\nfrom dataclasses import dataclass, field\nfrom enum import Enum, auto\nfrom functools import lru_cache, partial, reduce\nfrom typing import TYPE_CHECKING, List, Optional\n\nimport numpy as np\nimport numpy.linalg as la\nfrom numpy import pi\n\nif TYPE_CHECKING:\n    from kinemark import Observation\n\nPoint = namedtuple('Point', 'x y')\n\n\nclass Phase(Enum):\n    REACH = auto()\n    HOLD = 2\n\n\n@dataclass\nclass State:\n    gain: float\n    seen: List[float] = field(default_factory=list)\n    phase: Optional[Phase] = Phase.REACH\n\n    def __post_init__(self):\n        self.twice = 2 * self.gain\n\n\nstate = State(3.0)\n\n\n@lru_cache(maxsize=None)\ndef slow(n):\n    return n if n < 2 else slow(n - 1) + slow(n - 2)\n\n\ndef control(observation: Observation):\n    state.seen.append(observation.time)\n    state.phase = Phase.HOLD if state.phase is Phase.REACH else Phase.REACH\n    last = deque([1, 2, 3], maxlen=2)\n    return [state.twice, len(state.seen), state.phase.value, last[0], Point(4, 5).y, slow(30), la.norm([3, 4]), math.floor(pi), reduce(lambda a, b: a + b, itertools.islice(itertools.count(), 4)), partial(max, 7)(1)]\n";
    let answer = control(source).unwrap_or_else(|stop| panic!("{stop:?}"));
    assert_eq!(
        answer.value,
        list(&[6.0, 1.0, 2.0, 2.0, 5.0, 832_040.0, 5.0, 3.0, 6.0, 7.0])
    );
}

/// Names of sets and dicts come in the order in which they were put in, whatever their hashes are, and hashes are the same in each process.
#[test]
fn nothing_varies_from_start_to_start() {
    let source = "def control(observation):\n    names = {'b', 'a', 'c', 'd'}\n    return [hash('kinemark') % 1000, id(names) % 1000, *[ord(name) for name in names]]\n";
    let first = control(source).expect("an answer");
    assert_eq!(first, control(source).expect("an answer"));
}

/// Programs without arrays print what Python 3.11 prints: `.ci/full runtime` runs them with the one of the machine.
#[test]
fn programs_print_what_python_prints() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/python/runtime/programs");
    let mut programs: Vec<_> = std::fs::read_dir(folder)
        .expect("the programs")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "py"))
        .collect();
    programs.sort();
    assert!(programs.len() > 10);
    for path in programs {
        let source = std::fs::read_to_string(&path).expect("a program");
        let expected = std::fs::read_to_string(path.with_extension("out")).expect("its output");
        let mut opened = open(&source);
        let printed = opened.unanswered().log.into_iter();
        let printed: Vec<String> = printed.map(|line| line.text).collect();
        let expected: Vec<&str> = expected.lines().collect();
        assert_eq!(printed, expected, "{}", path.display());
    }
}

#[test]
fn no_function_is_made_of_bytes() {
    for line in [
        "f.__code__ = (lambda: 1).__code__",
        "f.__code__.replace(co_code=b'')",
        "type(f.__code__)()",
    ] {
        let source = format!(
            "def f():\n    return 1\ndef control(observation):\n    {line}\n    return 1.0\n"
        );
        let message = crash(&source).message;
        assert!(
            message.starts_with("TypeError") || message.starts_with("AttributeError"),
            "{message}"
        );
    }
}

#[test]
fn arrays_are_made_of_what_has_elements() {
    for (expression, wanted) in [
        (
            "np.mean(deque([[1.0, 3.0], [3.0, 5.0]], maxlen=5), axis=0)",
            list(&[2.0, 4.0]),
        ),
        ("deque([1.0, 2.0])", list(&[1.0, 2.0])),
        ("np.ones(2) + Point(1.0, 2.0)", list(&[2.0, 3.0])),
        (
            "np.ravel([[1, 2], [3, 4]], order='F')",
            list(&[1.0, 3.0, 2.0, 4.0]),
        ),
        (
            "np.arange(6).reshape((2, 3), order='F')[1]",
            list(&[1.0, 3.0, 5.0]),
        ),
        ("np.arange(stop=3)", list(&[0.0, 1.0, 2.0])),
        ("1.0 if ~np.any([False]) else 2.0", Value::Number(1.0)),
        (
            "np.linalg.lstsq([[1.0, 1], [1, 1]], [2.0, 2], rcond=-1)[0]",
            list(&[1.0, 1.0]),
        ),
    ] {
        let source = format!(
            "import numpy as np\nfrom collections import deque, namedtuple\nPoint = namedtuple('Point', 'x y')\ndef control(observation):\n    return {expression}\n"
        );
        match control(&source) {
            Ok(answer) => assert_eq!(rounded(answer.value), wanted, "{expression}"),
            Err(stop) => panic!("{expression}: {stop:?}"),
        }
    }
}

#[test]
fn a_file_may_begin_with_a_mark_of_its_encoding() {
    let answer = control("\u{feff}def control(observation):\n    return 1.0\n").expect("an answer");
    assert_eq!(answer.value, Value::Number(1.0));
}
