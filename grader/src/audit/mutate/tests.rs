use kinemark_sim::text::Source;

use super::covers;
use super::mutation::{Mutation, drawn, mutations};
use crate::submission::rhai::ProgramTree;

fn of(program: &str) -> Vec<Mutation> {
    mutations(&Source::new("solution.rhai", program))
}

/// The lines after the changes of a kind.
fn after(program: &str, operator: &str) -> Vec<String> {
    let of_kind = of(program).into_iter();
    let of_kind = of_kind.filter(|mutation| mutation.operator.0 == operator);
    of_kind.map(|mutation| mutation.after).collect()
}

#[test]
fn a_line_alone_stands_for_its_changes() {
    let change = "t += 0.15; -> t -= 0.15;";
    assert!(covers(change, change) && covers("t += 0.15;", change));
    for other in ["t += 0.15; -> t += 0.2;", "t += 0.1", "t -= 0.15;", "x"] {
        assert!(!covers(other, change), "{other}");
    }
}

/// A program, a kind of change, and the program after each.
const CHANGES: &[(&str, &str, &[&str])] = &[
    ("-s1 + 2.5", "sign", &["s1 + 2.5", "-s1 + -2.5"]),
    (
        "clamp(c, -1, 1)",
        "sign",
        &["clamp(c, 1, 1)", "clamp(c, -1, -1)"],
    ),
    ("a -acos(c)", "sign", &["a -(-acos(c))"]),
    ("sqrt(c)", "sign", &["-sqrt(c)"]),
    ("a + b * c", "operator", &["a - b * c", "a + b / c"]),
    ("x ** 2", "operator", &["x * 2"]),
    ("this.sum += e;", "operator", &["this.sum -= e;"]),
    (
        "sin(q) + cos(q)",
        "function",
        &["cos(q) + cos(q)", "sin(q) + sin(q)"],
    ),
    ("atan2(y, x - h)", "function", &["atan((y) / (x - h))"]),
    ("l[0] + p[2]", "index", &["l[1] + p[2]", "l[0] + p[1]"]),
    ("v[0..2]", "index", &["v[1..2]", "v[0..1]"]),
    (
        "fn f(q) { let l1 = q; let l2 = 2; l1 }",
        "index",
        &["fn f(q) { let l1 = q; let l2 = 2; l2 }"],
    ),
    ("[a, b]", "order", &["[b, a]"]),
    ("atan2(y, x - h)", "order", &["atan2(x - h, y)"]),
    ("plot(\"a, b\", c)", "order", &[]),
    ("o.q - o.qd", "signal", &["o.qd - o.qd", "o.q - o.q"]),
    ("a - b", "term", &["a", "-b"]),
    ("a * b + c", "term", &["a + c", "b + c", "a * b", "c"]),
    (
        "(a + b) * c",
        "term",
        &["(a + b)", "c", "(a) * c", "(b) * c"],
    ),
    (
        "sin(q[0])",
        "degrees",
        &["sin(deg(q[0]))", "sin(rad(q[0]))"],
    ),
    ("acos(c)", "degrees", &["deg(acos(c))"]),
    (
        "sin(rad(x))",
        "degrees",
        &["sin(deg(rad(x)))", "sin(rad(rad(x)))", "sin((x))"],
    ),
    (
        "const GAIN = 5;",
        "gain",
        &["const GAIN = 4.5;", "const GAIN = 5.5;"],
    ),
    (
        "t.kp * e",
        "gain",
        &["(0.9 * t.kp) * e", "(1.1 * t.kp) * e"],
    ),
    ("0.05 * x", "gain", &["0.045 * x", "0.055 * x"]),
    (
        "x * 2 + v[3]",
        "constant",
        &["x * 0 + v[3]", "x * 1 + v[3]"],
    ),
    (
        "if a < 1 { b } else { c }",
        "condition",
        &["if !(a < 1) { b } else { c }", "if a > 1 { b } else { c }"],
    ),
    (
        "if a == 1 && b { c }",
        "condition",
        &[
            "if !(a == 1 && b) { c }",
            "if a != 1 && b { c }",
            "if a == 1 || b { c }",
        ],
    ),
];

