"""Inverse dynamics of given motions, on arrays."""

import threading
from typing import NamedTuple, Optional

import numpy

from ._native import Call, Handle, Owner, ffi, lib
from .model import InverseDynamics, Model
from .records import usual_struct

NULL = ffi.NULL


class Gradient(NamedTuple):
    """Of one weighted sum, each [n][d]."""

    q: numpy.ndarray
    qd: numpy.ndarray
    qdd: numpy.ndarray


class Jacobians(NamedTuple):
    """n nodes, d coordinates, p points."""

    tau_q: numpy.ndarray
    """[n][d][d]: rows are those of tau."""
    tau_qd: numpy.ndarray
    tau_qdd: numpy.ndarray
    """The mass matrix."""
    wrench_q: numpy.ndarray
    """[n][6][d]."""
    wrench_qd: numpy.ndarray
    wrench_qdd: numpy.ndarray
    points_q: numpy.ndarray
    """[n][3 p][d]."""


class PointMotion(NamedTuple):
    """Of one point, world axes; d coordinates."""

    position: numpy.ndarray
    """[3], m."""
    velocity: numpy.ndarray
    """[3], m/s."""
    position_q: numpy.ndarray
    """[3][d]: slopes of the position by q, which are those of the velocity by qd."""
    velocity_q: numpy.ndarray
    """[3][d]: slopes of the velocity by q."""


def array_of(values, shape, what) -> numpy.ndarray:
    """C-contiguous doubles of a shape, which is checked."""
    values = numpy.ascontiguousarray(values, dtype=float)
    if values.shape != tuple(shape):
        raise ValueError(f"{what} is an array {list(values.shape)}; expected {list(shape)}")
    return values


def doubles(array: Optional[numpy.ndarray]):
    """The memory of an array as `double *`; NULL for None."""
    return NULL if array is None else ffi.from_buffer("double[]", array)


def _struct(name, memory):
    """A structure of pointers; `memory` has to live as long."""
    struct = usual_struct(name)
    for field, pointer in memory.items():
        setattr(struct, field, pointer)
    return struct


def point_motion(model: Model, link, local, q, qd) -> PointMotion:
    """``Model.point_motion``."""
    body = model._held
    d = lib.ambulo_model_coordinate_count(body.pointer)
    number = model.find("link", link) if isinstance(link, str) else int(link)
    given = [doubles(array_of(values, shape, what)) for values, shape, what in (
        (local, (3,), "local"), (q, (d,), "q"), (qd, (d,), "qd"))]
    found = PointMotion(numpy.empty(3), numpy.empty(3), numpy.empty((3, d)), numpy.empty((3, d)))
    struct = _struct("ambulo_point_motion", dict(zip(PointMotion._fields, map(doubles, found))))
    status = lib.ambulo_model_point_motion(body.pointer, number, *given, struct)
    if status:
        with Call() as call:
            call(status)
    return found


class Mechanics(Owner):
    """Inverse dynamics of a model, with its scratch memory: threads take turns.

    >>> with ambulo.Mechanics(model) as mechanics:
    ...     tau = mechanics.inverse_dynamics(q, qd, qdd).tau

    Motions are arrays [n][d]: one row for each time, one column for each of
    ``model.coordinate_names``; rad or m, and per second. Rates that are left out are zero. Pass many
    times at once: eight are computed together.
    """

    def __init__(self, model: Model):
        out, body = ffi.new("ambulo_mechanics **"), model._held
        with Call() as call:
            call(lib.ambulo_mechanics_create(body.pointer, NULL, out))
        self._handle = Handle(out[0], lib.ambulo_mechanics_free, body)
        self._lock = threading.Lock()
        self.model = model
        self._coordinates = lib.ambulo_model_coordinate_count(body.pointer)
        self._points = lib.ambulo_model_point_count(body.pointer)

    def _motion(self, q, qd, qdd):
        q = numpy.ascontiguousarray(q, dtype=float)
        if q.ndim != 2 or q.shape[1] != self._coordinates or len(q) < 1:
            raise ValueError(f"q is an array {list(q.shape)}; expected [n][{self._coordinates}]")
        qd = numpy.zeros_like(q) if qd is None else array_of(qd, q.shape, "qd")
        qdd = numpy.zeros_like(q) if qdd is None else array_of(qdd, q.shape, "qdd")
        return q, qd, qdd

    def inverse_dynamics(self, q, qd=None, qdd=None) -> InverseDynamics:
        """Torques, root wrench and points; no force acts but gravity."""
        q, qd, qdd = self._motion(q, qd, qdd)
        n = len(q)
        tau, wrench = numpy.empty_like(q), numpy.empty((n, 6))
        points = numpy.empty((n, self._points, 3))
        memory = {name: doubles(array) for name, array in
                  (("tau", tau), ("wrench", wrench), ("points", points))}
        with self._lock, Call() as call:
            call(lib.ambulo_mechanics_inverse_dynamics(
                self._pointer, n, doubles(q), doubles(qd), doubles(qdd),
                _struct("ambulo_outputs", memory)))
        return InverseDynamics(tau, wrench, points)

    def gradient(self, q, qd=None, qdd=None, *, tau_weights=None, wrench_weights=None,
                 point_weights=None) -> Gradient:
        """Gradient of the sum of all outputs, each times its weight (arrays in the shapes of
        ``InverseDynamics``), with respect to q, qd and qdd: one reverse sweep."""
        q, qd, qdd = self._motion(q, qd, qdd)
        n = len(q)
        weights = [None if values is None else array_of(values, shape, what)
                   for values, shape, what in (
                       (tau_weights, q.shape, "tau_weights"),
                       (wrench_weights, (n, 6), "wrench_weights"),
                       (point_weights, (n, self._points, 3), "point_weights"))]
        found = Gradient(*(numpy.empty_like(q) for _ in range(3)))
        memory = [doubles(array) for array in (*weights, *found)]
        with self._lock, Call() as call:
            call(lib.ambulo_mechanics_gradient(
                self._pointer, n, doubles(q), doubles(qd), doubles(qdd),
                _struct("ambulo_output_weights", dict(zip(("tau", "wrench", "points"), memory))),
                _struct("ambulo_motion_gradient", dict(zip(Gradient._fields, memory[3:])))))
        return found

    def jacobians(self, q, qd=None, qdd=None) -> Jacobians:
        """All derivatives of torques, root wrench and points."""
        q, qd, qdd = self._motion(q, qd, qdd)
        n, d = q.shape
        shapes = [(n, d, d)] * 3 + [(n, 6, d)] * 3 + [(n, 3 * self._points, d)]
        found = Jacobians(*(numpy.empty(shape) for shape in shapes))
        memory = dict(zip(Jacobians._fields, map(doubles, found)))
        struct = _struct("ambulo_jacobians", memory)
        with self._lock, Call() as call:
            call(lib.ambulo_mechanics_jacobians(self._pointer, n, doubles(q), doubles(qd),
                                                doubles(qdd), struct))
        return found
