"""Structures as Python objects."""

import ambulo
import numpy
from ambulo import records
from ambulo._declarations import ffi
from ambulo._native import lib
from support import Case, arm


class Records(Case):
    def test_new_ones_start_from_the_librarys_defaults(self):
        self.assertEqual(ambulo.Term("torque_power").power, 3.0)
        self.assertEqual(ambulo.Term("mechanical_power").smoothing, 0.05)
        self.assertEqual(ambulo.GroundReaction().friction, 0.5)
        self.assertEqual(ambulo.ProblemDefinition().intervals, 12)
        self.assertEqual(ambulo.Options().maximum_iterations, 150)
        self.assertEqual(ambulo.Device("spring").smoothing, 0.01)
        self.assertEqual(ambulo.Coordinate().range, [-numpy.inf, numpy.inf])

    def test_every_part_of_a_definition_has_a_default(self):
        """What a caller fills starts from what the library says."""
        parts, seen = [ambulo.ModelDefinition, ambulo.ProblemDefinition, ambulo.Extension,
                       ambulo.Parameters, ambulo.Gait, ambulo.Conditions, ambulo.Subject], set()
        while parts:
            kind = parts.pop()
            for _, spec, _ in kind._fields.values():
                if spec[0] in ("record", "records"):
                    parts.append(getattr(ambulo, spec[1]))
            seen.add(kind)
        without = {kind.__name__ for kind in seen 
                   if not records.fill_usual(kind._struct, ffi.new(kind._struct + " *"))}
        self.assertEqual(without, set())
        self.assertGreater(len(seen), 20)
        self.assertEqual(ambulo.Foot().heel, [-1, -1])
        self.assertEqual(ambulo.Contact().patch, -1)
        self.assertEqual(ambulo.UserRow().to, numpy.inf)

    def test_new_ones_share_nothing(self):
        one = ambulo.GroundReaction()
        one.heel_pressure[0] = 7.0
        self.assertNotEqual(ambulo.GroundReaction().heel_pressure[0], 7.0)

    def test_constants_have_names(self):
        term = ambulo.Term("torque_squared")
        self.assertIs(term.kind, ambulo.TermKind.TORQUE_SQUARED)
        self.assertEqual(str(term.kind), "torque_squared")
        term.kind = "posture"
        self.assertEqual(term.kind, ambulo.TermKind["POSTURE"])
        self.assertEqual(ambulo.JointType.REVOLUTE, 2)
        self.assertEqual(ambulo.Bound.AT_LOWER, 1)
        with self.assertRaisesRegex(ValueError, "did you mean 'torque_squared'"):
            ambulo.Term("torque_sqared")

    def test_unknown_fields_are_refused_with_a_hint(self):
        with self.assertRaisesRegex(AttributeError, "did you mean 'weight'"):
            ambulo.Term("posture", wieght=2)
        with self.assertRaisesRegex(TypeError, "twice"):
            ambulo.Term("posture", kind="posture")
        with self.assertRaisesRegex(TypeError, "needs its kind"):
            ambulo.Term()

    def test_docstrings_are_the_headers(self):
        self.assertIn("tau_i - offset_i", ambulo.TermKind.__doc__)
        self.assertIn("mass: kg; nan (or None): as in the file", ambulo.Subject.__doc__)
        self.assertIn("from_: s", ambulo.UserRow.__doc__)
        undocumented = [name for name in ("Link", "Coordinate", "Contact", "Term", "Device", "Options")
                        if not getattr(ambulo, name).__doc__]
        self.assertEqual(undocumented, [])

    def test_round_trip_through_the_structure(self):
        """Every record that a caller may fill comes back as it went."""
        device = ambulo.Device("actuator", name="motor", coordinate=1, amount=4.0,
                               clock="by_stride",
                               points=[[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]],
                               position=[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
        carrier = records.Carrier()
        back = records.from_c(ambulo.Device, carrier.new(device))
        self.assertEqual(back, device)
        self.assertEqual(back.position, [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(back.points, [[0, 0], [0.5, 1], [1, 0]])
        self.assertEqual(back.name, "motor")

    def test_lists_of_numbers(self):
        carrier = records.Carrier()
        obstacle = ambulo.Obstacle("bar", capsules=[3, 1])
        self.assertEqual(records.from_c(ambulo.Obstacle, carrier.new(obstacle)).capsules, [3, 1])

    def test_names_stand_for_numbers(self):
        with arm() as model:
            carrier = records.Carrier(find=model.find)
            self.assertEqual(carrier.new(ambulo.EndValue("elbow", 0, 0, 1.0)).coordinate, 1)
            reach = carrier.new(ambulo.Reach("hand", place=[1, 0, 0]))
            self.assertEqual(reach.point, 1)
            with self.assertRaisesRegex(ValueError, "has no coordinate 'knee'"):
                carrier.new(ambulo.EndValue("knee"))
        with self.assertRaisesRegex(TypeError, "order"):
            records.Carrier().new(ambulo.EndValue(0, "first"))

    def test_arrays_have_their_shape(self):
        carrier = records.Carrier({"d": 2, "devices": 0, "nodes": 3})
        struct = carrier.new(ambulo.Term("posture", scale=[1, 2], passive=numpy.ones((2, 4))))
        self.assertEqual(list(ffi.unpack(struct.scale, 2)), [1, 2])
        for wrong in ({"scale": [1, 2, 3]}, {"passive": numpy.ones((4, 2))},
                      {"reference": numpy.ones((2, 2))}, {"point": [1]}):
            with self.assertRaisesRegex(ValueError, "expected"):
                carrier.new(ambulo.Term("posture", **wrong))
        tube = carrier.new(ambulo.Tube(reference=numpy.ones((5, 2)), half_width=[1, 1]))
        self.assertEqual(tube.samples, 5)

    def test_as_a_dictionary(self):
        given = ambulo.Limits(low=1.0).to_dict()
        self.assertEqual(given["low"], 1.0)
        self.assertEqual(ambulo.Term("posture").to_dict()["kind"], "posture")
