//! Scripts that use up what there is, by accident or on purpose.

use super::{answer, observation, opening, run, stop};
use crate::submission::controller::{Budget, Call, Controller, Stop};
use crate::submission::rhai::{STACK_BYTES, ScriptController};

#[test]
fn a_mistake_can_be_caught_and_a_budget_cannot() {
    assert_eq!(
        answer("try { sin(\"a\") } catch (e) { print(e); } 3")
            .said
            .log,
        ["`sin` takes a number or a vector, got the string \"a\""]
    );
    assert!(matches!(
        stop("fn control(o) { try { loop {} } catch {} 1 }"),
        Stop::OverBudget {
            budget: Budget::OperationsPerCall,
            ..
        }
    ));
}

#[test]
fn a_task_has_a_budget_of_operations_too() {
    let mut opening = opening("fn control(o) { for i in 0..100 { } 1 }");
    opening.budgets.operations_per_task = 1_000;
    let mut script = ScriptController::open(&opening).unwrap();
    let stop = (0..100).find_map(|_| script.call(&Call::Control(observation())).err());
    assert!(matches!(
        stop,
        Some(Stop::OverBudget {
            budget: Budget::OperationsPerTask,
            limit: 1_000,
            ..
        })
    ));
}

#[test]
fn hostile_scripts_end_at_a_budget() {
    use Budget::{
        CallDepth, ExpressionDepth, ListSize, MapSize, OperationsPerCall, SourceBytes, TextSize,
    };
    let list = |item: &str| vec![item; 990].join(",");
    let control = |body: &str| format!("fn control(o) {{ {body} }}");
    let double_text = "let s = \"a\"; for i in 0..11 { s += s; }";
    let cases = [
        (control("loop {}"), OperationsPerCall),
        (control("while true { let x = o.q[0]; }"), OperationsPerCall),
        (
            control("for i in 0..9223372036854775807 { }"),
            OperationsPerCall,
        ),
        ("loop {}".to_owned(), OperationsPerCall),
        (control("control(o)"), CallDepth),
        (control("loop { try { control(o) } catch { } }"), CallDepth),
        (
            control("let a = [1]; loop { a.push([]) }"),
            OperationsPerCall,
        ),
        (control("let a = [1]; loop { a = concat(a, a); }"), ListSize),
        (control("let a = []; loop { a = [a]; }"), OperationsPerCall),
        (
            control("this.a = []; loop { this.a = [this.a]; }"),
            ListSize,
        ),
        (
            control("this.a = 1; loop { this.a = #{a: this.a}; }"),
            MapSize,
        ),
        (control("loop { this.a = this; }"), MapSize),
        (control("let s = \"a\"; loop { s += s; }"), TextSize),
        (control("let s = \"a\"; loop { s = `${s}${s}`; }"), TextSize),
        (
            control("let v = zeros(990); loop { v = concat(v, v); }"),
            ListSize,
        ),
        (control("zeros(100000)"), ListSize),
        (
            control("zeros(9000000000000000, 9000000000000000)"),
            ListSize,
        ),
        (control("eye(3000000000)"), ListSize),
        (control("loop { print(1) }"), OperationsPerCall),
        (
            control("loop { plot(\"a\", zeros(100)) }"),
            OperationsPerCall,
        ),
        (
            control(&format!("{double_text} loop {{ print(s) }}")),
            OperationsPerCall,
        ),
        (
            control(&format!("{double_text} loop {{ s[2000] = 'b'; }}")),
            OperationsPerCall,
        ),
        (
            control(&format!("{double_text} loop {{ \"aab\" in s }}")),
            OperationsPerCall,
        ),
        (
            control("let m = eye(30); loop { m = m * m; }"),
            OperationsPerCall,
        ),
        (
            control("let m = eye(30); loop { inverse(m); }"),
            OperationsPerCall,
        ),
        (
            control("let m = eye(30); loop { det(m); }"),
            OperationsPerCall,
        ),
        (
            control(&format!("let a = [{}]; loop {{ a == a }}", list("0"))),
            OperationsPerCall,
        ),
        (
            control(&format!("let a = [{}]; loop {{ sort(a) }}", list("0"))),
            OperationsPerCall,
        ),
        (
            control(&format!("this.a = [{}]; loop {{ this.a }}", list("0..1"))),
            OperationsPerCall,
        ),
        (
            control(&format!("let v = zeros(990); [{}]", list("v"))),
            ListSize,
        ),
        (
            control(&format!("let v = zeros(990); print([{}])", list("v"))),
            TextSize,
        ),
        (
            control("this.a = []; for i in 0..50 { this.a.push(zeros(990)); }"),
            ListSize,
        ),
        (
            control(&format!("{}1", "1+".repeat(30_000))),
            ExpressionDepth,
        ),
        (
            control(&format!("o{}", ".a".repeat(30_000))),
            ExpressionDepth,
        ),
        (
            control(&format!("o{}", "[0]".repeat(20_000))),
            ExpressionDepth,
        ),
        (control(&"(".repeat(30_000)), ExpressionDepth),
        (control(&"[".repeat(30_000)), ExpressionDepth),
        (control(&"{".repeat(30_000)), ExpressionDepth),
        (control(&"!".repeat(60_000)), ExpressionDepth),
        (control(&"f(".repeat(20_000)), ExpressionDepth),
        (control(&"if o {} else ".repeat(4_500)), ExpressionDepth),
        (
            control(&format!("{}true", "true&&".repeat(9_000))),
            ExpressionDepth,
        ),
        (control(&"`${".repeat(8_000)), ExpressionDepth),
        (control(&format!("\"{}\"", "a".repeat(60_000))), TextSize),
        (" ".repeat(65_537), SourceBytes),
    ];
    let run_all = move || {
        for (source, wanted) in cases {
            let start: String = source.chars().take(60).collect();
            match stop(&source) {
                Stop::OverBudget {
                    budget,
                    limit,
                    place,
                    ..
                } => {
                    assert_eq!(budget, wanted, "{start}");
                    assert!(limit > 0);
                    assert_eq!(place.is_none(), budget == SourceBytes, "{start}: no place");
                }
                other => panic!("{start}: {other:?}"),
            }
        }
    };
    on_a_large_stack(run_all);
}

