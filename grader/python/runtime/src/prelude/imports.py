# What can be imported, and words for what is not there. Its last function makes everything ready.
import builtins as _builtins


class _Output:
    """What `print(..., file=sys.stderr)` and `sys.stdout.flush()` need."""

    def write(self, text):
        print(text, end="")
        return len(text)

    def flush(self):
        pass


class _FloatInfo:
    epsilon, max, min, dig, mant_dig = 2.220446049250313e-16, 1.7976931348623157e308, 2.2250738585072014e-308, 15, 53


def _sys(ignored):
    names = {"unraisablehook": ignored, "maxsize": 2**63 - 1, "float_info": _FloatInfo, "byteorder": "little", "platform": "kinemark"}
    names.update(version="3.14", version_info=(3, 14, 0, "final", 0), argv=["submission.py"], stdout=_Output(), stderr=_Output())
    return _module("sys", names)


def _import_function(modules):
    nothing = {
        "random": "there is no chance: every run is the same",
        "secrets": "there is no chance: every run is the same",
        "time": "there is no clock: observation.time is the time of the simulation",
        "datetime": "there is no clock: observation.time is the time of the simulation",
        "os": "there are no files and no system",
        "io": "there are no files and no system",
        "pathlib": "there are no files and no system",
        "subprocess": "there are no files and no system",
        "socket": "there is no network",
        "requests": "there is no network",
        "urllib": "there is no network",
        "threading": "there are no threads",
        "multiprocessing": "there are no threads",
        "asyncio": "there are no threads",
        "scipy": "numpy has linalg.solve, inv, pinv, lstsq and norm, and np.interp",
        "statistics": "numpy has mean, median and std",
        "heapq": "use sorted, min and max",
        "decimal": "use float",
        "fractions": "use float",
        "string": "write the text itself",
        "json": "write the data as Python's own lists and dicts",
        "re": "use the methods of str",
        "warnings": "print writes to the log",
        "contextlib": "write a class with __enter__ and __exit__",
        "traceback": "an exception that is not caught is shown with its line",
        "types": "use type(it), or callable(it)",
        "inspect": "use type(it), or callable(it)",
        "cmath": "use two floats, or Python's complex",
        "sympy": "write the formula out",
        "matplotlib": 'plot("name", value) adds a signal to the report',
        "pandas": "use lists and numpy",
        "roboticstoolbox": "write the kinematics yourself, or use what the task grants on robot",
        "logging": "print writes to the log",
    }

    def ignored(it):
        try:
            print(f"Exception ignored in {it.object!r}: {it.exc_type.__name__}: {it.exc_value}")
        except Exception:
            print("Exception ignored")

    # the interpreter itself looks there for what to do with an exception that nobody can catch, as in __del__
    modules["sys"] = _sys(ignored)

    def __import__(name, globals=None, locals=None, fromlist=(), level=0):
        if level:
            raise ImportError("a submission is one file: there is nothing beside it to import", name=name)
        if name in modules:
            found = modules[name] if fromlist else modules[name.partition(".")[0]]
            for wanted in fromlist or ():
                if wanted != "*":
                    try:
                        getattr(found, wanted)
                    except AttributeError as error:
                        whole = f"{name}.{wanted}"
                        if whole in modules:
                            continue
                        why = str(error).removeprefix(f"module {name!r} has no attribute {wanted!r}")
                        why = why if why.startswith(".") or not why else f": {why}"
                        raise ImportError(f"cannot import name {wanted!r} from {name!r}{why}", name=name) from None
            return found
        first, _, rest = name.partition(".")
        why = nothing.get(first)
        if first in modules:
            try:
                getattr(modules[first], rest)
                why = f"{name} is no module"
            except AttributeError as error:
                why = str(error)
        if why is None:
            near = _nearest(first, list(modules))
            why = f"did you mean {near!r}?" if near else f"there are {', '.join(sorted(modules))}"
        raise ModuleNotFoundError(f"No module named {name!r}: {why}", name=name)

    return __import__


def _refusal(name, why):
    def refuse(*_, **__):
        raise NameError(f"name {name!r} is not there: {why}", name=name)

    refuse.__name__ = name
    return refuse


def _start(native):
    import itertools, _operator

    modules = dict(native)
    own = native["kinemark"]
    _builtins.quintic, _builtins.quintic_rate = own.quintic, own.quintic_rate
    own.__dict__.update(Robot=Robot, Sensors=Sensors, Given=Given, Target=Target, Record=Record)
    # what kinemark.pyi has for annotations
    own.__dict__.update({name: _Anything(name) for name in ("Vector", "Matrix", "Number")})
    operator = {name: value for name, value in _operator.__dict__.items() if not name.startswith("__")}
    modules.update(
        itertools=itertools,
        operator=_module("operator", operator),
        __future__=_future(),
        typing=_typing(),
        functools=_functools(),
        collections=_collections(),
        bisect=_bisect(),
        dataclasses=_dataclasses(),
        copy=_copy(),
        abc=_abc(),
        enum=_enum(),
    )
    abstract = _collections_abc()
    modules["collections"].abc = modules["collections.abc"] = abstract
    _builtins.__import__ = _import_function(modules)
    for name, why in (
        ("open", "there are no files"),
        ("input", "nobody types while a submission runs"),
        ("eval", "write the expression itself"),
        ("exec", "write the statements themselves"),
        ("compile", "write the code itself"),
        ("breakpoint", "use print and plot"),
        ("help", "docs/python.md lists what there is"),
        ("exit", "return ends a function"),
        ("quit", "return ends a function"),
    ):
        setattr(_builtins, name, _refusal(name, why))
