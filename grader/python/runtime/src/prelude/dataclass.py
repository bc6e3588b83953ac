# `dataclasses`, as Python 3.11 has it but for `slots` and `weakref_slot`, which change nothing here.


class _Missing:
    def __repr__(self):
        return "MISSING"


class _KeywordOnly:
    pass


_MISSING, _KW_ONLY = _Missing(), _KeywordOnly()


class FrozenInstanceError(AttributeError):
    pass


class _Field:
    def __init__(self, default, default_factory, init, repr, hash, compare, kw_only):
        self.name, self.type = None, None
        self.default, self.default_factory = default, default_factory
        self.init, self.repr, self.hash, self.compare, self.kw_only = init, repr, hash, compare, kw_only
        self.is_parameter_only = False


def _field(
    *, default=_MISSING, default_factory=_MISSING, init=True, repr=True, hash=None, compare=True, metadata=None, kw_only=_MISSING
):
    if default is not _MISSING and default_factory is not _MISSING:
        raise ValueError("cannot specify both default and default_factory")
    return _Field(default, default_factory, init, repr, hash, compare, kw_only)


def _is(annotation, what, name):
    """Whether an annotation is ClassVar, InitVar or KW_ONLY; with `from __future__ import annotations` it is a text."""
    if isinstance(annotation, str):
        return annotation.partition("[")[0].rpartition(".")[2].strip() == name
    return annotation is what


def _own_annotations(cls):
    if "__annotations__" in cls.__dict__:
        return cls.__dict__["__annotations__"]
    try:
        own = cls.__annotations__
    except NameError as error:
        help = "write `from __future__ import annotations` at the top"
        raise NameError(f"{error} ({help})", name=error.name) from None
    # those of a base are not its own
    return {} if any(own is getattr(base, "__annotations__", None) for base in cls.__mro__[1:-1]) else own


def _fields_of_class(cls, kw_only):
    fields = {}
    for base in cls.__mro__[-1:0:-1]:
        fields.update(base.__dict__.get("__dataclass_fields__", {}))
    for name, annotation in _own_annotations(cls).items():
        if _is(annotation, _KW_ONLY, "KW_ONLY"):
            kw_only = True
            continue
        if _is(annotation, _CLASS_VAR, "ClassVar"):
            continue
        default = cls.__dict__.get(name, _MISSING)
        made = default if isinstance(default, _Field) else _Field(default, _MISSING, True, True, None, True, _MISSING)
        made.name, made.type = name, annotation
        made.is_parameter_only = _is(annotation, _INIT_VAR, "InitVar")
        if made.kw_only is _MISSING:
            made.kw_only = kw_only
        if made.default is not _MISSING and type(made.default).__hash__ is None:
            raise ValueError(f"mutable default {type(made.default)} for field {name} is not allowed: use default_factory")
        if isinstance(default, _Field):
            if made.default is _MISSING:
                delattr(cls, name)
            else:
                setattr(cls, name, made.default)
        fields[name] = made
    for name, value in cls.__dict__.items():
        if isinstance(value, _Field) and name not in fields:
            raise TypeError(f"{name!r} is a field but has no type annotation")
    return fields


def _starter(cls, fields):
    places = [one for one in fields.values() if one.init and not one.kw_only]
    named = {one.name: one for one in fields.values() if one.init}
    has_default = False
    for one in places:
        if one.default is _MISSING and one.default_factory is _MISSING:
            if has_default:
                raise TypeError(f"non-default argument {one.name!r} follows default argument")
        else:
            has_default = True
    least = 1 + len([one for one in places if one.default is _MISSING and one.default_factory is _MISSING])
    head = f"{cls.__name__}.__init__()"
    everything = list(fields.values())
    has_more = hasattr(cls, "__post_init__")
    keep = object.__setattr__

    def __init__(self, *values, **given):
        if len(values) > len(places):
            raise TypeError(_too_many(head, least, len(places) + 1, len(values) + 1))
        for one, value in zip(places, values):
            if one.name in given:
                raise TypeError(f"{head} got multiple values for argument {one.name!r}")
            given[one.name] = value
        for name in given:
            if name not in named:
                raise TypeError(f"{head} got an unexpected keyword argument {name!r}")
        more, missing = [], []
        for one in everything:
            name = one.name
            if name in given:
                value = given[name]
            elif one.default_factory is not _MISSING:
                value = one.default_factory()
            elif one.default is not _MISSING:
                value = one.default
            else:
                if one.init:
                    missing.append(name)
                continue
            if one.is_parameter_only:
                more.append(value)
            else:
                keep(self, name, value)
        if missing:
            count = f"{len(missing)} required positional argument{'s' * (len(missing) > 1)}"
            names = [repr(name) for name in missing]
            names = " and ".join(names) if len(names) < 3 else ", ".join(names[:-1]) + ", and " + names[-1]
            raise TypeError(f"{head} missing {count}: {names}")
        if has_more:
            self.__post_init__(*more)

    return __init__


def _values(it, fields):
    return tuple([getattr(it, one.name) for one in fields])


