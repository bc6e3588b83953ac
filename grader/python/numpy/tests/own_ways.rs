//! What differs from numpy knowingly, and what a comparison with numpy cannot show: sentences about missing names, limits, the Rust interface.

#![expect(clippy::unwrap_used, reason = "a test may stop")]

use kinemark_python_numpy::NdArray;
use rustpython_vm::{AsObject as _, Interpreter, PyObjectRef, VirtualMachine, compiler::Mode};

fn with_modules<R>(run: impl FnOnce(&VirtualMachine) -> R) -> R {
    Interpreter::builder(Default::default())
        .build()
        .enter(|vm| {
            assert!(kinemark_python_numpy::install(vm).is_ok());
            run(vm)
        })
}

/// The value of `result` after a program, or the exception's type and sentence.
fn result(program: &str, vm: &VirtualMachine) -> Result<PyObjectRef, String> {
    let scope = vm.new_scope_with_builtins();
    let run = || {
        let code = vm
            .compile(program, Mode::Exec, "program".to_owned())
            .unwrap();
        vm.run_code_obj(code, scope.clone())?;
        scope.globals.get_item("result", vm)
    };
    run().map_err(|error| {
        let sentence = error.as_object().str(vm).map_or_else(
            |_| String::new(),
            |text| text.to_string_lossy().into_owned(),
        );
        format!("{}: {sentence}", error.class().name())
    })
}

/// Compares the `repr` of the result, or the exception, of each program with what is expected.
fn check(cases: &[(&str, &str)]) {
    with_modules(|vm| {
        for (program, expected) in cases {
            let program = format!("import math\nimport numpy as np\n{program}");
            let found = match result(&program, vm) {
                Ok(object) => object.repr(vm).unwrap().to_string_lossy().into_owned(),
                Err(sentence) => sentence,
            };
            assert_eq!(&found, expected, "{program}");
        }
    });
}

#[test]
fn missing_names_say_what_to_do() {
    check(&[
        (
            "np.arctn",
            "AttributeError: module 'numpy' has no attribute 'arctn'. Did you mean: 'arctan'?",
        ),
        (
            "np.random",
            "AttributeError: numpy here has no `random`: every run is the same; docs/python.md lists what there is",
        ),
        (
            "np.linalg.eig",
            "AttributeError: numpy.linalg here has no `eig`: use np.linalg.eigh for symmetric matrices; docs/python.md lists what there is",
        ),
        (
            "np.linalg.slove",
            "AttributeError: module 'numpy.linalg' has no attribute 'slove'. Did you mean: 'solve'?",
        ),
        (
            "math.sine",
            "AttributeError: module 'math' has no attribute 'sine'. Did you mean: 'sin'?",
        ),
        (
            "np.xyzzyx",
            "AttributeError: module 'numpy' has no attribute 'xyzzyx'",
        ),
        (
            "np.__file__",
            "AttributeError: module 'numpy' has no attribute '__file__'",
        ),
        (
            "result = hasattr(np, 'random'), hasattr(np, 'sin')",
            "(False, True)",
        ),
        (
            "result = np.array([1]).foo",
            "AttributeError: 'numpy.ndarray' object has no attribute 'foo'",
        ),
        (
            "import numpy.random",
            "ModuleNotFoundError: No module named 'numpy.random'",
        ),
        (
            "from numpy import random",
            "ImportError: cannot import name 'random' from 'numpy' (unknown location)",
        ),
    ]);
    assert_eq!(
        kinemark_python_numpy::absent::advice("numpy", "random"),
        Some("every run is the same")
    );
    assert_eq!(
        kinemark_python_numpy::absent::advice("math", "random"),
        None
    );
}

#[test]
fn modules_are_found_by_every_form_of_import() {
    check(&[
        ("import numpy.linalg as la\nresult = la.norm([3, 4])", "5.0"),
        (
            "import numpy.linalg\nresult = numpy.linalg.norm([3, 4])",
            "5.0",
        ),
        (
            "from numpy import linalg\nresult = linalg.det([[2]])",
            "2.0",
        ),
        (
            "from numpy.linalg import inv, norm, LinAlgError\nresult = LinAlgError.__mro__[1].__name__",
            "'ValueError'",
        ),
        (
            "from numpy import array, pi\nresult = array([pi])",
            "array([3.14159265])",
        ),
        (
            "from numpy import *\nresult = sin(array([0]))",
            "array([0.])",
        ),
        ("from math import *\nresult = floor(2.5)", "2"),
        (
            "import numpy.typing as npt\ndef f(a: npt.NDArray[np.float64]) -> np.ndarray: return a\nresult = f(1)",
            "1",
        ),
        ("result = __import__('sys').modules['numpy'] is np", "True"),
        (
            "result = np.__name__, np.linalg.__name__",
            "('numpy', 'numpy.linalg')",
        ),
    ]);
}

