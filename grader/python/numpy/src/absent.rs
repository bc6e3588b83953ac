//! The names of real numpy that are not here, each with what to do instead, and the sentences about missing names.

/// A name of `numpy` or `numpy.linalg` that is left out, and what to do.
pub type Absent = (&'static str, &'static str);

/// What is left out of `numpy`.
pub const NUMPY: &[Absent] = &[
    ("random", "every run is the same"),
    ("fft", "filters work sample by sample"),
    ("polynomial", "use np.polyval, or write the sum"),
    (
        "polyfit",
        "use np.linalg.lstsq with a matrix of powers (np.vander)",
    ),
    ("poly1d", "use np.polyval"),
    ("roots", "solve it by hand, or iterate"),
    ("matrix", "use np.array and the operator @"),
    ("mat", "use np.array and the operator @"),
    ("asmatrix", "use np.array and the operator @"),
    ("float16", "use float (float64)"),
    ("float32", "use float (float64)"),
    ("float128", "use float (float64)"),
    ("longdouble", "use float (float64)"),
    ("single", "use float (float64)"),
    ("half", "use float (float64)"),
    ("int8", "use int (int64)"),
    ("int16", "use int (int64)"),
    ("int32", "use int (int64)"),
    ("uint8", "use int (int64)"),
    ("uint16", "use int (int64)"),
    ("uint32", "use int (int64)"),
    ("uint64", "use int (int64)"),
    ("uint", "use int (int64)"),
    ("complex64", "use two floats, or Python's complex"),
    ("complex128", "use two floats, or Python's complex"),
    ("complexfloating", "use two floats, or Python's complex"),
    ("object_", "use a Python list"),
    ("str_", "use a Python str"),
    ("datetime64", "use the time that the task gives"),
    ("angle", "use np.arctan2(y, x)"),
    ("imag", "arrays are real"),
    ("iscomplex", "arrays are real"),
    ("loadtxt", "there are no files"),
    ("genfromtxt", "there are no files"),
    ("savetxt", "there are no files"),
    ("load", "there are no files"),
    ("save", "there are no files"),
    ("savez", "there are no files"),
    ("fromfile", "there are no files"),
    (
        "fromstring",
        "use np.array([float(word) for word in text.split()])",
    ),
    ("frombuffer", "use np.array"),
    ("fromiter", "use np.array(list(...))"),
    ("fromfunction", "use np.array with a comprehension"),
    (
        "vectorize",
        "use a comprehension: np.array([f(x) for x in a])",
    ),
    ("apply_along_axis", "use a comprehension over the rows"),
    ("einsum", "use @, np.dot, np.inner or np.outer"),
    ("tensordot", "use @, np.dot, np.inner or np.outer"),
    ("c_", "use np.column_stack"),
    ("r_", "use np.concatenate"),
    ("s_", "use slice()"),
    ("ix_", "use a[rows][:, columns]"),
    ("mgrid", "use np.meshgrid"),
    ("ogrid", "use np.meshgrid"),
    ("indices", "use np.arange"),
    ("ndindex", "use two loops"),
    ("ndenumerate", "use enumerate"),
    ("nditer", "use a for loop"),
    ("histogram", "count in a loop"),
    ("digitize", "use np.searchsorted"),
    ("bincount", "count in a loop"),
    ("cov", "use a - a.mean(axis=0) and @"),
    ("corrcoef", "use a - a.mean(axis=0) and @"),
    ("dstack", "arrays here have at most 2 dimensions"),
    ("atleast_3d", "arrays here have at most 2 dimensions"),
    ("array_split", "use slices"),
    ("split", "use slices"),
    ("hsplit", "use slices"),
    ("vsplit", "use slices"),
    ("insert", "use np.concatenate with slices"),
    ("pad", "use np.concatenate"),
    ("select", "use np.where"),
    ("piecewise", "use np.where"),
    ("rot90", "use np.flip and .T"),
    ("moveaxis", "use .T"),
    ("isin", "use a comparison with |"),
    ("in1d", "use a comparison with |"),
    ("setdiff1d", "use Python's set"),
    ("union1d", "use Python's set"),
    ("intersect1d", "use Python's set"),
    ("partition", "use np.sort"),
    ("argpartition", "use np.argsort"),
    ("lexsort", "use sorted with a key"),
    ("float", "use float"),
    ("int", "use int"),
    ("bool8", "use bool"),
    ("object", "use object"),
    ("infty", "use np.inf"),
    ("Inf", "use np.inf"),
    ("NaN", "use np.nan"),
    ("NAN", "use np.nan"),
    ("product", "use np.prod"),
    ("cumproduct", "use np.cumprod"),
    ("alltrue", "use np.all"),
    ("sometrue", "use np.any"),
    ("round_", "use np.round"),
    ("row_stack", "use np.vstack"),
    ("trapz", "use np.trapezoid"),
    ("rand", "every run is the same"),
    ("randn", "every run is the same"),
    ("real", "arrays are real"),
    ("conj", "arrays are real"),
    ("conjugate", "arrays are real"),
    ("number", "use float"),
    ("fill_diagonal", "use a loop: a[i, i] = x"),
    ("tri", "use np.tril(np.ones((n, n)))"),
    ("geomspace", "use np.logspace"),
    ("broadcast_arrays", "use np.broadcast_to"),
    ("resize", "use np.reshape or np.tile"),
    ("polyadd", "use np.polyval, or write the sum"),
    ("polymul", "use np.convolve"),
    ("polyder", "write the derivative out"),
    ("polyint", "write the integral out"),
    ("nanargmax", "use np.argmax"),
    ("nanargmin", "use np.argmin"),
    ("set_string_function", "write f-strings"),
    ("testing", "use assert with np.allclose"),
    ("ma", "use masks: a[a > 0]"),
    ("lib", "only what docs/python.md lists is here"),
    ("core", "only what docs/python.md lists is here"),
    ("ufunc", "call the functions by name"),
    ("generic", "numbers are Python's own float, int and bool"),
    ("printoptions", "write f-strings"),
    ("array2string", "use str(a) or f-strings"),
    ("finfo", "float64: eps is 2.220446049250313e-16"),
    (
        "iinfo",
        "int64 goes from -2**63 to 2**63 - 1; arrays here hold whole numbers exactly to 2**53",
    ),
];

