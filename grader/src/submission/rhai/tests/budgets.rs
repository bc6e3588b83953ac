//! Scripts that use up what there is, by accident or on purpose.

use super::{answer, observation, opening, run, stop, value};
use crate::submission::controller::{Budget, Call, Controller, Stop};
use crate::submission::rhai::{STACK_BYTES, ScriptController};

#[test]
fn a_mistake_can_be_caught_and_a_budget_cannot() {
    assert_eq!(
        answer("try { sin(\"a\") } catch (e) { print(e); } 3")
            .said
            .texts(),
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
            OperationsPerCall,
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

/// Functions that statements below call.
const FUNCTIONS: &str = "fn give(x) { 1 } fn give(x, y) { 1 } fn same(x) { x } fn whole() { this } fn returned() { return this; }
    fn kept() { 1 } const A = [1.5, 2.5];";

/// The operations that statements take in a body of `control`.
fn operations(statements: &str) -> u64 {
    let source = format!("{FUNCTIONS} fn control(o) {{ {statements}; 1 }}");
    match run(&source) {
        Ok(answer) => answer.operations,
        Err(stop) => panic!("{statements:.300}: {stop:?}"),
    }
}

/// The operations that a statement takes after others.
fn cost(before: &str, statement: &str) -> u64 {
    operations(&format!("{before} {statement}")) - operations(before)
}

/// A list of 100 small maps and 100 small lists: a copy of it costs as much as one of 1172 numbers.
fn nested() -> String {
    format!(
        "[{},{}]",
        vec!["#{a:1}"; 100].join(","),
        vec!["[1]"; 100].join(",")
    )
}

const OF_NESTED: u64 = (200 + 200 + 4 * (201 - 8)) / 8;

#[test]
fn what_is_copied_out_of_this_is_charged_by_its_size() {
    let nested = nested();
    let before = format!("this.a = {nested}; let k = \"a\";");
    for statement in [
        "this.a",
        "this[\"a\"]",
        "this[k]",
        "this?.a",
        "this",
        "let b = this",
        "let b = this.a",
        "give(this.a)",
        "give(1, this.a)",
        "give(this)",
        "give(1, this)",
        "same(this.a)",
        "this.give(this.a)",
        "this.whole()",
        "this.a.returned()",
        "[this.a]",
        "#{ b: this.a }",
        "{ this.a }",
        "if true { this.a }",
        "let b = if true { this.a } else { 1 }",
        "loop { break this.a; }",
        "for x in this.a { break; }",
        "switch this.a { 1 => 2 }",
        "switch 1 { 1 => this.a }",
        "this.a ?? 1",
        "this.a == 1",
        "1 == this.a",
        "this == this.a",
        "values(this)",
        "get(this, k, 0)",
        "this.get(k, 0)",
        "try { throw this.a } catch { }",
        "try { throw this.a } catch (e) { }",
        "try { -this.a } catch { }",
        "try { 1 + this } catch { }",
        "try { rows(this.a) } catch { }",
        "try { plot(k, this.a) } catch { }",
        "try { nosuch(this.a) } catch { }",
        "try { `${this.a}` } catch { }",
        "try { while this.a { } } catch { }",
        "try { [1][this.a] } catch { }",
    ] {
        let cost = cost(&before, statement);
        assert!(cost >= OF_NESTED, "{statement}: {cost} of {OF_NESTED}");
    }
    // inside of maps and lists of `this`
    for (kept, used) in [
        ("#{ b: @ }", "this.a.b"),
        ("#{ b: @ }", "this[k].b"),
        ("#{ b: @ }", "this.a[\"b\"]"),
        ("#{ b: #{ c: @ } }", "this.a.b.c"),
        ("[#{ b: @ }]", "this.a[0].b"),
        ("#{ b: [@] }", "this.a.b[0]"),
        ("[[@]]", "this.a[0][0]"),
        ("[[@]]", "this.a[this.i][this.i]"),
    ] {
        let value = kept.replace('@', &nested);
        let before = format!("this.i = 0; this.a = {value}; let k = \"a\";");
        for statement in ["@", "let x = @", "give(@)", "give(1, @)", "[@]", "@ == 1"] {
            let statement = statement.replace('@', used);
            let cost = cost(&before, &statement);
            assert!(cost >= OF_NESTED, "{statement}: {cost} of {OF_NESTED}");
        }
    }
}

#[test]
fn looking_through_what_this_holds_is_charged_where_nothing_is_copied() {
    let before = format!("this.a = {}; this.m = #{{}}; let k = \"a\";", nested());
    for statement in [
        "this.i = 1",
        "this.m.i = 1",
        "len(this)",
        "this.a.len()",
        "is_empty(this)",
        "k in this",
        "this.get(k + 1, 0)",
        "this.a.pop()",
    ] {
        let cost = cost(&before, statement);
        assert!((400 / 16..OF_NESTED).contains(&cost), "{statement}: {cost}");
    }
}

#[test]
fn small_things_in_this_cost_as_much_as_in_a_variable() {
    let before = |owner: &str| {
        format!(
            "let t = #{{}}; {owner}.i = 1; {owner}.v = zeros(2); {owner}.m = #{{ a: 1 }}; {owner}.list = [1];"
        )
    };
    for statement in [
        "@.i + 1",
        "@.i += 1",
        "@.i = 2",
        "@[\"i\"] += 1",
        "@.v[0]",
        "@.v[0] = 2.5",
        "@.v[@.i]",
        "@.m.a",
        "@.m.a += @.i",
        "@.list[0]",
        "@.list[0] = 3",
        "@.list.push(2)",
        "@.list[@.i - 1]",
        "sin(@.i)",
        "norm(@.v) + @.v.x",
        "if @.i > 0 { @.i = 0; }",
        "[@.i, @.m.a]",
        "give(@.i, @.list)",
        "@.fresh = [@.i]",
        "let v = @.v + @.i * @.v",
        "for x in @.list { @.i += x; }",
    ] {
        let of = |owner: &str| {
            let statement = statement.replace('@', owner);
            operations(&format!("{} {statement}", before(owner)))
        };
        assert_eq!(of("this"), of("t"), "{statement}");
    }
}

#[test]
fn what_the_engine_does_in_one_operation_is_charged() {
    let many = |item: &dyn Fn(usize) -> String| (0..2_000).map(item).collect::<String>();
    let list = format!("[{}]", vec!["1"; 900].join(","));
    let text = format!("\"{}\"", "ab".repeat(2_000));
    let vector = "let v = 1.5 * ones(900);";
    let lets = many(&|i| format!("let a{i}=1;"));
    for (before, statement, least) in [
        // a list of constants as an argument or as an index
        ("", format!("give({list})"), 900),
        ("", format!("len({list})"), 900),
        (
            "let x = [1];",
            format!("try {{ x[{list}] }} catch {{ }}"),
            900,
        ),
        // every element takes as long as an operation
        (vector, "v ** 1.37".to_owned(), 900),
        (vector, "v % 3e-300".to_owned(), 900),
        // arms that are tried one after the other
        (
            "",
            format!(
                "switch 1 {{ {} }}",
                many(&|i| format!("{}..{}=>0,", i + 10, i + 12))
            ),
            100,
        ),
        (
            "",
            format!("switch 1 {{ {} }}", many(&|_| "1 if false=>0,".to_owned())),
            100,
        ),
        // far away in the list of variables, and by name
        (lets.as_str(), "a0".to_owned(), 50),
        (lets.as_str(), "try { nosuch } catch { }".to_owned(), 100),
        // by all combinations of types
        (
            "",
            "try { nosuch(1,2,3,4,5,6,7,8,9,0,1,2,3) } catch { }".to_owned(),
            3_000,
        ),
        (
            "let x = 1;",
            "try { x.nosuch(2,3,4,5,6,7,8,9,0,1,2,3) } catch { }".to_owned(),
            3_000,
        ),
        // mistakes that are caught
        ("", "try { nosuch } catch { }".to_owned(), 8),
        ("", "try { throw 1 } catch (e) { }".to_owned(), 8),
        // what is thrown is copied for the variable
        (
            format!("let a = {list};").as_str(),
            "try { throw a } catch (e) { }".to_owned(),
            2 * 900 / 8,
        ),
    ] {
        let cost = cost(before, &statement);
        assert!(cost >= least, "{statement:.60}: {cost} of {least}");
    }
    // only as many characters as the loop comes to
    assert!(cost("", &format!("for c in {text} {{ break; }}")) < 10);
    assert_eq!(
        value("let s = \"\"; for c in \"aäb\" { s = c + s; } s"),
        value("\"bäa\"")
    );
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
        let log = said.texts().join("\n");
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
            ("this[", "]"),
            ("[this, ", "]"),
            ("switch x { 1 => ", "}"),
            ("loop { ", "}"),
            ("try { ", "} catch {}"),
            ("`${", "}`"),
            ("for i in [1] {", "}"),
        ];
        for (before, after) in nestings {
            // a function has `this` if it is called as a method of it
            let call = if before.contains("this") {
                "this.f"
            } else {
                "f"
            };
            let deepest = (1..64).rev().find_map(|depth| {
                let (before, after) = (before.repeat(depth), after.repeat(depth));
                let source =
                    format!("fn f(x) {{ {before}{call}(x){after} }} fn control(o) {{ {call}(1) }}");
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