def _order(name, compare, compared):
    def method(self, other):
        if type(other) is not type(self):
            return NotImplemented
        return compare(_values(self, compared), _values(other, compared))

    method.__name__ = name
    return method


def _dataclass(
    cls=None, *, init=True, repr=True, eq=True, order=False, unsafe_hash=False, frozen=False, match_args=True, kw_only=False,
    slots=False, weakref_slot=False,
):
    def make(cls):
        fields = _fields_of_class(cls, kw_only)
        cls.__dataclass_fields__ = fields
        kept = [one for one in fields.values() if not one.is_parameter_only]
        shown = [one for one in kept if one.repr]
        compared = [one for one in kept if one.compare]
        hashed = [one for one in kept if (one.compare if one.hash is None else one.hash)]

        def __repr__(self):
            return f"{type(self).__qualname__}({', '.join([f'{one.name}={getattr(self, one.name)!r}' for one in shown])})"

        def __eq__(self, other):
            if type(other) is not type(self):
                return NotImplemented
            return _values(self, compared) == _values(other, compared)

        def __hash__(self):
            return hash(_values(self, hashed))

        def __setattr__(self, name, value):
            if type(self) is cls or name in fields:
                raise FrozenInstanceError(f"cannot assign to field {name!r}")
            object.__setattr__(self, name, value)

        def __delattr__(self, name):
            raise FrozenInstanceError(f"cannot delete field {name!r}")

        own = cls.__dict__
        has_hash = own.get("__hash__") is not None
        if init:
            cls.__init__ = _starter(cls, fields)
        if repr and "__repr__" not in own:
            cls.__repr__ = __repr__
        if eq and "__eq__" not in own:
            cls.__eq__ = __eq__
        if order:
            if not eq:
                raise ValueError("eq must be true if order is true")
            for name, compare in (
                ("__lt__", lambda a, b: a < b), ("__le__", lambda a, b: a <= b), ("__gt__", lambda a, b: a > b), ("__ge__", lambda a, b: a >= b),
            ):
                if name in own:
                    raise TypeError(f"Cannot overwrite attribute {name} in class {cls.__name__}. Consider using functools.total_ordering")
                setattr(cls, name, _order(name, compare, compared))
        if frozen:
            cls.__setattr__, cls.__delattr__ = __setattr__, __delattr__
        if unsafe_hash or (eq and frozen and not has_hash):
            cls.__hash__ = __hash__
        elif eq and not has_hash:
            cls.__hash__ = None
        if match_args and "__match_args__" not in own:
            cls.__match_args__ = tuple([one.name for one in fields.values() if one.init and not one.kw_only])
        return cls

    return make if cls is None else make(cls)


def _fields_of(it):
    try:
        fields = it.__dataclass_fields__
    except AttributeError:
        raise TypeError("must be called with a dataclass type or instance") from None
    return tuple([one for one in fields.values() if not one.is_parameter_only])


def _is_instance(it):
    return hasattr(type(it), "__dataclass_fields__")


def _taken_apart(it, whole):
    if _is_instance(it):
        return whole([(one.name, _taken_apart(getattr(it, one.name), whole)) for one in _fields_of(it)])
    if isinstance(it, tuple) and hasattr(it, "_fields"):
        return type(it)(*[_taken_apart(one, whole) for one in it])
    if isinstance(it, (list, tuple)):
        return type(it)([_taken_apart(one, whole) for one in it])
    if isinstance(it, dict):
        return type(it)([(_taken_apart(key, whole), _taken_apart(value, whole)) for key, value in it.items()])
    return _deepcopy(it)


def _asdict(it, *, dict_factory=dict):
    if not _is_instance(it):
        raise TypeError("asdict() should be called on dataclass instances")
    return _taken_apart(it, dict_factory)


def _astuple(it, *, tuple_factory=tuple):
    if not _is_instance(it):
        raise TypeError("astuple() should be called on dataclass instances")
    return _taken_apart(it, lambda pairs: tuple_factory([value for _, value in pairs]))


def _replaced(it, /, **changes):
    if not _is_instance(it):
        raise TypeError("replace() should be called on dataclass instances")
    for one in it.__dataclass_fields__.values():
        if not one.init:
            if one.name in changes:
                raise ValueError(f"field {one.name} is declared with init=False, it cannot be specified with replace()")
        elif one.name not in changes:
            if one.is_parameter_only and one.default is _MISSING:
                raise ValueError(f"InitVar {one.name!r} must be specified with replace()")
            changes[one.name] = getattr(it, one.name)
    return type(it)(**changes)


def _dataclasses():
    names = {"dataclass": _dataclass, "field": _field, "fields": _fields_of, "asdict": _asdict, "astuple": _astuple, "replace": _replaced}
    names["is_dataclass"] = lambda it: hasattr(it, "__dataclass_fields__")
    names.update(FrozenInstanceError=FrozenInstanceError, MISSING=_MISSING, KW_ONLY=_KW_ONLY, InitVar=_INIT_VAR, Field=_Field)
    return _module("dataclasses", names)
