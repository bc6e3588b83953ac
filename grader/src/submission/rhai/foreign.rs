//! Names and signs from MATLAB, Python and C, and what to write instead.

use kinemark_sim::text::nearest;

/// Functions of other languages, and what to write instead.
const FUNCTIONS: &[(&str, &str)] = &[
    ("arctan2", "write atan2(y, x)"),
    ("arctan", "write atan(x)"),
    ("arccos", "write acos(x)"),
    ("arcsin", "write asin(x)"),
    ("power", "write x ** y"),
    ("fabs", "write abs(x)"),
    (
        "log",
        "write ln(x) for the natural logarithm, log10(x) for that to base 10",
    ),
    ("length", "write len(x)"),
    ("numel", "write len(x)"),
    ("size", "write len(x), or rows(m) and cols(m)"),
    ("shape", "write len(x), or rows(m) and cols(m)"),
    ("clip", "write clamp(x, low, high)"),
    ("saturate", "write clamp(x, low, high)"),
    ("disp", "write print(x)"),
    ("printf", "write print(\"x =\", x)"),
    ("fprintf", "write print(\"x =\", x)"),
    ("println", "write print(x)"),
    ("sprintf", "join strings with +: \"x = \" + x"),
    ("format", "join strings with +: \"x = \" + x"),
    ("str", "write to_string(x), or join strings with +"),
    ("num2str", "write to_string(x), or join strings with +"),
    ("float", "numbers need no conversion"),
    ("int", "write trunc(x), floor(x) or round(x)"),
    ("to_int", "write trunc(x), floor(x) or round(x)"),
    ("to_float", "numbers need no conversion"),
    ("fix", "write trunc(x)"),
    ("mod", "write a % b; its sign is that of b"),
    ("rem", "write a % b; its sign is that of b"),
    ("fmod", "write a % b; its sign is that of b"),
    ("array", "write vector([1, 2]) or matrix([[1, 2], [3, 4]])"),
    ("append", "write list.push(x), or concat(a, b)"),
    ("extend", "write concat(a, b)"),
    ("matmul", "write a * b"),
    (
        "multiply",
        "write a * b; vectors multiply element by element",
    ),
    ("times", "write a * b; vectors multiply element by element"),
    ("pinv", "write transpose(J) * solve(J * transpose(J), v)"),
    ("mldivide", "write solve(A, b)"),
    ("lstsq", "write solve(transpose(A) * A, transpose(A) * b)"),
    ("degrees", "write deg(x)"),
    ("rad2deg", "write deg(x)"),
    ("to_degrees", "write deg(x)"),
    ("radians", "write rad(x)"),
    ("deg2rad", "write rad(x)"),
    ("to_radians", "write rad(x)"),
    ("wrapToPi", "write wrap_pi(x)"),
    ("identity", "write eye(n)"),
    ("magnitude", "write norm(v)"),
    ("normalize", "write v / norm(v)"),
    ("normalized", "write v / norm(v)"),
    ("unit", "write v / norm(v)"),
    ("sind", "write sin(rad(x))"),
    ("cosd", "write cos(rad(x))"),
    ("tand", "write tan(rad(x))"),
    ("asind", "write deg(asin(x))"),
    ("acosd", "write deg(acos(x))"),
    ("atand", "write deg(atan(x))"),
    ("atan2d", "write deg(atan2(y, x))"),
    ("mean", "write sum(v) / len(v)"),
    ("trace", "write m[0][0] + m[1][1]"),
    ("strcmp", "write a == b"),
    ("error", "write throw \"text\""),
    ("Vec2", "write [x, y]"),
    ("Vec3", "write [x, y, z]"),
    ("iter", "write for x in list { ... }"),
    ("clone", "an assignment copies: let b = a;"),
    ("isnan", "write is_nan(x)"),
    ("isnumeric", "there is no test of types"),
    ("type_of", "there is no test of types"),
    (
        "sleep",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "pause",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "wait",
        "nothing waits here: `control` is called every control period",
    ),
    (
        "tic",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "toc",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "timestamp",
        "there is no clock: observation.time is the time of the run",
    ),
    (
        "rand",
        "there is no randomness: the same run gives the same bits",
    ),
    (
        "random",
        "there is no randomness: the same run gives the same bits",
    ),
    (
        "randn",
        "there is no randomness: the same run gives the same bits",
    ),
    ("toFixed", "write round(x, 2), or print(x)"),
    ("tolist", "leave it out: vectors and lists are taken alike"),
    ("to_vec", "leave it out: an assignment copies"),
    ("collect", "write a `for` loop with list.push(x)"),
    ("is_none", "write x == ()"),
    ("is_some", "write x != ()"),
    (
        "Some",
        "leave it out: a variable holds a value, or () for nothing",
    ),
    ("unwrap", "leave it out: a variable holds the value itself"),
    ("vec", "write [0.0, 0.0], or zeros(2)"),
    ("isinstance", "there is no test of types"),
    ("isempty", "write len(x) == 0"),
    ("empty", "write len(x) == 0"),
    ("range", "write for i in 0..n { ... }"),
    ("enumerate", "write for i in 0..len(list) { ... }"),
    ("zip", "write for i in 0..len(a) { ... }"),
    ("square", "write x ** 2"),
    ("map", "write a `for` loop"),
    ("filter", "write a `for` loop"),
    ("reduce", "write a `for` loop"),
];

