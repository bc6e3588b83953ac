//! Statements, each of which may be slow for an operation: what an interpreter copies, compares, formats and looks up.

/// A statement to repeat, and what comes before the loop.
pub(crate) struct Statement {
    pub(crate) functions: String,
    pub(crate) before: String,
    pub(crate) repeated: String,
}

fn statement(before: impl Into<String>, repeated: impl Into<String>) -> Statement {
    Statement {
        functions: String::new(),
        before: before.into(),
        repeated: repeated.into(),
    }
}

impl Statement {
    fn with(self, functions: impl Into<String>) -> Self {
        Self {
            functions: functions.into(),
            ..self
        }
    }

    /// It in one line.
    pub(crate) fn name(&self) -> String {
        let shown = |text: &str, most: usize| {
            let mut shown: String = text.chars().take(most).collect();
            if shown.len() < text.len() {
                shown.push_str("...");
            }
            shown
        };
        format!(
            "{}{}{}",
            shown(&self.functions, 40),
            if self.before.is_empty() {
                String::new()
            } else {
                format!("[{}] ", shown(&self.before, 40))
            },
            shown(&self.repeated, 60)
        )
    }
}

fn list(item: &str, count: usize) -> String {
    format!("[{}]", vec![item; count].join(","))
}

/// A list of small maps and lists, as many as a script may keep: the value that takes longest to copy.
fn nested() -> String {
    let maps = vec!["#{a:1}"; 250].join(",");
    let lists = vec!["[1]"; 370].join(",");
    format!("[{maps},{lists}]")
}

/// A map of `count` entries whose keys have `length` characters.
fn map(count: usize, length: usize) -> String {
    let entry = |i: usize| format!("k{i:0>length$}: {i}", length = length - 1);
    let entries: Vec<String> = (0..count).map(entry).collect();
    format!("#{{{}}}", entries.join(", "))
}

/// A string of `length` characters, quoted.
fn text(length: usize) -> String {
    format!("\"{}\"", "ab".repeat(length / 2))
}

