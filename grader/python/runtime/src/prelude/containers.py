# `collections`, `copy`, and the named tuples of `typing`.
import _collections as _native


def _too_many(head, least, most, given):
    """Python's words for more positional arguments than there are parameters."""
    takes = f"from {least} to {most}" if least < most else most
    return f"{head} takes {takes} positional argument{'s' * (most != 1)} but {given} were given"


def _namedtuple(typename, field_names, *, rename=False, defaults=None, module=None):
    name, fields = typename, field_names
    if isinstance(fields, str):
        fields = fields.replace(",", " ").split()
    fields = tuple([str(field) for field in fields])
    seen = set()
    for field in (name, *fields):
        if not field.isidentifier():
            raise ValueError(f"Type names and field names must be valid identifiers: {field!r}")
    for field in fields:
        if field.startswith("_"):
            raise ValueError(f"Field names cannot start with an underscore: {field!r}")
        if field in seen:
            raise ValueError(f"Encountered duplicate field name: {field!r}")
        seen.add(field)
    defaults = tuple(defaults or ())
    if len(defaults) > len(fields):
        raise TypeError("Got more default values than field names")
    defaults = dict(zip(fields[len(fields) - len(defaults):], defaults))
    count = len(fields)

    def make(cls, *values, **named):
        if len(values) == count and not named:
            return tuple.__new__(cls, values)
        if len(values) > count:
            raise TypeError(_too_many(f"{name}.__new__()", count + 1 - len(defaults), count + 1, len(values) + 1))
        missing = []
        for field in fields[len(values):]:
            if field in named:
                values += (named.pop(field),)
            elif field in defaults:
                values += (defaults[field],)
            else:
                missing.append(field)
        if named:
            raise TypeError(f"{name}.__new__() got an unexpected keyword argument {next(iter(named))!r}")
        if missing:
            names = " and ".join([repr(field) for field in missing])
            raise TypeError(f"{name}.__new__() missing {len(missing)} required positional argument{'s' * (len(missing) > 1)}: {names}")
        return tuple.__new__(cls, values)

    def show(self):
        return f"{type(self).__name__}({', '.join([f'{field}={value!r}' for field, value in zip(fields, self)])})"

    def made_of(cls, values):
        values = tuple(values)
        if len(values) != count:
            raise TypeError(f"Expected {count} arguments, got {len(values)}")
        return tuple.__new__(cls, values)

    def replaced(self, /, **named):
        values = [named.pop(field, value) for field, value in zip(fields, self)]
        if named:
            raise ValueError(f"Got unexpected field names: {list(named)!r}")
        return type(self)._make(values)

    members = {"__new__": make, "__repr__": show, "_fields": fields, "_field_defaults": defaults, "__match_args__": fields, "__slots__": ()}
    members["_make"] = classmethod(made_of)
    members["_asdict"] = lambda self: dict(zip(fields, self))
    members["_replace"] = replaced
    for i, field in enumerate(fields):
        members[field] = property(lambda self, i=i: self[i])
    return type(name, (tuple,), members)


class _NamedTupleKind(type):
    """What makes a named tuple of a class with annotated fields."""

    def __new__(meta, name, bases, members):
        if not bases:
            return type.__new__(meta, name, bases, members)
        body = type(name, (), dict(members))
        fields = list(body.__annotations__)
        made = _namedtuple(name, fields, defaults=[members[field] for field in fields if field in members])
        for key, value in members.items():
            if key in ("__new__", "__init__", "__slots__", "__getnewargs__", "_fields", "_make", "_replace", "_asdict"):
                raise AttributeError(f"Cannot overwrite NamedTuple attribute {key}")
            if key not in fields and (not key.startswith("__") or hasattr(value, "__get__")):
                setattr(made, key, value)
        made.__doc__, made.__annotations__ = members.get("__doc__"), body.__annotations__
        return made

    def __call__(cls, *arguments, **named):
        if cls.__name__ == "NamedTuple" and arguments:
            return _namedtuple(arguments[0], [name for name, _ in arguments[1]])
        return type.__call__(cls, *arguments, **named)


class Counter(dict):
    def __init__(self, iterable=None, /, **named):
        dict.__init__(self)
        self.update(iterable, **named)

    def __missing__(self, _):
        return 0

    def update(self, iterable=None, /, **named):
        self._count(iterable, 1)
        self._count(named, 1)

    def subtract(self, iterable=None, /, **named):
        self._count(iterable, -1)
        self._count(named, -1)

    def _count(self, iterable, sign):
        pairs = iterable.items() if isinstance(iterable, dict) else [(one, 1) for one in iterable or ()]
        for one, count in pairs:
            self[one] = self[one] + sign * count

    def most_common(self, n=None):
        return sorted(self.items(), key=lambda pair: pair[1], reverse=True)[:n]

    def total(self):
        return sum(self.values())

    def elements(self):
        return iter([one for one, count in self.items() for _ in range(count)])

    def copy(self):
        return Counter(self)

    def __add__(self, other):
        return Counter({one: self[one] + other[one] for one in {**self, **other} if self[one] + other[one] > 0})

    def __sub__(self, other):
        return Counter({one: self[one] - other[one] for one in {**self, **other} if self[one] - other[one] > 0})

    def __repr__(self):
        return f"Counter({dict(self.most_common())!r})" if self else "Counter()"


