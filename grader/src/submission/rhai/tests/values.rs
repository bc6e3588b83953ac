//! What scripts calculate: values as a student writes and gets them.

use super::{assert_values, numbers, value, words};
use crate::submission::controller::Value;

#[test]
fn whole_numbers_are_numbers() {
    use Value::Number;
    assert_values([
        ("1 / 2", Number(0.5)),
        ("4 / 2", Number(2.0)),
        ("7 % 3", Number(1.0)),
        ("-7 % 3", Number(2.0)),
        ("-7.5 % 2", Number(0.5)),
        ("7 % -3", Number(-2.0)),
        ("2 ** 10", Number(1024.0)),
        ("2 ** -1", Number(0.5)),
        ("2 ** 0.5", Number(std::f64::consts::SQRT_2)),
        ("2 ** 100", Number(1.2676506002282294e30)),
        ("9223372036854775807 + 1", Number(9.223_372_036_854_776e18)),
        (
            "-(-9223372036854775807 - 1)",
            Number(9.223_372_036_854_776e18),
        ),
        ("1 / 0", Number(f64::INFINITY)),
        ("1 + 0.5", Number(1.5)),
        ("let x = 1; x += 0.5; x", Number(1.5)),
        ("let x = 1; x /= 2; x", Number(0.5)),
        ("floor(2.5)", Number(2.0)),
        ("round(2.567, 2)", Number(2.57)),
        ("round(1e300, 3)", Number(1e300)),
        ("let a = [5, 6]; a[floor(1.5)]", Number(6.0)),
    ]);
    assert!(matches!(value("0 / 0"), Number(x) if x.is_nan()));
    assert!(matches!(value("5 % 0"), Number(x) if x.is_nan()));
}

#[test]
fn comparisons_are_exact_and_go_across_kinds() {
    for (body, wanted) in [
        // a letter of a text is a text of one letter
        ("\"RzTx\"[0] == \"R\"", true),
        ("'z' == \"RzTx\"[1]", true),
        ("\"RzTx\"[0] == \"Rz\"", false),
        ("\"RzTx\"[0] != \"r\"", true),
        ("\"RzTx\"[0] == 82", false),
        ("1 < 2.5", true),
        ("1 == 1.0", true),
        ("0.1 + 0.2 == 0.3", false),
        ("0 / 0 == 0 / 0", false),
        ("(0 / 0) < 1", false),
        ("\"a\" < \"b\"", true),
        ("() == 1", false),
        ("[0.25, 0.5] == observation.q", true),
        ("[1, [2, 3]] == [1, [2, 3]]", true),
        ("[1, 2] != [1, 2, 3]", true),
        ("#{a: 1} == #{a: 1.0}", true),
        ("\"q\" in observation", true),
        ("2 in [1, 2]", true),
        ("!true", false),
    ] {
        assert_eq!(value(body), Value::Boolean(wanted), "{body}");
    }
}

#[test]
fn vectors_calculate_element_by_element() {
    assert_values([
        (
            "observation.q + observation.qd * observation.dt",
            numbers([0.75, 1.5]),
        ),
        ("[1, 2] + [3, 4]", numbers([4.0, 6.0])),
        ("[1, 2] * [3, 4]", numbers([3.0, 8.0])),
        ("2 * [1, 2]", numbers([2.0, 4.0])),
        ("2 / [1, 2]", numbers([2.0, 1.0])),
        ("1 + vector([1, 2])", numbers([2.0, 3.0])),
        ("-observation.q", numbers([-0.25, -0.5])),
        ("[1, 2] ** 2", numbers([1.0, 4.0])),
        ("sqrt([4, 9])", numbers([2.0, 3.0])),
        ("clamp([-5, 5], -[1, 2], [1, 2])", numbers([-1.0, 2.0])),
        ("lerp([0, 0], [2, 4], 0.25)", numbers([0.5, 1.0])),
        ("linspace(0, 1, 3)", numbers([0.0, 0.5, 1.0])),
        ("linspace(2, 3, 1)", numbers([2.0])),
        ("cross([1, 0, 0], [0, 1, 0])", numbers([0.0, 0.0, 1.0])),
        (
            "let v = zeros(2); v[1] = 3; v[0] -= 1; v",
            numbers([-1.0, 3.0]),
        ),
        ("let v = vector([1]); v.push(2); v", numbers([1.0, 2.0])),
        (
            "let a = observation.q; let b = a; b[0] = 9; a",
            numbers([0.25, 0.5]),
        ),
        ("vector([1, 2, 3])[1..3]", numbers([2.0, 3.0])),
        ("vector([1, 2, 3])[0..=1]", numbers([1.0, 2.0])),
        ("concat(observation.q, [1])", numbers([0.25, 0.5, 1.0])),
        ("dot([1, 2], [3, 4])", Value::Number(11.0)),
        ("norm([3, 4])", Value::Number(5.0)),
        ("[3, 4].norm()", Value::Number(5.0)),
        ("observation.q[1.0]", Value::Number(0.5)),
        ("observation.tcp.x", Value::Number(4.0)),
        (
            "observation.tcp_rotation * [1, 0, 0]",
            numbers([0.0, 1.0, 0.0]),
        ),
        (
            "col(observation.tcp_rotation, 1)",
            numbers([-1.0, 0.0, 0.0]),
        ),
        ("max(observation.q)", Value::Number(0.5)),
        (
            "let s = 0; for x in observation.q { s += x; } s",
            Value::Number(0.75),
        ),
        ("len(observation.q)", Value::Number(2.0)),
    ]);
}