/// Variables of other languages, and what to write instead.
const VARIABLES: &[(&str, &str)] = &[
    (
        "np",
        "functions are built in: write sin(x), pi and [1, 2], without a prefix",
    ),
    (
        "numpy",
        "functions are built in: write sin(x), pi and [1, 2], without a prefix",
    ),
    (
        "math",
        "functions are built in: write sin(x), pi and [1, 2], without a prefix",
    ),
    (
        "Math",
        "functions are built in: write sin(x), pi and [1, 2], without a prefix",
    ),
    ("self", "what is kept between calls is in `this`"),
    ("True", "write true"),
    ("False", "write false"),
    ("None", "write ()"),
    ("null", "write ()"),
    ("nil", "write ()"),
    ("NULL", "write ()"),
    ("undefined", "write ()"),
    ("console", "write print(x)"),
    ("NaN", "nothing is equal to it: write is_nan(x)"),
    ("nan", "nothing is equal to it: write is_nan(x)"),
    ("eps", "write 1e-12"),
    ("Inf", "write inf"),
    ("Infinity", "write inf"),
    ("pass", "leave it out: an empty block is { }"),
    ("M_PI", "write pi"),
    ("PI", "write pi"),
    ("Pi", "write pi"),
    (
        "end",
        "blocks end with `}`; the last element is v[len(v) - 1]",
    ),
];

/// Words of other languages' syntax, and what to write instead.
const SYNTAX: &[(&str, &str)] = &[
    ("and", "write && for \"and\""),
    ("or", "write || for \"or\""),
    ("not", "write ! for \"not\""),
    ("elif", "write } else if condition { ... }"),
    ("elseif", "write } else if condition { ... }"),
    ("def", "a function is written fn name(parameters) { ... }"),
    (
        "function",
        "a function is written fn name(parameters) { ... }",
    ),
    ("func", "a function is written fn name(parameters) { ... }"),
    ("lambda", "write a function with a name: fn name(x) { ... }"),
    ("end", "a block ends with }"),
    ("then", "write if condition { ... }"),
    (
        "struct",
        "there are no types: keep values in a map, #{ kp: 1.0 }, or in `this`",
    ),
    (
        "class",
        "there are no types: keep values in a map, #{ kp: 1.0 }, or in `this`",
    ),
    (
        "enum",
        "there are no types: keep values in a map, #{ kp: 1.0 }, or in `this`",
    ),
    ("except", "write try { ... } catch { ... }"),
    ("pass", "leave it out: an empty block is { }"),
    ("raise", "write throw \"text\""),
    ("assert", "write if !condition { throw \"text\" }"),
    ("impl", "functions stand alone: fn name(x) { ... }"),
    ("var", "declare a variable with let x = 1;"),
    ("double", "declare a variable with let x = 1;"),
    ("float", "declare a variable with let x = 1;"),
    ("int", "declare a variable with let x = 1;"),
    ("import", "everything there is, is built in"),
    ("pub", "leave it out: fn name(x) { ... }"),
    ("persistent", "keep it in `this`: this.x = 0; in init"),
    ("global", "keep it in `this`: this.x = 0; in init"),
    ("from", "everything there is, is built in"),
];

