//! What to do about an exception: Python says what is wrong, this says what to write.

/// The help after the message of an exception of type `kind`, which looked for `name` in `line`.
pub(super) fn help(kind: &str, message: &str, name: Option<&str>, line: &str) -> Option<String> {
    let help = match kind {
        "NameError" => of_name(name?, line),
        "AttributeError" => of_attribute(name, message),
        "ModuleNotFoundError" | "ImportError" => None,
        "IndexError" => Some("counting starts at 0: the last of n elements is n - 1, or -1"),
        "KeyError" => {
            Some("`in` tests for a key; `get` returns something else where it is missing")
        }
        "ZeroDivisionError" => Some("check the divisor before you divide"),
        "RecursionError" => Some("look for a function that calls itself without an end"),
        "UnboundLocalError" => Some(
            "a name that a function assigns is its own: write `global` and the name first, or keep it in an object",
        ),
        "IndentationError" | "TabError" => {
            Some("indent the lines of a block alike, with four spaces")
        }
        "SyntaxError" => of_syntax(line),
        "LinAlgError" => Some(
            "at a singular configuration use np.linalg.pinv, or damp: J.T @ np.linalg.inv(J @ J.T + d * np.eye(m))",
        ),
        "TypeError" => of_type(message, line),
        "ValueError" => of_value(message),
        "MemoryError" => Some("make lists, texts and arrays smaller"),
        _ => None,
    };
    help.map(str::to_owned)
}

/// Functions of `math` and of numpy that are written without their module.
const OF_MATH: [&str; 18] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "pi", "hypot", "exp", "log",
    "radians", "degrees", "floor", "ceil", "copysign", "fabs",
];
const OF_NUMPY: [&str; 14] = [
    "array", "zeros", "ones", "eye", "dot", "cross", "clip", "deg2rad", "rad2deg", "arctan2",
    "arccos", "arcsin", "linalg", "norm",
];

fn of_name(name: &str, line: &str) -> Option<&'static str> {
    match name {
        "np" => Some("write `import numpy as np` at the top"),
        "math" => Some("write `import math` at the top"),
        "self" => Some("`self` is the first parameter of a method: def control(self, observation)"),
        "true" => Some("Python writes True"),
        "false" => Some("Python writes False"),
        "null" | "nil" | "none" => Some("Python writes None"),
        "matrix" | "vector" => Some("write np.array: it makes vectors and matrices"),
        "q" | "qd" | "tcp" | "target" | "time" | "dt" | "sensors"
            if !line.contains("observation") =>
        {
            Some("it is a field of the observation: observation.q")
        }
        "link_lengths" => Some("it is a field of the robot: robot.link_lengths"),
        name if OF_MATH.contains(&name) => {
            Some("write `import math` at the top and math. before it, or np. for arrays")
        }
        name if OF_NUMPY.contains(&name) => {
            Some("write `import numpy as np` at the top and np. before it")
        }
        _ => None,
    }
}

fn of_attribute(name: Option<&str>, message: &str) -> Option<&'static str> {
    if message.contains("not granted") {
        return Some("write it yourself: the dimensions are in `robot`");
    }
    if message.contains("'list'") && message.contains("has no attribute") {
        return Some("a list has no arithmetic: np.array(the_list) has");
    }
    match name {
        Some("append" | "push") if message.contains("ndarray") => {
            Some("an array keeps its size: use a list, or np.append, which returns a new one")
        }
        _ => None,
    }
}

fn of_syntax(line: &str) -> Option<&'static str> {
    let line = line.trim();
    if line.contains("&&") || line.contains("||") {
        return Some("Python writes `and`, `or`, `not`");
    }
    if line.starts_with("fn ") || line.starts_with("function ") || line.starts_with("func ") {
        return Some("Python writes def name(parameters):");
    }
    if line.starts_with("let ") || line.starts_with("var ") || line.starts_with("const ") {
        return Some("Python writes a variable without a word before it: x = 1");
    }
    if line.starts_with("else if") {
        return Some("Python writes elif");
    }
    let opens = ["if ", "elif ", "for ", "while ", "def ", "class ", "else"];
    if opens.iter().any(|word| line.starts_with(word)) && !line.ends_with(':') {
        return Some("a line that opens a block ends with a colon");
    }
    if line.contains("^") {
        return Some("Python writes a power as **");
    }
    None
}

fn of_type(message: &str, line: &str) -> Option<&'static str> {
    if message.contains("only length-1 arrays") || message.contains("only size-1 arrays") {
        return Some("math works on one number: use np.sin, np.cos and so on for arrays");
    }
    if message.contains("must be real number")
        || message.contains("'list'") && line.contains("math.")
    {
        return Some("math works on one number: use np.sin, np.cos and so on for arrays");
    }
    if message.contains("can't multiply sequence") || message.contains("'list'") {
        return Some("a list has no arithmetic: np.array(the_list) has");
    }
    if message.contains("'NoneType'") {
        return Some("a function without `return` returns None");
    }
    if message.contains("not callable") {
        return Some("elements are in square brackets: q[0], not q(0)");
    }
    if message.contains("not subscriptable") {
        return Some("a function is called with round brackets");
    }
    if message.contains("list indices must be integers") {
        return Some(
            "rows and columns in one pair of brackets need an array: np.array(the_list)[i, j]",
        );
    }
    None
}

fn of_value(message: &str) -> Option<&'static str> {
    if message.contains("could not be broadcast") || message.contains("matmul") {
        return Some("print the .shape of both; A @ b needs as many columns in A as elements in b");
    }
    if message.contains("truth value of an array") {
        return Some("write .any() or .all() after the comparison, or compare np.linalg.norm(...)");
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