/// All of them, the baseline first.
// long: a list
pub(crate) fn statements() -> Vec<Statement> {
    let at_this = |value: &str| format!("this.a = {value};");
    let local = |value: &str| format!("let a = {value};");
    let nested_this = || at_this(&nested());
    let floats_this = || at_this(&list("1.5", 990));
    let keys = |length| {
        format!(
            "let s = \"{}\"; for i in 0..250 {{ this[s + i] = i; }}",
            "k".repeat(length)
        )
    };
    let many = |count: usize| {
        (0..count)
            .map(|i| format!("let v{i}=1;"))
            .collect::<String>()
    };
    let mut all = vec![
        // numbers
        statement("let a = 1.5;", "a + 1.0"),
        statement("let a = 1.5;", "a * a - a / 2.0"),
        statement("let a = 3;", "a + 1"),
        statement("let a = 3;", "a / 2"),
        statement("let a = 1.5;", "a ** 2"),
        statement("let a = 1.5;", "a ** 1.37"),
        statement("let a = 1e300;", "a ** 1.0000001"),
        statement("let a = -1.5;", "a ** 0.5"),
        statement("let a = 3;", "a ** 40"),
        statement("let a = 1;", "a ** 4000000000"),
        statement("let a = 7;", "a ** -3"),
        statement("let a = 7.5;", "a % 2.0"),
        statement("let a = 1e300;", "a % 3e-300"),
        statement("let a = 1e300;", "a % 3.0"),
        statement("let a = 9e15;", "a %= 3e-300; a = 9e15"),
        statement("let a = 7;", "a % 3"),
        statement("let a = 1.5;", "a < 2.0 && a > 1.0 || a == 1.5"),
        statement("let a = true;", "!a"),
        statement("let a = 1.5;", "-a"),
        statement("let a = 1.5;", "a += 1.0"),
        statement("let a = 1.5;", "a = a"),
        statement("", "let a = 1.5"),
        statement("", "1.5"),
        statement("", "if true { 1 } else { 2 }"),
        statement("", "{ { { 1 } } }"),
        statement("", "for i in 0..1000 { }"),
        statement("", "for i in 0..1000 { i }"),
        statement("", "for i in range(1000) { i }"),
        statement("", "for i in 0..0 { }"),
        statement("", "while false { }"),
        statement("", "do { } while false"),
        statement("let a = ();", "a ?? 1"),
        // functions of numbers
        statement("let a = 1.5;", "sin(a)"),
        statement("let a = 1e300;", "sin(a)"),
        statement("let a = 1e300;", "cos(a)"),
        statement("let a = 1e300;", "tan(a)"),
        statement("let a = 0.5;", "asin(a)"),
        statement("let a = 0.5;", "acos(a)"),
        statement("let a = 0.5;", "atan(a)"),
        statement("let a = 0.5;", "atan2(a, 1.0)"),
        statement("let a = 0.5;", "sinh(a)"),
        statement("let a = 20.5;", "cosh(a)"),
        statement("let a = 0.5;", "tanh(a)"),
        statement("let a = 0.5;", "exp(a)"),
        statement("let a = 0.5;", "ln(a)"),
        statement("let a = 0.5;", "log10(a)"),
        statement("let a = 0.5;", "log2(a)"),
        statement("let a = 0.5;", "sqrt(a)"),
        statement("let a = -0.5;", "sqrt(a)"),
        statement("let a = 0.5;", "hypot(a, 1.5)"),
        statement("let a = 0.5;", "pow(a, 1.37)"),
        statement("let a = 1e300;", "wrap_pi(a)"),
        statement("let a = 0.5;", "round(a, 7)"),
        statement("let a = 0.5;", "quintic(a)"),
        statement("let a = 0.5;", "clamp(a, 0, 1)"),
        statement("let a = 0.5;", "lerp(a, 1, 0.5)"),
        statement("let a = 0.5;", "max(a, 1.0, 2)"),
        statement("let a = 0.5;", "min(a, 3)"),
        statement("let a = 0.5;", "is_nan(a)"),
        // vectors and matrices
        statement("let v = zeros(990);", "v + v"),
        statement("let v = zeros(990);", "v * 2.0"),
        statement("let v = ones(990);", "v ** 1.37"),
        statement("let v = 1e300 * ones(990);", "v % 3e-300"),
        statement("let v = 1e300 * ones(990);", "wrap_pi(v)"),
        statement("let v = 1e300 * ones(990);", "sin(v)"),
        statement("let v = ones(990);", "pow(v, 1.37)"),
        statement("let v = ones(990);", "norm(v)"),
        statement("let v = ones(990);", "sum(v)"),
        statement("let v = ones(990);", "dot(v, v)"),
        statement("let v = ones(990);", "max(v)"),
        statement("let v = ones(990);", "-v"),
        statement("let v = ones(990);", "v[3]"),
        statement("let v = ones(990);", "v[0..900]"),
        statement(
            "let v = ones(990); let i = 0.0;",
            "let w = v; v[0] = i; i += 1.0",
        ),
        statement("let v = ones(990);", "for x in v { break; }"),
        statement("let v = ones(990);", "v == v"),
        statement("let v = ones(990);", "reverse(v)"),
        statement("let v = ones(990);", "sort(v)"),
        statement("let v = ones(990);", "slice(v, 0, 900)"),
        statement("let v = ones(990);", "concat(v, [])"),
        statement("let v = ones(900);", "v.push(1.0); v = ones(900)"),
        statement("let v = ones(2);", "v + v"),
        statement("let v = ones(2);", "v.x + v.y"),
        statement("", "zeros(990)"),
        statement("", "eye(31)"),
        statement("", "zeros(990, 1)"),
        statement("", "zeros(0, 990)"),
        statement("", "linspace(0, 1, 990)"),
        statement("let v = ones(31);", "diag(v)"),
        statement("let m = eye(31);", "m * m"),
        statement("let m = eye(31); let v = ones(31);", "m * v"),
        statement("let m = eye(31);", "m + m"),
        statement("let m = eye(31);", "det(m)"),
        statement("let m = eye(31);", "inverse(m)"),
        statement("let m = eye(31);", "solve(m, m)"),
        statement("let m = eye(3);", "inverse(m)"),
        statement("let m = eye(2);", "det(m)"),
        statement("let m = eye(31);", "transpose(m)"),
        statement("let m = eye(31);", "m.T"),
        statement("let m = eye(31);", "m[0][0]"),
        statement("let m = zeros(1, 990);", "m[0][0]"),
        statement("let m = zeros(1, 990); let i = 0.0;", "m[0][0] = i; i += 1"),
        statement("let m = zeros(1, 990);", "for r in m { break; }"),
        statement("let m = zeros(990, 1);", "col(m, 0)"),
        statement("let m = zeros(1, 990);", "row(m, 0)"),
        statement("let m = eye(31);", "rows(m)"),
        statement("let m = eye(31);", "abs(m)"),
        statement(local(&list("1.5", 990)), "try { rows(a) } catch { }"),
        statement(local(&list("[1,2]", 330)), "rows(a)"),
        statement(local(&list("[1,2]", 330)), "a * 2"),
        statement(local(&list("[1,2]", 330)), "try { a + 1 } catch { }"),
        // literals and what they are passed to
        statement("", list("1", 990)),
        statement("", format!("len({})", list("1", 990))),
        statement("", format!("len({})", list("[1]", 330))),
        statement("", format!("f({})", list("1", 990))).with("fn f(x) { 1 }"),
        statement("", format!("f({})", nested())).with("fn f(x) { 1 }"),
        statement(
            "let x = [1];",
            format!("try {{ x[{}] }} catch {{ }}", list("1", 990)),
        ),
        statement("", format!("{}[0]", list("1", 990))),
        statement("", format!("f({})", map(250, 8))).with("fn f(x) { 1 }"),
        statement("", format!("for x in {} {{ break; }}", list("1", 990))),
        statement("", map(250, 8)),
        statement("", map(100, 190)),
        statement("", format!("for c in {} {{ break; }}", text(4000))),
        statement("", format!("{}[3990]", text(4000))),
        statement("", format!("len({})", text(4000))),
        statement("", format!("{} < {}", text(4000), text(4000))),
        statement("", format!("{} == {}", text(4000), text(4000))),
        statement("", format!("\"b\" in {}", text(4000))),
        statement("", format!("{} + 1", text(3900))),
        statement("", format!("`{}${{1}}`", "ab".repeat(1900))),
        statement("", format!("let a = {}", text(4000))),
        statement("", format!("switch {} {{ 1 => 2 }}", text(4000))),
        statement("", format!("to_string({})", text(4000))),
        statement("", format!("try {{ sin({}) }} catch {{ }}", text(4000))),
        statement(
            "",
            format!("try {{ throw {} }} catch (e) {{ }}", text(4000)),
        ),
        statement(local(&text(4000)), "for c in a { break; }"),
        statement(local(&text(4000)), "for c in a { }"),
        statement(local(&text(4000)), "a[3990]"),
        statement(local(&text(4000)), "a == a"),
        statement(local(&text(3900)), "`${a}x`"),
        statement(local(&text(4000)), "try { a[3990] = \"c\" } catch { }"),
        statement(local(&text(30)), "a + 1"),
        statement("", "`${1.1}${2.2}${3.3}`"),
        statement("", "`${0.1 + 0.2}`"),
        statement("", "to_string(1e-300)"),
        // lists and maps
        statement(local(&list("1.5", 990)), "a[3]"),
        statement(local(&list("1.5", 990)), "a"),
        statement(local(&list("1.5", 990)), "len(a)"),
        statement(local(&list("1.5", 990)), "let b = a"),
        statement(local(&list("1.5", 990)), "a[3] = 1"),
        statement(local(&list("1.5", 990)), "a == a"),
        statement(local(&list("1.5", 990)), "sum(a)"),
        statement(local(&list("1.5", 990)), "a + a"),
        statement(local(&list("1.5", 990)), "sort(a)"),
        statement(local(&list("1.5", 990)), "reverse(a)"),
        statement(local(&list("1.5", 990)), "2 in a"),
        statement(local(&list("1.5", 700)), "print(a)"),
        statement(local(&list("1.5", 990)), "switch a { 1 => 2 }"),
        statement(local(&list("1.5", 990)), "for x in a { break; }"),
        statement(local(&list("1.5", 900)), "a.push(1); a.pop()"),
        statement(local(&list("1.5", 900)), "a.insert(0, 1); a.remove(0)"),
        statement(local(&nested()), "a"),
        statement(local(&nested()), "len(a)"),
        statement(local(&nested()), "let b = a"),
        statement(local(&nested()), "reverse(a)"),
        statement(local(&nested()), "a == a"),
        statement(local(&nested()), "throw_it(a)")
            .with("fn throw_it(x) { try { throw x } catch (e) { } }"),
        statement(local(&nested()), "try { sin(a) } catch { }"),
        statement(local(&nested()), "try { nosuch(a) } catch { }"),
        statement(local(&nested()), "f(a)").with("fn f(x) { 1 }"),
        statement(format!("let a = #{{ b: {} }};", nested()), "a.b"),
        statement(format!("let a = #{{ b: {} }};", nested()), "values(a)"),
        statement(
            format!("let a = #{{ b: {} }};", nested()),
            "get(a, \"b\", 0)",
        ),
        statement(local(&map(250, 8)), "a.k0000003"),
        statement(local(&map(250, 8)), "a.k0000003 = 1"),
        statement(local(&map(250, 8)), "keys(a)"),
        statement(local(&map(250, 8)), "values(a)"),
        statement(local(&map(250, 8)), "a"),
        statement(local(&map(100, 190)), "a"),
        statement(local(&map(20, 190)), "keys(a)"),
        statement("let a = #{ b: 1 };", "a.b"),
        statement("let a = #{ b: #{ c: 1 } };", "a.b.c"),
        statement("let a = #{ b: #{ c: 1 } };", "a.b.c = 2"),
        statement("", "#{ a: 1, b: 2 }"),
        statement("", "[1, 2]"),
        statement("", "[[[[[[[[[[1]]]]]]]]]]"),
        // constants
        statement("", "A").with(format!("const A = {};", nested())),
        statement("", "A[3]").with(format!("const A = {};", list("1.5", 990))),
        statement("", "f(A)").with(format!("const A = {}; fn f(x) {{ 1 }}", nested())),
        statement("", "sum(A)").with(format!("const A = {};", list("1.5", 990))),
        statement("", "A").with("const A = 1.5;"),
        statement("", "[A, A]").with(format!("const A = {};", list("1.5", 490))),
        // `this`
        statement("this.i = 0;", "this.i += 1"),
        statement("this.i = 0;", "this.i"),
        statement("this.i = 0;", "this.i = 1"),
        statement("this.i = 0;", "this.i + 1"),
        statement("this.m = #{ i: 0 };", "this.m.i += 1"),
        statement("", "this.nosuch = 1"),
        statement(nested_this(), "this"),
        statement(nested_this(), "this.a"),
        statement(nested_this(), "this[\"a\"]"),
        statement(nested_this() + "let k = \"a\";", "this[k]"),
        statement(nested_this(), "let b = this"),
        statement(nested_this(), "let b = this.a"),
        statement(nested_this(), "this.a;"),
        statement(nested_this(), "f(this.a)").with("fn f(x) { 1 }"),
        statement(nested_this(), "f(this)").with("fn f(x) { 1 }"),
        statement(nested_this(), "f(1, this)").with("fn f(x, y) { 1 }"),
        statement(nested_this(), "this.f()").with("fn f() { this }"),
        statement(nested_this(), "this.f(1)").with("fn f(x) { 1 }"),
        statement(nested_this(), "this.f(this.a)").with("fn f(x) { 1 }"),
        statement(nested_this(), "this.a.f()").with("fn f() { 1 }"),
        statement(nested_this(), "this.a.f()").with("fn f() { return this; }"),
        statement(nested_this(), "try { throw this.a } catch { }"),
        statement(nested_this(), "try { throw this } catch (e) { }"),
        statement(nested_this(), "try { plot(\"a\", this.a) } catch { }"),
        statement(nested_this(), "try { rows(this.a) } catch { }"),
        statement(nested_this(), "try { nosuch(this.a) } catch { }"),
        statement(nested_this(), "try { this.nosuch } catch { }"),
        statement(nested_this(), "try { this + 1 } catch { }"),
        statement(nested_this(), "try { 1 + this } catch { }"),
        statement(nested_this(), "try { -this.a } catch { }"),
        statement(nested_this(), "this == this.a"),
        statement(nested_this(), "this.a == 1"),
        statement(nested_this(), "1 == this.a"),
        statement(nested_this(), "this.a == this.a"),
        statement(nested_this(), "this.i = 1"),
        statement(nested_this() + "this.i = 0;", "this.i += 1"),
        statement(nested_this() + "this.i = 0;", "this.i"),
        statement(nested_this() + "this.i = [0];", "this.i[0] = 1"),
        statement(nested_this(), "this.a[0]"),
        statement(nested_this(), "this.a[0].a = 1"),
        statement(nested_this(), "this.a[600] = [1]"),
        statement(nested_this(), "this.a.len()"),
        statement(nested_this(), "len(this.a)"),
        statement(nested_this(), "this.len()"),
        statement(nested_this(), "len(this)"),
        statement(nested_this(), "is_empty(this)"),
        statement(nested_this(), "\"a\" in this"),
        statement(nested_this(), "keys(this)"),
        statement(nested_this(), "values(this)"),
        statement(nested_this(), "get(this, \"a\", 0)"),
        statement(nested_this(), "this.get(\"a\", 0)"),
        statement(nested_this(), "this.get(\"b\", 0)"),
        statement(nested_this(), "for x in this.a { break; }"),
        statement(nested_this(), "switch this.a { 1 => 2 }"),
        statement(nested_this(), "[this.a]"),
        statement(nested_this(), "#{ b: this.a }"),
        statement(nested_this(), "this.a ?? 1"),
        statement(nested_this(), "this?.a"),
        statement(nested_this(), "{ this.a }"),
        statement(nested_this(), "if true { this.a }"),
        statement(nested_this(), "loop { break this.a; }"),
        statement(nested_this(), "f()").with("fn f() { 1 }"),
        statement(nested_this(), "let b = if true { this.a } else { 1 }"),
        statement(nested_this(), "`${this.a[0]}`"),
        statement(nested_this(), "(this.a)[0]"),
        statement(nested_this(), "this.a[this.a.len() - 1]"),
        statement(
            format!("this.a = [{}];", nested().replace("[1]", "1")),
            "this.a[0]",
        ),
        statement(format!("this.m = #{{ a: {} }};", nested()), "this.m.a"),
        statement(format!("this.m = #{{ a: {} }};", nested()), "this.m[\"a\"]"),
        statement(format!("this.m = #{{ a: {} }};", nested()), "this.m.i = 1"),
        statement(format!("this.l = [{}];", nested()), "this.l[0]"),
        statement(format!("this.l = [{}];", nested()), "this.l[0][3]"),
        statement(floats_this(), "this.a"),
        statement(floats_this(), "this.a[3]"),
        statement(floats_this(), "this.a[3] = 1"),
        statement(floats_this(), "this.a[3] += 1"),
        statement(floats_this(), "this.i = 1"),
        statement(floats_this(), "sum(this.a)"),
        statement(floats_this(), "this.a.len()"),
        statement(floats_this(), "this.a.push(1); this.a.pop()"),
        statement(at_this("zeros(990)"), "this.a"),
        statement(at_this("zeros(990)"), "this.a[3]"),
        statement(at_this("zeros(990)"), "this.a[3] = 1.5; this.a[3] = 2.5"),
        statement(at_this(&list("zeros(1)", 490)), "this.a"),
        statement(at_this(&text(3900)), "this.a"),
        statement(at_this(&text(3900)), "this.a[3800]"),
        statement(at_this(&text(3900)), "this.a.len()"),
        statement(at_this(&text(3900)), "for c in this.a { break; }"),
        statement(keys(8), "this.i = 1"),
        statement(keys(8), "this"),
        statement(keys(1_000), "this"),
        statement(keys(1_000), "keys(this)"),
        statement(keys(3_000), "let b = this"),
        statement(keys(3_000), "keys(this)"),
        statement(keys(3_000), "this.i = 1"),
        statement(keys(3_000) + "let s = s + 200;", "this[s]"),
        // mistakes that are caught
        statement("", "try { nosuch; } catch { }"),
        statement("", "try { nosuch; } catch (e) { }"),
        statement("", "try { nosuch(); } catch { }"),
        statement(
            "",
            "try { nosuch(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16) } catch { }",
        ),
        statement(
            "",
            "try { print(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16) } catch { }",
        ),
        statement("", "try { sin(1, 2) } catch { }"),
        statement("", "try { sin(\"a\") } catch { }"),
        statement("", "try { sin(\"a\") } catch (e) { }"),
        statement("", "try { throw 1 } catch { }"),
        statement("", "try { throw 1 } catch (e) { }"),
        statement("let a = [1];", "try { a[5] } catch { }"),
        statement("let a = ones(1);", "try { a[5] } catch { }"),
        statement("let a = #{};", "try { a.b } catch { }"),
        statement("let a = 1;", "try { a.b } catch { }"),
        statement("let a = 1;", "try { a.b = 1 } catch { }"),
        statement("let a = 1;", "try { a[0] } catch { }"),
        statement("let a = 1;", "try { if a { } } catch { }"),
        statement("let a = 1;", "try { for x in a { } } catch { }"),
        statement("", "try { 1 + \"a\"[0..2] } catch { }"),
        statement("", "try { f(0) } catch { }")
            .with("fn f(x) { if x < 25 { f(x + 1) } else { throw 1 } }"),
        statement("", "try { f(0) } catch { }")
            .with("fn f(x) { if x < 25 { f(x + 1) } else { nosuch } }"),
        statement("", format!("try {{ {} }} catch {{ }}", "n".repeat(200))),
        statement(
            "",
            format!("try {{ {}() }} catch (e) {{ }}", "n".repeat(200)),
        ),
        statement(
            "let a = #{};",
            format!("try {{ a.{} }} catch (e) {{ }}", "n".repeat(200)),
        ),
        // beside known names that are as long as one is compared with
        statement(
            local(&map(60, 60)),
            format!("try {{ a.{} }} catch (e) {{ }}", "n".repeat(60)),
        ),
        statement(
            (0..600)
                .map(|i| format!("let n{i:0>59}=1;"))
                .collect::<String>(),
            format!("try {{ {} }} catch (e) {{ }}", "n".repeat(60)),
        ),
        statement(
            "",
            format!("try {{ {}() }} catch (e) {{ }}", "n".repeat(60)),
        )
        .with(
            (0..600)
                .map(|i| format!("fn n{i:0>59}(){{}}"))
                .collect::<String>(),
        ),
        statement(many(2_000), "try { nosuch } catch { }"),
        statement("", "try { nosuch } catch { }").with(
            (0..2_000)
                .map(|i| format!("fn f{i}(){{}}"))
                .collect::<String>(),
        ),
        // many variables, functions, arms
        statement(many(2_000), "v0 + 1"),
        statement(many(2_000), "v0"),
        statement(many(2_000), "v1999"),
        statement(many(2_000), "pi"),
        statement(many(2_000), "A").with("const A = 1;"),
        statement("", "f(1)").with("fn f(x) { x }"),
        statement("", "f()").with("fn f() { }"),
        statement("", "f(1,2,3,4,5,6,7,8,9,10)").with("fn f(a,b,c,d,e,f,g,h,i,j) { }"),
        statement("let a = 1;", "a.f()").with("fn f() { this }"),
        statement("let a = 1;", "a.f()").with("fn f() { this + 1 }"),
        statement("", "f(20)").with("fn f(x) { if x > 0 { f(x - 1) } }"),
        statement("let a = 1;", "switch a { 1 => 2, 3 => 4 }"),
        statement(
            "let a = 1;",
            format!(
                "switch a {{ {} }}",
                (0..3_000)
                    .map(|i| format!("{}=>0,", i + 10))
                    .collect::<String>()
            ),
        ),
        statement(
            "let a = 1;",
            format!(
                "switch a {{ {} }}",
                (0..3_000)
                    .map(|i| format!("{}..{}=>0,", i + 10, i + 12))
                    .collect::<String>()
            ),
        ),
        statement(
            "let a = 1.5;",
            format!(
                "switch a {{ {} }}",
                (0..3_000)
                    .map(|i| format!("{}..={}=>0,", i + 10, i + 12))
                    .collect::<String>()
            ),
        ),
        statement(
            "let a = 1;",
            format!(
                "switch a {{ {} }}",
                (0..2_000)
                    .map(|_| "1 if false=>0,".to_owned())
                    .collect::<String>()
            ),
        ),
        // output
        statement("", "print(1.1)"),
        statement("", "print(1,2,3,4,5,6,7,8)"),
        // with other types of arguments each time
        statement(
            "let a = 1; let b = 1.5; let c = true; let d = (); let e = zeros(1); let f = eye(1); let g = \"\"; let h = []; let n = 0;",
            "let t = a; a = b; b = c; c = d; d = e; if n % 3 == 0 { e = f; f = g; } g = h; h = t; n += 1; print(a, b, c, d, e, f, g, h)",
        ),
        statement(
            "let a = 1; let b = 1.5; let c = true; let d = (); let e = zeros(1); let f = eye(1); let g = \"\"; let h = []; let n = 0;",
            "let t = a; a = b; b = c; c = d; d = e; if n % 3 == 0 { e = f; f = g; } g = h; h = t; n += 1; try { nosuch(a, b, c, d, e, f, g, h) } catch { }",
        ),
        statement(
            "let a = 1; let b = 1.5; let c = true; let d = (); let e = 1; let f = 2.5; let g = false; let h = []; let n = 0;",
            "let t = a; a = b; b = c; c = d; d = e; if n % 3 == 0 { e = f; f = g; } if n % 7 == 0 { g = h; h = t; } n += 1; try { xa(a, b, c, d, e, f, g, h, a, b, c, d, e, f, g, h) } catch { } try { xb(a, b, c, d, e, f, g, h, a, b, c, d, e, f, g, h) } catch { } try { xc(a, b, c, d, e, f, g, h, a, b, c, d, e, f, g, h) } catch { } try { xd(a, b, c, d, e, f, g, h, a, b, c, d, e, f, g, h) } catch { }",
        ),
        statement("let m = #{ f: own };", "m.f()").with("fn own() { 1 }"),
        statement("", "own").with("fn own() { 1 }"),
        statement("", "plot(\"a\", 1)"),
        statement("let v = ones(990);", "plot(\"a\", v)"),
        statement("let v = ones(2);", "plot(\"a\", v)"),
        // what the grader gives
        statement("", "o.q"),
        statement("", "o.q[0]"),
        statement("", "o.time"),
        statement("", "o.target"),
        statement("", "o"),
        statement("", "let b = o"),
        statement("", format!("`{}{}`", "ab".repeat(1900), "${1}".repeat(60))),
        statement(format!("let a = #{{ b: {} }};", nested()), "a.b[0].a = 1"),
        statement(local(&nested()), "f(a)").with("fn f(x) { loop { x; } }"),
        statement(local(&nested()), "a.f()").with("fn f() { loop { this; } }"),
        statement(local(&nested()), "a.f()").with("fn f() { loop { this[0].a = 1; } }"),
        statement("let m = #{};", format!("m[{}] = 1", text(3900))),
        statement(local(&map(250, 8)), "let t = this; a.k0000003 += 1"),
        // strings
        statement("let a = \"abc\";", "a == \"abd\""),
        statement("let a = \"abc\";", "a[1]"),
        statement("let a = \"abc\";", "\"b\" in a"),
        statement("let a = \"\";", "a += \"x\"; if a.len() > 100 { a = \"\" }"),
    ];
    // what several statements can be about
    for used in [
        "this.a.b",
        "this.a.b.c",
        "this.a[0].b",
        "this.a.b[0]",
        "this.a[0][0]",
        "this[\"a\"].b",
    ] {
        let inner = nested();
        let before = match used {
            "this.a.b" | "this[\"a\"].b" => format!("this.a = #{{ b: {inner} }};"),
            "this.a.b.c" => format!("this.a = #{{ b: #{{ c: {inner} }} }};"),
            "this.a[0].b" => format!("this.a = [#{{ b: {inner} }}];"),
            "this.a.b[0]" => format!("this.a = #{{ b: [{inner}] }};"),
            _ => format!("this.a = [[{inner}]];"),
        };
        for pattern in [
            "@",
            "let x = @",
            "f(@)",
            "f(1, @)",
            "[@]",
            "@ == 1",
            "return_it(@)",
        ] {
            let functions = "fn f(x) { 1 } fn f(x, y) { 1 } fn return_it(x) { x }";
            all.push(statement(before.clone(), pattern.replace('@', used)).with(functions));
        }
    }
    all
}