class OrderedDict(dict):
    def move_to_end(self, key, last=True):
        value = self.pop(key)
        rest = {} if last else dict(self)
        if not last:
            self.clear()
        self[key] = value
        self.update(rest)

    def popitem(self, last=True):
        if last or not self:
            return dict.popitem(self)
        key = next(iter(self))
        return key, self.pop(key)

    def copy(self):
        return OrderedDict(self)

    def __repr__(self):
        return f"OrderedDict({dict(self)!r})" if self else "OrderedDict()"


class ChainMap:
    def __init__(self, *maps):
        self.maps = list(maps) or [{}]

    def __getitem__(self, key):
        for one in self.maps:
            if key in one:
                return one[key]
        raise KeyError(key)

    def __setitem__(self, key, value):
        self.maps[0][key] = value

    def __contains__(self, key):
        return any([key in one for one in self.maps])

    def __iter__(self):
        return iter({key: None for one in reversed(self.maps) for key in one})

    def __len__(self):
        return len(list(iter(self)))

    def keys(self):
        return list(iter(self))

    def get(self, key, default=None):
        return self[key] if key in self else default


def _collections():
    names = {"deque": _native.deque, "defaultdict": _native.defaultdict, "OrderedDict": OrderedDict, "Counter": Counter, "ChainMap": ChainMap}
    names["namedtuple"] = _namedtuple
    return _module("collections", names)


# what a copy of is the thing itself
_ATOMIC = (int, float, complex, str, bytes, bool, type(None), type(...), type, range, slice, property, type(_module), type(len), type(_builtins))


def _copied(it):
    kind = type(it)
    if isinstance(it, _ATOMIC) and kind in _ATOMIC:
        return it
    if hasattr(kind, "__copy__"):
        return it.__copy__()
    if kind in (tuple, frozenset):
        return it
    if hasattr(kind, "copy") and kind in (list, dict, set):
        return it.copy()
    return _rebuilt(it, lambda one: one)


def _deepcopy(it, memo=None):
    kind = type(it)
    if kind in _ATOMIC or isinstance(it, type):
        return it
    memo = {} if memo is None else memo
    known = memo.get(id(it))
    if known is not None:
        return known
    if hasattr(kind, "__deepcopy__"):
        made = it.__deepcopy__(memo)
    elif kind is list:
        made = memo[id(it)] = []
        for one in it:
            made.append(_deepcopy(one, memo))
    elif kind is dict:
        made = memo[id(it)] = {}
        for key, one in it.items():
            made[_deepcopy(key, memo)] = _deepcopy(one, memo)
    elif kind in (tuple, set, frozenset):
        made = kind([_deepcopy(one, memo) for one in it])
    else:
        made = _rebuilt(it, lambda one: _deepcopy(one, memo), memo)
    memo[id(it)] = made
    # what was copied lives as long as its copy is known by its id
    memo.setdefault(id(memo), []).append(it)
    return made


def _rebuilt(it, each, memo=None):
    """A thing of the same class with the contents, entries and attributes of `it`, each copied by `each`."""
    kind = type(it)
    if isinstance(it, _native.deque):
        made = kind([each(one) for one in it], it.maxlen)
    elif isinstance(it, _native.defaultdict):
        made = kind(it.default_factory)
    elif isinstance(it, tuple):
        made = tuple.__new__(kind, [each(one) for one in it])
    elif isinstance(it, (list, set, dict)):
        made = kind.__new__(kind)
    elif hasattr(kind, "copy") and not hasattr(it, "__dict__"):
        # an array
        return it.copy()
    elif isinstance(it, (int, float, str)):
        made = kind.__new__(kind, it)
    else:
        try:
            made = object.__new__(kind)
        except TypeError:
            raise TypeError(f"cannot copy {kind.__name__!r} object") from None
    if memo is not None:
        memo[id(it)] = made
    if isinstance(it, dict):
        for key, one in it.items():
            dict.__setitem__(made, each(key), each(one))
    elif isinstance(it, list):
        for one in it:
            list.append(made, each(one))
    elif isinstance(it, set):
        for one in it:
            set.add(made, each(one))
    for name, one in getattr(it, "__dict__", {}).items():
        made.__dict__[name] = each(one)
    for base in kind.__mro__:
        names = base.__dict__.get("__slots__", ())
        for name in (names,) if isinstance(names, str) else names:
            if name != "__dict__" and hasattr(it, name) and not isinstance(it, tuple):
                object.__setattr__(made, name, each(getattr(it, name)))
    return made


def _copy():
    return _module("copy", {"copy": _copied, "deepcopy": _deepcopy, "Error": TypeError})
