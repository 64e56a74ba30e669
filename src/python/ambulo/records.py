"""Structures of the C interface as Python objects, and how they are carried over and back.

The classes themselves are in ``_records``, made from the headers. A record is a plain object with
the fields of its structure (``from`` is called ``from_``). One that is made starts from what the
library says is usual (``ambulo_..._default()``), where it says something:

    >>> term = ambulo.Term("torque_squared", weight=2)
    >>> term.scale is None
    True

Enumerations may be given as words ("torque_squared"), numbers that stand for a coordinate, link,
point, foot, patch or capsule of the model as its name. Records that the library hands out are
copies: they stay what they are when the objects they came from are gone.
"""

import enum
import difflib
import weakref
from typing import Any, Dict, Tuple

import numpy

from ._native import ffi, lib, text_of


class Enumeration(enum.IntEnum):
    """A constant of the library; equal to its number, made from its number or its name."""

    @classmethod
    def _missing_(cls, value):
        if isinstance(value, str):
            name = value.strip().upper()
            if name in cls.__members__:
                return cls.__members__[name]
            near = difflib.get_close_matches(name, cls.__members__, 1)
            hint = f"; did you mean '{near[0].lower()}'?" if near else ""
            words = ", ".join(member.lower() for member in cls.__members__)
            raise ValueError(f"{cls.__name__} '{value}' is not known; expected {words}{hint}")
        return None

    def __str__(self):
        return self.name.lower()


class Record:
    """Base of the structures; see the module."""

    _struct = ""
    _fields: Dict[str, Tuple[Any, ...]] = {}

    def __init__(self, *values, **fields):
        names = list(self._fields)
        if len(values) > len(names):
            raise TypeError(f"{type(self).__name__} has {len(names)} fields, got {len(values)}")
        given = dict(zip(names, values))
        for name in fields:
            if name in given:
                raise TypeError(f"{type(self).__name__}: {name} is there twice")
        given.update(fields)
        self.__dict__.update(_usual(type(self), given))
        for name, value in given.items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        if name not in self._fields:
            near = difflib.get_close_matches(name, self._fields, 1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise AttributeError(f"{type(self).__name__} has no field '{name}'{hint}")
        spec = self._fields[name][1]
        if spec[0] == "enum":
            value = record_class(spec[1])(value)
        self.__dict__[name] = value

    def __repr__(self):
        shown = ", ".join(f"{name}={self.__dict__[name]!r}" for name in self._fields)
        return f"{type(self).__name__}({shown})"

    def __eq__(self, other):
        return type(self) is type(other) and repr(self) == repr(other)

    __hash__ = None  # type: ignore[assignment]

    def to_dict(self):
        """The fields, records among them as dictionaries too, constants by their names."""
        return {name: _as_plain(self.__dict__[name]) for name in self._fields}


def _as_plain(value):
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, Enumeration):
        return str(value)
    if isinstance(value, (list, tuple)):
        return [_as_plain(item) for item in value]
    return value


_classes: Dict[str, Any] = {}


def record_class(name):
    if not _classes:
        from . import _records

        _classes.update(vars(_records))
    return _classes[name]


_usual_fields: Dict[type, "Record"] = {}


def _usual(kind, given):
    """What a new record holds before anything is set."""
    if kind._struct in ("ambulo_term", "ambulo_device"):
        if "kind" not in given:
            raise TypeError(f"{kind.__name__} needs its kind")
        number = int(record_class(kind.__name__ + "Kind")(given["kind"]))
        return dict(from_c(kind, usual_struct(kind._struct, number)).__dict__)
    if kind not in _usual_fields:
        _usual_fields[kind] = from_c(kind, usual_struct(kind._struct))
    return {name: list(value) if isinstance(value, list) else value
            for name, value in _usual_fields[kind].__dict__.items()}


def usual_struct(name, *kind):
    """What ambulo_..._default() is in C: sizes, and what the library fills in."""
    struct = ffi.new(name + " *")
    for field, about in ffi.typeof(name).fields:
        if about.type.kind != "primitive" or about.type.cname not in ("size_t", "unsigned long"):
            continue
        if field == "size":
            struct.size = ffi.sizeof(name)
        elif field.endswith("_size"):
            setattr(struct, field, ffi.sizeof("ambulo_" + field[:-len("_size")]))
    if kind:
        struct.kind = kind[0]
    fill_usual(name, struct)
    return struct


def fill_usual(name, struct):
    """Sets the library's defaults; False: it has none for this structure."""
    return any(fill(name.encode(), struct, ffi.sizeof(name)) == lib.AMBULO_OK for fill in
               (lib.ambulo_defaults, lib.ambulo_problem_defaults, lib.ambulo_tool_defaults))


# -------------------------------------------------------------- from the library


def from_c(kind, struct):
    """A record of class `kind` from a structure of the library."""
    made = kind.__new__(kind)
    for name, (field, spec, _) in kind._fields.items():
        made.__dict__[name] = _value(struct, getattr(struct, field), spec)
    return made


def _items(value):
    return [_items(item) for item in value] if isinstance(value[0], ffi.CData) else list(value)


def _value(struct, value, spec):
    what = spec[0]
    if what in ("int", "float"):
        return value
    if what == "text":
        return text_of(value)
    if what == "enum":
        return record_class(spec[1])._value2member_map_.get(value, value)
    if what == "record":
        return from_c(record_class(spec[1]), value)
    if what == "array":
        if spec[1] == "record":
            return [from_c(record_class(spec[2]), item) for item in value]
        return _items(value)
    if what == "characters":
        return ffi.string(value).decode()
    if what in ("function", "numbers"):
        return None
    count = getattr(struct, spec[-1]) if value != ffi.NULL else 0
    if what == "records":
        return [from_c(record_class(spec[1]), value[i]) for i in range(count)]
    if what == "texts":
        return [text_of(value[i]) for i in range(count)]
    if what == "ints":
        return [value[i] for i in range(count)] if value != ffi.NULL else None
    return [list(value[i]) for i in range(count)]  # a table


