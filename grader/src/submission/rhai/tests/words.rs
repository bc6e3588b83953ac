//! What a student reads when something is wrong.

use super::{answer, assert_words, numbers, stop};
use crate::submission::controller::{SourcePosition, Stop};

#[test]
fn the_place_is_that_of_the_innermost_mistake() {
    let source = "fn helper(x) {\n    let y = x;\n    sinn(y)\n}\nfn control(o) { helper(1) }";
    let Stop::Crashed(mistake) = stop(source) else {
        panic!("no crash");
    };
    assert_eq!(mistake.place, Some(SourcePosition { line: 3, column: 5 }));
}

#[test]
fn mistakes_are_reported_with_names_values_and_a_way_out() {
    assert_words([
        ("sinn(1)", "`sinn` is not a function: did you mean `sin`?"),
        ("sin(1, [2, 3", "a `]` or a `,` is missing before this"),
        ("let x = 1; sin(x", "a `)` or a `,` is missing before this"),
        ("sin()", "`sin` takes 1 argument, got none"),
        ("atan2(1)", "`atan2` takes 2 arguments, got 1"),
        (
            "sin(\"a\")",
            "`sin` takes a number or a vector, got the string \"a\"",
        ),
        (
            "let gain = 2; gian",
            "variable `gian` is not known here: did you mean `gain`?",
        ),
        (
            "kp * 2",
            "variable `kp` is not known here | declare it first: let kp = ...;",
        ),
        (
            "qd * 2",
            "variable `qd` is not known here | write observation.qd",
        ),
        (
            "observation.qdd",
            "`observation` has no `qdd`: did you mean `qd`? | it has dt, effort, q, qd, sensors, target, task, tcp, tcp_rotation, tick, time",
        ),
        (
            "this.x",
            "`this.x` is not set yet | set it in init(robot, task)",
        ),
        (
            "this.x += 1",
            "cannot add nothing `()` and the number 1 | `()` means that nothing was set or returned: set what is in `this` in init, and end a function with `return`",
        ),
        (
            "vector([1, 2]) + vector([1, 2, 3])",
            "cannot add a vector of 2 and a vector of 3 | element by element needs as many on the left as on the right",
        ),
        (
            "[1, 2] * eye(2)",
            "cannot multiply a list of 2 by a 2x2 matrix | write the matrix first: m * v, or transpose(m) * v",
        ),
        (
            "observation.q < 1",
            "cannot compare a vector of 2 < the number 1 | compare elements, or one number of it: max(abs(v)), norm(v)",
        ),
        (
            "observation.q[2]",
            "index 2 is past the end: joint 2 is q[1], counting starts at 0",
        ),
        (
            "let v = [1, 2]; v[5]",
            "index 5 is past the end: the last is v[1], counting starts at 0",
        ),
        (
            "let i = 0; observation.q[i - 1]",
            "index -1 is negative | counting starts at 0; the last is [len(...) - 1]",
        ),
        (
            "observation.q[-1]",
            "an index is negative | counting starts at 0; the last is v[len(v) - 1]",
        ),
        (
            "observation.q[0.5]",
            "an index is an integer, got the number 0.5",
        ),
        (
            "[1, 2][1.0]",
            "the index of a list is an integer | round(i) makes it whole; a vector takes 2.0 for 2",
        ),
        (
            "let a = [1, 2]; let i = 0.5 + 0.5; a[i]",
            "the index of a list is an integer, got a number | round(i) makes it whole; a vector takes 2.0 for 2",
        ),
        (
            "let a = [1, 2]; a[0..1]",
            "the index of a list is an integer, got a range | slice(a, 0, 3) is the part from index 0 to before 3",
        ),
        (
            "let a = [1, 2]; a[0..=1]",
            "the index of a list is an integer, got a range | slice(a, 0, 3) is the part from index 0 to before 3",
        ),
        ("observation.tcp.w", "a vector has no `w`"),
        ("let x = 1.5; x[0]", "the number 1.5 has no elements"),
        (
            "if observation.q { 1 }",
            "expected true or false, got a vector",
        ),
        ("throw \"bad\"", "the script threw: bad"),
        (
            "const K = [1, 2]; K.push(5)",
            "a constant cannot change | copy it with `let` first",
        ),
        (
            "this = 5; 1",
            "`this` is not a map any more | keep values under names: this.count = 0",
        ),
        (
            "clamp(1, 2, 0)",
            "`clamp` from 2 to 0: the lower end is above the upper",
        ),
        (
            "let r = robot.fk([1, 2]);",
            "variable `robot` is not known here | only `init` is given it: write this.robot = robot; there, and this.robot here",
        ),
        (
            "observation.fk([1, 2])",
            "`robot.fk` is not granted in this task | write it yourself: the dimensions are in `robot`; if this line is for another task, `observation.task` is compared with another name",
        ),
    ]);
}

