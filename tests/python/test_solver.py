"""The solver object, and starts that bring multipliers."""

import math

import ambulo
import numpy
from support import REACH, TOP, Case


class Solvers(Case):
    def test_another_end(self):
        """The same as a problem with that end, and a result of it."""
        with ambulo.Problem.load(REACH) as problem:
            solver = ambulo.Solver(problem, algorithm=ambulo.Algorithm.AUGLAG)
        x, state = solver.iterate(150)
        self.assertTrue(state.converged and state.feasible)
        solver.set_end("shoulder", math.radians(-20), final=True)
        solver.shift(0.02)
        x, state = solver.iterate(150)
        self.assertTrue(state.converged and state.feasible)
        with ambulo.Problem.load(REACH, ["ends.final.shoulder=-20"]) as other:
            self.assertAlmostEqual(state.objective / other.solve().objective, 1.0, 3)
        result = solver.result()
        self.assertTrue(result.is_solution)
        self.close(result.x, x, 0.0)
        first = solver.iterate(1)
        self.assertLessEqual(first.state.iterations, 1)
        with self.assertRaises(ambulo.AmbuloError):
            solver.set_end(0, 0.0, order=2)
        solver.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            solver.iterate()

    def test_another_foothold(self):
        """The same as a problem with that foothold; the solver's own problem has it."""
        start = TOP / "tests" / "support" / "rigid_walk_start.yaml"
        there = [f"contacts[{i}].{key}" for i in (4, 5, 6) for key in ("place=[0.55, -0.06]", "heading=4")]
        with ambulo.Problem.load(start) as problem, ambulo.Problem.load(start, there) as other:
            solver = ambulo.Solver(problem)
            solver.set_foothold(5, [0.55, -0.06], heading=math.radians(4))
            self.assertEqual([c.place[0] for c in solver.problem.contacts[4:7]], 3 * [0.55])
            x = 0.1 * numpy.sin(numpy.arange(problem.variable_count))
            self.close(solver.problem.motion(x).tau, other.motion(x).tau)
            self.assertGreater(abs(problem.motion(x).tau - other.motion(x).tau).max(), 1.0)
            with self.assertRaises(ambulo.AmbuloError):
                solver.set_foothold(5, [3, 0])
            with self.assertRaises(ValueError):
                solver.set_foothold(5, [0.5, 0, 0])

    def test_starts(self):
        """A Result, a file and unknowns are starts."""
        with ambulo.Problem.load(REACH) as problem:
            result = problem.solve()
            result.write(self.folder / "reach")
            solver = ambulo.Solver(problem, algorithm=ambulo.Algorithm.AUGLAG)
            for start in (result, self.folder / "reach" / "solution.yaml", result.x):
                self.assertLessEqual(problem.solve(start).iterations, result.iterations)
                solver.start(start)
                x, state = solver.iterate(20)
                self.assertAlmostEqual(state.objective / result.objective, 1.0, 3)
            with self.assertRaises(ambulo.AmbuloError):
                solver.start(numpy.full_like(result.x, numpy.nan))

    def test_several_steps(self):
        """They start from one; unless they are told to start at zero."""
        steps = ["gait.steps=3", "time.duration=1.62", "time.intervals=75", "trajectory.intervals=51"]
        with ambulo.Problem.load(TOP / "tests" / "support" / "walk_rigid.yaml", steps) as problem:
            few, many = problem.solve(), problem.solve("zero")
            self.assertLess(2 * few.iterations, many.iterations)
            self.assertLess(few.objective, 1.001 * many.objective)
