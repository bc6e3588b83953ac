# `functools` and `bisect`.


def _wraps(wrapped, assigned=None, updated=None):
    def keep(wrapper):
        for name in ("__module__", "__name__", "__qualname__", "__doc__"):
            try:
                setattr(wrapper, name, getattr(wrapped, name))
            except AttributeError:
                pass
        wrapper.__dict__.update(getattr(wrapped, "__dict__", {}))
        wrapper.__wrapped__ = wrapped
        return wrapper

    return keep


def _lru_cache(maxsize=128, typed=False):
    def remembering(function):
        known = {}
        counted = [0, 0]

        @_wraps(function)
        def wrapper(*arguments, **named):
            key = (arguments, tuple(named.items())) if named else arguments
            if key in known:
                counted[0] += 1
                known[key] = known.pop(key)
                return known[key]
            counted[1] += 1
            value = function(*arguments, **named)
            if maxsize is not None and len(known) >= maxsize:
                known.pop(next(iter(known)), None)
            if maxsize != 0:
                known[key] = value
            return value

        def clear():
            known.clear()
            counted[:] = [0, 0]

        wrapper.cache_clear = clear
        wrapper.cache_info = lambda: _CacheInfo(counted[0], counted[1], maxsize, len(known))
        return wrapper

    if callable(maxsize):
        function, maxsize = maxsize, 128
        return remembering(function)
    return remembering


_CacheInfo = _namedtuple("CacheInfo", "hits misses maxsize currsize")


class _CachedProperty:
    def __init__(self, function):
        self.function, self.__doc__ = function, function.__doc__

    def __set_name__(self, _, name):
        self.name = name

    def __get__(self, it, _=None):
        if it is None:
            return self
        value = it.__dict__[self.name] = self.function(it)
        return value


def _total_ordering(cls):
    ways = {
        "__lt__": {
            "__gt__": lambda a, b: not (a < b or a == b),
            "__le__": lambda a, b: a < b or a == b,
            "__ge__": lambda a, b: not a < b,
        },
        "__le__": {
            "__ge__": lambda a, b: not a <= b or a == b,
            "__lt__": lambda a, b: a <= b and not a == b,
            "__gt__": lambda a, b: not a <= b,
        },
        "__gt__": {
            "__lt__": lambda a, b: not (a > b or a == b),
            "__ge__": lambda a, b: a > b or a == b,
            "__le__": lambda a, b: not a > b,
        },
        "__ge__": {
            "__le__": lambda a, b: not a >= b or a == b,
            "__gt__": lambda a, b: a >= b and not a == b,
            "__lt__": lambda a, b: not a >= b,
        },
    }
    for given, others in ways.items():
        if given in cls.__dict__:
            for name, method in others.items():
                if name not in cls.__dict__:
                    setattr(cls, name, method)
            return cls
    raise ValueError("must define at least one ordering operation: < > <= >=")


class _PartialMethod:
    def __init__(self, function, *arguments, **named):
        self.function, self.arguments, self.named = function, arguments, named

    def __get__(self, it, kind=None):
        def method(*arguments, **named):
            return self.function(it, *self.arguments, *arguments, **{**self.named, **named})

        return method


def _single_dispatch(function):
    known = {object: function}

    def register(kind, method=None):
        if method is None:
            return lambda method: register(kind, method)
        known[kind] = method
        return method

    @_wraps(function)
    def wrapper(it, *arguments, **named):
        for kind in type(it).__mro__:
            if kind in known:
                return known[kind](it, *arguments, **named)

    wrapper.register = register
    return wrapper


def _functools():
    import _functools as native

    names = {"reduce": native.reduce, "partial": native.partial, "cmp_to_key": native.cmp_to_key, "wraps": _wraps}
    names["update_wrapper"] = lambda wrapper, wrapped, *_: _wraps(wrapped)(wrapper)
    names.update(lru_cache=_lru_cache, cache=lambda function: _lru_cache(None)(function))
    names.update(cached_property=_CachedProperty, total_ordering=_total_ordering, partialmethod=_PartialMethod, singledispatch=_single_dispatch)
    return _module("functools", names)


def _place(a, x, lo, hi, key, is_before):
    if lo < 0:
        raise ValueError("lo must be non-negative")
    hi = len(a) if hi is None else hi
    while lo < hi:
        middle = (lo + hi) // 2
        one = a[middle] if key is None else key(a[middle])
        if is_before(one, x):
            lo = middle + 1
        else:
            hi = middle
    return lo


def _bisect_left(a, x, lo=0, hi=None, *, key=None):
    return _place(a, x, lo, hi, key, lambda one, x: one < x)


def _bisect_right(a, x, lo=0, hi=None, *, key=None):
    return _place(a, x, lo, hi, key, lambda one, x: not x < one)


def _insort_left(a, x, lo=0, hi=None, *, key=None):
    a.insert(_bisect_left(a, x if key is None else key(x), lo, hi, key=key), x)


def _insort_right(a, x, lo=0, hi=None, *, key=None):
    a.insert(_bisect_right(a, x if key is None else key(x), lo, hi, key=key), x)


def _bisect():
    names = {"bisect": _bisect_right, "bisect_left": _bisect_left, "bisect_right": _bisect_right}
    names.update(insort=_insort_right, insort_left=_insort_left, insort_right=_insort_right)
    return _module("bisect", names)
