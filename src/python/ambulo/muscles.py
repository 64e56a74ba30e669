"""Muscles on a model: torques shared among them, contact forces of joints, metabolic power."""

import os
from typing import NamedTuple, Optional

import numpy

from ._native import Call, Handle, Owner, ffi, lib, path_of, text_of
from .mechanics import _struct, array_of, doubles
from .model import Model
from .records import usual_struct

NULL = ffi.NULL


class Sharing(NamedTuple):
    """n times, m muscles, d coordinates. Slopes are those of the cost, exact by its multipliers."""

    cost: numpy.ndarray
    """[n]."""
    activation: numpy.ndarray
    """[n][m], 0 to 1."""
    force: numpy.ndarray
    """[n][m] along the tendon, N."""
    length: numpy.ndarray
    """[n][m] of the fibres, in optimal lengths."""
    speed: numpy.ndarray
    """[n][m] of the fibres, optimal lengths per s; lengthening is positive."""
    reserve: numpy.ndarray
    """[n][d] torque that no muscle supplies, N m."""
    by_q: numpy.ndarray
    """[n][d]."""
    by_qd: numpy.ndarray
    by_tau: numpy.ndarray
    by_tau_rate: numpy.ndarray


class MuscleAnalysis(NamedTuple):
    """What muscles did in a motion: n rows, m muscles, d coordinates, j joints."""

    times: numpy.ndarray
    """[n] s."""
    activation: numpy.ndarray
    """[n][m]."""
    force: numpy.ndarray
    """[n][m] along the tendon, N."""
    fiber_length: numpy.ndarray
    """[n][m] in optimal lengths."""
    fiber_speed: numpy.ndarray
    metabolic: numpy.ndarray
    """[n][m] W, by Bhargava et al. (2004)."""
    reserve: numpy.ndarray
    """[n][d] N m."""
    joints: tuple
    """Names of the joints that muscles pull across."""
    contact: numpy.ndarray
    """[n][j][3] force on what lies below, along the axes of the link above, N."""
    between_links: numpy.ndarray
    """[n][j][3] the same without muscles."""
    body_weight: float
    """N."""
    distance: float
    """Of the centre of mass along forward, m."""
    bhargava: float
    """Gross metabolic power, W per kg of the body."""
    umberger: float


class Muscles(Owner):
    """Muscles of a file (docs/muscles-format.md) on a model; scaled with its legs and its mass.

    >>> muscles = ambulo.Muscles("leg_muscles.yaml", model)
    >>> activation = muscles.share(q, qd, tau).activation
    """

    def __init__(self, path, model: Model):
        out, body = ffi.new("ambulo_muscles **"), model._held
        with Call() as call:
            call(lib.ambulo_muscles_load(path_of(path), body.pointer, NULL, call.messages, out))
        self._handle = Handle(out[0], lib.ambulo_muscles_free, body)
        self.model = model
        count = lib.ambulo_muscles_count(self._pointer)
        each = [lib.ambulo_muscles_get(self._pointer, i) for i in range(count)]
        self.names = tuple(text_of(muscle.name) for muscle in each)
        self.groups = tuple(text_of(muscle.group) for muscle in each)
        self.source = text_of(lib.ambulo_muscles_source(self._pointer))

    def share(self, q, qd, tau, tau_rate=None, *, activation=1.0, metabolic=0.0, reserve=0.2,
              by_volume=True) -> Sharing:
        """The sharing of least cost at n times; arrays are [n][d], in the order of
        ``model.coordinate_names``. Prices are those of ``ambulo_sharing``."""
        d, m = len(self.model.coordinate_names), len(self.names)
        q = numpy.ascontiguousarray(q, dtype=float)
        if q.ndim != 2 or q.shape[1] != d or len(q) < 1:
            raise ValueError(f"q is an array {list(q.shape)}; expected [n][{d}]")
        given = {"q": q, "qd": array_of(qd, q.shape, "qd"), "tau": array_of(tau, q.shape, "tau"),
                 "tau_rate": None if tau_rate is None else array_of(tau_rate, q.shape, "tau_rate")}
        shapes = [(len(q),)] + [(len(q), m)] * 4 + [(len(q), d)] * 5
        found = Sharing(*(numpy.empty(shape) for shape in shapes))
        prices = usual_struct("ambulo_sharing")
        prices.activation, prices.metabolic, prices.reserve = activation, metabolic, reserve
        prices.by_volume = bool(by_volume)
        states = _struct("ambulo_sharing_states", {name: doubles(array) for name, array in given.items()})
        states.count = len(q)
        memory = {name: doubles(array) for name, array in zip(Sharing._fields, found)}
        with Call() as call:
            call(lib.ambulo_muscles_share(self._pointer, prices, states, NULL,
                                          _struct("ambulo_sharing_outputs", memory)))
        return found

    def analyse(self, motion, *, activation=1.0, metabolic=0.0, reserve=0.2, by_volume=True,
                resting_power=1.2, output: Optional[os.PathLike] = None,
                overwrite=False) -> MuscleAnalysis:
        """Of a table of `ambulo solve` (motion.csv) or `ambulo inverse`; `output`: where to write
        the table of muscles, CSV or STO."""
        options = usual_struct("ambulo_muscle_options")
        options.activation, options.metabolic, options.reserve = activation, metabolic, reserve
        options.by_volume, options.resting_power = bool(by_volume), resting_power
        out = ffi.new("ambulo_muscle_analysis **")
        with Call() as call:
            call(lib.ambulo_muscle_analysis_create(self._pointer, path_of(motion),
                                                   options, NULL, call.messages, out))
        handle = ffi.gc(out[0], lib.ambulo_muscle_analysis_free)
        if output is not None:
            with Call() as call:
                call(lib.ambulo_muscle_analysis_write(handle, path_of(output), bool(overwrite),
                                                      call.messages))
        return self._copied(lib.ambulo_muscle_analysis_values(handle))

    def _copied(self, v) -> MuscleAnalysis:
        n, j = v.rows, v.joints
        d, m = len(self.model.coordinate_names), len(self.names)

        def array(pointer, *shape):
            size = int(numpy.prod(shape))
            return numpy.frombuffer(ffi.buffer(pointer, 8 * size), dtype=float).reshape(shape).copy()

        return MuscleAnalysis(
            array(v.times, n), array(v.activation, n, m), array(v.force, n, m), array(v.fiber_length, n, m),
            array(v.fiber_speed, n, m), array(v.metabolic, n, m), array(v.reserve, n, d),
            tuple(text_of(v.joint[i]) for i in range(j)), array(v.contact, n, j, 3),
            array(v.between_links, n, j, 3), v.body_weight, v.distance, v.bhargava, v.umberger)