/// Signs of other languages' syntax, and what to write instead.
const SIGNS: &[(&str, &str)] = &[
    (".*", "write *: vectors multiply element by element"),
    ("./", "write /: vectors divide element by element"),
    (".^", "write **: vectors go element by element"),
    ("++", "write x += 1"),
    ("--", "write x -= 1"),
    (":=", "write let x = 1; to declare and x = 2; to change"),
    ("@(", "write a function with a name: fn name(x) { ... }"),
    ("@", "write * for the product of matrices"),
    ("#", "a comment begins with //"),
    ("?", "write if condition { a } else { b }"),
    ("===", "write =="),
    ("!==", "write !="),
    ("<>", "write !="),
    ("<-", "write x = 1; to set, and x < -1 to compare"),
    ("->", "write a function as fn name(x) { ... }"),
    ("(*", "a comment begins with //"),
    ("~=", "write !="),
    ("~", "write ! for \"not\", and != for \"not equal\""),
    (
        "'",
        "a string goes in double quotes; the transpose of a matrix is m.T, and a vector needs none",
    ),
];

/// Characters that a keyboard or a word processor gives for those of the language, and what to write instead.
const CHARACTERS: &[(&str, &str)] = &[
    ("“”„«»", "write \" (a straight quote)"),
    ("‘’‚", "write \" (a straight quote)"),
    ("π", "write pi"),
    ("×", "write *"),
    ("·∙", "write dot(a, b) for vectors, and * for numbers"),
    ("÷", "write /"),
    ("−–—", "write - (a minus sign)"),
    ("²³", "use ** for powers: x ** 2"),
    ("≤", "write <="),
    ("≥", "write >="),
    ("≠", "write !="),
    ("∞", "write inf"),
    ("√", "write sqrt(x)"),
    ("\\", "write solve(A, b) for A \\ b"),
    ("&", "leave it out; \"and\" is &&"),
    ("°", "write rad(90) for 90 degrees"),
    (
        "%",
        "a comment begins with //; the remainder of a division is a % b",
    ),
    ("\u{a0}\u{200b}", "write a plain space"),
];

/// What to write instead of a character that the language does not have.
pub(super) fn character(sign: &str) -> Option<String> {
    let first = sign.chars().next()?;
    let known = CHARACTERS.iter().find(|(signs, _)| signs.contains(first));
    match known {
        Some((_, help)) => Some((*help).to_owned()),
        None if first.is_alphabetic() && !first.is_ascii() => {
            Some("names have the letters a to z, digits and _".to_owned())
        }
        None => None,
    }
}

/// What to write instead of a sign of another language.
pub(super) fn sign(sign: &str) -> Option<String> {
    look_up(SIGNS, sign)
}

/// What to write instead of a word of another language's syntax.
pub(super) fn word(name: &str) -> Option<String> {
    look_up(SYNTAX, name)
}

/// What to write instead of a function of another language.
pub(super) fn function(name: &str) -> Option<String> {
    look_up(FUNCTIONS, name).or_else(|| look_up(SYNTAX, name))
}

/// What to write instead of a variable of another language.
pub(super) fn variable(name: &str) -> Option<String> {
    look_up(VARIABLES, name).or_else(|| look_up(SYNTAX, name))
}

/// Words that the language keeps for itself although nothing is written with them. script-language.md lists them.
pub(super) const RESERVED: [&str; 26] = [
    "async",
    "await",
    "case",
    "default",
    "go",
    "goto",
    "is",
    "match",
    "module",
    "new",
    "nil",
    "null",
    "package",
    "protected",
    "public",
    "shared",
    "spawn",
    "static",
    "super",
    "sync",
    "thread",
    "use",
    "var",
    "void",
    "with",
    "yield",
];