# ---------------------------------------------------------------- to the library


_pointed_to: "weakref.WeakKeyDictionary[Any, list]" = weakref.WeakKeyDictionary()


class Carrier:
    """Fills structures of the library from records, and holds the memory they point to.

    ``sizes`` are the lengths that shapes of arrays refer to, ``find(what, name)`` the number of
    something of the model by its name, ``function`` what a function becomes.
    """

    def __init__(self, sizes=None, find=None, function=None):
        self.sizes, self.find, self.function = sizes or {}, find, function
        self.kept = []

    def keep(self, value):
        self.kept.append(value)
        return value

    def text(self, value):
        if value is None:
            return ffi.NULL
        return self.keep(ffi.new("char[]", str(value).encode()))

    def fill(self, struct, record):
        """Sets the structure to what the record says."""
        for name, (field, spec, named) in record._fields.items():
            value = record.__dict__[name]
            try:
                self._set(struct, field, spec, named, value, record)
            except (TypeError, ValueError, OverflowError) as fault:
                raise type(fault)(f"{type(record).__name__}.{name}: {fault}") from None
        return struct

    def new(self, record):
        """A structure with the sizes of these declarations, filled."""
        kind = (int(record.kind),) if record._struct in ("ambulo_term", "ambulo_device") else ()
        struct = usual_struct(record._struct, *kind)
        _pointed_to[struct] = self.kept  # lives as long as the structure
        return self.fill(struct, record)

    def records(self, kind, values):
        """An array of structures, and its length."""
        values = [value if isinstance(value, Record) else kind(**value) if isinstance(value, dict)
                  else kind(*value) for value in values or ()]
        array = self.keep(ffi.new(f"{kind._struct}[]", max(1, len(values))))
        for i, value in enumerate(values):
            if not isinstance(value, kind):
                raise TypeError(f"got a {type(value).__name__}; expected {kind.__name__}")
            self.fill(array[i], value)
        return (array if values else ffi.NULL), len(values)

    def number(self, named, value):
        if isinstance(value, str):
            if not named or not self.find:
                raise TypeError(f"got '{value}'; expected a number")
            return self.find(named, value)
        return int(value)

    def _set(self, struct, field, spec, named, value, record):
        what = spec[0]
        if what == "int":
            setattr(struct, field, self.number(named, value))
        elif what == "float":
            setattr(struct, field, float("nan") if value is None else float(value))
        elif what == "enum":
            setattr(struct, field, int(value))
        elif what == "text":
            setattr(struct, field, self.text(value))
        elif what == "record":
            self.fill(getattr(struct, field), value)
        elif what == "array":
            self._set_array(getattr(struct, field), spec, named, value)
        elif what == "function":
            setattr(struct, field, self.function(value) if value is not None else ffi.NULL)
        elif what == "numbers":
            setattr(struct, field, self._numbers(spec[1], value, record, struct))
        else:
            self._set_list(struct, field, spec, named, value)

    def _set_array(self, array, spec, named, value):
        if spec[1] == "record":
            raise TypeError("cannot be given")
        if len(spec[3]) == 1:
            value = list(value)
            if len(value) != spec[3][0]:
                raise ValueError(f"got {len(value)} values; expected {spec[3][0]}")
            for i, item in enumerate(value):
                array[i] = self.number(named, item) if spec[1] == "int" else float(item)
            return
        value = numpy.asarray(value, dtype=float)
        if value.shape != spec[3]:
            raise ValueError(f"got an array {list(value.shape)}; expected {list(spec[3])}")
        for index in numpy.ndindex(*value.shape[:-1]):
            row = array
            for i in index:
                row = row[i]
            row[0:value.shape[-1]] = [float(item) for item in value[index]]

    def _numbers(self, shape, value, record, struct):
        if value is None:
            return ffi.NULL
        value = numpy.ascontiguousarray(value, dtype=float)
        own = record.__dict__
        if "samples" in own and "samples" in shape and not own["samples"]:
            struct.samples = value.shape[0]
        sizes = dict(self.sizes, samples=getattr(struct, "samples", 0),
                     marks=getattr(struct, "mark_count", 0))
        expected = tuple(sizes[s] if isinstance(s, str) else s for s in shape)
        if value.shape != expected:
            raise ValueError(f"got an array {list(value.shape)}; expected {list(expected)}, "
                             f"[{']['.join(str(s) for s in shape)}]")
        self.keep(value)
        return self.keep(ffi.from_buffer("double[]", value))

    def _set_list(self, struct, field, spec, named, value):
        what, count = spec[0], spec[-1]
        if what == "records":
            array, length = self.records(record_class(spec[1]), value)
        elif what == "texts":
            array = self.keep(ffi.new("char *[]", [self.text(item) for item in value or ()] or 1))
            length = len(value or ())
        elif what == "ints":
            array = ffi.NULL if value is None else self.keep(
                ffi.new("int[]", [self.number(named, item) for item in value] or [0]))
            length = len(value or ())
        elif what == "table":
            value = numpy.asarray(value if value is not None else (), dtype=float)
            value = numpy.ascontiguousarray(value.reshape(-1, spec[1]))
            length = len(value)
            self.keep(value)
            array = ffi.cast(f"double(*)[{spec[1]}]", self.keep(ffi.from_buffer(value)))
        else:
            raise TypeError("cannot be given")
        setattr(struct, field, array if length else ffi.NULL)
        setattr(struct, count, length)
