//! What to do about an exception: Python says what is wrong, this says what to write.

use kinemark_sim::text::nearest;

/// The help after the message of an exception of type `kind`, which looked for `name` in `line` of `source`.
pub(super) fn help(
    kind: &str,
    message: &str,
    name: Option<&str>,
    line: &str,
    source: &str,
) -> Option<String> {
    if let Some(lost) = lost_global(kind, message, name, line, source) {
        return Some(format!(
            "`{lost}` is assigned in a function, where it is a name of that function alone: write `global {lost}` before it there"
        ));
    }
    let help = match kind {
        "NameError" => return of_name(name?, line, source),
        "AttributeError" => of_attribute(name, message),
        "StopIteration" => Some("nothing is left: next(it, default) gives the default then"),
        "ModuleNotFoundError" | "ImportError" => None,
        "IndexError" if message.contains("only integers") => Some(AN_INT),
        "IndexError" => Some("counting starts at 0: the last of n elements is n - 1, or -1"),
        "KeyError" if message.contains("Did you mean") => None,
        "KeyError" => {
            Some("`in` tests for a key; `get` returns something else where it is missing")
        }
        "ZeroDivisionError" => Some("check the divisor before you divide"),
        "RecursionError" => Some("look for a function that calls itself without an end"),
        "UnboundLocalError" if source.contains("del ") => None,
        "UnboundLocalError" => Some(
            "a name that a function assigns is its own: write `global` and the name first, or keep it in an object",
        ),
        "IndentationError" | "TabError" => {
            Some("indent the lines of a block alike, with four spaces")
        }
        "SyntaxError" => return of_syntax(line),
        "UFuncTypeError" => Some("write the numbers of the array as floats: np.array([0.0, 0.0])"),
        "LinAlgError" if message.contains("square") => {
            Some("the matrix needs as many columns as rows; np.linalg.pinv takes others, too")
        }
        "LinAlgError" => Some(
            "at a singular configuration use np.linalg.pinv, or damp: J.T @ np.linalg.inv(J @ J.T + d * np.eye(m))",
        ),
        "TypeError" => of_one_number(message, line)
            .or_else(|| of_operands(message, line))
            .or_else(|| of_call(message, line)),
        "ValueError" => of_value(message),
        "MemoryError" => Some("make lists, texts and arrays smaller"),
        _ => None,
    };
    help.map(str::to_owned)
}

/// A name that another function was to assign and did not, for want of `global`.
fn lost_global<'a>(
    kind: &str,
    message: &str,
    name: Option<&'a str>,
    line: &'a str,
    source: &str,
) -> Option<&'a str> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let is_assigned_inside = |name: &str| {
        source.lines().any(|line| {
            let rest = line.trim_start().strip_prefix(name);
            let rest = rest.filter(|_| line.starts_with([' ', '\t']));
            rest.is_some_and(|rest| {
                let rest = rest.trim_start();
                rest.starts_with([':', '=']) && !rest.starts_with("==")
            })
        })
    };
    let is_global = |name: &str| {
        source.lines().any(|line| {
            let names = line.trim_start().strip_prefix("global ");
            names.is_some_and(|names| names.split(',').any(|known| known.trim() == name))
        })
    };
    let is_lost = |name: &&str| is_assigned_inside(name) && !is_global(name);
    match kind {
        "NameError" => name.filter(is_lost),
        "TypeError" | "AttributeError" if message.contains("'NoneType'") => {
            let starts_as_none = |name: &&str| {
                source.lines().any(|line| {
                    let rest = line.strip_prefix(*name);
                    let value = rest.and_then(|rest| rest.split_once('='));
                    value.is_some_and(|(between, value)| {
                        !between.starts_with(is_name)
                            && value.split('#').next().unwrap_or_default().trim() == "None"
                    })
                })
            };
            let mut names = line.split(|c| !is_name(c)).filter(|name| !name.is_empty());
            names.find(|name| starts_as_none(name) && is_lost(name))
        }
        _ => None,
    }
}

/// Functions of `math` and of numpy that are written without their module.
const OF_MATH: [&str; 18] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "pi", "hypot", "exp", "log",
    "radians", "degrees", "floor", "ceil", "copysign", "fabs",
];
const OF_NUMPY: [&str; 25] = [
    "array",
    "zeros",
    "ones",
    "eye",
    "dot",
    "cross",
    "clip",
    "deg2rad",
    "rad2deg",
    "arctan2",
    "arccos",
    "arcsin",
    "arctan",
    "linspace",
    "arange",
    "maximum",
    "minimum",
    "concatenate",
    "hstack",
    "vstack",
    "outer",
    "where",
    "interp",
    "isclose",
    "allclose",
];
const OF_LINALG: [&str; 7] = ["norm", "inv", "pinv", "solve", "det", "svd", "lstsq"];
const A_NUMBER: &str = "one number is wanted here: take an element, such as q[0]";
const AN_INT: &str = "an index is an int: write // instead of /, or int(x)";

