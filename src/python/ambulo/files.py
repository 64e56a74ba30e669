"""Motions in files: their inverse dynamics, and how they compare with people."""

import io
from typing import Dict, List, NamedTuple, Optional

import numpy

from . import _records as records
from ._native import FOLDER, Call, ffi, lib, path_of, text_of
from .model import Model
from .records import Carrier, from_c, usual_struct

NULL = ffi.NULL


class InverseOfFile(NamedTuple):
    """Inverse dynamics of a measured motion."""

    columns: Dict[str, numpy.ndarray]
    """By name: time, q.*, qd.*, qdd.*, tau.*, zmp.*, ... (docs/guide-inverse.md)."""
    residual: Optional[records.GroundResidual]
    """What the forces on the feet leave over of the root wrench; None without forces."""

    def to_pandas(self):
        """A pandas.DataFrame with the time (s) as its index."""
        import pandas

        table = dict(self.columns)
        index = pandas.Index(table.pop("time"), name="time")
        return pandas.DataFrame(table, index=index)


def read_table(text: str) -> Dict[str, numpy.ndarray]:
    """Columns by name of a CSV of the library: comments, a line of names, lines of numbers."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    values = numpy.loadtxt(io.StringIO("\n".join(lines[1:])), delimiter=",", ndmin=2)
    return dict(zip(lines[0].split(","), values.T))


def inverse_of_file(model: Model, motion, **options) -> InverseOfFile:
    """Inverse dynamics of a motion in a file (CSV, STO or MOT), with forces on the feet.

    ``options`` are those of ``InverseOptions``: ``forces`` (a file), ``force_columns``, ``angles``
    ("angles_degrees"), ``cutoff`` (Hz), ...
    """
    carrier = Carrier()
    for name in ("forces",):
        if options.get(name) is not None:
            options[name] = str(options[name])
    struct = carrier.new(records.InverseOptions(**options))
    residual, out = ffi.new("ambulo_ground_residual *"), ffi.new("char **")
    residual.moment_rms = -1.0  # untouched without forces
    outputs = usual_struct("ambulo_inverse_outputs")
    outputs.residual, outputs.text = residual, out
    with Call() as call:
        call(lib.ambulo_inverse_dynamics_motion(model._pointer, path_of(motion), NULL, struct, NULL,
                                                call.messages, outputs))
    text = text_of(out[0])
    lib.ambulo_text_free(out[0], NULL)
    known = None if residual.moment_rms == -1.0 else from_c(records.GroundResidual, residual)
    return InverseOfFile(read_table(text), known)


def compare(folder, reference=None, *, norms=None, **options) -> List[records.CurveScore]:
    """Scores a result folder, or a file with a person's own motion, against curves of people.

    ``reference`` is a CSV of normative curves; None: the shipped curves (or those of the
    folder ``norms``). ``options`` are those of ``CompareOptions``.
    """
    struct = Carrier().new(records.CompareOptions(**options))
    out = ffi.new("ambulo_comparison **")
    with Call() as call:
        if reference is None:
            norms = FOLDER / "models" / "norms" if norms is None else norms
            call(lib.ambulo_compare_norms(path_of(folder), path_of(norms), struct, NULL,
                                          call.messages, out))
        else:
            call(lib.ambulo_compare(path_of(folder), path_of(reference), struct, NULL,
                                    call.messages, out))
    made = ffi.gc(out[0], lib.ambulo_comparison_free)
    return [from_c(records.CurveScore, lib.ambulo_comparison_curve(made, i))
            for i in range(lib.ambulo_comparison_curve_count(made))]
