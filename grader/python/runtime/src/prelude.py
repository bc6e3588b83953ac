# What submissions find besides Python's own: the objects they are given, the modules they can import, and words for what is not there.
# It runs once, when the runtime is made.
import builtins as _builtins


class Record:
    """An object with fields, which are also entries: `robot.name` is `robot["name"]`."""

    def __getattr__(self, name):
        raise AttributeError(_no_field_of(self, name), name=name, obj=self)

    def __getitem__(self, name):
        try:
            return self.__dict__[name]
        except KeyError:
            raise KeyError(_no_field_of(self, name)) from None

    def __setitem__(self, name, value):
        self.__dict__[name] = value

    def __contains__(self, name):
        return name in self.__dict__

    def __iter__(self):
        return iter(self.__dict__)

    def __len__(self):
        return len(self.__dict__)

    def keys(self):
        return self.__dict__.keys()

    def values(self):
        return self.__dict__.values()

    def items(self):
        return self.__dict__.items()

    def get(self, name, default=None):
        return self.__dict__.get(name, default)

    def __repr__(self):
        fields = ", ".join(f"{name}={value!r}" for name, value in self.__dict__.items())
        return f"{type(self).__name__}({fields})"


def _no_field(what, names, name):
    near = _nearest(name, names)
    if near is not None:
        return f"{what} has no {name!r}. Did you mean: {near!r}?"
    return f"{what} has no {name!r}; it has {', '.join(names) or 'nothing'}"


def _no_field_of(record, name):
    return _no_field(type(record).__name__.lower(), list(record.__dict__), name)


def _distance(a, b):
    row = list(range(len(b) + 1))
    for i, x in enumerate(a):
        last, row[0] = row[0], i + 1
        for j, y in enumerate(b):
            last, row[j + 1] = row[j + 1], min(row[j] + 1, row[j + 1] + 1, last + (x != y))
    return row[-1]


