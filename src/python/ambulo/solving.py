"""Solves: options, progress, interruption, and what becomes of exceptions meanwhile."""

import os
import sys
import time

import numpy

from . import _records as records
from ._native import Call, Handle, ffi, keep_exception, lib, path_of, pending, take_pending, warn
from .errors import AmbuloError
from .mechanics import array_of, doubles
from .records import Carrier, from_c, usual_struct

NULL = ffi.NULL


def print_progress(progress):
    """A line on standard error that is written over."""
    left = f", {progress.seconds_left:.0f} s left" if progress.seconds_left >= 0 else ""
    sys.stderr.write(f"\r{progress.stage} {progress.iteration}: objective "
                     f"{progress.objective:.6g}, violation {progress.violation:.1e}, "
                     f"{progress.seconds:.1f} s{left}\033[K")
    sys.stderr.flush()


class Run:
    """One call of the solver from Python: the C options with the callback that watches it.

    The callback is there in any case: Python sees Ctrl-C only when some Python code runs.
    """

    def __init__(self, problem, options, settings, progress, interrupt):
        if interrupt not in ("keep", "raise"):
            raise ValueError(f"interrupt '{interrupt}'; expected 'keep' or 'raise'")
        options = problem.options() if options is None else options
        for name, value in settings.items():
            setattr(options, name, value)
        self.interrupt = interrupt
        self.shown = progress is True
        progress = print_progress if self.shown else progress

        def watch(_, state):
            if pending() is not None:
                return 1
            return 1 if progress and progress(from_c(records.Progress, state)) else 0

        self.watch = ffi.callback("int(void *, const ambulo_progress *)", watch, error=1,
                                  onerror=keep_exception)
        self.carrier = Carrier()
        self.options = self.carrier.new(options)
        self.options.progress = self.watch

    def finish(self, call, status, make):
        """The result, or the exception that ended the run."""
        if self.shown:
            sys.stderr.write("\n")
        stopped = take_pending()
        if status and stopped is not None:
            raise stopped
        call(status)
        result = make(call)
        if stopped is None:
            return result
        if isinstance(stopped, KeyboardInterrupt) and self.interrupt == "keep":
            warn("interrupted: the result is the best point so far")
            return result
        stopped.result = result
        raise stopped


def multipliers_handle(make):
    """What `make(out)` leaves in an ambulo_multipliers **; None where it leaves none."""
    out = ffi.new("ambulo_multipliers **")
    make(out)
    return Handle(out[0], lib.ambulo_multipliers_free) if out[0] else None


def start_from_step(problem, run):
    """Unknowns, and multipliers or None; what it takes is taken off the time limit."""
    x, began = numpy.zeros(problem.variable_count), time.monotonic()
    with Call() as call:
        multipliers = multipliers_handle(lambda out: call(lib.ambulo_start_from_step(
            problem._pointer, run.options, NULL, doubles(x), out)))
    if run.options.time_limit > 0:
        left = run.options.time_limit - (time.monotonic() - began)
        run.options.time_limit = max(1e-3, left)
    return x, multipliers


def start_of(problem, start, run):
    """The unknowns to begin at; run.options get the multipliers of a Result, a file or a step."""
    from .result import Result

    if isinstance(start, str) and start == "zero":
        return NULL
    multipliers = None
    if start is None:
        x, multipliers = start_from_step(problem, run)
        if not multipliers:
            return NULL
    elif isinstance(start, Result):
        with Call() as call:
            multipliers = multipliers_handle(lambda out: call(lib.ambulo_multipliers_of(
                start.problem._pointer, start._pointer, NULL, out)))
        x = start.x
        if x.size != problem.variable_count:
            x = start.problem.transfer(x, problem)
    elif isinstance(start, (str, os.PathLike)):
        x = problem.load_solution(start, stretch=True)
        with Call() as call:
            multipliers = multipliers_handle(lambda out: call(lib.ambulo_solution_multipliers(
                path_of(start), problem._pointer, lib.AMBULO_ENDS_FREE, NULL, call.messages, out)))
    else:
        x = start
    if multipliers:
        run.options.multipliers = multipliers.pointer
        run.multipliers = multipliers
    return doubles(problem._point(x))