#[test]
fn numbers_out_of_arrays_are_pythons() {
    check(&[
        (
            "result = np.array([1.5])[0], np.array([1])[0], np.array([True])[0]",
            "(1.5, 1, True)",
        ),
        (
            "result = np.float64 is float, np.int64 is int, np.bool_ is bool",
            "(True, True, True)",
        ),
        (
            "result = np.array([1.0])[0] / 0",
            "ZeroDivisionError: division by zero",
        ),
        ("result = np.array([2])[0] ** -1", "0.5"),
        (
            "result = float(np.array([2.5])), int(np.array([[2.5]])), math.sqrt(np.array([4]))",
            "(2.5, 2, 2.0)",
        ),
        (
            "result = np.zeros(2)\nresult[0] = np.array([3])",
            "array([3., 0.])",
        ),
        (
            "math.sin(np.array([1, 2]))",
            "TypeError: only length-1 arrays can be converted to Python scalars",
        ),
        (
            "math.sin([1, 2])",
            "TypeError: must be real number, not list",
        ),
    ]);
}

#[test]
fn what_arrays_do_not_hold_is_refused() {
    check(&[
        (
            "np.array([[[1]]])",
            "ValueError: arrays here have at most 2 dimensions",
        ),
        (
            "np.zeros((2, 2, 2))",
            "ValueError: arrays here have at most 2 dimensions",
        ),
        (
            "np.eye(2)[None]",
            "ValueError: arrays here have at most 2 dimensions",
        ),
        (
            "np.stack([np.eye(2), np.eye(2)])",
            "ValueError: arrays here have at most 2 dimensions",
        ),
        (
            "np.array(['a'])",
            "TypeError: arrays here hold numbers and bools, not 'str'",
        ),
        (
            "np.array([1, None])",
            "TypeError: arrays here hold numbers and bools, not 'NoneType'",
        ),
        (
            "np.array(1j)",
            "TypeError: arrays here hold numbers and bools, not 'complex'",
        ),
        (
            "np.array({1: 2})",
            "TypeError: arrays here hold numbers and bools, not 'dict'",
        ),
        (
            "a = np.zeros(2)\na[0] = None",
            "TypeError: arrays here hold numbers and bools, not 'NoneType'",
        ),
        (
            "np.array([2 ** 70])",
            "OverflowError: Python int too large to convert to C long",
        ),
        (
            "np.zeros(2, dtype=complex)",
            "TypeError: data type complex not understood: arrays here are float64, int64 or bool",
        ),
        (
            "np.zeros(2, dtype='float32')",
            "TypeError: data type 'float32' not understood: arrays here are float64, int64 or bool",
        ),
        (
            "np.ndarray((2, 2))",
            "TypeError: arrays are made with np.array, np.zeros and their like",
        ),
    ]);
}