#[test]
fn matrices_multiply_and_solve_as_in_linear_algebra() {
    let square = |[a, b, c, d]: [f64; 4]| Value::List(vec![numbers([a, b]), numbers([c, d])]);
    assert_values([
        ("[[1, 2], [3, 4]] * [1, 1]", numbers([3.0, 7.0])),
        (
            "matrix([[1, 2], [3, 4]]).solve([1, 1])",
            numbers([-1.0, 1.0]),
        ),
        (
            "let J = matrix([[1, 2], [3, 4]]); J.T.solve([1, 1])",
            numbers([-0.5, 0.5]),
        ),
        (
            "eye(2) * matrix([[1, 2], [3, 4]])",
            square([1.0, 2.0, 3.0, 4.0]),
        ),
        ("2 * eye(2) - eye(2)", square([1.0, 0.0, 0.0, 1.0])),
        ("transpose([[1, 2], [3, 4]])", square([1.0, 3.0, 2.0, 4.0])),
        ("inverse([[2, 0], [0, 4]])", square([0.5, 0.0, 0.0, 0.25])),
        (
            "let m = eye(2); m[0][1] = 5; m",
            square([1.0, 5.0, 0.0, 1.0]),
        ),
        (
            "let m = eye(2); m[1] = [7, 8]; m",
            square([1.0, 0.0, 7.0, 8.0]),
        ),
        ("diag([1, 2])", square([1.0, 0.0, 0.0, 2.0])),
        ("ones(2, 2)", square([1.0, 1.0, 1.0, 1.0])),
        ("det([[1, 2], [3, 4]])", Value::Number(-2.0)),
        ("col([[1, 2], [3, 4]], 1)", numbers([2.0, 4.0])),
        (
            "let s = 0; for row in eye(3) { s += sum(row); } s",
            Value::Number(3.0),
        ),
    ]);
    assert_eq!(
        words("inverse([[1, 2], [2, 4]])"),
        "the matrix is singular: it has no inverse | a Jacobian is singular where the arm is straight or folded; elsewhere `print` the matrix: which row or column is wrong?"
    );
}

#[test]
fn lists_maps_and_texts_do_the_everyday_things() {
    assert_values([
        (
            "let a = []; a.push(1); a.push([2]); a",
            Value::List(vec![Value::Number(1.0), numbers([2.0])]),
        ),
        (
            "let a = [1, 2, 3]; a.remove(0); a.insert(0, 9); a.pop(); a",
            numbers([9.0, 2.0]),
        ),
        ("sort([3, 1, 2])", numbers([1.0, 2.0, 3.0])),
        ("reverse([1, 2])", numbers([2.0, 1.0])),
        ("slice([1, 2, 3], 1, 3)", numbers([2.0, 3.0])),
        (
            "let s = 0; for i in 0..=3 { s += i; } s",
            Value::Number(6.0),
        ),
        (
            "let s = 0; for i in range(4) { s += i; } s",
            Value::Number(6.0),
        ),
        (
            "let n = 3.0; let s = 0; for i in 0..n { s += 1; } s",
            Value::Number(3.0),
        ),
        (
            "let s = \"\"; for c in \"ab\" { s = c + s; } s",
            Value::Text("ba".into()),
        ),
        ("\"x = \" + [1, 2.5]", Value::Text("x = [1, 2.5]".into())),
        ("`${observation.q}`", Value::Text("[0.25, 0.5]".into())),
        ("get(observation, \"zz\", 4)", Value::Number(4.0)),
        ("len(keys(#{a: 1, b: 2}))", Value::Number(2.0)),
        ("switch 2 { 1 => 5, 2 => 6 }", Value::Number(6.0)),
        (
            "#{b: 1, a: true}",
            Value::Map(vec![
                ("a".into(), Value::Boolean(true)),
                ("b".into(), Value::Number(1.0)),
            ]),
        ),
        ("", Value::Nothing),
    ]);
}
