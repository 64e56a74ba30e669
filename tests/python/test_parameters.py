"""Free parameters from Python."""

import ambulo
from support import REACH, Case, arm, effort, swing

KEY = "ends.initial_speed.shoulder"
FREE = {"free": {KEY: [-300, 600]}}  # degrees, as the file


class Parameters(Case):
    def test_those_of_a_file(self):
        with ambulo.Problem.load(REACH, FREE) as problem:
            self.assertEqual([item.name for item in problem.parameters.items], [KEY])
            result = problem.solve_parameters()
            item = result.parameters.items[0]
            self.assertTrue(result.parameters.converged)
            self.assertIs(item.bound, ambulo.Bound.BETWEEN)
            self.assertLess(result.parameters.objective, result.parameters.first)
            with problem.at([item.value]) as at:
                self.assertAlmostEqual(at.solve(result.x).objective, result.objective, 5)
            # it is a minimum: both neighbours are dearer
            for step in (-0.2, 0.2):
                self.assertGreater(problem.at([item.value + step]).solve().objective,
                                   result.objective)

    def test_with_a_term_of_the_caller(self):
        """A term that doubles the first one moves the best value as its weight would."""
        twice = ambulo.Problem.load(REACH, dict(FREE, **{"objective[0].weight": 2}))
        base = ambulo.Problem.load(REACH, FREE)
        own = base.extend(terms=[ambulo.Term("user_term", function=effort)])
        a, b = twice.solve_parameters(), own.solve_parameters()
        base.close()
        own.close()
        self.assertEqual(b.problem.term_names[2], "user")
        self.assertAlmostEqual(a.parameters.items[0].value, b.parameters.items[0].value, 2)
        self.assertAlmostEqual(a.objective, b.objective, 3)

    def test_made_by_a_function(self):
        """The speed of the shoulder at the start, of a swing made of records."""
        made = []
        with arm() as model:
            def at(values):
                made.append(values[0])
                if values[0] < -6:
                    raise ambulo.AmbuloError("E_PROBLEM", "none of these")
                ends = [ambulo.EndValue(name, order, final, value) for name, order, final, value in (
                    ("shoulder", 0, 0, -1.2), ("shoulder", 1, 0, float(values[0])),
                    ("elbow", 0, 0, 0.3), ("elbow", 1, 0, 0.0), ("shoulder", 0, 1, 0.4),
                    ("shoulder", 1, 1, 0.0), ("elbow", 0, 1, 1.1), ("elbow", 1, 1, 0.0))]
                return ambulo.Problem.create(model, duration=1, intervals=12, end_values=ends,
                                             terms=[ambulo.Term("user_square", weight=1.0,
                                                                function=shoulder_torque),
                                                    ambulo.Term("torque_squared")])

            def shoulder_torque(state, gradient):
                if gradient is not None:
                    gradient.tau[0] += 1
                return state.tau[0]

            first = at([0.0])
            names = [item.name for item in first.solve().sensitivities()]
            name = next(name for name in names if name.startswith("ends.initial_speed.shoulder"))
            result = first.solve_parameters({name: (-8, 3)}, at=at)
        self.assertGreater(len(made), 2)
        best = result.parameters.items[0].value
        self.assertTrue(-6 < best < -3, best)
        self.assertGreaterEqual(result.parameters.failed, 1)
        self.assertLess(result.parameters.objective, result.parameters.first)
        # the best problem keeps what its function made it of
        self.assertAlmostEqual(result.problem.evaluate(result.x).objective, result.objective, 10)
        self.assertEqual(result.motion().q.shape, (13, 2))

    def test_faults(self):
        with ambulo.Problem.load(REACH) as problem:
            self.assertEqual(problem.parameters.items, [])
            self.fails("E_ARGUMENT", problem.solve_parameters)
            self.fails("E_ARGUMENT", problem.solve_parameters, {"no.such": (0, 1)},
                       at=lambda values: None)

            def at(values):
                raise ZeroDivisionError("mine")

            with self.assertRaisesRegex(ZeroDivisionError, "mine"):
                problem.solve_parameters({KEY: (-5, 5)}, at=at)
            with self.assertRaisesRegex(TypeError, "expected a Problem"):
                problem.solve_parameters({KEY: (-5, 5)}, at=lambda values: None)
            problem.solve()