/// Why a reserved word or symbol cannot stand where it does, and what to write instead.
pub(super) fn reserved(word: &str) -> (String, Option<String>) {
    if RESERVED.contains(&word) {
        let other = format!("choose another name, such as `my_{word}`");
        let help = match word {
            "null" | "nil" => format!("write () for nothing; for a name, {other}"),
            "case" | "match" => format!("write switch x {{ 1 => a, _ => b }}; for a name, {other}"),
            "var" => "declare a variable with let x = 1;".to_owned(),
            "use" | "module" | "package" => {
                format!("everything there is, is built in; for a name, {other}")
            }
            _ => other,
        };
        return (
            format!("`{word}` is a reserved word of the language"),
            Some(help),
        );
    }
    if matches!(word, "print" | "debug") {
        let help = format!("call it: {word}(x); give a variable another name");
        return (format!("`{word}` is a function"), Some(help));
    }
    let help = match word {
        "eval" | "Fn" | "call" | "curry" => "functions are called by name",
        "import" | "export" | "as" => "everything there is, is built in",
        "type_of" | "is_def_var" | "is_def_fn" | "is_shared" => "there is no test of this",
        "|" | "||" => "functions without a name are not available: write fn name(x) { ... }",
        other => {
            let is_word = other.chars().all(|c| c.is_alphanumeric() || c == '_');
            let reserved = "it is a word of the language: choose another name";
            let help = look_up(SIGNS, other)
                .or_else(|| look_up(SYNTAX, other))
                .or_else(|| look_up(VARIABLES, other))
                .or_else(|| look_up(FUNCTIONS, other))
                .or_else(|| is_word.then(|| reserved.to_owned()));
            return (format!("`{word}` is not available here"), help);
        }
    };
    (
        format!("`{word}` is not available here"),
        Some(help.to_owned()),
    )
}

/// Help if a line shows another language's syntax at or before a column.
pub(super) fn syntax(line: &str, column: usize) -> Option<String> {
    let characters: Vec<char> = line.chars().collect();
    let column = column.saturating_sub(1).min(characters.len());
    // the word the parser stopped at, and the one before it
    let around: String = characters
        .iter()
        .enumerate()
        .filter(|(i, c)| *i < column || c.is_alphanumeric() || **c == '_')
        .map(|(_, c)| *c)
        .collect();
    let mut words = around
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .filter(|word| !word.is_empty());
    let stopped: String = characters[column..]
        .iter()
        .take_while(|c| c.is_alphanumeric() || **c == '_')
        .collect();
    let before = characters[..column]
        .split(|c| !(c.is_alphanumeric() || *c == '_'))
        .rfind(|word| !word.is_empty())
        .map(|word| word.iter().collect::<String>());
    look_up(SYNTAX, &stopped)
        .or_else(|| look_up(SYNTAX, &before?))
        .or_else(|| look_up(SYNTAX, words.next()?))
        .or_else(|| {
            let near: String = characters[column.saturating_sub(2)..]
                .iter()
                .take(4)
                .collect();
            SIGNS
                .iter()
                .find(|(sign, _)| near.contains(sign))
                .map(|(_, help)| (*help).to_owned())
        })
}

/// Words that a line begins with.
const KEYWORDS: [&str; 8] = ["fn", "let", "const", "if", "for", "while", "return", "else"];

/// The keyword that is nearest to a line's first word, if the parser stopped at its second word.
pub(super) fn near_keyword(line: &str, column: usize) -> Option<String> {
    let before: String = line.chars().take(column.saturating_sub(1)).collect();
    let word = before.trim();
    let is_name = word.chars().all(|c| c.is_alphanumeric() || c == '_');
    // a single letter is a variable
    if !is_name || word.len() < 2 || KEYWORDS.contains(&word) {
        return None;
    }
    let near = nearest(word, KEYWORDS.into_iter())?;
    Some(format!("did you mean `{near}`? Else end `{word}` with `;`"))
}

fn look_up(table: &[(&str, &str)], name: &str) -> Option<String> {
    table
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, help)| (*help).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_other_languages_are_seen_where_the_parser_stops() {
        assert!(syntax("if a and b {", 6).is_some_and(|help| help.contains("&&")));
        assert!(syntax("def control(o):", 5).is_some_and(|help| help.contains("fn")));
        assert!(syntax("let x = 1 +", 12).is_none());
    }
}
