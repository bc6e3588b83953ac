# The objects that submissions are given: fields that are also entries.


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
