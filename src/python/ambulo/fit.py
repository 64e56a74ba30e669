"""Inverse optimal control: numbers of a problem from curves of people."""

import json
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Union

from . import _records as records
from ._native import Call, Handle, Owner, ffi, lib, path_of, text_of
from .problem import Problem
from .processes import Watch, left_of, print_line
from .records import Carrier, from_c

NULL = ffi.NULL


def _show(now):
    print_line(f"iteration {now.iteration}: distance {now.best:.4f} (at first {now.first:.4f}), "
               f"{now.solves} solves{left_of(now.seconds_left)}")


class Fit(Owner):
    """A fit file: parameters of a problem, conditions with curves of people, a distance.

    >>> with ambulo.Fit.load("fit_walk.yaml") as fit:
    ...     found = fit.run("fitted", progress=True)
    >>> found.to_pandas()
    >>> found.problem().solve()

    The format is that of docs/guide-fit.md.
    """

    def __init__(self, handle: Handle):
        self._handle = handle

    @classmethod
    def load(cls, path) -> "Fit":
        """Reads a fit file, its problem and its references, and tries the bounds of each parameter."""
        out = ffi.new("ambulo_fit **")
        with Call() as call:
            call(lib.ambulo_fit_load(path_of(path), NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_fit_free))

    def describe(self) -> str:
        """What was understood."""
        out = ffi.new("char **")
        with Call() as call:
            call(lib.ambulo_fit_describe(self._pointer, NULL, out))
        return _taken(out[0])

    def run(self, folder, *, workers: int = 0, progress: Union[bool, Callable, None] = None,
            interrupt: str = "keep", **options) -> "FitReport":
        """Runs the fit, or goes on with it, in ``folder``.

        ``progress`` gets a FitProgress; it and the other arguments are as in ``Batch.run``,
        ``options`` those of FitOptions. A run that is stopped before its first solves ended leaves
        no report: FileNotFoundError.
        """
        carrier, text = Carrier(), ffi.new("char **")
        watch = Watch(carrier, records.FitOptions(workers=workers, **options), progress, _show,
                      records.FitProgress, interrupt)
        with Call() as call:
            status = lib.ambulo_fit_run(self._pointer, path_of(folder), watch.options, NULL,
                                        call.messages, NULL, text)
            told = _taken(text[0])
            watch.finish(call, status, "the same call goes on")
        return FitReport(folder, told)


def _taken(pointer) -> Optional[str]:
    """A text of the library that is the caller's to free."""
    text = text_of(pointer)
    lib.ambulo_text_free(pointer, NULL)
    return text


class FitReport:
    """What a fit found: the folder of a run, from ``Fit.run`` or from before.

    ``document`` is fit.json (docs/guide-fit.md), ``text`` the table for people of the run that made
    it, None where the folder was only opened.
    """

    def __init__(self, folder, text: Optional[str] = None):
        self.folder = Path(folder)
        self.text = text
        path = self.folder / "fit.json"
        if not path.exists():
            raise FileNotFoundError(f"{path} is not there: no fit ended in this folder")
        self.document: Dict[str, Any] = json.loads(path.read_text())

    @property
    def name(self) -> str:
        return self.document["name"]

    @property
    def ended_by(self) -> str:
        """"converged", "iterations", "interrupted" or "stuck"."""
        return self.document["ended_by"]

    @property
    def distance(self) -> Dict[str, Optional[float]]:
        """``before``, ``after``, ``from_zero``, ...; None where there is none."""
        return self.document["distance"]

    @property
    def parameters(self) -> Dict[str, float]:
        """The factor or the addend of each parameter."""
        return {name: one["change"] for name, one in self.document["parameters"].items()}

    @property
    def fitted(self) -> Path:
        """The problem file with the fitted numbers in place."""
        return self.folder / "fitted.yaml"

    def problem(self, condition: Optional[str] = None) -> Problem:
        """The fitted problem, as its file has it or as a condition sets it."""
        if condition is None:
            return Problem.load(self.fitted)
        known = self.document["conditions"]
        if condition not in known:
            raise KeyError(f"there is no condition '{condition}'; known are {', '.join(known)}")
        return Problem.load(self.document["problem"], known[condition]["settings"])

    def to_pandas(self):
        """A line for each number of the problem that was fitted: parameter, key, value before and
        after, and what is known of the parameter."""
        import pandas

        return pandas.DataFrame([
            {"parameter": name, "key": key, **values,
             **{word: one[word] for word in ("scale", "change", "at_bound", "sensitivity")}}
            for name, one in self.document["parameters"].items()
            for key, values in one["keys"].items()])

    def curves_to_pandas(self):
        """A line for each curve of each condition, before and after: z, rmse, r, range_ratio."""
        import pandas

        lines: List[Dict[str, Any]] = []
        for condition, one in self.document["conditions"].items():
            for curve, about in one["curves"].items():
                for when in ("before", "after"):
                    lines.append({"condition": condition, "held_out": bool(one["held_out"]),
                                  "curve": curve, "unit": about["unit"], "when": when,
                                  **(about.get(when) or {})})
        return pandas.DataFrame(lines)

    def history_to_pandas(self):
        """A line for each iteration: distance, cost, what was accepted."""
        import pandas

        return pandas.DataFrame(self.document["history"])

    def __repr__(self):
        distance = self.distance
        return (f"<FitReport {self.name}: {self.ended_by}, distance {distance['before']:.4g} -> "
                f"{distance['after']:.4g}>")
