"""What to minimize, subject to what."""

import threading
from typing import TYPE_CHECKING, Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Union

import numpy

from . import _records as records
from ._native import (Call, Handle, Owner, ffi, lib, overrides_of, path_of, raise_pending, text_of)
from .callbacks import node_function
from .errors import AmbuloError
from .mechanics import array_of, doubles
from .model import Model
from .motion import Motion, motion_of
from .records import Carrier, from_c, usual_struct

if TYPE_CHECKING:
    from .result import Result

NULL = ffi.NULL


class Evaluation(NamedTuple):
    """What a problem says of one point."""

    objective: float
    terms: numpy.ndarray
    """[term_count], weighted; names: ``problem.term_names``."""
    rows: numpy.ndarray
    """[row_count], each in its unit; ``problem.rows()`` describes them."""


class Problem(Owner):
    """A motion to predict, read from a file or made from records; it never changes.

    >>> with ambulo.Problem.load(ambulo.MODELS / "walk_normal.yaml") as problem:
    ...     result = problem.solve()
    >>> print(result.verdict, result.motion().q.shape)
    optimal (26, 18)

    The unknowns x are the control points of the joint trajectories, an array [control_points][d];
    functions take it in this shape or flat. Several threads may use one problem at once.
    """

    def __init__(self, handle: Optional[Handle]):
        self._handle = handle
        self._workspaces = threading.local()

    def _twin(self) -> "Problem":
        """The same for another owner: what results hold, so that this one may be closed."""
        return Problem(self._held)

    def close(self):
        super().close()
        self._workspaces = threading.local()

    # --------------------------------------------------------------- making one

    @classmethod
    def load(cls, path, overrides: Union[Dict[str, Any], Sequence[str], None] = None) -> "Problem":
        """Reads a problem file (docs/problem-format.md) and the model that it names.

        ``overrides`` replace values before anything is read, as ``--set`` of the program does:
        ``{"gait.speed": 1.6, "subject.mass": 55}``.
        """
        texts, count, _keep = overrides_of(overrides)
        out = ffi.new("ambulo_problem **")
        with Call() as call:
            call(lib.ambulo_problem_load(path_of(path), texts, count, NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_problem_free))

    @classmethod
    def load_text(cls, text: str, name: str = "problem", *, folder=None, overrides=None) -> "Problem":
        """The same from text; names of files in it are relative to ``folder`` (None: the current
        one), ``name`` stands for the file in messages."""
        texts, count, _keep = overrides_of(overrides)
        data = text.encode()
        kept = [ffi.new("char[]", one) for one in (
            data, name.encode(), b"" if folder is None else path_of(folder))]
        struct = usual_struct("ambulo_problem_text")
        struct.text, struct.name, struct.length = kept[0], kept[1], len(data)
        struct.directory = NULL if folder is None else kept[2]
        struct.overrides, struct.override_count = ffi.cast("char **", texts), count
        out = ffi.new("ambulo_problem **")
        with Call() as call:
            call(lib.ambulo_problem_load_text(struct, NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_problem_free))

    @classmethod
    def create(cls, model: Model, **fields) -> "Problem":
        """Makes a problem from records; fields are those of ``ProblemDefinition``.

        >>> problem = ambulo.Problem.create(
        ...     model, duration=1, intervals=20, terms=[ambulo.Term("torque_squared")],
        ...     end_values=[ambulo.EndValue("shoulder", 0, 0, -1.2)])

        Coordinates, points, feet, patches, links and capsules of the model may be given by name.
        """
        if "breakpoints" in fields and fields["breakpoints"] is not None:
            fields.setdefault("spline_intervals", len(fields["breakpoints"]) - 1)
        definition = records.ProblemDefinition(**fields)
        body = model._held
        carrier, functions = _carrier(model, definition.intervals, definition.spline_intervals,
                                      len(definition.devices or ()))
        struct = carrier.new(definition)
        struct.model = body.pointer
        out = ffi.new("ambulo_problem **")
        with Call() as call:
            call(lib.ambulo_problem_create(struct, NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_problem_free, body, functions))

    def extend(self, terms: Sequence[records.Term] = (),
               user_rows: Sequence[records.UserRow] = ()) -> "Problem":
        """The problem with further terms and rows, whatever it was made from: a function of your
        own on a walk of a file.

        >>> more = problem.extend(terms=[ambulo.Term("user_term", function=power_squared,
        ...                                          name="power squared", weight=0.01)])

        ``ambulo.callbacks`` says what such a function is. Options and free parameters of the file
        go along.
        """
        held = self._held
        carrier, functions = _carrier(
            self.model, self.node_count - 1, 0, lib.ambulo_problem_device_count(self._pointer))
        struct = carrier.new(records.Extension(terms=list(terms), user_rows=list(user_rows)))
        out = ffi.new("ambulo_problem **")
        with Call() as call:
            call(lib.ambulo_problem_extend(held.pointer, struct, NULL, call.messages, out))
        return Problem(Handle(out[0], lib.ambulo_problem_free, held, functions))

    # ------------------------------------------------------------------ queries

    @property
    def name(self) -> Optional[str]:
        return self._read(text_of, lib.ambulo_problem_name)

    @property
    def model(self) -> Model:
        """The body; with points of capsules that rows are about behind its own."""
        held = self._held
        return Model(Handle(lib.ambulo_problem_model(held.pointer), lambda _: None, held))

    @property
    def duration(self) -> float:
        """s."""
        return lib.ambulo_problem_duration(self._pointer)

    @property
    def node_count(self) -> int:
        return lib.ambulo_problem_node_count(self._pointer)

    @property
    def times(self) -> numpy.ndarray:
        """[node_count]: of the time nodes, s."""
        pointer = self._pointer
        return numpy.array([lib.ambulo_problem_node_time(pointer, k)
                            for k in range(self.node_count)])

    @property
    def control_point_count(self) -> int:
        return lib.ambulo_problem_control_point_count(self._pointer)

    @property
    def variable_count(self) -> int:
        """Of control points times coordinates."""
        return lib.ambulo_problem_variable_count(self._pointer)

    @property
    def row_count(self) -> int:
        return lib.ambulo_problem_row_count(self._pointer)

    @property
    def equality_count(self) -> int:
        """Rows that are equations."""
        return lib.ambulo_problem_equality_count(self._pointer)

    @property
    def term_names(self) -> List[str]:
        pointer = self._pointer
        return [text_of(lib.ambulo_problem_term_name(pointer, i))
                for i in range(lib.ambulo_problem_term_count(pointer))]

    @property
    def contacts(self) -> List[records.Contact]:
        pointer = self._pointer
        return [from_c(records.Contact, lib.ambulo_problem_contact(pointer, i))
                for i in range(lib.ambulo_problem_contact_count(pointer))]

    @property
    def devices(self) -> List[records.Device]:
        pointer = self._pointer
        return [from_c(records.Device, lib.ambulo_problem_device(pointer, i))
                for i in range(lib.ambulo_problem_device_count(pointer))]

    @property
    def holds(self) -> List[records.Hold]:
        """What hands hold or push."""
        pointer = self._pointer
        return [from_c(records.Hold, lib.ambulo_problem_hold(pointer, i))
                for i in range(lib.ambulo_problem_hold_count(pointer))]

    def rows(self) -> List[records.Row]:
        """What each row is: family, subject, unit, time; in the order of their values."""
        struct, found, pointer = ffi.new("ambulo_row *"), [], self._pointer
        with Call() as call:
            for i in range(lib.ambulo_problem_row_count(pointer)):
                call(lib.ambulo_problem_row(pointer, i, struct))
                found.append(from_c(records.Row, struct))
        return found

    def limits(self, coordinate: Union[int, str], what: str = "position") -> records.Limits:
        """Where "position", "speed" or "torque" of a coordinate has to stay."""
        if isinstance(coordinate, str):
            coordinate = self.model.find("coordinate", coordinate)
        struct = ffi.new("ambulo_limits *")
        kind = int(records.Limited(what))  # type: ignore[arg-type]
        with Call() as call:
            call(lib.ambulo_problem_limits(self._pointer, coordinate, kind, struct))
        return from_c(records.Limits, struct)

    @property
    def memory(self) -> records.Memory:
        """Predicted, bytes."""
        return from_c(records.Memory, lib.ambulo_problem_memory(self._pointer))

    @property
    def hash(self) -> int:
        """Of everything that was resolved."""
        return lib.ambulo_problem_hash(self._pointer)

    def options(self, **settings) -> records.Options:
        """What the file asks of the solver, or the defaults; changed by ``settings``."""
        struct, pointer = usual_struct("ambulo_options"), self._pointer
        lib.ambulo_problem_options_fill(pointer, struct, ffi.sizeof("ambulo_options"))
        options = from_c(records.Options, struct)
        for name, value in settings.items():
            setattr(options, name, value)
        return options

    # --------------------------------------------------------------- evaluation

    def _point(self, x):
        x = numpy.ascontiguousarray(x, dtype=float).reshape(-1)
        return array_of(x, (self.variable_count,), "x")

    def _workspace(self):
        """Of this thread: a handle."""
        held = getattr(self._workspaces, "handle", None)
        if held is None:
            out, problem = ffi.new("ambulo_workspace **"), self._held
            with Call() as call:
                call(lib.ambulo_workspace_create(problem.pointer, NULL, out))
            held = self._workspaces.handle = Handle(out[0], lib.ambulo_workspace_free, problem)
        return held

    def _asked(self, function, *arguments):
        """A function of the library that asks functions of the caller: their exceptions come
        through, and so does what the workspace knows of a value that is not finite. One of those
        functions may close the problem; evaluate it once more it may not."""
        problem, workspace = self._held, self._workspace()
        if getattr(self._workspaces, "busy", False):
            raise ValueError("a function of the caller evaluates the problem that it is a part of")
        busy = self._workspaces
        busy.busy = True
        try:
            with Call() as call:
                status = function(problem.pointer, workspace.pointer, *arguments)
                raise_pending()
                if status == records.Status.E_NUMERIC:
                    text = ffi.new("char[]", 1000)
                    lib.ambulo_fault_text(lib.ambulo_workspace_fault(workspace.pointer), text, 1000)
                    raise AmbuloError("E_NUMERIC", text_of(text))
                call(status)
        finally:
            busy.busy = False

    def evaluate(self, x) -> Evaluation:
        """Objective, its terms and all rows at x."""
        x, objective = self._point(x), ffi.new("double *")
        terms = numpy.empty(lib.ambulo_problem_term_count(self._pointer))
        rows = numpy.empty(self.row_count)
        self._asked(lib.ambulo_problem_evaluate, doubles(x), objective, doubles(terms),
                    doubles(rows))
        return Evaluation(objective[0], terms, rows)

    def gradient(self, x, objective_weight: float = 1.0, row_weights=None) -> numpy.ndarray:
        """Gradient [control_points][d] of ``objective_weight`` times the objective plus all rows,
        each times its weight."""
        x = self._point(x)
        if row_weights is not None:
            row_weights = array_of(row_weights, (self.row_count,), "row_weights")
        found, points = numpy.empty_like(x), self.control_point_count
        self._asked(lib.ambulo_problem_gradient, doubles(x), objective_weight,
                    doubles(row_weights), doubles(found))
        return found.reshape(points, -1)

    def row_gradient(self, x, row: int) -> numpy.ndarray:
        """Gradient [control_points][d] of one row."""
        x = self._point(x)
        found, points = numpy.empty_like(x), self.control_point_count
        self._asked(lib.ambulo_problem_row_gradient, doubles(x), row, doubles(found))
        return found.reshape(points, -1)

    def motion(self, x, times=None) -> Motion:
        """The motion at ``times`` in [0, duration] (None: the time nodes)."""
        times = self.times if times is None else times
        return motion_of(self, self._point(x), times)

    def check_derivatives(self, x, step: float = 0.0) -> List[records.DerivativeError]:
        """Worst disagreement of the gradients with central differences, for each family of rows
        and each term: functions of your own are among them."""
        x, room, count = self._point(x), 400, ffi.new("int *")
        errors = ffi.new("ambulo_derivative_error[]", room)
        self._asked(lib.ambulo_problem_check_derivatives, doubles(x), step, errors, room, count)
        return [from_c(records.DerivativeError, errors[i]) for i in range(min(room, count[0]))]

    def transfer(self, x, to: "Problem") -> numpy.ndarray:
        """x of this problem as unknowns of one on another grid."""
        found = numpy.empty(to.variable_count)
        x = self._point(x)
        with Call() as call:
            call(lib.ambulo_problem_transfer(self._pointer, doubles(x), to._pointer,
                                             doubles(found)))
        return found.reshape(to.control_point_count, -1)

    def load_solution(self, path, *, stretch: bool = False) -> numpy.ndarray:
        """Unknowns from a solution.yaml; ``stretch``: as a start, also from another duration."""
        found = numpy.empty(self.variable_count)
        load = lib.ambulo_solution_start if stretch else lib.ambulo_solution_load
        with Call() as call:
            call(load(path_of(path), self._pointer, NULL, call.messages, doubles(found)))
        return found.reshape(self.control_point_count, -1)

    # ------------------------------------------------------------------ solving

    def solve(self, start=None, *, progress: Union[bool, Callable, None] = None,
              interrupt: str = "keep", options: Optional[records.Options] = None, **settings) -> "Result":
        """Finds the motion; returns a Result, whatever its verdict.

        ``start``      unknowns to begin at. A Result or the path of a solution.yaml bring their
                       multipliers: beside a solved problem that takes a few iterations. "zero", or
                       None: zero, but a gait of several steps with None from one of them, solved
                       first and repeated
        ``progress``   a function that is called with a Progress at every iteration and at least ten
                       times a second in between, and stops the solve by returning something true;
                       True prints a line
        ``interrupt``  Ctrl-C stops the solve at its next iteration: "keep" returns the best point,
                       with the verdict "interrupted"; "raise" raises KeyboardInterrupt, with the
                       best point in its attribute ``result``
        ``options``    Options, by default ``problem.options()``; further arguments change single
                       ones: ``time_limit=10, optimality_tolerance=1e-4``

        Other threads run meanwhile. An exception of a function of yours ends the solve and is
        raised, with the best point in its attribute ``result``.
        """
        from .solving import solve

        return solve(self, start, progress, interrupt, options, settings)

    def solve_refined(self, start=None, *, progress=None, interrupt: str = "keep", options=None,
                      **settings) -> "Result":
        """``solve``, and again on finer grids until the motion holds between the nodes too;
        ``result.problem`` is the problem on the last grid."""
        from .solving import solve_refined

        return solve_refined(self, start, progress, interrupt, options, settings)

    @property
    def parameters(self) -> records.Parameters:
        """The free parameters of the problem's file; ``items`` is empty without."""
        struct, pointer = usual_struct("ambulo_parameters"), self._pointer
        lib.ambulo_problem_parameters_fill(pointer, struct)
        return from_c(records.Parameters, struct)

    def solve_parameters(self, parameters=None, *, at: Optional[Callable] = None, start=None,
                         progress=None, interrupt: str = "keep", options=None, **settings) -> "Result":
        """Finds the best values of numbers of the problem as well.

        ``parameters`` are Parameters, or bounds by name in SI and rad, ``{"gait.step_time":
        (0.4, 0.8)}``; None: those of the file. For any but those of the file ``at`` makes the
        problem at given values: a function of an array that returns a Problem with unknowns as many
        as before, and raises AmbuloError where there is none.

        ``result.problem`` is the problem at the best values, ``result.parameters`` says which they
        are.
        """
        from .solving import solve_parameters

        return solve_parameters(self, parameters, at, start, progress, interrupt, options, settings)

    def at(self, values) -> "Problem":
        """The problem of a file with its free parameters at values, SI and rad."""
        values = array_of(values, (len(self.parameters.items),), "values")
        out, held = ffi.new("ambulo_problem **"), self._held
        with Call() as call:
            call(lib.ambulo_problem_at(held.pointer, doubles(values), NULL, call.messages, out))
        return Problem(Handle(out[0], lib.ambulo_problem_free, held))

    def audit(self, x, *, options=None, **settings) -> "Result":
        """Judges given unknowns as if a solver had returned them: a Result."""
        from .solving import audit

        return audit(self, x, options, settings)

    def __repr__(self):
        if self._handle is None:
            return "<Problem, closed>"
        return (f"<Problem {self.name}: {self.variable_count} unknowns, {self.row_count} rows, "
                f"{self.node_count} nodes, {self.duration:.4g} s>")


def _carrier(model, intervals, spline_intervals, devices):
    """For records about a model, with the functions that they bring."""
    coordinates, points = len(model.coordinates), len(model.points)
    functions = []

    def function(given):
        made = node_function(given, coordinates, points)
        functions.append((made, given))
        return made

    sizes = {"d": coordinates, "feet": len(model.feet), "devices": devices,
             "nodes": int(intervals) + 1, "knots": int(spline_intervals) + 1}
    return Carrier(sizes, model.find, function), functions