def _nearest(name, names):
    if not isinstance(name, str) or len(name) > 40:
        return None
    best, least = None, max(1, len(name) // 3) + 1
    name = name.lower()
    for known in names:
        lower = known.lower()
        # a longer or shorter form of it: qdot of qd
        if min(len(lower), len(name)) > 1 and (name.startswith(lower) or lower.startswith(name)):
            there = 1
        elif abs(len(lower) - len(name)) >= least:
            continue
        else:
            there = _distance(name, lower)
        if there < least:
            best, least = known, there
    return best


class Robot(Record):
    def __getattr__(self, name):
        if name in ("fk", "jacobian", "gravity", "mass_matrix"):
            raise AttributeError(f"robot.{name} is not granted in this task", name=name, obj=self)
        return Record.__getattr__(self, name)


class Sensors(Record):
    pass


class Target(Record):
    pass


class Given(Record):
    pass


def _module(name, names):
    made = type(_builtins)(name)
    made.__dict__.update(names)
    return made


def _future():
    names = ("annotations", "division", "print_function", "generator_stop", "absolute_import", "unicode_literals")
    return _module("__future__", {name: name for name in names})


class _Anything:
    """What stands for a type in an annotation: nothing is checked."""

    def __getitem__(self, _):
        return self

    def __call__(self, *_, **__):
        return self

    def __or__(self, _):
        return self

    __ror__ = __or__

    def __mro_entries__(self, _):
        return ()


def _typing():
    names = (
        "Any", "Callable", "ClassVar", "Dict", "Final", "Generic", "Iterable", "Iterator", "List", "Literal", "Mapping",
        "NoReturn", "Optional", "Protocol", "Self", "Sequence", "Set", "Tuple", "Type", "TypedDict", "Union",
    )
    anything = _Anything()
    module = {name: anything for name in names}
    module["TYPE_CHECKING"] = False
    module["NamedTuple"] = _NamedTupleKind("NamedTuple", (), {})
    module["cast"] = lambda _, value: value
    module["TypeVar"] = lambda *_, **__: anything
    module["final"] = module["override"] = module["overload"] = module["runtime_checkable"] = lambda it: it
    return _module("typing", module)


def _functools():
    import _functools as native

    def wraps(wrapped):
        def keep(wrapper):
            wrapper.__name__, wrapper.__doc__ = wrapped.__name__, wrapped.__doc__
            wrapper.__wrapped__ = wrapped
            return wrapper

        return keep

    def lru_cache(maxsize=128, typed=False):
        def remembering(function):
            known = {}

            @wraps(function)
            def wrapper(*arguments):
                if arguments not in known:
                    if maxsize is not None and len(known) >= maxsize:
                        known.pop(next(iter(known)), None)
                    known[arguments] = function(*arguments)
                return known[arguments]

            wrapper.cache_clear = known.clear
            return wrapper

        if callable(maxsize):
            function, maxsize = maxsize, 128
            return remembering(function)
        return remembering

    names = {"reduce": native.reduce, "partial": native.partial, "cmp_to_key": native.cmp_to_key, "wraps": wraps}
    names.update(lru_cache=lru_cache, cache=lambda function: lru_cache(None)(function))
    return _module("functools", names)


def _namedtuple(name, fields, *, defaults=()):
    if isinstance(fields, str):
        fields = fields.replace(",", " ").split()
    fields = tuple(fields)
    defaults = dict(zip(fields[len(fields) - len(defaults):], defaults))

    def make(cls, *values, **named):
        for field in fields[len(values):]:
            if field in named:
                values += (named.pop(field),)
            elif field in defaults:
                values += (defaults[field],)
            else:
                raise TypeError(f"{name}.__new__() missing 1 required positional argument: {field!r}")
        if named or len(values) > len(fields):
            raise TypeError(f"{name}.__new__() takes {len(fields)} arguments: {', '.join(fields)}")
        return tuple.__new__(cls, values)

    def show(self):
        return f"{name}({', '.join(f'{field}={value!r}' for field, value in zip(fields, self))})"

    members = {"__new__": make, "__repr__": show, "_fields": fields, "__slots__": ()}
    members["_asdict"] = lambda self: dict(zip(fields, self))
    members["_replace"] = lambda self, **named: type(self)(**{**self._asdict(), **named})
    for i, field in enumerate(fields):
        members[field] = property(lambda self, i=i: self[i])
    return type(name, (tuple,), members)


class _NamedTupleKind(type):
    """What makes a named tuple of a class with annotated fields."""

    def __new__(meta, name, bases, members):
        if not bases:
            return type.__new__(meta, name, bases, members)
        fields = list(type(name, (), dict(members)).__annotations__)
        made = _namedtuple(name, fields, defaults=[members[field] for field in fields if field in members])
        for key, value in members.items():
            if key not in fields and not key.startswith("__"):
                setattr(made, key, value)
        return made


def _collections():
    import _collections as native

    class Counter(dict):
        def __init__(self, items=()):
            for item in items:
                self[item] = self[item] + 1

        def __missing__(self, _):
            return 0

    names = {"deque": native.deque, "defaultdict": native.defaultdict, "OrderedDict": dict, "Counter": Counter}
    names["namedtuple"] = _namedtuple
    return _module("collections", names)


_MISSING = object()


class _Field:
    def __init__(self, default, default_factory):
        self.default, self.default_factory = default, default_factory


def _dataclass(cls=None, *, init=True, repr=True, eq=True, order=False, frozen=False, slots=False, kw_only=False):
    def make(cls):
        fields = dict(getattr(cls, "_fields", {}))
        try:
            own = cls.__annotations__
        except NameError as error:
            help = "write `from __future__ import annotations` at the top"
            raise NameError(f"{error} ({help})", name=error.name) from None
        for name in own:
            fields[name] = cls.__dict__.get(name, _MISSING)
            if isinstance(fields[name], (list, dict, set)):
                kind = type(fields[name])
                raise ValueError(f"mutable default {kind} for field {name} is not allowed: use default_factory")
            if isinstance(fields[name], _Field) and fields[name].default is _MISSING:
                delattr(cls, name)
        cls._fields = fields

        def start(self, *values, **named):
            if len(values) > len(fields):
                raise TypeError(f"{cls.__name__}.__init__() takes {len(fields) + 1} positional arguments but {len(values) + 1} were given")
            given = dict(zip(fields, values))
            for name, value in named.items():
                if name in given or name not in fields:
                    raise TypeError(f"{cls.__name__}.__init__() got an unexpected keyword argument {name!r}")
                given[name] = value
            for name, default in fields.items():
                if name in given:
                    value = given[name]
                elif isinstance(default, _Field) and default.default_factory is not _MISSING:
                    value = default.default_factory()
                elif isinstance(default, _Field):
                    value = default.default
                else:
                    value = default
                if value is _MISSING:
                    raise TypeError(f"{cls.__name__}.__init__() missing 1 required positional argument: {name!r}")
                object.__setattr__(self, name, value)
            if hasattr(self, "__post_init__"):
                self.__post_init__()

        def show(self):
            return f"{cls.__name__}({', '.join(f'{name}={getattr(self, name)!r}' for name in fields)})"

        def same(self, other):
            if type(self) is not type(other):
                return NotImplemented
            return all(getattr(self, name) == getattr(other, name) for name in fields)

        def refuse(self, name, *_):
            raise AttributeError(f"cannot assign to field {name!r}")

        for wanted, name, made in ((init, "__init__", start), (repr, "__repr__", show), (eq, "__eq__", same), (frozen, "__setattr__", refuse)):
            if wanted and name not in cls.__dict__:
                setattr(cls, name, made)
        return cls

    return make if cls is None else make(cls)


def _dataclasses():
    names = {"dataclass": _dataclass, "field": lambda *, default=_MISSING, default_factory=_MISSING, **_: _Field(default, default_factory)}
    names["asdict"] = lambda it: {name: getattr(it, name) for name in it._fields}
    return _module("dataclasses", names)


def _copy():
    def copy(it):
        if hasattr(it, "copy"):
            return it.copy()
        if isinstance(it, (int, float, str, tuple, bool, type(None))):
            return it
        made = object.__new__(type(it))
        made.__dict__.update(it.__dict__)
        return made

    def deepcopy(it):
        if isinstance(it, (list, tuple, set)):
            return type(it)(deepcopy(one) for one in it)
        if isinstance(it, dict):
            return {name: deepcopy(one) for name, one in it.items()}
        made = copy(it)
        if hasattr(made, "__dict__") and made is not it:
            for name, one in made.__dict__.items():
                made.__dict__[name] = deepcopy(one)
        return made

    return _module("copy", {"copy": copy, "deepcopy": deepcopy})


def _abc():
    return _module("abc", {"ABC": object, "ABCMeta": type, "abstractmethod": lambda it: it})


def _enum():
    class Kind(type):
        def __new__(meta, name, bases, members):
            made = type.__new__(meta, name, bases, dict(members))
            made._all = {}
            for key, value in members.items():
                if bases and not key.startswith("_") and not callable(value) and not isinstance(value, (property, classmethod, staticmethod)):
                    if isinstance(value, _Auto):
                        value = len(made._all) + 1
                    one = int.__new__(made, value) if issubclass(made, int) else object.__new__(made)
                    one.name, one.value = key, value
                    type.__setattr__(made, key, one)
                    made._all[key] = one
            return made

        def __iter__(cls):
            return iter(cls._all.values())

        def __len__(cls):
            return len(cls._all)

        def __getitem__(cls, name):
            return cls._all[name]

        def __call__(cls, value):
            for one in cls._all.values():
                if one.value == value:
                    return one
            raise ValueError(f"{value!r} is not a valid {cls.__name__}")

    class _Auto:
        pass

    class Enum(metaclass=Kind):
        def __repr__(self):
            return f"<{type(self).__name__}.{self.name}: {self.value!r}>"

        def __str__(self):
            return f"{type(self).__name__}.{self.name}"

    class IntEnum(int, Enum):
        pass

    return _module("enum", {"Enum": Enum, "IntEnum": IntEnum, "auto": _Auto})


def _import_function(modules):
    nothing = {
        "random": "there is no chance: every run is the same",
        "secrets": "there is no chance: every run is the same",
        "time": "there is no clock: observation.time is the time of the simulation",
        "datetime": "there is no clock: observation.time is the time of the simulation",
        "os": "there are no files and no system",
        "sys": "there are no files and no system",
        "io": "there are no files and no system",
        "pathlib": "there are no files and no system",
        "subprocess": "there are no files and no system",
        "socket": "there is no network",
        "requests": "there is no network",
        "urllib": "there is no network",
        "threading": "there are no threads",
        "multiprocessing": "there are no threads",
        "asyncio": "there are no threads",
        "scipy": "numpy has linalg.solve, inv, pinv and norm",
        "sympy": "write the formula out",
        "matplotlib": 'plot("name", value) adds a signal to the report',
        "pandas": "use lists and numpy",
        "roboticstoolbox": "write the kinematics yourself, or use what the task grants on robot",
        "logging": "print writes to the log",
    }

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
                        raise ImportError(str(error), name=name) from None
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
    own.__dict__.update(Robot=Robot, Sensors=Sensors, Given=Given)
    operator = {name: value for name, value in _operator.__dict__.items() if not name.startswith("__")}
    modules.update(
        itertools=itertools,
        operator=_module("operator", operator),
        __future__=_future(),
        typing=_typing(),
        functools=_functools(),
        collections=_collections(),
        dataclasses=_dataclasses(),
        copy=_copy(),
        abc=_abc(),
        enum=_enum(),
    )
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