#[test]
fn names_and_signs_of_other_languages_get_a_hint() {
    assert_words([
        (
            "np.sin(1)",
            "variable `np` is not known here | functions are built in: write sin(x), pi and [1, 2], without a prefix",
        ),
        (
            "math.pi",
            "variable `math` is not known here | functions are built in: write sin(x), pi and [1, 2], without a prefix",
        ),
        (
            "arctan2(1, 2)",
            "`arctan2` is not a function | write atan2(y, x)",
        ),
        ("arccos(1)", "`arccos` is not a function | write acos(x)"),
        ("power(1, 2)", "`power` is not a function | write x ** y"),
        ("length([1])", "`length` is not a function | write len(x)"),
        ("numel([1])", "`numel` is not a function | write len(x)"),
        ("disp(1)", "`disp` is not a function | write print(x)"),
        (
            "printf(1)",
            "`printf` is not a function | write print(\"x =\", x)",
        ),
        (
            "sleep(5)",
            "`sleep` is not a function | nothing waits here: `control` is called every control period",
        ),
        (
            "sleep(0.5)",
            "`sleep` is not a function | nothing waits here: `control` is called every control period",
        ),
        (
            "2 ^ 2",
            "`^` is not a power here | use ** for powers: x ** 2",
        ),
        (
            "let x = 2; x ^= 2; x",
            "`^` is not a power here | use ** for powers: x ** 2",
        ),
        (
            "if true and false { 1 }",
            "a `{` is missing before this | write && for \"and\"",
        ),
        (
            "let x = true ? 2 : 3;",
            "`?` is not an operator here | write if condition { a } else { b }",
        ),
        (
            "observation.q .* 2",
            "a name must follow the `.` | write *: vectors multiply element by element",
        ),
        (
            "let x = 1; x++;",
            "`++` is not an operator here | write x += 1",
        ),
        (
            "let m = eye(2); m[0, 1]",
            "a `]` is missing before this | an element of a matrix is m[row][column]",
        ),
        (
            "'abc'",
            "a string goes in double quotes | write \"text\" instead of 'text'",
        ),
        (
            "let x = 1 let y = 2;",
            "a `;` is missing before this | end the statement before it with `;`",
        ),
        (
            "eval(\"1\")",
            "`eval` is not available here | functions are called by name",
        ),
        (
            "let f = |x| x;",
            "unexpected `|` | functions without a name are not available: write fn name(x) { ... }",
        ),
        (
            "import \"x\" as y;",
            "`import` is not available here | everything there is, is built in",
        ),
        (
            "for i in 3 { }",
            "`for` goes over a range, a list, a vector or a string | count with `for i in 0..n`",
        ),
        (
            "let n = 3; for i in n { }",
            "`for` goes over a range, a list, a vector or a string | count with `for i in 0..n`; go over a map with `for key in keys(m)`",
        ),
        ("None", "variable `None` is not known here | write ()"),
    ]);
}

#[test]
fn a_file_that_does_not_compile_gets_a_way_out() {
    assert_words([
        (
            "let a = 1; if a = 2 { }",
            "`=` sets a value and cannot be part of a condition | write == to compare",
        ),
        (
            "let a = 1; while (a = 2) { }",
            "`=` sets a value and cannot be part of a condition | write == to compare",
        ),
        ("let x = cos(1)) ;", "this `)` closes nothing | remove it"),
        ("let x = [1]];", "this `]` closes nothing | remove it"),
        ("} }", "this `}` closes nothing | remove it"),
        (
            "[[1, 2]\n [3, 4]]",
            "a `,` is missing at the end of line 1 | elements and rows are separated by ,",
        ),
        (
            "[[1, 2] [3, 4]]",
            "a `,` is missing before this | elements and rows are separated by ,",
        ),
        (
            "if 1 > 2 { }\nelif\n1",
            "`elif` is not available here | write } else if condition { ... }",
        ),
        (
            "elif(1)",
            "`elif` is not a function | write } else if condition { ... }",
        ),
        (
            "null",
            "`null` is a reserved word of the language | write () for nothing; for a name, choose another name, such as `my_null`",
        ),
        (
            "let x = “a”;",
            "unexpected `“` | write \" (a straight quote)",
        ),
        ("π * 2", "unexpected `π` | write pi"),
        (
            "θ * 2",
            "unexpected `θ` | names have the letters a to z, digits and _",
        ),
        (
            "print x",
            "`print` is a function | call it: print(x); give a variable another name",
        ),
        (
            "if 1 { }",
            "a condition is true or false, got a number | compare: x > 0",
        ),
        (
            "if { }",
            "a condition is missing before this | a condition is true or false: if x > 0 { ... }",
        ),
        ("let x = 1 + ;", "a value is missing before this `;`"),
        (
            "sin(1) = 2;",
            "this cannot be set | on the left of `=` is a variable, an element v[0] or m[0][1], or a key; list.push(x) appends; == compares",
        ),
        (
            "let = 3;",
            "the name of a variable is missing here | a name begins with a letter and is not a word of the language: let gain = 1;",
        ),
        (
            "for (i in 0..3) { }",
            "`for` is written without `(` and `)` | write for i in 0..n { ... }",
        ),
    ]);
}

