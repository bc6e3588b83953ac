//! A script gives with its charges what it gives without: values, output, mistakes and their places, in scripts that nobody wrote.

use std::fmt::Write as _;

use proptest::prelude::*;

use super::{observation, opening};
use crate::submission::controller::{Answer, Call, Controller, Said, Stop};
use crate::submission::rhai::ScriptController;

/// What two calls come to, one after another: state stays in between.
fn outcome(source: &str, has_charges: bool) -> (Vec<Result<Answer, Stop>>, Said) {
    let mut script = match open(source, has_charges) {
        Ok(script) => script,
        Err(stop) => return (vec![Err(stop)], Said::default()),
    };
    let mut call = || {
        let answer = script.call(&Call::Control(observation()));
        // what is counted is the difference
        answer.map(|answer| Answer {
            operations: 0,
            ..answer
        })
    };
    let answers = vec![call(), call()];
    (answers, script.unanswered())
}

fn open(source: &str, has_charges: bool) -> Result<ScriptController, Stop> {
    let mut opening = opening(source);
    opening.budgets.operations_per_call = 10_000_000;
    match has_charges {
        true => ScriptController::open(&opening),
        false => ScriptController::rewritten(&opening, |_, _, ast, _| Ok(ast.clone())),
    }
}

/// Expressions; `x` and `n` are variables, `this` has what statements before gave it.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        3 => prop::sample::select(vec![
            "x", "n", "this", "this.a", "this.m", "this.m.k", "this.a[0]", "this.a[n]", "this.m[\"k\"]", "o.q", "o.q[1]", "o.tick",
        ])
        .prop_map(str::to_owned),
        1 => (-3_i64..20).prop_map(|number| number.to_string()),
        1 => prop::sample::select(vec!["1.5", "PI", "[[1, 2], [3, 4]]", "vector([1, 2])", "\"ab\"", "true", "()", "[]", "#{}", "this.none", "this.a[99]"]).prop_map(str::to_owned),
        // a list of constants that is written out
        1 => (14_usize..20).prop_map(|count| format!("[{}]", vec!["7"; count].join(", "))),
    ];
    leaf.prop_recursive(4, 24, 4, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            pair.clone().prop_map(|(a, b)| format!("[{a}, {b}]")),
            pair.clone()
                .prop_map(|(a, b)| format!("#{{k: {a}, l: {b}}}")),
            pair.clone().prop_map(|(a, b)| format!("({a}) + ({b})")),
            pair.clone().prop_map(|(a, b)| format!("({a}) == ({b})")),
            (
                pair.clone(),
                prop::sample::select(vec!["-", "*", "/", "%", "**", "<", "<=", ">", ">=", "!="])
            )
                .prop_map(|((a, b), operator)| format!("({a}) {operator} ({b})")),
            // a variable on the left is lent, after the right was evaluated
            inner
                .clone()
                .prop_map(|a| format!("x - {{ x = {a}; n = 2; n }} * n")),
            inner.clone().prop_map(|a| format!("[{a}, n][n]")),
            inner.clone().prop_map(|a| format!("this.a[len([{a}])]")),
            pair.clone().prop_map(|(a, b)| format!("(({a}) ?? ({b}))")),
            pair.clone().prop_map(|(a, b)| format!("f({a}, {b})")),
            pair.clone()
                .prop_map(|(a, b)| format!("g({a}, {b}, 1, 2, 3)")),
            pair.clone()
                .prop_map(|(a, b)| format!("if ({a}) == ({b}) {{ {a} }} else {{ {b} }}")),
            pair.prop_map(|(a, b)| format!(
                "switch {a} {{ 1 => {b}, 2..9 => {a}, \"ab\" => 3, _ => [{a}] }}"
            )),
            inner.clone().prop_map(|a| format!("len({a})")),
            inner.clone().prop_map(|a| format!("({a}).k")),
            inner.clone().prop_map(|a| format!("`<${{{a}}}>`")),
            inner
                .clone()
                .prop_map(|a| format!("({{ let y = {a}; y }})")),
            inner.prop_map(|a| format!("(({a}) == 1 && true)")),
        ]
    })
}

