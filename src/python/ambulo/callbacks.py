"""Functions of the caller as the library calls them.

A function of one node gets its state and, where a gradient is wanted, a gradient to add to:

    def power_squared(state, gradient):
        power = state.tau * state.qd
        if gradient is not None:
            gradient.tau += 2 * power * state.qd
            gradient.qd += 2 * power * state.tau
        return (power ** 2).sum()

It must be a pure function of the state: it is also called with states that belong to no motion.
Arrays are views of the library's memory and hold for the call only; a copy may be kept. An exception
ends the solve, which then raises it. It costs some microseconds a call, which is thousands of times
what the same term costs in C; a function that was compiled (``numba.cfunc``, cffi, ctypes) is given
by its address, and has the signature of ``ambulo_node_function`` in problem.h.
"""

import numbers

import numpy

from ._native import ffi, keep_exception

MOST_VIEWS = 256


class NodeState:
    """State of one node: ``time`` (s), ``node``, and arrays ``q``, ``qd``, ``qdd``, ``tau`` [d],
    ``wrench`` [6] (moment about the world's origin, then force), ``points`` [p][3]."""

    __slots__ = ("time", "node", "q", "qd", "qdd", "tau", "wrench", "points")


class NodeGradient:
    """Arrays to add to, zero at the start; shapes as in NodeState."""

    __slots__ = ("q", "qd", "qdd", "tau", "wrench", "points")

    def __setattr__(self, name, value):
        """`gradient.tau = ...` sets the array's values."""
        array = getattr(self, name)
        if value is not array:
            array[...] = value


def _views(into, struct, coordinates, points, writable):
    shapes = {"wrench": (6,), "points": (points, 3)}
    for name in NodeGradient.__slots__:
        shape = shapes.get(name, (coordinates,))
        size = 8 * int(numpy.prod(shape))
        array = numpy.frombuffer(ffi.buffer(getattr(struct, name), size), dtype=float) \
            if size else numpy.empty(0)
        array = array.reshape(shape)
        array.flags.writeable = writable
        object.__setattr__(into, name, array)
    return into


def node_function(function, coordinates, points):
    """`function` as an ambulo_node_function; hold on to what is returned."""
    if isinstance(function, ffi.CData):
        return function
    if isinstance(function, numbers.Integral):
        return ffi.cast("ambulo_node_function", int(function))
    address = getattr(function, "address", None)  # of numba.cfunc
    if isinstance(address, numbers.Integral):
        return ffi.cast("ambulo_node_function", int(address))
    if not callable(function):
        raise TypeError(f"got a {type(function).__name__}; expected a function")

    # The library uses the same memory again: arrays are made once for each place they were at.
    states, gradients = {}, {}
    arrays = ffi.offsetof("ambulo_node_state", "q")

    def call(_, state, gradient):
        key = bytes(ffi.buffer(state))[arrays:]
        view = states.get(key)
        if view is None:
            if len(states) > MOST_VIEWS:
                states.clear()
            view = states[key] = _views(NodeState(), state, coordinates, points, False)
        view.time, view.node = state.time, state.node
        if not gradient:
            return function(view, None)
        key = bytes(ffi.buffer(gradient))
        slope = gradients.get(key)
        if slope is None:
            if len(gradients) > MOST_VIEWS:
                gradients.clear()
            slope = gradients[key] = _views(NodeGradient(), gradient, coordinates, points, True)
        return function(view, slope)

    return ffi.callback("ambulo_node_function", call, error=float("nan"), onerror=keep_exception)
