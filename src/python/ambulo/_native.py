"""The library itself: where it is, calls that can fail, messages, memory.

Every wrapper of an object of the library holds a Handle; whatever else that object needs (the model
of a problem, the problem of a result, functions of the caller) is held by the Handle in turn, and
lives as long. So does what a call was given: ``close()`` may come from a callback of that call, or
from another thread, and frees when the call is back.
"""

import json
import os
import sys
import threading
import warnings
from pathlib import Path
from typing import Optional

from ._declarations import ffi
from .errors import AmbuloError, AmbuloWarning, Message

FOLDER = Path(__file__).resolve().parent


def _open():
    path = os.environ.get("AMBULO_LIBRARY") or str(FOLDER / "libambulo.so")
    try:
        return ffi.dlopen(path)
    except OSError as fault:
        raise ImportError(
            f"ambulo: {fault}\nThe library needs NLopt, libyaml and a LAPACK: on Debian and Ubuntu "
            f"the packages libnlopt0, libyaml-0-2, libopenblas0. AMBULO_LIBRARY in the environment "
            f"names another libambulo.so.") from None


lib = _open()


def text_of(pointer):
    """A string of the library; None for NULL."""
    return None if pointer == ffi.NULL else ffi.string(pointer).decode(errors="replace")


class Handle:
    """A pointer and what it needs. ``pointer`` itself frees what it points to when nothing refers to
    it any more, and an argument of a call that is under way is referred to."""

    __slots__ = ("pointer", "needs")

    def __init__(self, pointer, free, *needs):
        def destroy(raw, free=free, needs=needs, _library=lib):
            if all(is_there(need) for need in needs):  # else it may look at what is gone: stays
                free(raw)

        self.pointer, self.needs = ffi.gc(pointer, destroy), needs

    def give(self):
        """The pointer, which is the library's to free from now on."""
        pointer, self.pointer = self.pointer, None
        ffi.gc(pointer, None)
        return pointer


def is_there(need):
    """Whether a Handle, and all that it needs, was not given away."""
    if not isinstance(need, Handle):
        return True
    return need.pointer is not None and all(is_there(other) for other in need.needs)


class Owner:
    """An object of the library: freed by ``close()``, by the end of a ``with`` block, or when it is
    collected, whichever comes first. What was made from it (results of a problem) stays usable, and
    so does the object itself in calls that are under way."""

    _handle: Optional[Handle] = None

    @property
    def _held(self):
        """The handle: a function that calls the library more than once holds it meanwhile."""
        handle = self._handle
        if handle is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        if not is_there(handle):
            raise ValueError(f"this {type(self).__name__} belongs to a problem that was handed over, "
                             f"by the function that makes problems for solve_parameters")
        return handle

    @property
    def _pointer(self):
        return self._held.pointer

    def _read(self, convert, function, *arguments):
        """What `function` of the library returns of the object, converted while that is there."""
        pointer = self._pointer
        found = convert(function(pointer, *arguments))
        del pointer
        return found

    def close(self):
        """Gives the object up; memory is freed once nothing that was made from it is left, and no
        call of it is under way."""
        self._handle = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce_ex__(self, protocol):
        raise TypeError(f"a {type(self).__name__} is memory of the library: it can be neither pickled "
                        f"nor copied; {self._instead}")

    _instead = "load or make it again from its file or its records"


# ------------------------------------------------------------------- messages


def warn(text):
    """A warning at the line of the caller's code."""
    level, frame = 1, sys._getframe()
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == str(FOLDER):
        level, frame = level + 1, frame.f_back
    warnings.warn(AmbuloWarning(text), stacklevel=level)


class Call:
    """One call that can fail: its list of messages, and an exception if it does.

        with Call() as call:
            call(lib.ambulo_model_load(path, NULL, NULL, call.messages, out))
    """

    def __init__(self):
        self.messages = ffi.gc(lib.ambulo_diagnostics_create(ffi.NULL), lib.ambulo_diagnostics_free)
        if self.messages == ffi.NULL:
            raise MemoryError
        self.found = None

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is None and lib.ambulo_diagnostics_count(self.messages):
            for message in self.list():
                if message.severity == "warning":
                    warn(message.text)
        ffi.release(self.messages)

    def __call__(self, status):
        if status:
            raise AmbuloError(text_of(lib.ambulo_status_name(status)),
                              text_of(lib.ambulo_status_text(status)), self.list())

    def list(self):
        """The messages so far, of a call that is back."""
        if self.found is not None:
            return self.found
        self.found = found = []
        for i in range(lib.ambulo_diagnostics_count(self.messages)):
            one = lib.ambulo_diagnostics_get(self.messages, i)
            size = lib.ambulo_diagnostics_format(self.messages, i, ffi.NULL, 0) + 1
            text = ffi.new("char[]", size)
            lib.ambulo_diagnostics_format(self.messages, i, text, size)
            found.append(Message(
                ("", "note", "warning", "error")[one.severity], text_of(one.message),
                text_of(one.file), one.line, one.column, text_of(one.path), text_of(one.hint),
                text_of(text)))
        return found


# An exception of a function of the caller that the library called in this thread. It cannot pass
# through C: it is kept, the library told to stop, and raised when the call is back.
_pending = threading.local()


def keep_exception(kind, exception, traceback):
    if getattr(_pending, "exception", None) is None:
        _pending.exception = exception


def pending():
    return getattr(_pending, "exception", None)


def take_pending():
    exception = getattr(_pending, "exception", None)
    _pending.exception = None
    return exception


def raise_pending():
    exception = take_pending()
    if exception is not None:
        raise exception


# ------------------------------------------------------------------ arguments


def path_of(path):
    return os.fsencode(path)


def overrides_of(overrides):
    """{"gait.speed": 1.6} or ["gait.speed=1.6"] as an array of C strings; with what it points to."""
    if overrides is None:
        overrides = ()
    if hasattr(overrides, "items"):
        overrides = [f"{path}={_setting(value)}" for path, value in overrides.items()]
    texts = [ffi.new("char[]", text.encode()) for text in overrides]
    return ffi.new("char *[]", texts) if texts else ffi.NULL, len(texts), texts


def _setting(value):
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    return json.dumps(value)