fn of_name(name: &str, line: &str, source: &str) -> Option<String> {
    let help = match name {
        "np" => "write `import numpy as np` at the top",
        "math" => "write `import math` at the top",
        "this" => {
            "Python keeps what lasts in a global, named after `global` in the function that assigns it, or in an object"
        }
        "self" => "`self` is the first parameter of a method: def control(self, observation)",
        "true" => "Python writes True",
        "false" => "Python writes False",
        "null" | "nil" | "none" => "Python writes None",
        "matrix" | "vector" => "write np.array: it makes vectors and matrices",
        "clamp" => "write np.clip(x, low, high)",
        "lerp" => "write a + (b - a) * s",
        "transpose" => "write A.T",
        "q" | "qd" | "tcp" | "target" | "time" | "tick" | "dt" | "sensors" | "effort"
            if !line.contains("observation") =>
        {
            return Some(format!(
                "it is a field of the observation: observation.{name}"
            ));
        }
        "robot" => {
            "`init(robot, task)` is given the robot: keep it there, in a global or in an object"
        }
        "link_lengths" => "it is a field of the robot: robot.link_lengths",
        "linalg" => "write `import numpy as np` at the top and np. before it",
        name if OF_LINALG.contains(&name) => {
            return Some(format!(
                "write `import numpy as np` at the top, and np.linalg.{name}"
            ));
        }
        name if OF_MATH.contains(&name) => {
            "write `import math` at the top and math. before it, or np. for arrays"
        }
        name if OF_NUMPY.contains(&name) => {
            "write `import numpy as np` at the top and np. before it"
        }
        _ => {
            let words = source.split(|c: char| !c.is_alphanumeric() && c != '_');
            let known = words
                .filter(|word| *word != name && !word.starts_with(|c: char| c.is_ascii_digit()));
            return nearest(name, known).map(|near| format!("did you mean `{near}`?"));
        }
    };
    Some(help.to_owned())
}

fn of_attribute(name: Option<&str>, message: &str) -> Option<&'static str> {
    if message.contains("not granted") {
        return Some("write it yourself: the dimensions are in `robot`");
    }
    if message.contains("'list'") && message.contains("has no attribute") {
        return Some("a list has no arithmetic: np.array(the_list) has");
    }
    let is_number = message.contains("'float'") || message.contains("'int'");
    match name {
        Some("x" | "y" | "z") if message.contains("ndarray") => {
            Some("elements are counted: tcp[0] is x, tcp[1] is y, tcp[2] is z")
        }
        Some("append" | "push") if message.contains("ndarray") => {
            Some("an array keeps its size: use a list, or np.append, which returns a new one")
        }
        Some("append" | "extend" | "sort" | "insert" | "update")
            if message.contains("'NoneType'") =>
        {
            Some(
                "append, sort and their like change the list and return None: write them alone in a line",
            )
        }
        Some("round") if is_number => {
            Some("a number out of an array is Python's own: write round(x, 3)")
        }
        Some(name) if is_number && OF_ARRAYS.contains(&name) => {
            Some("a number out of an array is Python's own float or int: use it as it is")
        }
        _ => None,
    }
}

/// Attributes of arrays, which numbers have in numpy and not here.
const OF_ARRAYS: [&str; 16] = [
    "shape", "dtype", "ndim", "size", "T", "item", "tolist", "copy", "astype", "flatten", "ravel",
    "reshape", "sum", "mean", "clip", "squeeze",
];

fn of_syntax(line: &str) -> Option<String> {
    let pasted = line.chars().find_map(|c| {
        let plain = match c {
            '\u{2212}' | '\u{2013}' | '\u{2014}' => "-",
            '\u{201c}' | '\u{201d}' | '\u{201e}' | '\u{ab}' | '\u{bb}' => "\"",
            '\u{2018}' | '\u{2019}' | '\u{b4}' => "'",
            '\u{d7}' | '\u{b7}' | '\u{22c5}' => "*",
            '\u{b2}' => "**2",
            '\u{a0}' => "a space",
            '\u{ff0c}' => ",",
            _ => return None,
        };
        Some((c, plain))
    });
    if let Some((pasted, plain)) = pasted {
        let code = u32::from(pasted);
        return Some(format!(
            "the line has the character `{pasted}` (U+{code:04X}), as a text or a web page has it: write {plain}"
        ));
    }
    let line = line.trim();
    let is_mark = |mark: &str| line.starts_with(mark);
    let help = if line.contains("&&") || line.contains("||") {
        "Python writes `and`, `or`, `not`"
    } else if is_mark("//") || is_mark("%") || is_mark("/*") {
        "a comment begins with #"
    } else if is_mark("fn ") || is_mark("function ") || is_mark("func ") {
        "Python writes def name(parameters):"
    } else if is_mark("let ") || is_mark("var ") || is_mark("const ") {
        "Python writes a variable without a word before it: x = 1"
    } else if is_mark("else if") {
        "Python writes elif"
    } else if line.ends_with('{') || is_mark("}") {
        "a block begins with a colon and is indented: Python has no braces around it"
    } else if line.contains(".from") {
        "`from` is a word of Python: write target[\"from\"]"
    } else if line.contains("++") || line.contains("--") {
        "write i += 1 or i -= 1"
    } else if is_an_open_block(line) {
        "a line that opens a block ends with a colon"
    } else if line.contains('^') {
        "Python writes a power as **"
    } else if line.contains('!') && !line.contains("!=") {
        "Python writes not"
    } else if line.ends_with("'") || line.contains("'*") || line.contains("' *") {
        "the transpose of a matrix is A.T"
    } else {
        return None;
    };
    Some(help.to_owned())
}

