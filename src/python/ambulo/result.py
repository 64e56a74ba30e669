"""What a solve found, and how good it is."""

import json
from typing import Any, Dict, List, Optional

import numpy

from . import _records as records
from ._native import Call, Handle, Owner, ffi, lib, path_of, text_of
from .errors import Message
from .motion import Motion
from .records import Carrier, from_c

NULL = ffi.NULL


class Result(Owner):
    """The point that a solve ended at; made by ``Problem.solve`` and its kin.

    Three facts are kept apart: that there is a result at all (the call was legal), its ``verdict``
    (what the point is), and its ``audit`` (how good it is). ``problem`` is the problem it belongs
    to, which with free parameters is the one at their best values.
    """

    _instead = "write it with write(), or keep what it says: x, summary(), motion()"

    def __init__(self, problem, pointer, messages: List[Message]):
        self._handle = Handle(pointer, lib.ambulo_result_free, problem._held)
        self.problem = problem._twin()
        self.messages = messages

    # -------------------------------------------------------------------- point

    @property
    def verdict(self) -> records.Verdict:
        """OPTIMAL, FEASIBLE, INFEASIBLE, ...; prints as "optimal"."""
        return records.Verdict(lib.ambulo_result_verdict(self._pointer))

    @property
    def is_solution(self) -> bool:
        """Whether the motion can be used: verdict optimal or feasible."""
        return bool(lib.ambulo_verdict_is_solution(lib.ambulo_result_verdict(self._pointer)))

    def _array(self, function, *shape) -> numpy.ndarray:
        size, held = int(numpy.prod(shape)), self._held
        pointer = function(held.pointer)
        if pointer == NULL or not size:
            return numpy.full(shape, numpy.nan)
        return numpy.frombuffer(ffi.buffer(pointer, 8 * size), dtype=float).reshape(shape).copy()

    @property
    def x(self) -> numpy.ndarray:
        """The unknowns [control_points][d]."""
        count = self.problem.control_point_count
        return self._array(lib.ambulo_result_x, count,
                           self.problem.variable_count // count)

    @property
    def objective(self) -> float:
        return lib.ambulo_result_objective(self._pointer)

    @property
    def terms(self) -> Dict[str, float]:
        """Terms of the objective by name, weighted; of several of one name the sum."""
        names = self.problem.term_names
        values = self._array(lib.ambulo_result_terms, len(names))
        found: Dict[str, float] = {}
        for name, value in zip(names, values):
            found[name] = found.get(name, 0.0) + float(value)
        return found

    @property
    def rows(self) -> numpy.ndarray:
        """Values of the rows, each in its unit; ``problem.rows()`` describes them."""
        return self._array(lib.ambulo_result_rows, self.problem.row_count)

    @property
    def multipliers(self) -> numpy.ndarray:
        """[row_count]: of the Lagrangian f - sum of multiplier times row."""
        return self._array(lib.ambulo_result_multipliers, self.problem.row_count)

    def motion(self, times=None) -> Motion:
        """The motion at ``times`` in [0, duration]; None: the time nodes; a whole number: so many
        equally spaced ones."""
        if isinstance(times, int):
            times = numpy.linspace(0.0, self.problem.duration, times)
        return self.problem.motion(self.x, times)

    # --------------------------------------------------------------- how good it is

    def _record(self, kind, function):
        return self._read(lambda found: None if found == NULL else from_c(kind, found), function)

    @property
    def audit(self) -> records.Audit:
        return self._record(records.Audit, lib.ambulo_result_audit)

    @property
    def dense_audit(self) -> Optional[records.DenseAudit]:
        """What happens between the nodes; None: nothing is known."""
        return self._record(records.DenseAudit, lib.ambulo_result_dense_audit)

    @property
    def families(self) -> List[records.Violation]:
        """Worst violation of each family of rows."""
        pointer = self._pointer
        return [from_c(records.Violation, lib.ambulo_result_family(pointer, i))
                for i in range(lib.ambulo_result_family_count(pointer))]

    @property
    def explanation(self) -> Optional[records.Explanation]:
        """Why there is no solution; None where there is one."""
        return self._record(records.Explanation, lib.ambulo_result_explanation)

    @property
    def iterations(self) -> int:
        return lib.ambulo_result_iterations(self._pointer)

    @property
    def evaluations(self) -> int:
        return lib.ambulo_result_evaluations(self._pointer)

    @property
    def timing(self) -> records.Timing:
        """Wall time and where it went, s."""
        return self._record(records.Timing, lib.ambulo_result_timing)

    @property
    def nlopt(self) -> records.NloptWork:
        return self._record(records.NloptWork, lib.ambulo_result_nlopt)

    @property
    def history(self) -> Dict[str, numpy.ndarray]:
        """The way of the solve, an array for each column: iteration, evaluations, intervals of the
        grid, objective, violation, gradient, seconds (``ambulo_iteration`` of ambulo/solve.h); the
        last is the point that was found. ``pandas.DataFrame(result.history)`` makes a table,
        ``ambulo.plots.convergence(result)`` a picture."""
        items = self._record(records.History, lib.ambulo_result_history).items
        return {name: numpy.array([getattr(item, name) for item in items], kind)
                for name, kind in (("iteration", int), ("evaluations", int), ("intervals", int),
                                   ("objective", float), ("violation", float), ("gradient", float),
                                   ("seconds", float))}

    @property
    def starts(self) -> Optional[records.Starts]:
        """Valleys that several starts ended in; None for one start."""
        return self._record(records.Starts, lib.ambulo_result_starts)

    @property
    def refinement(self) -> Optional[records.Refinement]:
        """The grids of Problem.solve_refined, and what finer ones would still bring; None for one
        grid."""
        return self._record(records.Refinement, lib.ambulo_result_refinement)

    @property
    def ending(self) -> str:
        """Why the solver ended, in words."""
        return self._read(text_of, lib.ambulo_result_ending)

    @property
    def ending_code(self) -> records.Ending:
        return records.Ending(lib.ambulo_result_ending_code(self._pointer))

    @property
    def parameters(self) -> Optional[records.ParametersOutcome]:
        """What became of free parameters; None without."""
        return self._record(records.ParametersOutcome, lib.ambulo_result_parameters)

    # ----------------------------------------------------------- sensitivities

    def sensitivities(self) -> List[records.Sensitivity]:
        """The sensitivity of this optimum to each number of the problem, largest first; empty where the
        point is not optimal. ``ambulo.to_pandas(result.sensitivities())`` makes a table."""
        out = ffi.new("ambulo_sensitivity_list **")
        with Call() as call:
            call(lib.ambulo_sensitivities(self.problem._pointer, self._pointer, NULL, out))
        made = ffi.gc(out[0], lib.ambulo_sensitivities_free)
        return from_c(records.SensitivityList, made).items

    # ------------------------------------------------------------------- output

    def summary(self) -> Dict[str, Any]:
        """What summary.json says (docs/results.md)."""
        out = ffi.new("char **")
        with Call() as call:
            call(lib.ambulo_report_summary(self.problem._pointer, self._pointer, NULL, NULL, out))
        text = text_of(out[0])
        lib.ambulo_text_free(out[0], NULL)
        return json.loads(text)

    def write(self, folder, *, samples: int = 0, overwrite: bool = False, norms=None) -> None:
        """Writes the result folder that ``ambulo solve`` writes, all or nothing: summary.json,
        motion.csv at the nodes or ``samples`` equally spaced times, motion.sto, solution.yaml,
        gait.svg with curves of people from the folder ``norms`` behind."""
        carrier = Carrier()
        options = carrier.new(records.ReportOptions(
            samples=samples, overwrite=int(overwrite), norms=None if norms is None else str(norms)))
        with Call() as call:
            call(lib.ambulo_report_write(self.problem._pointer, self._pointer, path_of(folder),
                                         options, NULL, call.messages))

    def rows_to_pandas(self):
        """All rows with their values and multipliers, a pandas.DataFrame."""
        from .tables import to_pandas

        table = to_pandas(self.problem.rows())
        return table.assign(value=self.rows, multiplier=self.multipliers)

    def __repr__(self):
        if self._handle is None:
            return "<Result, closed>"
        worst = self.audit.violation
        return (f"<Result of {self.problem.name}: {self.verdict}, objective {self.objective:.6g}, "
                f"violation {worst.worst:.1e} {worst.unit or ''}>".replace(" >", ">"))