#[test]
fn large_arrays_are_refused_before_memory_is_taken() {
    let sentence = |count: &str| {
        format!("MemoryError: an array of {count} elements: arrays here have at most 1000000")
    };
    for (program, count) in [
        ("np.zeros(1000001)", "1000001"),
        ("np.zeros((2000, 2000))", "4000000"),
        ("np.ones((10 ** 15, 10 ** 5))", "214748364700000"),
        ("np.arange(10 ** 12)", "1000000000000"),
        ("np.zeros(10 ** 15)", "2147483647"),
        ("np.arange(0, 1, 1e-300)", "18446744073709551615"),
        ("np.linspace(0, 1, 10 ** 9)", "1000000000"),
        ("np.eye(10 ** 6)", "1000000000000"),
        ("np.tile([1, 2], 10 ** 9)", "2000000000"),
        ("np.repeat([1, 2], 10 ** 9)", "2000000000"),
        ("np.outer(np.arange(2000), np.arange(2000))", "4000000"),
        ("np.arange(2000)[:, None] + np.arange(2000)", "4000000"),
        (
            "np.arange(2000)[:, None] @ np.arange(2000)[None]",
            "4000000",
        ),
        ("np.array(range(10 ** 9))", "1000000000"),
        ("np.array([0] * 1000001)", "1000001"),
        ("a = np.zeros(600000)\nnp.concatenate([a, a])", "1200000"),
        ("np.kron(np.eye(100), np.eye(100))", "100000000"),
        ("np.linalg.qr(np.ones((2000, 1)))", "4000000"),
        ("np.linalg.svd(np.ones((2000, 1)))", "4000000"),
        ("np.diag(np.arange(2000))", "4000000"),
        ("np.broadcast_to(1, (2000, 2000))", "4000000"),
        ("np.meshgrid(np.arange(2000), np.arange(2000))", "4000000"),
    ] {
        let count = if cfg!(target_pointer_width = "64") {
            count
        } else {
            continue;
        };
        check(&[(program, &sentence(count))]);
    }
}

#[test]
fn arrays_pass_between_rust_and_python() {
    with_modules(|vm| {
        let scope = vm.new_scope_with_builtins();
        let vector = vm.new_pyobj(NdArray::from_vector(vec![1.0, 2.0]));
        let matrix = vm.new_pyobj(NdArray::from_matrix(
            2,
            3,
            vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        ));
        scope.globals.set_item("vector", vector, vm).unwrap();
        scope.globals.set_item("matrix", matrix, vm).unwrap();
        let code = vm
            .compile(
                "product = vector @ matrix\nturned = matrix.T[:2]\nflags = vector > 1",
                Mode::Exec,
                "program".to_owned(),
            )
            .unwrap();
        vm.run_code_obj(code, scope.clone()).unwrap();
        let array = |name: &str| {
            scope
                .globals
                .get_item(name, vm)
                .unwrap()
                .downcast::<NdArray>()
                .unwrap()
        };
        assert_eq!(array("product").to_f64(), [9.0, 12.0, 15.0]);
        assert_eq!(array("turned").shape(), [2, 2]);
        assert_eq!(array("turned").to_f64(), [1.0, 4.0, 2.0, 5.0]);
        assert!(array("flags").is_bool());
        assert!(!array("product").is_bool());
    });
}

#[test]
fn every_listed_name_is_there() {
    with_modules(|vm| {
        for (module, names) in kinemark_python_numpy::names() {
            assert!(names.is_sorted() && names.len() > 10, "{module}");
            for name in names {
                let program = format!("from {module} import {name} as result");
                assert!(result(&program, vm).is_ok(), "{program}");
            }
        }
    });
}

#[test]
fn nothing_that_is_there_is_listed_as_absent() {
    with_modules(|vm| {
        for (module, absent) in [
            ("numpy", kinemark_python_numpy::absent::NUMPY),
            ("numpy.linalg", kinemark_python_numpy::absent::LINALG),
        ] {
            for (name, _) in absent {
                let program = format!("from {module} import {name} as result");
                assert!(result(&program, vm).is_err(), "{program}");
            }
        }
    });
}

#[test]
fn a_run_has_the_same_bits_on_every_machine() {
    // a change here changes grades: the numbers are those of the crate libm
    check(&[
        (
            "result = np.sin(np.array([1.0, 2.0, 3.0])).tolist()",
            "[0.8414709848078965, 0.9092974268256817, 0.1411200080598672]",
        ),
        (
            "result = np.exp(np.array([0.1, 10.5])).tolist()",
            "[1.1051709180756477, 36315.502674246636]",
        ),
    ]);
}

#[test]
fn what_is_no_step_or_period_is_refused() {
    check(&[
        (
            "np.gradient([1, 2], [])",
            "ValueError: when 1d, distances must match the length of the corresponding dimension",
        ),
        (
            "np.gradient([1, 2], np.zeros((0, 2)))",
            "ValueError: distances must be either scalars or 1d",
        ),
        (
            "np.unwrap([1.0, 2], period=[])",
            "ValueError: unwrap() here takes a number as period",
        ),
        (
            "np.diag([1, 2], -2 ** 63)",
            "MemoryError: an array of 4611686022722355201 elements: arrays here have at most 1000000",
        ),
    ]);
}