#[test]
fn a_long_name_is_refused() {
    let name = "n".repeat(201);
    for source in [
        format!("fn control(o) {{ {name} }}"),
        format!("fn control(o) {{ let {name} = 1; 1 }}"),
        format!("fn control(o) {{ o.{name} }}"),
        format!("fn control(o) {{ {name}() }}"),
        format!("fn control(o) {{ #{{ {name}: 1 }} }}"),
        format!("fn control(o) {{ for {name} in 0..1 {{ }} }}"),
        format!("fn control({name}) {{ 1 }}"),
        format!("fn {name}() {{ 1 }}"),
    ] {
        let Stop::DidNotBuild(mistake) = stop(&source) else {
            panic!("{source:.60} builds");
        };
        assert_eq!(mistake.message, "a name has 201 characters", "{source:.60}");
        assert!(mistake.place.is_some(), "{source:.60}");
    }
    let name = "n".repeat(200);
    assert!(run(&format!("fn control(o) {{ let {name} = 1; {name} }}")).is_ok());
}

#[test]
fn what_is_shown_beyond_the_most_is_left_out_and_said_once() {
    let mut opening = opening("fn control(o) { for i in 0..9 { print(i); plot(\"a\", i); } 1 }");
    (opening.budgets.log_lines, opening.budgets.plot_samples) = (4, 3);
    let mut script = ScriptController::open(&opening).unwrap();
    for call in 0..2 {
        let answer = script.call(&Call::Control(observation())).unwrap();
        let said = answer.said;
        if call == 1 {
            assert!(said.log.is_empty() && said.plots.is_empty(), "{said:?}");
            continue;
        }
        let log = said.log.join("\n");
        let expected = "0\n1\n2\n3\nmore than 3 values are plotted: the rest is not kept\nmore than 4 lines are printed: the rest is not kept";
        assert_eq!(log, expected);
        assert_eq!(said.plots.len(), 3);
    }
}

#[test]
fn large_but_flat_sources_are_read() {
    let flat = |item: &dyn Fn(usize) -> String, count| (0..count).map(item).collect::<String>();
    for source in [
        format!(
            "fn control(o) {{ {} }}",
            flat(&|i| format!("let a{i}=1;"), 5_500)
        ),
        format!(
            "fn control(o) {{ switch 1 {{ {} }} }}",
            flat(&|i| format!("{i}=>1,"), 7_000)
        ),
        format!(
            "fn control(o) {{ 1 }} {}",
            flat(&|i| format!("fn f{i}(){{}}\n"), 4_000)
        ),
    ] {
        assert!(run(&source).is_ok(), "{source:.60}");
    }
}

#[test]
fn the_deepest_expressions_in_the_deepest_calls_fit_the_stack() {
    let run_all = || {
        let nestings = [
            ("(1+", ")"),
            ("if true {", "}"),
            ("[", "]"),
            ("sin(", ")"),
            ("#{a:", "}"),
            ("!", ""),
            ("1+", ""),
            ("x[", "]"),
            ("switch x { 1 => ", "}"),
            ("loop { ", "}"),
            ("try { ", "} catch {}"),
            ("`${", "}`"),
            ("for i in [1] {", "}"),
        ];
        for (before, after) in nestings {
            let deepest = (1..64).rev().find_map(|depth| {
                let (before, after) = (before.repeat(depth), after.repeat(depth));
                let source = format!("fn f(x) {{ {before}f(x){after} }} fn control(o) {{ f(1) }}");
                ScriptController::open(&opening(&source)).ok()
            });
            let result = deepest
                .expect("one level is not too deep")
                .call(&Call::Control(observation()));
            assert!(
                matches!(
                    result,
                    Err(Stop::OverBudget {
                        budget: Budget::CallDepth,
                        ..
                    })
                ),
                "{before}: {result:?}"
            );
        }
    };
    on_a_large_stack(run_all);
}

fn on_a_large_stack(work: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new()
        .stack_size(STACK_BYTES)
        .spawn(work)
        .expect("a thread")
        .join()
        .expect("no panic");
}
