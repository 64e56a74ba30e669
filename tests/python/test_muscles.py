"""Muscles: sharing on arrays, slopes against differences, the analysis of a result."""

import tempfile
import unittest
from pathlib import Path

import numpy

import ambulo


class Shared(unittest.TestCase):
    def setUp(self):
        self.model = ambulo.Model.load(ambulo.MODELS / "lower_body_23.yaml")
        self.muscles = ambulo.Muscles(ambulo.MODELS / "leg_muscles.yaml", self.model)

    def states(self, count=5):
        random = numpy.random.default_rng(1)
        d = len(self.model.coordinate_names)
        return random.uniform(-0.3, 0.3, (count, d)), random.uniform(-1, 1, (count, d)), \
            random.uniform(-20, 20, (count, d))

    def test_names_and_credits(self):
        self.assertEqual(len(self.muscles.names), 80)
        self.assertIn("soleus_l", self.muscles.names)
        self.assertIn("Apache-2.0", self.muscles.source)

    def test_torques_are_shared_and_slopes_are_those_of_the_cost(self):
        q, qd, tau = self.states()
        shared = self.muscles.share(q, qd, tau, metabolic=0.5)
        self.assertTrue((shared.activation >= 0).all() and (shared.activation <= 1).all())
        step = 1e-5
        knee = self.model.coordinate_names.index("knee_angle_r")
        moved = [tau.copy(), tau.copy()]
        moved[0][:, knee] -= step
        moved[1][:, knee] += step
        low, high = (self.muscles.share(q, qd, torque, metabolic=0.5).cost for torque in moved)
        numpy.testing.assert_allclose((high - low) / (2 * step), shared.by_tau[:, knee], rtol=1e-4, atol=1e-7)

    def test_shapes_are_checked(self):
        q, qd, tau = self.states()
        with self.assertRaisesRegex(ValueError, r"tau is an array \[5, 1\]; expected \[5, 23\]"):
            self.muscles.share(q, qd, tau[:, :1])

    def test_a_result_is_analysed(self):
        with tempfile.TemporaryDirectory() as name, ambulo.Problem.load(ambulo.MODELS / "walk.yaml") as problem:
            folder = Path(name)
            result = problem.solve()
            result.write(folder / "walk")
            found = self.muscles.analyse(folder / "walk" / "motion.csv", output=folder / "m.sto")
            self.assertTrue((folder / "m.sto").read_text().startswith("# ambulo muscles"))
        self.assertEqual(found.joints, ("hip_r", "knee_r", "ankle_r", "hip_l", "knee_l", "ankle_l"))
        self.assertTrue(2.5 < found.bhargava < 5.0)
        peak = numpy.linalg.norm(found.contact[:, 0], axis=1).max() / found.body_weight
        self.assertTrue(2.0 < peak < 6.0)


if __name__ == "__main__":
    unittest.main()
