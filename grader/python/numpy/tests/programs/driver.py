# Runs one case and describes its result as a text without numbers and the numbers. The same text runs in RustPython and in CPython.
import math

import numpy as np
import numpy.linalg as la


def describe(value, numbers):
    if value is None or isinstance(value, str):
        return repr(value)
    if isinstance(value, (bool, np.bool_)):
        return str(bool(value))
    if isinstance(value, np.ndarray):
        numbers.extend([float(x) for x in value.flatten().tolist()])
        if value.ndim == 0:
            name = value.dtype.name
            return {"float64": "float", "int64": "int"}.get(name, str(bool(value)) if name == "bool" else name)
        return "array " + value.dtype.name + " " + str(tuple(int(n) for n in value.shape))
    if isinstance(value, (int, np.integer)):
        if abs(int(value)) > 2 ** 53:
            return str(int(value))
        numbers.append(float(value))
        return "int"
    if isinstance(value, (float, np.floating)):
        numbers.append(float(value))
        return "float"
    if isinstance(value, (list, tuple)):
        inner = ", ".join([describe(item, numbers) for item in value])
        return ("list(" if isinstance(value, list) else "tuple(") + inner + ")"
    if isinstance(value, np.dtype):
        return "dtype " + value.name
    return "object"


def kind_of(error):
    # numpy has private subclasses: the first type that a program can name counts
    for kind in type(error).__mro__:
        if kind.__name__ in ("LinAlgError", "AxisError") or kind.__module__ == "builtins":
            return kind.__name__


def run(block, expression):
    names = {"np": np, "la": la, "math": math}
    numbers = []
    try:
        exec(block, names)
        structure = describe(eval(expression, names), numbers)
    except Exception as error:
        return "raises " + kind_of(error), [], str(error)
    return structure, numbers, ""
