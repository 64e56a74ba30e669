"""Models: files, records, queries, mechanics against closed forms."""

import ambulo
import numpy
from support import Case, arm

GRAVITY = 9.81


def closed_form(q, qd, qdd):
    """Torques of models/two_link.yaml, as its head has them."""
    h, (q1, q2), (v1, v2), (a1, a2) = 1.5 * 0.3 * 0.12, q.T, qd.T, qdd.T
    i1, i2, c1, c2 = 0.016, 0.009, 0.15, 0.12
    coupling = i2 + 1.5 * c2 ** 2 + h * numpy.cos(q2)
    one = ((i1 + 2 * c1 ** 2 + i2 + 1.5 * (0.3 ** 2 + c2 ** 2) + 2 * h * numpy.cos(q2)) * a1
           + coupling * a2 - h * numpy.sin(q2) * (2 * v1 * v2 + v2 ** 2)
           + GRAVITY * (2 * c1 + 1.5 * 0.3) * numpy.cos(q1) + GRAVITY * 1.5 * c2 * numpy.cos(q1 + q2))
    two = (coupling * a1 + (i2 + 1.5 * c2 ** 2) * a2 + h * numpy.sin(q2) * v1 ** 2
           + GRAVITY * 1.5 * c2 * numpy.cos(q1 + q2))
    return numpy.stack([one, two], axis=1)


def motion(nodes=11):
    values = numpy.sin(1.3 * numpy.arange(6 * nodes)).reshape(3, nodes, 2)
    return values[0], 2 * values[1], 5 * values[2]


class Models(Case):
    def test_made_of_records_is_what_the_file_says(self):
        with arm() as made, ambulo.Model.load(ambulo.MODELS / "two_link.yaml") as read:
            self.assertEqual(made.coordinate_names, ["shoulder", "elbow"])
            self.assertEqual([link.parent for link in made.links], [-1, 0])
            self.assertEqual(made.mass, read.mass)
            for a, b in zip(made.inverse_dynamics(*motion()), read.inverse_dynamics(*motion())):
                self.close(a, b, 1e-14)

    def test_drives_are_of_coordinates(self):
        def driven(**drive):
            links = [ambulo.Link("rod", type="revolute", a=1.0, mass=2.0, inertia=[0.1] * 3 + [0.0] * 3)]
            return ambulo.Model.create(links, [ambulo.Coordinate("turn", "revolute", **drive)], [])

        q, qd, qdd = numpy.array([[[0.3]], [[0.2]], [[-1.5]]])
        with driven() as bare, driven(armature=0.25, damping=2.0, friction=3.0) as model:
            self.assertEqual(model.coordinates[0].armature, 0.25)
            added = 0.25 * qdd + 2.0 * qd + 3.0 * qd / numpy.hypot(qd, 0.1)
            self.close(model.inverse_dynamics(q, qd, qdd).tau - bare.inverse_dynamics(q, qd, qdd).tau, added)

    def test_queries(self):
        with ambulo.Model.load(ambulo.MODELS / "lower_body_18.yaml", mass=70, stature=1.8) as model:
            self.assertEqual(len(model.coordinates), 18)
            self.assertAlmostEqual(model.mass, 70, 9)
            self.assertEqual(model.stature, 1.8)
            self.assertEqual([foot.name for foot in model.feet], ["right", "left"])
            self.assertEqual(model.find("coordinate", "knee_angle_r"),
                             model.coordinate_names.index("knee_angle_r"))
            self.close(model.up, [0, 1, 0])
            self.close(numpy.cross(model.up, model.forward), model.left)
            self.assertEqual(model.mirror_faults(), [])
            with self.assertRaises(ValueError):
                model.find("coordinate", "nose")
            self.assertIn("18 coordinates", repr(model))
        self.assertEqual(repr(model), "<Model, closed>")
        with self.assertRaisesRegex(ValueError, "closed"):
            model.mass

    def test_overrides_and_conditions(self):
        with ambulo.Model.load(ambulo.MODELS / "pendulum.yaml",
                               {"links[rod].body.mass": 4.5}) as model:
            self.assertEqual(model.mass, 4.5)
            with model.adapt(load_link="rod", load_mass=2.0, slope=0.1) as loaded:
                self.assertEqual(loaded.mass, 6.5)
                self.close(loaded.gravity, [-9.81 * numpy.sin(0.1), -9.81 * numpy.cos(0.1), 0])

    def test_faults_say_where(self):
        text = "ambulo: 1\nkind: model\nname: x\nlinks:\n  - {name: a, parent: none, jiont: fixed}\n"
        fault = self.fails("E_SCHEMA", ambulo.Model.load_text, text, "mine.yaml")
        error = next(message for message in fault.messages if "jiont" in message.message)
        self.assertEqual((error.severity, error.file, error.line), ("error", "mine.yaml", 5))
        self.assertIn("joint", error.hint)
        self.assertIn("mine.yaml:5:", str(fault))
        self.fails("E_IO", ambulo.Model.load, self.folder / "none.yaml")
        link = ambulo.Link("rod", type="revolute", mass=-1)
        fault = self.fails("E_MODEL", ambulo.Model.create, [link],
                           [ambulo.Coordinate("swing", "revolute")])
        self.assertIn("mass", str(fault))

    def test_left_that_is_not_right_is_told(self):
        with ambulo.Model.load(ambulo.MODELS / "lower_body_18.yaml",
                               {"links[shank_r].body.mass": 9}) as model:
            self.assertTrue(any("shank_r" in fault for fault in model.mirror_faults()))