#[test]
fn each_kind_changes_what_it_should() {
    for (program, operator, expected) in CHANGES {
        assert_eq!(
            after(program, operator),
            *expected,
            "{operator} of {program}"
        );
    }
}

#[test]
fn an_operand_is_all_that_belongs_to_it() {
    // a condition, a call on a result, an index of a call, and the precedence of powers
    assert_eq!(
        after("let d = n / if a { 2 } else { b };", "term"),
        ["let d = n;"]
    );
    assert_eq!(
        after("f(a, b)[0].g(c) + 2 ** x ** y", "term"),
        [
            "f(a, b)[0].g(c)",
            "2 ** x ** y",
            "f(a, b)[0].g(c) + 2",
            "f(a, b)[0].g(c) + 2 ** x"
        ]
    );
}

#[test]
fn comments_and_texts_stay_as_they_are() {
    let program = "// sin(q) + 1\nlet a = b + c; // a + b\nprint(\"1 + sin(2)\"); /* 3 - 4 */ let d = `x * ${e + 1} / y`;";
    let tree = ProgramTree::read(program).unwrap();
    assert_eq!(tree.comments.len(), 3);
    for mutation in of(program) {
        let changed = mutation.program(program);
        for kept in [
            "// sin(q) + 1\n",
            "// a + b\n",
            "\"1 + sin(2)\"",
            "/* 3 - 4 */",
            "`x * ${",
            "} / y`",
        ] {
            assert!(changed.contains(kept), "{changed}");
        }
    }
    assert_eq!(
        after(program, "operator"),
        [
            "let a = b - c;",
            "print(\"1 + sin(2)\"); let d = `x * ${e - 1} / y`;"
        ]
    );
}

#[test]
fn places_are_right_behind_other_alphabets() {
    let program = "let s = \"Größe 日本\"; /* é */ let a = b + c;";
    let all = of(program);
    let sum = all
        .iter()
        .find(|mutation| mutation.operator.0 == "operator");
    let sum = sum.unwrap();
    assert_eq!((sum.line, sum.column), (1, 39));
    assert_eq!(&program[sum.at.clone()], "+");
    assert_eq!(sum.after, "let s = \"Größe 日本\"; let a = b - c;");
}

#[test]
fn late_control_answers_what_it_answered_before() {
    let program = "fn init(robot, task) { this.k = 0; }\nfn control(o) { this.k += 1; [this.k] }";
    let all = of(program);
    let late = all.iter().find(|mutation| mutation.operator.0 == "delay");
    let late = late.unwrap();
    assert_eq!((late.line, late.column), (2, 4));
    assert_eq!(late.before, "fn control(o) { this.k += 1; [this.k] }");
    assert!(
        late.after.ends_with("// one control period late"),
        "{}",
        late.after
    );
    assert!(after("fn other(o) { 1 }", "delay").is_empty());
}

#[test]
fn an_entry_is_read_as_it_is_printed() {
    #[derive(serde::Deserialize)]
    struct Entry {
        of: String,
    }
    #[derive(serde::Deserialize)]
    struct File {
        accepted: Vec<Entry>,
    }
    for mutation in of("if o.task == \"a'b\" { 1 } else { 2 } // why") {
        let file: File = toml::from_str(&mutation.entry()).unwrap();
        assert_eq!(file.accepted[0].of, mutation.of());
    }
}

#[test]
fn the_same_seed_draws_the_same_changes() {
    let first = drawn("a-lab", 100, 10, 7);
    assert_eq!(first, drawn("a-lab", 100, 10, 7));
    assert_ne!(first, drawn("a-lab", 100, 10, 8));
    assert_ne!(first, drawn("b-lab", 100, 10, 7));
    assert_eq!(first.len(), 10);
    assert!(first.windows(2).all(|pair| pair[0] < pair[1]) && first[9] < 100);
    assert_eq!(drawn("a-lab", 3, 10, 7), [0, 1, 2]);
}

#[test]
fn brackets_that_do_not_match_have_no_changes() {
    for program in [
        "fn f( { 1 + 2 }",
        "(1 + 2",
        "1 + 2)",
        "let a = \" 1 + 2",
        "",
    ] {
        assert!(of(program).is_empty(), "{program}");
    }
}