#[test]
fn values_of_the_wrong_shape_and_names_out_of_sight_are_reported() {
    assert_words([
        (
            "matrix([[1, 2], [3]])",
            "the rows have 2 and 1 numbers: a matrix has rows of equal length",
        ),
        (
            "vector([1, 2]) * [[1, 2], [3, 4], [5, 6]]",
            "cannot multiply a vector of 2 by a 3x2 matrix | write the matrix first: m * v, or transpose(m) * v",
        ),
        (
            "for i in 0..2 { let x = i; } x",
            "variable `x` is not known here | `x` ends with the block in which it is declared: write let x = 0; before that block, and x = ...; without `let` inside it",
        ),
        (
            "x; let x = 2;",
            "variable `x` is not known here | declare it first: let x = ...;",
        ),
        (
            "cosine(1)",
            "`cosine` is not a function: did you mean `cos`?",
        ),
    ]);
}

#[test]
fn a_call_without_end_is_reported_where_it_can_be() {
    for (source, line) in [
        (
            "fn spin(x) {\n while true { let y = x; } }\nfn control(o) {\n let a = 2 * 3;\n spin(a) }",
            Some(2),
        ),
        (
            "fn spin(x) {\n while true { x += 1; } }\nfn control(o) {\n spin(1) }",
            Some(2),
        ),
        (
            "fn spin(x) {\n loop { } }\nfn control(o) {\n while false { }\n spin(1) }",
            None,
        ),
        (
            "fn spin(x) {\n spin(x) }\nfn control(o) {\n spin(1) }",
            Some(2),
        ),
        ("fn control(o) {\n loop { } }", Some(2)),
        (
            "fn other(x) {\n loop { } }\nfn control(o) {\n for i in 0..10000000 { } }",
            Some(4),
        ),
        (
            "fn spin(x) {\n loop { } }\nfn other(x) {\n loop { } }\nfn control(o) {\n spin(1) }",
            Some(2),
        ),
        (
            "fn control(o) {\n this.a = [1, 2, 3];\n loop {\n let copy = this;\n } }",
            Some(4),
        ),
    ] {
        let Stop::OverBudget { place, .. } = stop(source) else {
            panic!("{source}: it ends");
        };
        assert_eq!(place.map(|place| place.line), line, "{source}");
    }
}

/// The message, the place and the help of a file that does not compile.
fn unbuilt(source: &str) -> String {
    let Stop::DidNotBuild(mistake) = stop(source) else {
        panic!("{source}: it builds");
    };
    let place = mistake.place.expect("a place");
    format!(
        "{}:{} {} | {}",
        place.line,
        place.column,
        mistake.message,
        mistake.help.unwrap_or_default()
    )
}

#[test]
fn a_slip_is_reported_where_it_is_and_not_where_the_parser_stops() {
    for (source, wanted) in [
        (
            "fn control(o) { let x = 3 // three\n  [x, 0] }",
            "1:26 a `;` is missing at the end of line 1 | end the statement with ;",
        ),
        (
            "fn control(o) { let x = 3\n  [0.5, 0] }",
            "1:26 a `;` is missing at the end of line 1 | end the statement with ;",
        ),
        (
            "fn control(o) {\n  1 /* a\n}\n",
            "2:5 the comment that begins at 2:5 is not closed | end it with */",
        ),
        (
            "fn control(observation)\n [0.5, 0]",
            "2:2 a function's body is in { } | fn control(observation) { [0.5, 0] }",
        ),
        (
            "fn control { 1 }",
            "1:12 the parameters of `control` are missing | write fn control(observation) { ... }",
        ),
    ] {
        assert_eq!(unbuilt(source), wanted, "{source}");
    }
}

#[test]
fn of_two_slips_the_first_in_the_file_is_reported() {
    let source = "fn z(x) { x ^ 2 }\nfn a(x) { x ^ 2 }\nfn control(o) { o.q[-1] }";
    let Stop::DidNotBuild(mistake) = stop(source) else {
        panic!("it builds");
    };
    assert_eq!(
        mistake.place,
        Some(SourcePosition {
            line: 1,
            column: 13
        })
    );
}

#[test]
fn an_unfinished_file_is_reported_where_its_block_begins() {
    let Stop::DidNotBuild(mistake) = stop("fn control(o) {\n    let x = 1;\n") else {
        panic!("it builds");
    };
    assert_eq!(mistake.place.map(|place| place.line), Some(1));
    assert_eq!(mistake.message, "the `{` of line 1 is never closed");
}

#[test]
fn an_answer_that_is_no_number_says_in_the_log_where_it_began() {
    let answer = answer("let a = sqrt(4);\nlet b = acos([0.5, 1.5]);\na + sqrt(-b)");
    assert_eq!(
        answer.said.texts(),
        ["line 2: `acos` takes a number from -1 to 1, got 1.5: the result is not a number"]
    );
}

#[test]
fn a_number_that_is_none_may_be_tested_for() {
    let answer = answer("let x = acos(1.5); if is_nan(x) { [] } else { [x] }");
    assert_eq!(answer.value, numbers([]));
    assert!(answer.said.log.is_empty());
}
