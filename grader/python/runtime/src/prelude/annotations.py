# `typing`, `abc` and `collections.abc`: names for annotations, which nothing checks.
import builtins as _builtins


def _module(name, names):
    made = type(_builtins)(name)
    made.__dict__.update(names)
    return made


class _Anything:
    """What stands for a type in an annotation."""

    def __init__(self, name):
        self.__name__ = name

    def __repr__(self):
        return f"typing.{self.__name__}"

    def __getitem__(self, _):
        return self

    def __call__(self, *_, **__):
        return self

    def __or__(self, _):
        return self

    __ror__ = __or__

    def __mro_entries__(self, _):
        return (dict,) if self.__name__ == "TypedDict" else (_Generic,)

    def __instancecheck__(self, it):
        if self.__name__ in ("Callable", "Hashable"):
            return callable(it) if self.__name__ == "Callable" else type(it).__hash__ is not None
        wanted = _METHODS.get(self.__name__)
        if wanted is None:
            raise TypeError(f"typing.{self.__name__} cannot be used with isinstance()")
        return all(hasattr(type(it), name) for name in wanted) and not (
            self.__name__ in ("Sequence", "MutableSequence") and isinstance(it, dict)
        )


class _Generic:
    """What a class has of `Generic[T]` and of `Protocol`."""

    def __class_getitem__(cls, _):
        return cls


# by what `isinstance` knows the kinds of collections.abc
_METHODS = {
    "Iterable": ["__iter__"],
    "Iterator": ["__iter__", "__next__"],
    "Generator": ["__iter__", "send"],
    "Sized": ["__len__"],
    "Container": ["__contains__"],
    "Collection": ["__iter__", "__len__", "__contains__"],
    "Sequence": ["__iter__", "__len__", "__getitem__", "index"],
    "MutableSequence": ["__iter__", "__len__", "__setitem__", "append"],
    "Mapping": ["keys", "__getitem__"],
    "MutableMapping": ["keys", "__setitem__"],
    "Set": ["isdisjoint"],
    "MutableSet": ["isdisjoint", "add"],
}

_CLASS_VAR, _INIT_VAR = _Anything("ClassVar"), _Anything("InitVar")


def _future():
    names = ("annotations", "division", "print_function", "generator_stop", "absolute_import", "unicode_literals")
    return _module("__future__", {name: name for name in names})


def _typing():
    names = (
        "Annotated", "Any", "AnyStr", "Callable", "Collection", "Container", "Counter", "DefaultDict", "Deque", "Dict", "Final",
        "FrozenSet", "Generator", "Generic", "Hashable", "Iterable", "Iterator", "List", "Literal", "Mapping", "MutableMapping",
        "MutableSequence", "MutableSet", "Never", "NoReturn", "Optional", "OrderedDict", "ParamSpec", "Protocol", "Self", "Sequence",
        "Set", "Sized", "SupportsFloat", "SupportsIndex", "SupportsInt", "Tuple", "Type", "TypeAlias", "TypedDict", "TypeGuard", "Union",
    )
    module = {name: _Anything(name) for name in names}
    module["ClassVar"] = _CLASS_VAR
    module["TYPE_CHECKING"] = False
    module["NamedTuple"] = _NamedTupleKind("NamedTuple", (), {})
    module["cast"] = lambda _, value: value
    module["NewType"] = lambda _, kind: kind
    module["TypeVar"] = lambda name, *_, **__: _Anything(name)
    module["get_type_hints"] = lambda it: dict(getattr(it, "__annotations__", {}))
    for name in ("final", "override", "overload", "runtime_checkable", "no_type_check"):
        module[name] = lambda it: it
    return _module("typing", module)


def _abc():
    class ABC:
        pass

    names = {"ABC": ABC, "ABCMeta": type, "abstractmethod": lambda it: it, "abstractproperty": property}
    return _module("abc", names)


def _collections_abc():
    names = ["Callable", "Hashable", *_METHODS]
    return _module("collections.abc", {name: _Anything(name) for name in names})