/// What is left out of `numpy.linalg`.
pub const LINALG: &[Absent] = &[
    ("eig", "use np.linalg.eigh for symmetric matrices"),
    ("eigvals", "use np.linalg.eigvalsh for symmetric matrices"),
    ("tensorsolve", "arrays here have at most 2 dimensions"),
    ("tensorinv", "arrays here have at most 2 dimensions"),
    ("multi_dot", "use the operator @"),
    ("svdvals", "use np.linalg.svd(a, compute_uv=False)"),
    ("vector_norm", "use np.linalg.norm"),
    ("matrix_norm", "use np.linalg.norm"),
    ("matmul", "use the operator @"),
    ("outer", "use np.outer"),
    ("cross", "use np.cross"),
    ("trace", "use np.trace"),
    ("diagonal", "use np.diag"),
];

/// The sentence for a name that `module` does not have, `known` being the names it has.
#[must_use]
pub fn sentence(module: &str, name: &str, known: &[&str]) -> String {
    if let Some(advice) = advice(module, name) {
        return format!(
            "{module} here has no `{name}`: {advice}; docs/python.md lists what there is"
        );
    }
    let mut sentence = format!("module '{module}' has no attribute '{name}'");
    let elsewhere = match module {
        "numpy" => Some("numpy.linalg"),
        "numpy.linalg" | "math" => Some("numpy"),
        _ => None,
    };
    let has = |module: &str| {
        crate::module::names()
            .iter()
            .any(|(known, names)| *known == module && names.contains(&name))
    };
    if let Some(other) = elsewhere.filter(|other| has(other)) {
        let short = other.replace("numpy", "np");
        sentence.push_str(&format!(". Did you mean: '{short}.{name}'?"));
    } else if !name.starts_with('_')
        && let Some(near) = nearest(name, known)
    {
        sentence.push_str(&format!(". Did you mean: '{near}'?"));
    }
    sentence
}

/// What to do instead of a name of real numpy that is left out of `module`; for sentences about failing imports too.
#[must_use]
pub fn advice(module: &str, name: &str) -> Option<&'static str> {
    let absent = match module {
        "numpy" => NUMPY,
        "numpy.linalg" => LINALG,
        _ => return None,
    };
    let found = absent.iter().find(|(absent, _)| *absent == name);
    found.map(|(_, advice)| *advice)
}

/// The name that `name` was meant to be: a longer or shorter form of it (`qdot` of `qd`), or one with few changes.
#[must_use]
pub fn meant<'names>(name: &str, known: &'names [String]) -> Option<&'names str> {
    if name.chars().count() > 40 {
        return None;
    }
    let name = name.to_lowercase();
    let most = (name.chars().count() / 3).max(1);
    let changes = |known: &&String| {
        let lower = known.to_lowercase();
        let is_form = lower.starts_with(&name) || name.starts_with(&lower);
        match is_form && lower.len().min(name.len()) > 1 {
            true => 1,
            false => distance(&name, &lower),
        }
    };
    let ranked = known.iter().map(|known| (changes(&known), known));
    let found = ranked.filter(|(changes, _)| *changes <= most);
    found
        .min_by_key(|(changes, _)| *changes)
        .map(|(_, known)| known.as_str())
}

/// The known name with the fewest changes from `name`, if they are few.
fn nearest<'names>(name: &str, known: &[&'names str]) -> Option<&'names str> {
    let allowed = 1 + name.len() / 4;
    known
        .iter()
        .map(|candidate| (distance(name, candidate), *candidate))
        .filter(|(changes, _)| *changes <= allowed)
        .min()
        .map(|(_, candidate)| candidate)
}

/// The number of letters to insert, delete, replace or exchange with their neighbour (Damerau's distance).
fn distance(left: &str, right: &str) -> usize {
    let left: Vec<char> = left.to_lowercase().chars().collect();
    let right: Vec<char> = right.to_lowercase().chars().collect();
    let width = right.len() + 1;
    let mut table = vec![0; (left.len() + 1) * width];
    for row in 0..=left.len() {
        for column in 0..=right.len() {
            let value = if row == 0 || column == 0 {
                row + column
            } else {
                let (here, there) = (left[row - 1], right[column - 1]);
                let changed = table[(row - 1) * width + column - 1] + usize::from(here != there);
                let gap =
                    table[(row - 1) * width + column].min(table[row * width + column - 1]) + 1;
                let swapped =
                    row > 1 && column > 1 && here == right[column - 2] && left[row - 2] == there;
                let exchanged = if swapped {
                    table[(row - 2) * width + column - 2] + 1
                } else {
                    usize::MAX
                };
                changed.min(gap).min(exchanged)
            };
            table[row * width + column] = value;
        }
    }
    table[left.len() * width + right.len()]
}