/// Statements that set state and variables, loop, and catch what goes wrong.
fn statement() -> impl Strategy<Value = String> {
    let simple = prop_oneof![
        expression().prop_map(|a| format!("x = {a};")),
        expression().prop_map(|a| format!("this.a = {a};")),
        expression().prop_map(|a| format!("this.m = #{{k: {a}}};")),
        (expression(), expression()).prop_map(|(a, b)| format!("this.a[{a}] = {b};")),
        expression().prop_map(|a| format!("this.m.k = {a};")),
        expression().prop_map(|a| format!("this.a += {a};")),
        expression().prop_map(|a| format!("print({a});")),
        expression().prop_map(|a| format!("this.a.push({a});")),
        expression().prop_map(|a| format!("if n > 2 {{ throw {a}; }}")),
    ];
    simple.prop_recursive(3, 12, 3, |inner| {
        let block = prop::collection::vec(inner, 1..3).prop_map(|lines| lines.join(" "));
        prop_oneof![
            (block.clone(), block.clone())
                .prop_map(|(a, b)| format!("try {{ {a} }} catch {{ {b} }}")),
            (block.clone(), block.clone())
                .prop_map(|(a, b)| format!("try {{ {a} }} catch (wrong) {{ x = wrong; {b} }}")),
            block
                .clone()
                .prop_map(|a| format!("for v in 0..3 {{ n = v; {a} }}")),
            (expression(), block.clone())
                .prop_map(|(e, a)| format!("for v in [{e}, n] {{ x = v; {a} }}")),
            block.prop_map(|a| format!("{{ let c = 0; while c < 3 {{ c += 1; {a} }} }}")),
        ]
    })
}

fn script() -> impl Strategy<Value = String> {
    // what nobody catches ends all that would follow
    let statements = prop::collection::vec((statement(), prop::bool::weighted(0.9)), 1..8);
    (statements, expression()).prop_map(|(statements, last)| {
        let mut text = "fn f(a, b) { if len([a]) == 1 { [b, a] } else { a } }\n".to_owned();
        text += "fn g(a, b, c, d, e) { a }\n";
        text += "fn control(o) {\n let x = 1; let n = 0;\n";
        text += " if !(\"a\" in this) { this.a = [1, 2, [3]]; this.m = #{k: 4}; }\n";
        for (statement, is_caught) in statements {
            // into a string: nothing can fail
            let _ = match is_caught {
                true => writeln!(text, " try {{ {statement} }} catch (w) {{ print(w); }}"),
                false => writeln!(text, " {statement}"),
            };
        }
        format!("{text} {last}\n}}\n")
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn charges_change_nothing_but_the_count(source in script()) {
        let charged = outcome(&source, true);
        // values that grow without end reach a budget, with charges sooner
        let is_over = |outcome: &Result<Answer, Stop>| matches!(outcome, Err(Stop::OverBudget { .. }));
        prop_assume!(!charged.0.iter().any(is_over));
        // as text, because 0 / 0 is not equal to itself
        let [charged, plain] = [charged, outcome(&source, false)].map(|outcome| format!("{outcome:?}"));
        prop_assert_eq!(charged, plain, "{}", source);
    }
}

/// Nothing here is large: what is done is counted as the engine counts it.
#[test]
fn operators_take_the_operations_that_the_engine_counts() {
    let source = "fn control(o) {
        let x = o.q[0];
        let v = vector([x, 2.0]) * 3 - o.q;
        for k in 0..300 {
            if x * k + 1.5 >= k ** 2 / 7 || v == [k, k % 3] {
                x = x - (k - 2 * x) / 3;
            }
        }
        x
    }";
    let operations = |has_charges: bool| {
        let mut script = open(source, has_charges).unwrap();
        let call = Call::Control(observation());
        [script.call(&call), script.call(&call)].map(|answer| answer.unwrap().operations)
    };
    let counted = operations(true);
    assert_eq!(counted, operations(false));
    assert!(counted[0] > 5000, "{counted:?}");
}

/// What an operator takes is in the budget: the loop ends where it ends without charges.
#[test]
fn a_budget_runs_out_in_the_same_operator() {
    let source =
        "fn control(o) {\n let x = 0.5;\n while x < 1 {\n x = (x * 0.5\n + 0.1) / 2;\n }\n x\n}";
    let stop = |has_charges: bool| {
        let mut script = open(source, has_charges).unwrap();
        script.call(&Call::Control(observation())).unwrap_err()
    };
    let Stop::OverBudget { place, .. } = stop(true) else {
        panic!("within the budget");
    };
    assert!(place.is_some());
    assert_eq!(stop(true), stop(false));
}