def solve(problem, start, progress, interrupt, options, settings):
    from .result import Result

    run = Run(problem, options, settings, progress, interrupt)
    problem = problem._twin()  # the caller's may be closed meanwhile
    out, first = ffi.new("ambulo_result **"), start_of(problem, start, run)
    with Call() as call:
        status = lib.ambulo_solve(problem._pointer, run.options, first, NULL, call.messages, out)
        return run.finish(call, status, lambda call: Result(problem, out[0], call.list()))


def solve_refined(problem, start, progress, interrupt, options, settings):
    from .problem import Problem
    from .result import Result

    run = Run(problem, options, settings, progress, interrupt)
    problem = problem._twin()
    out, finer = ffi.new("ambulo_result **"), ffi.new("ambulo_problem **")
    first = start_of(problem, start, run)

    def make(call):
        last = problem
        if finer[0]:
            last = Problem(Handle(finer[0], lib.ambulo_problem_free, problem._held))
        return Result(last, out[0], call.list())

    with Call() as call:
        status = lib.ambulo_solve_refined(problem._pointer, run.options, first, NULL,
                                          call.messages, finer, out)
        return run.finish(call, status, make)


def audit(problem, x, options, settings):
    from .result import Result

    run = Run(problem, options, settings, None, "keep")
    problem = problem._twin()
    out, x = ffi.new("ambulo_result **"), problem._point(x)
    with Call() as call:
        status = lib.ambulo_audit_point(problem._pointer, run.options, doubles(x), NULL,
                                        call.messages, out)
        return run.finish(call, status, lambda call: Result(problem, out[0], call.list()))


# ------------------------------------------------------------- free parameters


def problem_at(solved, function, count, kept):
    """A Python function that makes problems, as the library calls it. The library takes each
    problem over; what that needs (its model, functions) is held in `kept`."""

    def of(handle):
        yield handle
        for need in handle.needs:
            if isinstance(need, Handle):
                yield from of(need)

    def make(_, values, _allocator, _diagnostics, out):
        values = numpy.frombuffer(ffi.buffer(values, 8 * count), dtype=float).copy()
        try:
            problem = function(values)
        except AmbuloError as fault:
            return int(records.Status[fault.status])
        if not hasattr(problem, "_twin"):
            raise TypeError(f"the function returned {problem!r}; expected a Problem")
        handle = problem._held
        if any(handle is other for other in of(solved._held)):
            raise ValueError("the function returned the problem that is solved; expected a new one "
                             "at each call, which is then handed over")
        kept.append(handle.needs)
        out[0] = handle.give()
        problem.close()
        return 0

    return ffi.callback(
        "ambulo_status(void *, const double *, const ambulo_allocator *, ambulo_diagnostics *, "
        "ambulo_problem **)", make, error=int(records.Status.E_PROBLEM), onerror=keep_exception)


def solve_parameters(problem, parameters, at, start, progress, interrupt, options, settings):
    from .problem import Problem
    from .result import Result

    run, kept = Run(problem, options, settings, progress, interrupt), []
    problem = problem._twin()
    struct = usual_struct("ambulo_parameters")
    lib.ambulo_problem_parameters_fill(problem._pointer, struct)
    if parameters is not None or at is not None:
        parameters = problem.parameters if parameters is None else parameters
        if hasattr(parameters, "items") and callable(parameters.items):  # a dictionary
            parameters = records.Parameters(items=[
                records.Parameter(name, *bounds) for name, bounds in parameters.items()])
        struct = run.carrier.new(parameters)
        if at is not None:
            struct.problem_at = run.carrier.keep(problem_at(problem, at, len(parameters.items), kept))
    out, best = ffi.new("ambulo_result **"), ffi.new("ambulo_problem **")
    struct.start = first = start_of(problem, start, run)

    def make(call):
        handle = Handle(best[0], lib.ambulo_problem_free, problem._held, kept)
        return Result(Problem(handle), out[0], call.list())

    with Call() as call:
        status = lib.ambulo_solve_parameters(problem._pointer, struct, run.options, NULL,
                                             call.messages, best, out)
        return run.finish(call, status, make)
