"""The robot of docs/tutorial-mpc.md walks; skipped without MuJoCo."""

import sys
import unittest

from support import TOP, Case, optional


@unittest.skipUnless(optional("mujoco"), "no module mujoco")
class Robot(Case):
    def test_it_walks_and_bears_a_push(self):
        """From rest, 22 steps on another program's contacts; 10 N s from the side on the way."""
        sys.path.insert(0, str(TOP / "docs" / "examples"))
        import robot_walks

        walk = robot_walks.walk(TOP / "tests" / "users" / "biped.urdf", seconds=9, push=(0, 10, 4.1))
        self.assertTrue(walk["upright"])
        self.assertGreaterEqual(walk["steps"], 22)
        self.assertGreater(walk["ahead"], 2.0)  # without plans it falls within 1 m
        self.assertGreater(walk["left"], 0.2)  # it was pushed, and stepped aside
        self.assertLess(walk["left"], 1.5)
