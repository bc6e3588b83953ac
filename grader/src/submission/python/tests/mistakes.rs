//! How each mistake in a file is reported: its words, its place, what to do about it.

use super::*;

#[test]
fn an_exception_has_pythons_words_its_place_and_help() {
    let (message, help, line, column) =
        mistake(control("import numpy as np\n\n\ndef control(observation):\n    e = observation.q\n    return e + observation.tcp\n").unwrap_err());
    assert!(
        message.starts_with(
            "ValueError: operands could not be broadcast together with shapes (2,) (3,)"
        ),
        "{message}"
    );
    assert!(help.contains(".shape"), "{help}");
    assert_eq!((line, column), (6, 12));
    let (message, help, line, _) = mistake(control("def control(observation):\n    return helper(observation)\n\n\ndef helper(observation):\n    return [observation.qdot[0]]\n").unwrap_err());
    assert_eq!(
        message,
        "AttributeError: observation has no 'qdot'. Did you mean: 'qd'?"
    );
    assert_eq!((line, help.as_str()), (6, ""));
    let (message, help, ..) = mistake(
        control("def control(observation):\n    return np.sin(observation.q)\n").unwrap_err(),
    );
    assert!(
        message.starts_with("NameError: name 'np' is not defined"),
        "{message}"
    );
    assert_eq!(help, "write `import numpy as np` at the top");
}

#[test]
fn a_file_that_python_cannot_read_does_not_build() {
    for (source, words, at) in [
        ("def control(observation)\n    return 1\n", "SyntaxError", 1),
        ("x = (1\n", "SyntaxError", 1),
        (
            "def control(observation):\nreturn 1\n",
            "IndentationError",
            2,
        ),
        ("x = 1\ny = 2 +\n", "SyntaxError", 2),
        ("x = 'abc\n", "SyntaxError", 1),
    ] {
        let stop = failed(source).stop;
        assert!(matches!(stop, Stop::DidNotBuild(_)), "{source}: {stop:?}");
        let (message, _, line, _) = mistake(stop);
        assert!(message.starts_with(words), "{source}: {message}");
        assert_eq!(line, at, "{source}: {message}");
    }
    let failed = failed("import numpy\nprint('here')\nx = 1 / 0\n");
    assert_eq!(failed.said.texts(), ["here"]);
    let (message, _, line, _) = mistake(failed.stop);
    assert_eq!(
        (message.as_str(), line),
        ("ZeroDivisionError: division by zero", 3)
    );
}

#[test]
fn a_function_that_is_missing_is_named_with_what_is_like_it() {
    let Err(Stop::Missing {
        function,
        help,
        namesake,
    }) = control("def controll(observation):\n    return 1\n")
    else {
        panic!("nothing is missing");
    };
    assert_eq!(function, "control(observation)");
    assert!(help.expect("help").contains("controll"));
    assert!(namesake.is_none());
    let Err(Stop::Missing { namesake, .. }) = control("x = 1\ndef control():\n    return 1\n")
    else {
        panic!("nothing is missing");
    };
    let namesake = namesake.expect("a function of this name");
    assert_eq!((namesake.parameters, namesake.wanted), (0, 1));
    assert_eq!(namesake.place.expect("a place").line, 2);
    // one that `init` makes is there when it has run
    let mut made = open(
        "def init(robot, task):\n    global control\n    control = lambda observation: [robot.height]\n",
    );
    made.call(&Call::Init).expect("init runs");
    let answer = made.call(&Call::Control(observation())).expect("an answer");
    assert_eq!(answer.value, list(&[2.5]));
    let mut none = open("def init(robot, task):\n    pass\n");
    none.call(&Call::Init).expect("init runs");
    let stop = none.call(&Call::Control(observation())).unwrap_err();
    assert!(matches!(stop, Stop::Missing { .. }), "{stop:?}");
    // parameters that have values of their own, and any number of them, fit
    for head in ["observation, gain=3", "*anything", "observation=None"] {
        let source = format!("def control({head}):\n    return 1\n");
        assert!(control(&source).is_ok(), "{head}");
    }
    assert_eq!(
        open("x = 1\n").call(&Call::Init).expect("no init").value,
        Value::Nothing
    );
}

