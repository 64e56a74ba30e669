"""One problem again and again: the solver object."""

from typing import NamedTuple, Optional

import numpy

from . import _records as records
from ._native import Call, Handle, Owner, ffi, lib
from .mechanics import doubles
from .problem import Problem
from .records import from_c
from .result import Result
from .solving import Run, start_of

NULL = ffi.NULL


class Iterate(NamedTuple):
    """Where a solver stands. ``state`` has objective, the row that is missed most (``worst``),
    ``feasible``, ``converged`` and what it took."""

    x: numpy.ndarray
    state: records.SolverState


class Solver(Owner):
    """A problem that is solved again and again, as a controller does. Its prescribed ends, its
    footholds, its references and its time change; a few iterations continue from where the last
    ones ended.

        solver = ambulo.Solver(problem)
        solver.iterate(150)
        solver.set_end("shoulder", 0.1)
        x, state = solver.iterate(2)
    """

    _instead = "make another of its problem"

    def __init__(self, problem, *, options: Optional[records.Options] = None, **settings):
        held, out = problem._held, ffi.new("ambulo_solver **")
        run = Run(problem, options, settings, None, "keep")
        with Call() as call:
            call(lib.ambulo_solver_create(held.pointer, run.options, NULL, call.messages, out))
        self._handle = Handle(out[0], lib.ambulo_solver_free, held, run)

    @property
    def problem(self) -> Problem:
        """As it is by now, for motions: with the ends, footholds and references that were set."""
        held = self._held
        own = ffi.cast("ambulo_problem *", lib.ambulo_solver_problem(held.pointer))
        return Problem(Handle(own, lambda _: None, held))

    def start(self, start):
        """Begin there: unknowns, a Result or the path of a solution.yaml, with its multipliers."""
        problem = self.problem
        run = Run(problem, None, {}, None, "keep")
        x = start_of(problem, start, run)
        with Call() as call:
            call(lib.ambulo_solver_start(self._held.pointer, x, run.options.multipliers))

    def set_end(self, coordinate, value: float, *, order: int = 0, final: bool = False):
        """Another value of a prescribed end: of a coordinate, or of its rate (order 1)."""
        index = coordinate
        if isinstance(coordinate, str):
            index = self.problem.model.coordinate_names.index(coordinate)
        with Call() as call:
            call(lib.ambulo_solver_set_end(self._held.pointer, index, order, final, value))

    def set_foothold(self, contact: int, place, *, heading: float = 0.0):
        """Another place (forward, left) of contact ``problem.contacts[contact]``, and of all that
        belong to its stance."""
        place = numpy.ascontiguousarray(place, dtype=float)
        if place.shape != (2,):
            raise ValueError(f"a foothold of shape {place.shape}; expected (2,): forward, left")
        with Call() as call:
            call(lib.ambulo_solver_set_foothold(self._held.pointer, contact, doubles(place), heading))

    def set_reference(self, term: int, reference):
        """Another motion [nodes][d] for a term that follows one."""
        shape = (self.problem.node_count, -1)
        reference = numpy.ascontiguousarray(reference, dtype=float).reshape(shape)
        with Call() as call:
            call(lib.ambulo_solver_set_reference(self._held.pointer, term, doubles(reference)))

    def shift(self, time: float):
        """The motion and its multipliers as they are ``time`` s later."""
        with Call() as call:
            call(lib.ambulo_solver_shift(self._held.pointer, time))

    def iterate(self, iterations: int = 1, seconds: Optional[float] = None) -> Iterate:
        """At most so many inner solves, and so many seconds."""
        out, held = ffi.new("const ambulo_solver_state **"), self._held
        limit = float("nan") if seconds is None else seconds
        with Call() as call:
            call(lib.ambulo_solver_iterate(held.pointer, iterations, limit, out))
        problem = self.problem
        x = numpy.frombuffer(ffi.buffer(out[0].x, 8 * problem.variable_count), dtype=float).copy()
        return Iterate(x.reshape(problem.control_point_count, -1),
                       from_c(records.SolverState, out[0]))

    def result(self) -> Result:
        """The point where it stands, audited."""
        out, held = ffi.new("ambulo_result **"), self._held
        with Call() as call:
            call(lib.ambulo_solver_result(held.pointer, call.messages, out))
            return Result(self.problem, out[0], call.list())
