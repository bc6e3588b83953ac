//! Files that may be slow to read: nested, chained and repeated as far as a source may be long.

/// Files that are slow to read, by name.
// long: a list
pub(crate) fn files() -> Vec<(String, String)> {
    let flat = |item: &dyn Fn(usize) -> String, most: usize| {
        let mut text = String::new();
        let mut index = 0;
        while text.len() + 40 < most {
            text += &item(index);
            index += 1;
        }
        text
    };
    const MOST: usize = 65_000;
    let control = |body: String| format!("fn control(o) {{ {body} }}");
    let of = |name: &str, source: String| (name.to_owned(), source);
    let letters = |mut i: usize| {
        let mut name = String::new();
        loop {
            name.push(char::from(b'a' + (i % 26) as u8));
            i /= 26;
            if i == 0 {
                return name;
            }
        }
    };
    vec![
        of(
            "switch",
            control(format!(
                "switch 1 {{ {} }}",
                flat(&|i| format!("{i}=>1,"), MOST)
            )),
        ),
        of(
            "switch of ranges",
            control(format!(
                "switch 1 {{ {} }}",
                flat(&|i| format!("{i}..{}=>1,", i + 2), MOST)
            )),
        ),
        of(
            "switch of one range",
            control(format!(
                "switch 1 {{ {} }}",
                flat(&|_| "0..9=>1,".to_owned(), MOST)
            )),
        ),
        of("lets", control(flat(&|i| format!("let a{i}=1;"), MOST))),
        of(
            "lets that are read",
            control(flat(&|i| format!("let a{i}=a0;"), MOST)),
        ),
        of(
            "one let again and again",
            control(flat(&|_| "let a=1;".to_owned(), MOST)),
        ),
        of("constants", flat(&|i| format!("const a{i}=1;"), MOST)),
        of("functions", flat(&|i| format!("fn f{i}(){{}}\n"), MOST)),
        of(
            "parameters",
            format!(
                "fn f({}) {{ }} fn control(o) {{ 1 }}",
                flat(&|i| format!("a{i},"), MOST)
            ),
        ),
        of(
            "arguments",
            control(format!("f({})", flat(&|_| "1,".to_owned(), MOST))),
        ),
        of(
            "unknown variables",
            control(flat(&|i| format!("x{};", letters(i)), MOST)),
        ),
        of(
            "unknown variables that are set",
            control(flat(&|i| format!("x{}=1;", letters(i)), MOST)),
        ),
        of(
            "unknown variables beside known ones",
            control(flat(&|i| format!("let xa{0};xb{0};", letters(i)), MOST)),
        ),
        of(
            "unknown functions",
            control(flat(&|i| format!("x{}();", letters(i)), MOST)),
        ),
        of(
            "unknown functions beside known ones",
            flat(&|i| format!("fn xa{}(){{}}", letters(i)), MOST / 2)
                + &*control(flat(&|i| format!("xb{}();", letters(i)), MOST / 2)),
        ),
        of(
            "one unknown variable in many blocks",
            control(flat(&|_| "if x{x=1}".to_owned(), MOST)),
        ),
        of(
            "nested blocks with an unknown variable",
            control(
                (0..900)
                    .map(|i| format!("{}x{i}=1;{}", "if true{".repeat(4), "}".repeat(4)))
                    .collect(),
            ),
        ),
        of(
            "long unknown name beside a long known one",
            control(format!(
                "let {} = 1; {}",
                "ab".repeat(15_000),
                "ac".repeat(15_000)
            )),
        ),
        of(
            "long unknown names",
            control(flat(&|i| format!("{}{i};", "ab".repeat(150)), MOST)),
        ),
        of(
            "map",
            control(format!("#{{{}}}", flat(&|i| format!("a{i}:1,"), MOST))),
        ),
        of(
            "list",
            control(format!("[{}]", flat(&|_| "1,".to_owned(), MOST))),
        ),
        of("lists", control(flat(&|_| "[1,2,3];".to_owned(), MOST))),
        of(
            "nested lists",
            control(flat(
                &|_| format!("{}1{};", "[".repeat(30), "]".repeat(30)),
                MOST,
            )),
        ),
        of(
            "nested blocks",
            control(flat(
                &|_| format!("{}{}", "{".repeat(30), "}".repeat(30)),
                MOST,
            )),
        ),
        of(
            "nested calls",
            control(flat(
                &|_| format!("{}1{};", "f(".repeat(30), ")".repeat(30)),
                MOST,
            )),
        ),
        of(
            "sums",
            control(flat(&|_| "1+1+1+1+1+1+1+1;".to_owned(), MOST)),
        ),
        of("comparisons", control(flat(&|_| "1<1;".to_owned(), MOST))),
        of(
            "chains",
            control(flat(&|_| format!("o{};", ".a".repeat(30)), MOST)),
        ),
        of(
            "strings",
            control(flat(&|_| format!("\"{}\";", "a".repeat(3_000)), MOST)),
        ),
        of(
            "interpolated strings",
            control(flat(&|_| "`${1}${2}${3}`;".to_owned(), MOST)),
        ),
        of("comments", flat(&|_| "//\n".to_owned(), MOST)),
        of(
            "nested comments",
            format!("{}{}", "/*".repeat(16_000), "*/".repeat(16_000)),
        ),
        of("a comment that is not closed", "/*".repeat(32_000)),
        of(
            "a string that is not closed",
            control(format!("\"{}", "a".repeat(3_000))),
        ),
        of("empty lines", "\n".repeat(65_000)),
        of("blanks", " ".repeat(65_000)),
        of("a long line of digits", control("1".repeat(64_000))),
        of(
            "numbers with long fractions",
            control(format!("1.{}", "1".repeat(64_000))),
        ),
        of(
            "a mistake in each line",
            flat(&|_| "x ^^ 2\n".to_owned(), MOST),
        ),
        of(
            "a mistake in each short line",
            flat(&|_| ")\n".to_owned(), MOST),
        ),
        of(
            "a mistake at the end",
            flat(&|_| "let a=1;\n".to_owned(), MOST) + ")",
        ),
        of(
            "mistakes at the end",
            flat(&|_| "let a=1;\n".to_owned(), MOST - 1_000) + &*")\n".repeat(400),
        ),
        of(
            "mistakes in one line",
            control(flat(&|_| "x x;".to_owned(), MOST)),
        ),
        of(
            "a missing semicolon in each line",
            control(flat(&|i| format!("let a{i}=1\n"), MOST)),
        ),
        of(
            "Python",
            flat(&|i| format!("def f{i}(x):\n    return x**2\n"), MOST),
        ),
        of(
            "MATLAB",
            flat(
                &|i| format!("function y = f{i}(x)\n  y = x.^2; % squared\nend\n"),
                MOST,
            ),
        ),
        of("comments of Python", flat(&|_| "# a\n".to_owned(), MOST)),
        of("powers", control(flat(&|_| "a^2;\n".to_owned(), MOST))),
        of(
            "open brackets before a mistake",
            format!("fn control(o) {{ {} )", flat(&|_| "f(1);".to_owned(), MOST)),
        ),
        of(
            "brackets over many lines",
            control(
                "f(\n".repeat(20) + &*flat(&|_| "1,\n".to_owned(), MOST - 200) + &*")".repeat(20),
            ),
        ),
        of(
            "blocks that are not closed",
            flat(&|i| format!("fn f{i}() {{\n"), MOST),
        ),
        of(
            "words of other languages",
            flat(&|_| "end\n".to_owned(), MOST),
        ),
        of("fences", flat(&|_| "```\n".to_owned(), MOST)),
        of(
            "fences with mistakes between",
            "```\n".to_owned() + &*flat(&|_| "x ^^ 2\n".to_owned(), MOST - 100) + "\n```",
        ),
        of("quotes", "\"\n".repeat(32_000)),
        of("backquotes", "`".repeat(60_000)),
        of("letters of other alphabets", "ä".repeat(32_000)),
        of(
            "annotations",
            control(flat(&|i| format!("let a{i}: float = 1;\n"), MOST)),
        ),
        of(
            "else if",
            control(format!("if o {{}} {}", "else if o {}".repeat(5_000))),
        ),
        of("a long sum", control(format!("1{}", "+1".repeat(32_000)))),
        of(
            "a long chain of and",
            control(format!("o{}", "&&o".repeat(20_000))),
        ),
        of(
            "a long chain of ??",
            control(format!("o{}", "??o".repeat(20_000))),
        ),
        of(
            "a long chain of fields",
            control(format!("o{}", ".a".repeat(32_000))),
        ),
        of(
            "a long chain of indices",
            control(format!("o{}", "[0]".repeat(20_000))),
        ),
        of(
            "a long chain of calls",
            control(format!("o{}", ".a()".repeat(15_000))),
        ),
        of(
            "a long chain of assignments",
            control(format!("{}1", "a=".repeat(30_000))),
        ),
        of(
            "a long chain of fields that are set",
            control(format!("o{}=1", ".a".repeat(32_000))),
        ),
        of(
            "powers of powers",
            control(format!("2{}", "**2".repeat(20_000))),
        ),
        of("signs", control(format!("{}1", "-".repeat(60_000)))),
        of("signs apart", control(format!("{}1", "- ".repeat(30_000)))),
        of("nots", control(format!("{}true", "!".repeat(60_000)))),
        of("round brackets", control("(".repeat(60_000))),
        of("square brackets", control("[".repeat(60_000))),
        of("braces", "{".repeat(65_000)),
        of("maps in maps", control("#{a:".repeat(15_000))),
        of("strings in strings", control("`${".repeat(20_000))),
        of("ifs in ifs", control("if ".repeat(20_000))),
        of("if blocks", control("if o {".repeat(10_000))),
        of("loops in loops", control("loop {".repeat(10_000))),
        of("tries in tries", control("try {".repeat(10_000))),
        of(
            "switches in switches",
            control("switch o { 1 => ".repeat(4_000)),
        ),
        of("returns of returns", control("return ".repeat(9_000))),
        of("lets of lets", control("let a = ".repeat(8_000))),
        of("functions in functions", "fn f() {".repeat(8_000)),
        of("functions without names", control("|a|".repeat(20_000))),
        of("commas", control(format!("f({})", ",".repeat(60_000)))),
        of("colons", control("a::".repeat(20_000))),
        of("closing brackets", ")".repeat(65_000)),
        of("closing brackets in lines", "}\n".repeat(32_000)),
        of("increments", control(flat(&|_| "i++;\n".to_owned(), MOST))),
    ]
}