class Mechanics(Case):
    def test_torques_are_those_of_the_closed_form(self):
        with arm() as model:
            q, qd, qdd = motion()
            found = model.inverse_dynamics(q, qd, qdd)
            self.close(found.tau, closed_form(q, qd, qdd), 1e-12)
            hand = numpy.stack([0.3 * numpy.cos(q[:, 0]) + 0.25 * numpy.cos(q.sum(axis=1)),
                                0.3 * numpy.sin(q[:, 0]) + 0.25 * numpy.sin(q.sum(axis=1))], axis=1)
            self.close(found.points[:, 1, :2], hand, 1e-14)

    def test_rates_left_out_are_zero_and_lists_are_arrays(self):
        with arm() as model:
            self.close(model.inverse_dynamics([[0.1, 0.2]]).tau,
                       closed_form(*(numpy.array([v]) for v in ([0.1, 0.2], [0, 0], [0, 0]))))
            q = numpy.asfortranarray(motion()[0])
            self.close(model.inverse_dynamics(q).tau, model.inverse_dynamics(q.copy("C")).tau, 0)

    def test_shapes_and_values_are_checked(self):
        with arm() as model, ambulo.Mechanics(model) as mechanics:
            with self.assertRaisesRegex(ValueError, r"expected \[n\]\[2\]"):
                mechanics.inverse_dynamics([1.0, 2.0])
            with self.assertRaisesRegex(ValueError, "qd is an array"):
                mechanics.inverse_dynamics(*[numpy.zeros((3, 2)), numpy.zeros((2, 2))])
            self.fails("E_NUMERIC", mechanics.inverse_dynamics, [[numpy.nan, 0]])

    def test_derivatives(self):
        q, qd, qdd = motion(3)
        with arm() as model, ambulo.Mechanics(model) as mechanics:
            jacobians = mechanics.jacobians(q, qd, qdd)
            mass = jacobians.tau_qdd
            self.close(mass, numpy.swapaxes(mass, 1, 2), 1e-13)
            unit = mechanics.inverse_dynamics(q, 0 * qd, numpy.tile([1.0, 0.0], (3, 1))).tau
            weightless = unit - mechanics.inverse_dynamics(q).tau
            self.close(mass[:, :, 0], weightless, 1e-12)
            weights = numpy.cos(numpy.arange(6.0)).reshape(3, 2)
            gradient = mechanics.gradient(q, qd, qdd, tau_weights=weights)
            for got, jacobian in zip(gradient, jacobians[:3]):
                self.close(got, numpy.einsum("ni,nij->nj", weights, jacobian), 1e-12)

    def test_velocity_of_any_point(self):
        (q, qd), l1, l2 = numpy.array([[0.4, -0.9], [2.0, 1.5]]), 0.3, 0.07
        with arm() as model:
            found = model.point_motion(1, [l2 - 0.25, 0, 0], q, qd)
            angle, turn = q.sum(), qd.sum()
            upper = l1 * numpy.array([-numpy.sin(q[0]), numpy.cos(q[0]), 0])
            fore = l2 * numpy.array([-numpy.sin(angle), numpy.cos(angle), 0])
            self.close(found.velocity, upper * qd[0] + fore * turn, 1e-14)
            self.close(found.position_q, numpy.stack([upper + fore, fore], axis=1), 1e-14)
            self.close(found.position_q @ qd, found.velocity, 1e-14)
            for c, step in enumerate(1e-6 * numpy.eye(2)):
                ahead, behind = (model.point_motion(1, [l2 - 0.25, 0, 0], q + s, qd).velocity
                                 for s in (step, -step))
                self.close(found.velocity_q[:, c], (ahead - behind) / 2e-6, 1e-8)
            named = model.point_motion(model.links[1].name, [l2 - 0.25, 0, 0], q, qd)
            self.close(named.velocity, found.velocity, 0)
            with self.assertRaisesRegex(ValueError, "no link 'nose'"):
                model.point_motion("nose", [0, 0, 0], q, qd)
            with self.assertRaisesRegex(ValueError, "local is an array"):
                model.point_motion(0, [0, 0], q, qd)
            self.fails("E_ARGUMENT", model.point_motion, 2, [0, 0, 0], q, qd)
            self.fails("E_NUMERIC", model.point_motion, 1, [0, 0, 0], q, [numpy.nan, 0])