#[test]
fn columns_count_characters() {
    let source = "def control(observation):\n    print(\"Größe\"); return observation.q[7]\n";
    assert_eq!(
        crash(source).place,
        Some(SourcePosition {
            line: 2,
            column: 28
        })
    );
}

#[test]
fn a_forgotten_global_is_named() {
    let help = |source: &str| crash(source).help.unwrap_or_default();
    let none = "state = None\ndef start():\n    state = [1]\ndef control(observation):\n    start()\n    return state[0]\n";
    assert!(
        help(none).contains("write `global state`"),
        "{}",
        help(none)
    );
    let unknown =
        "def start():\n    best = 1\ndef control(observation):\n    start()\n    return best\n";
    assert!(
        help(unknown).contains("write `global best`"),
        "{}",
        help(unknown)
    );
    let right = "state = None\ndef start():\n    global state\n    state = 1\ndef control(observation):\n    return state[0]\n";
    assert!(!help(right).contains("global"), "{}", help(right));
}

#[test]
fn an_error_that_imitates_the_compiler_is_a_crash() {
    for error in [
        "SyntaxError('m', ('f.py', 0, 0, None))",
        "SyntaxError('m', ('f.py', 10**9, -5, None))",
        "type('SyntaxError', (Exception,), {})('m')",
    ] {
        let mistake = crash(&format!("def control(observation):\n    raise {error}\n"));
        assert_eq!(mistake.place.map(|place| place.line), Some(2), "{error}");
    }
}

#[test]
fn an_exception_that_nobody_can_catch_is_printed() {
    let source = "class Log:\n    def __del__(self):\n        print(self.missing)\ndef control(observation):\n    Log()\n    return 1.0\n";
    let answer = control(source).expect("an answer");
    assert!(
        answer.said.log[0].text.starts_with("Exception ignored in "),
        "{:?}",
        answer.said.log
    );
}