/// Whether a line opens a block and lacks its colon.
fn is_an_open_block(line: &str) -> bool {
    let opens = [
        "if ", "elif ", "for ", "while ", "def ", "class ", "else", "try", "with ",
    ];
    opens.iter().any(|word| line.starts_with(word)) && !line.ends_with(':')
}

/// A TypeError where one number, or an int, is wanted.
fn of_one_number(message: &str, line: &str) -> Option<&'static str> {
    let is_array =
        message.contains("only length-1 arrays") || message.contains("only size-1 arrays");
    if line.contains("% ") && (is_array || message.contains("must be real number")) {
        return Some("write each element into the text, or all of them: f\"{q}\"");
    }
    if is_array && !line.contains("math.") {
        return Some(A_NUMBER);
    }
    if is_array {
        return Some("math works on one number: use np.sin, np.cos and so on for arrays");
    }
    if message.contains("unhashable") {
        return Some(
            "keys of a dict and elements of a set are numbers, texts and tuples: tuple(a)",
        );
    }
    if message.contains("cannot be interpreted as an integer") {
        return Some(
            "an int is wanted here; arrays that belong together are one argument: np.concatenate([a, b])",
        );
    }
    if message.contains("too many arguments") && line.contains("stack(") {
        return Some("arrays that belong together are one argument: np.hstack([a, b])");
    }
    if message.contains("float() argument") {
        return Some(A_NUMBER);
    }
    None
}

/// A TypeError of operators and indices.
fn of_operands(message: &str, line: &str) -> Option<&'static str> {
    let is_xor = message.contains("unsupported operand") && message.contains('^');
    if is_xor || message.contains("'bitwise_xor'") {
        return Some("Python writes a power as **");
    }
    if message.contains("indices must be integers") && message.ends_with("float") {
        return Some(AN_INT);
    }
    if message.contains("must be real number")
        || message.contains("'list'") && line.contains("math.")
    {
        return Some("math works on one number: use np.sin, np.cos and so on for arrays");
    }
    if message.contains("can't multiply sequence")
        || message.contains("'list'") && !message.contains("callable")
        || message.contains("list and")
    {
        return Some("a list has no arithmetic: np.array(the_list) has");
    }
    if message.contains("'NoneType'") {
        return Some("a function without `return` returns None");
    }
    None
}

/// A TypeError of brackets, round and square, and of what is between them.
fn of_call(message: &str, line: &str) -> Option<&'static str> {
    let kind = message
        .strip_prefix('\'')
        .and_then(|rest| rest.split('\'').next());
    if message.contains("not callable") {
        return match kind {
            Some("list" | "ndarray" | "tuple" | "numpy.ndarray" | "dict") => {
                Some("elements are in square brackets: q[0], not q(0)")
            }
            Some("float" | "int") => Some("write the operator: 2 * (a + b), not 2(a + b)"),
            Some("module") => Some("name the function of the module: math.sin(x)"),
            _ => Some(
                "only functions, classes, and objects whose class has a method __call__ can be called",
            ),
        };
    }
    if message.contains("not subscriptable") {
        return match kind {
            Some("float" | "int" | "bool") => Some("it is one number: it has no elements"),
            _ => Some("a function is called with round brackets"),
        };
    }
    if message.contains("data type") {
        return Some("shape and elements are one argument: np.zeros((2, 3)), np.array([1, 2])");
    }
    if message.contains("positional argument")
        && message.contains("given")
        && line.contains("self.")
    {
        return Some("the first parameter of a method is self: def step(self, q)");
    }
    if message.contains("list indices must be integers") {
        return Some(
            "rows and columns in one pair of brackets need an array: np.array(the_list)[i, j]",
        );
    }
    None
}

fn of_value(message: &str) -> Option<&'static str> {
    if message.contains("could not be broadcast")
        || message.contains("could not broadcast")
        || message.contains("not aligned")
        || message.contains("matmul")
    {
        return Some("print the .shape of both; A @ b needs as many columns in A as elements in b");
    }
    if message.contains("truth value of an array") {
        return Some("write .any() or .all() after the comparison, or compare np.linalg.norm(...)");
    }
    if message.contains("values to unpack") {
        return Some(
            "there are as many names on the left as elements on the right: x, y, z = observation.tcp",
        );
    }
    if message.contains("math domain error") {
        return Some(
            "acos and asin take -1 to 1, sqrt takes 0 and more: clip the argument, or the target is out of reach",
        );
    }
    if message.contains("setting an array element with a sequence") {
        return Some("rows of one array have the same length, and an element is a number");
    }
    None
}
