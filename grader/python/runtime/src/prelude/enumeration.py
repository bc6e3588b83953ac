# `enum`: Enum, IntEnum, StrEnum and their companions, without flags.


class _Auto:
    pass


class _Members(dict):
    """The names of the class body, in which a member may not be defined twice."""

    def __setitem__(self, name, value):
        if name in self and not name.startswith("_") and not hasattr(value, "__get__"):
            raise TypeError(f"{name!r} already defined as {self[name]!r}")
        dict.__setitem__(self, name, value)


class EnumMeta(type):
    @classmethod
    def __prepare__(meta, name, bases, **_):
        return _Members()

    def __new__(meta, name, bases, body):
        for base in bases:
            if getattr(base, "_member_map_", None):
                raise TypeError(f"<enum {name!r}> cannot extend <enum {base.__name__!r}>")
        rest, members = {}, {}
        for key, value in body.items():
            is_member = bases and not key.startswith("_") and not hasattr(value, "__get__")
            (members if is_member else rest)[key] = value
        made = type.__new__(meta, name, bases, rest)
        made._member_map_ = {}
        data = None
        for base in made.__mro__[1:]:
            if base is not object and not isinstance(base, EnumMeta) and base.__new__ is not object.__new__:
                data = base
                break
        if bases and data is not None:
            # a member looks like one, not like the number or the text that it is
            for key in ("__repr__", "__str__", "__format__"):
                if getattr(made, key) is getattr(data, key):
                    type.__setattr__(made, key, getattr(Enum, key))
        values = []
        for key, value in members.items():
            if isinstance(value, _Auto):
                value = made._generate_next_value_(key, 1, len(values), values)
            values.append(value)
            for known in made._member_map_.values():
                if type(known._value_) is type(value) and known._value_ == value:
                    one = known
                    break
            else:
                arguments = value if isinstance(value, tuple) else (value,)
                if "__new__" in rest:
                    one = made.__new__(made, *arguments)
                elif data is not None:
                    one = data.__new__(made, *arguments)
                else:
                    one = object.__new__(made)
                if "_value_" not in one.__dict__:
                    one.__dict__["_value_"] = value if data is None or data is object else data(*arguments)
                one.__dict__["_name_"] = key
                if made.__init__ is not object.__init__ and (data is None or made.__init__ is not data.__init__):
                    made.__init__(one, *arguments)
            type.__setattr__(made, key, one)
            made._member_map_[key] = one
        if "__new__" in rest:
            # afterwards a call looks a member up
            type.__delattr__(made, "__new__")
        return made

    def __call__(cls, value, names=None, **_):
        if names is not None:
            if isinstance(names, str):
                names = names.replace(",", " ").split()
            pairs = names.items() if isinstance(names, dict) else names
            body = cls.__prepare__(value, (cls,))
            for place, pair in enumerate(pairs):
                name, it = (pair, place + 1) if isinstance(pair, str) else pair
                body[name] = it
            return type(cls)(value, (cls,), body)
        if type(value) is cls:
            return value
        for one in cls._member_map_.values():
            if one._value_ == value:
                return one
        found = cls._missing_(value)
        if found is not None:
            return found
        raise ValueError(f"{value!r} is not a valid {cls.__qualname__}")

    def __iter__(cls):
        return iter([one for name, one in cls._member_map_.items() if one._name_ == name])

    def __reversed__(cls):
        return reversed(list(cls))

    def __len__(cls):
        # not of a list of the class, for which Python asks its length
        return len([name for name, one in cls._member_map_.items() if one._name_ == name])

    def __bool__(cls):
        return True

    def __contains__(cls, it):
        return isinstance(it, cls) or any([one._value_ == it for one in cls])

    def __getitem__(cls, name):
        return cls._member_map_[name]

    @property
    def __members__(cls):
        return dict(cls._member_map_)

    def __setattr__(cls, name, value):
        if name in cls.__dict__.get("_member_map_", {}):
            raise AttributeError(f"cannot reassign member {name!r}")
        type.__setattr__(cls, name, value)

    def __delattr__(cls, name):
        if name in cls.__dict__.get("_member_map_", {}):
            raise AttributeError(f"{cls.__name__!r} cannot delete member {name!r}.")
        type.__delattr__(cls, name)

    def __repr__(cls):
        return f"<enum {cls.__name__!r}>"


class Enum(metaclass=EnumMeta):
    @staticmethod
    def _generate_next_value_(name, start, count, last_values):
        numbers = [value for value in last_values if isinstance(value, int)]
        return max(numbers) + 1 if numbers else start

    @classmethod
    def _missing_(cls, value):
        return None

    @property
    def name(self):
        return self._name_

    @property
    def value(self):
        return self._value_

    def __repr__(self):
        return f"<{type(self).__name__}.{self._name_}: {self._value_!r}>"

    def __str__(self):
        return f"{type(self).__name__}.{self._name_}"

    def __format__(self, how):
        return str.__format__(str(self), how)

    def __hash__(self):
        return hash(self._name_)

    def __copy__(self):
        return self

    def __deepcopy__(self, _):
        return self


class IntEnum(int, Enum):
    def __str__(self):
        return int.__repr__(self)

    def __format__(self, how):
        return int.__format__(self, how)

    __hash__ = int.__hash__


class StrEnum(str, Enum):
    def __str__(self):
        return str.__str__(self)

    def __format__(self, how):
        return str.__format__(self, how)

    __hash__ = str.__hash__

    @staticmethod
    def _generate_next_value_(name, start, count, last_values):
        return name.lower()


def _unique(cls):
    twice = [f"{name} -> {one._name_}" for name, one in cls._member_map_.items() if one._name_ != name]
    if twice:
        raise ValueError(f"duplicate values found in {cls!r}: {', '.join(twice)}")
    return cls


def _enum():
    names = {"Enum": Enum, "IntEnum": IntEnum, "StrEnum": StrEnum, "EnumMeta": EnumMeta, "EnumType": EnumMeta, "auto": _Auto, "unique": _unique}
    names["member"] = lambda it: it
    return _module("enum", names)
