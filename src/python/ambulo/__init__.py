"""Ambulo: prediction of human motion by optimization.

    >>> import ambulo
    >>> with ambulo.Problem.load(ambulo.MODELS / "walk_normal.yaml") as problem:
    ...     result = problem.solve()
    >>> result.verdict
    <Verdict.OPTIMAL: 1>
    >>> result.motion().to_pandas()["tau.knee_angle_r"].plot()

=======================  ===================================================================
``Model``                the skeleton
``Mechanics``            inverse dynamics of motions in arrays
``Problem``              what to minimize, subject to what; its solves
``Result``               the point that was found: verdict, audit, motion, sensitivities
``Solver``               one problem again and again, from where it stands
``Motion``               arrays, a table, a picture
``Muscles``              muscle forces of a motion, contact forces, metabolic power
``inverse_of_file``      inverse dynamics of a measured motion
``compare``              a result or a measured motion against people
``Batch``, ``Study``     many problems at once, on all cores; the folder that this leaves
``Fit``, ``FitReport``   numbers of a problem from curves of people
``plots``                pictures
``AmbuloError``          every call that fails
=======================  ===================================================================

Problems and models made in Python are made of records: ``Link``, ``Coordinate``, ``Contact``,
``Term``, ``UserRow``, ... with the fields of the C structures, which ``help`` explains. SI units and
radians, always; arrays are [nodes][coordinates]. ``MODELS`` is the folder of the shipped models.

Models and problems may be shared between threads; a solve lets other threads run. Everything else
belongs to one thread at a time.
"""

from . import _records, callbacks, plots
from ._native import FOLDER, ffi, lib
from ._records import *  # noqa: F401,F403 - the structures of the interface
from ._records import __all__ as _record_names
from .batch import Batch, Study, StudyCase, Verified
from .errors import AmbuloError, AmbuloWarning, Message
from .files import InverseOfFile, compare, inverse_of_file
from .fit import Fit, FitReport
from .mechanics import Gradient, Jacobians, Mechanics, PointMotion
from .model import InverseDynamics, Model
from .motion import Motion
from .muscles import MuscleAnalysis, Muscles, Sharing
from .problem import Evaluation, Problem
from .processes import program
from .records import Enumeration, Record, from_c
from .result import Result
from .solver import Iterate, Solver
from .tables import to_pandas

__version__ = ffi.string(lib.ambulo_version()).decode()
MODELS = FOLDER / "models"
"""Folder of the shipped models and problems."""


def versions() -> dict:
    """The versions of what is running: ambulo, nlopt, libyaml, blas, instruction_set, engine."""
    struct = ffi.new("ambulo_versions *")
    lib.ambulo_versions_get(struct)
    return from_c(_records.Versions, struct).to_dict()


__all__ = [
    "AmbuloError", "AmbuloWarning", "Batch", "Enumeration", "Evaluation", "Fit", "FitReport",
    "Gradient", "InverseDynamics", "InverseOfFile", "Iterate", "Jacobians", "MODELS", "Mechanics",
    "Message", "Model", "Motion", "MuscleAnalysis", "Muscles", "PointMotion", "Problem", "Record",
    "Result", "Sharing", "Solver", "Study", "StudyCase", "Verified", "callbacks", "compare",
    "inverse_of_file", "plots", "program", "to_pandas", "versions",
] + _record_names
