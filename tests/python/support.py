"""What the tests of the Python package share."""

import os
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy

import ambulo

TOP = Path(os.environ.get("AMBULO_TOP", Path(__file__).resolve().parents[2]))
REACH = ambulo.MODELS / "two_link_reach.yaml"
COARSE_REACH = TOP / "tests" / "support" / "two_link_reach.yaml"  # off between its nodes
WALK = ambulo.MODELS / "walk_normal.yaml"
YARDSTICK = ambulo.MODELS / "yardstick_12.yaml"  # optimal at its nodes only


def optional(name):
    """A module, or None: tests of it are then skipped."""
    try:
        return __import__(name)
    except ImportError:
        return None


class Case(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", ambulo.AmbuloWarning)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def close(self, a, b, tolerance=1e-12):
        a, b = numpy.asarray(a, dtype=float), numpy.asarray(b, dtype=float)
        self.assertEqual(a.shape, b.shape)
        scale = max(1.0, float(numpy.abs(b).max()) if b.size else 1.0)
        self.assertLessEqual(float(numpy.abs(a - b).max()) if a.size else 0.0, tolerance * scale)

    def fails(self, status, function, *arguments, **named):
        """The AmbuloError that a call raises."""
        with self.assertRaises(ambulo.AmbuloError) as caught:
            function(*arguments, **named)
        self.assertEqual(caught.exception.status, status)
        return caught.exception


def arm():
    """The arm of models/two_link.yaml, made of records."""
    links = [
        ambulo.Link("upper", type="revolute", a=0.3, mass=2.0, com=[-0.15, 0, 0],
                    inertia=[0.002, 0.016, 0.016, 0, 0, 0]),
        ambulo.Link("lower", parent="upper", type="revolute", a=0.25, mass=1.5,
                    com=[-0.13, 0, 0], inertia=[0.001, 0.009, 0.009, 0, 0, 0])]
    coordinates = [ambulo.Coordinate("shoulder", "revolute", torque=[-30, 30]),
                   ambulo.Coordinate("elbow", "revolute", torque=[-15, 15])]
    points = [ambulo.Point("elbow", "upper", [0, 0, 0]), ambulo.Point("hand", "lower")]
    return ambulo.Model.create(links, coordinates, points, name="arm")


def swing(model, **fields):
    """From rest to rest in one second."""
    ends = [ambulo.EndValue(name, order, final, value)
            for name, first, last in (("shoulder", -1.2, 0.4), ("elbow", 0.3, 1.1))
            for final, value in ((0, first), (1, last))
            for order, value in ((0, value), (1, 0.0))]
    fields.setdefault("terms", [ambulo.Term("torque_squared")])
    return ambulo.Problem.create(model, name="swing", duration=1, intervals=12, end_values=ends,
                                 **fields)


def some_point(problem):
    return 0.4 * numpy.sin(1.0 + 1.7 * numpy.arange(problem.variable_count))


def effort(state, gradient):
    """What torque_squared is."""
    if gradient is not None:
        gradient.tau += 2 * state.tau
    return float(state.tau @ state.tau)