/// Each advice, by a line of `control` that needs it.
#[test]
fn every_slip_has_its_advice() {
    // long: a row for each slip
    let before = "import math\nimport numpy as np\na = np.array([1.0, 2.0])\nl = [1.0, 2.0]\nd = {}\n\ndef nothing(x):\n    pass\n\nclass Filter:\n    def step(x):\n        return x\n    def both(self, x):\n        return self.step(x)\n\ndef control(observation):\n    ";
    let mut wrong = Vec::new();
    for (line, advice) in [
        ("next(iter([]))", "nothing is left"),
        ("return a[1.5]", "an index is an int"),
        ("return l[3 / 2]", "an index is an int"),
        ("return l[2]", "counting starts at 0"),
        ("return a[2]", "counting starts at 0"),
        ("return d['x']", "`in` tests for a key"),
        ("return 1 / 0", "check the divisor"),
        ("return control(observation)", "calls itself without an end"),
        ("l = l + [1.0]", "a name that a function assigns is its own"),
        (
            "x = np.array([1, 2]); x += 0.5",
            "write the numbers of the array as floats",
        ),
        (
            "return np.linalg.inv(np.ones((2, 3)))",
            "as many columns as rows",
        ),
        (
            "return np.linalg.inv(np.zeros((2, 2)))",
            "at a singular configuration",
        ),
        (
            "return [0.0] * 10**9",
            "make lists, texts and arrays smaller",
        ),
        ("this.x = 1", "Python keeps what lasts in a global"),
        ("self.x = 1", "`self` is the first parameter"),
        ("return true", "Python writes True"),
        ("return false", "Python writes False"),
        ("return null", "Python writes None"),
        ("return vector([1])", "write np.array"),
        ("return clamp(1, 2, 3)", "write np.clip(x, low, high)"),
        ("return lerp(1, 2, 3)", "write a + (b - a) * s"),
        ("return transpose(a)", "write A.T"),
        (
            "return qd[0]",
            "it is a field of the observation: observation.qd",
        ),
        (
            "return robot.height",
            "`init(robot, task)` is given the robot",
        ),
        ("return link_lengths[0]", "robot.link_lengths"),
        ("return linalg.inv(a)", "np. before it"),
        ("return pinv(a)", "np.linalg.pinv"),
        (
            "return sin(1.0)",
            "write `import math` at the top and math. before it",
        ),
        (
            "return zeros(2)",
            "write `import numpy as np` at the top and np. before it",
        ),
        ("return nothin(2)", "did you mean `nothing`?"),
        ("return l.sum()", "a list has no arithmetic"),
        ("return observation.tcp.x", "tcp[0] is x"),
        ("a.append(1.0)", "an array keeps its size"),
        (
            "x = l.append(1.0); x.append(2.0)",
            "change the list and return None",
        ),
        ("return a[0].round(2)", "write round(x, 3)"),
        (
            "return a[0].shape",
            "a number out of an array is Python's own",
        ),
        ("return math.sin(a)", "math works on one number"),
        ("return math.sin(l)", "math works on one number"),
        ("d[l] = 1", "keys of a dict and elements of a set"),
        ("return range(1.5)", "an int is wanted here"),
        (
            "return np.hstack(a, a)",
            "arrays that belong together are one argument",
        ),
        ("return float(a)", "one number is wanted here"),
        ("return '%.3f' % a", "write each element into the text"),
        ("return a ^ 2", "Python writes a power as **"),
        ("return 2.0 * l", "a list has no arithmetic"),
        ("return l - l", "a list has no arithmetic"),
        (
            "return nothing(1) + 1",
            "a function without `return` returns None",
        ),
        ("return a(0)", "elements are in square brackets"),
        ("return 2.0(1 + 1)", "write the operator"),
        ("return math(1)", "name the function of the module"),
        ("return 'abc'(1)", "can be called"),
        ("return observation.time[0]", "it is one number"),
        (
            "return nothing[0]",
            "a function is called with round brackets",
        ),
        (
            "return np.zeros(2, 3)",
            "shape and elements are one argument",
        ),
        (
            "return Filter().both(1)",
            "the first parameter of a method is self",
        ),
        (
            "return [l, l][0, 1]",
            "rows and columns in one pair of brackets",
        ),
        ("return a + observation.tcp", "print the .shape of both"),
        (
            "return np.ones((2, 2)) @ observation.tcp",
            "print the .shape of both",
        ),
        ("return 1 if a > 0 else 2", "write .any() or .all()"),
        ("x, y, z = a", "as many names on the left"),
        ("return math.acos(2)", "acos and asin take -1 to 1"),
        (
            "return np.array([[1.0], [1.0, 2.0]])",
            "rows of one array have the same length",
        ),
    ] {
        let mistake = crash(&format!("{before}{line}\n"));
        let help = mistake.help.unwrap_or_default();
        if !help.contains(advice) {
            wrong.push(format!("{line}: {}: {help}", mistake.message));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The same for lines that Python cannot read.
#[test]
fn every_slip_of_syntax_has_its_advice() {
    let mut wrong = Vec::new();
    for (line, advice) in [
        ("return 1 \u{2212} 2", "the character `\u{2212}` (U+2212)"),
        ("print(\u{201c}a\u{201d})", "write \""),
        ("return 1 if 1 && 2 else 0", "Python writes `and`"),
        ("// a remark", "a comment begins with #"),
        ("% a remark", "a comment begins with #"),
        ("fn f(x)", "Python writes def name(parameters):"),
        (
            "let x = 1",
            "Python writes a variable without a word before it",
        ),
        ("else if 1:", "Python writes elif"),
        ("if 1 {", "a block begins with a colon"),
        ("return observation.target.from", "write target[\"from\"]"),
        ("i++", "write i += 1"),
        ("while 1", "a line that opens a block ends with a colon"),
        ("return !1", "Python writes not"),
        ("return a' * a", "the transpose of a matrix is A.T"),
    ] {
        let source = format!("def control(observation):\n    {line}\n");
        let (message, help, at, _) = mistake(failed(&source).stop);
        if !help.contains(advice) || at != 2 {
            wrong.push(format!("{line}: line {at}: {message}: {help}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
