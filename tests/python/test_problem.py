"""Problems: made of records, read from files, extended, evaluated."""

import threading

import ambulo
import numpy
from support import REACH, TOP, WALK, Case, arm, effort, some_point, swing


def slower_elbow(state, gradient):
    """rad/s below 2."""
    if gradient is not None:
        gradient.qd[1] -= 1
    return 2.0 - state.qd[1]


class Problems(Case):
    def test_made_of_records(self):
        with arm() as model, swing(model) as problem:
            self.assertEqual(problem.name, "swing")
            self.assertEqual(problem.term_names, ["torque_squared"])
            self.assertEqual(problem.variable_count, 2 * problem.control_point_count)
            self.close(problem.times, numpy.linspace(0, 1, 13), 1e-15)
            self.assertEqual(problem.equality_count, 8)
            rows = problem.rows()
            self.assertEqual(len(rows), problem.row_count)
            self.assertEqual({row.family for row in rows}, {"initial_state", "final_state"})
            self.assertEqual((rows[0].unit, rows[0].relation), ("rad", ambulo.Relation.EQUAL))

    def test_a_problem_outlives_the_names_of_its_model(self):
        model = arm()
        problem = swing(model)
        model.close()
        del model
        self.assertEqual(problem.model.coordinate_names, ["shoulder", "elbow"])
        problem.evaluate(some_point(problem))

    def test_read_with_overrides(self):
        with ambulo.Problem.load(WALK, {"gait.step_width": 0.12, "subject.mass": 60,
                                        "solver.continuation": False}) as problem:
            self.assertAlmostEqual(problem.model.mass, 60, 6)
            self.assertEqual(problem.options().continuation, 0)
            self.assertEqual(problem.options(time_limit=3).time_limit, 3)
            self.assertEqual(len(problem.contacts[0].place), 3)
        with ambulo.Problem.load(REACH, ["time.intervals=8"]) as problem:
            self.assertEqual(problem.node_count, 9)

    def test_text_and_its_folder(self):
        text = REACH.read_text()
        with ambulo.Problem.load_text(text, folder=ambulo.MODELS) as problem:
            self.assertEqual(problem.node_count, 33)
        fault = self.fails("E_SCHEMA", ambulo.Problem.load_text,
                           text.replace("torque_squared", "torque_sqared"), "mine.yaml",
                           folder=ambulo.MODELS)
        self.assertIn("mine.yaml:", str(fault))
        self.assertIn("torque_squared", fault.messages[-1].hint)

    def test_faults_of_records(self):
        with arm() as model:
            with self.assertRaisesRegex(ValueError, "no coordinate 'knee'"):
                ambulo.Problem.create(model, end_values=[ambulo.EndValue("knee")])
            fault = self.fails("E_PROBLEM", ambulo.Problem.create, model, duration=-1)
            self.assertIn("duration", str(fault))
            with self.assertRaisesRegex(ValueError, "scale: got an array"):
                swing(model, terms=[ambulo.Term("torque_squared", scale=[1, 2, 3])])
            with self.assertRaisesRegex(TypeError, "expected Term"):
                swing(model, terms=[ambulo.EndValue(0)])

    def test_breakpoints_and_references(self):
        with arm() as model:
            reference = numpy.zeros((13, 2))
            with swing(model, breakpoints=[0, 0.2, 0.5, 1.0],
                       terms=[ambulo.Term("tracking", reference=reference)]) as problem:
                self.assertEqual(problem.control_point_count, 6)
                x = some_point(problem)
                q = problem.motion(x).q
                dt = numpy.full(13, 1 / 12)
                dt[[0, -1]] /= 2
                self.close(problem.evaluate(x).objective, float(dt @ (q ** 2).sum(axis=1)), 1e-12)

    def test_muscles_behind_tendons(self):
        power = ambulo.Term("mechanical_power", tendon=[40, 0])
        with arm() as model, swing(model, terms=[power]) as problem:
            x = some_point(problem)
            motion = problem.motion(x)
            mean_torque = (motion.tau[1:] + motion.tau[:-1]) / 2
            mean_speed = (motion.qd[1:] + motion.qd[:-1]) / 2
            stretch = 12 * numpy.diff(motion.tau, axis=0) * [1 / 40, 0]
            u = mean_torque * (mean_speed + stretch) / model.mass
            self.close(problem.evaluate(x).objective,
                       float((numpy.sqrt(u ** 2 + 0.05 ** 2) - 0.05).sum() / 12), 1e-12)
            with self.assertRaisesRegex(ValueError, "tendon: got an array"):
                swing(model, terms=[ambulo.Term("mechanical_power", tendon=[40])])

    def test_a_walk_made_of_records_is_that_of_the_file(self):
        """tests/support/walker_2d_step.yaml, number for number."""
        with ambulo.Problem.load(TOP / "tests" / "support" / "walker_2d_step.yaml") as file, \
                ambulo.Model.load(ambulo.MODELS / "walker_2d.yaml") as model:
            time = 0.6 / 1.1
            gait = ambulo.Gait(first_foot="right", step_length=0.6, step_time=time, heel_strike=-0.06,
                               foot_flat=0.02, heel_off=0.32, toe_off=0.56)
            scale = numpy.ones(len(model.coordinates))
            scale[:2] = 0.05
            offset = numpy.zeros(len(scale))
            offset[model.find("coordinate", "pelvis_ty")] = 9.81 * model.mass
            made = ambulo.Problem.create(
                model, duration=time, intervals=16, spline_intervals=14,
                contacts=model.contacts_of(gait), ground_penetration=1, foot_strike=1,
                support="box", joint_limits="nodes", ends="mirrored", travel=0.6,
                terms=[ambulo.Term("torque_squared", weight=0.01, scale=scale, offset=offset)])
            self.assertEqual(len(made.contacts), len(file.contacts))
            self.assertEqual([row.to_dict() for row in made.rows()],
                             [row.to_dict() for row in file.rows()])
            x = some_point(file)
            a, b = made.evaluate(x), file.evaluate(x)
            self.close(a.rows, b.rows, 1e-12)
            self.close(a.terms, b.terms, 1e-12)
            self.assertIs(made.solve(options=file.options()).verdict,
                          file.solve().verdict)
            many = ambulo.Gait(steps=40, step_length=0.6, step_time=time)
            self.assertGreater(len(model.contacts_of(many)), 80)
            self.fails("E_ARGUMENT", model.contacts_of, ambulo.Gait(toe_off=0.1))

    def test_limits(self):
        with ambulo.Problem.load(REACH) as problem:
            limits = problem.limits("shoulder")
            self.close([limits.low, limits.high], numpy.radians([-120, 150]), 1e-12)
            self.assertEqual(problem.limits(1, "torque").high, 15)


class Evaluation(Case):
    def test_gradient_is_that_of_the_values(self):
        with ambulo.Problem.load(REACH) as problem:
            x = some_point(problem)
            weights = numpy.sin(numpy.arange(problem.row_count))
            gradient = problem.gradient(x, 0.7, weights)
            self.assertEqual(gradient.shape, (problem.control_point_count, 2))

            def value(at):
                found = problem.evaluate(at)
                return 0.7 * found.objective + weights @ found.rows

            numeric = numpy.empty_like(x)
            for i in range(len(x)):
                step = numpy.zeros_like(x)
                step[i] = 1e-5
                numeric[i] = (value(x + step) - value(x - step)) / 2e-5
            self.close(gradient.reshape(-1), numeric, 1e-7)

    def test_rows_one_by_one(self):
        with ambulo.Problem.load(REACH) as problem:
            x = some_point(problem).reshape(-1, 2)
            weights = numpy.zeros(problem.row_count)
            weights[17] = 1
            self.close(problem.row_gradient(x, 17), problem.gradient(x, 0.0, weights), 1e-13)
            self.fails("E_ARGUMENT", problem.row_gradient, x, problem.row_count)

    def test_points_are_checked(self):
        with ambulo.Problem.load(REACH) as problem:
            with self.assertRaisesRegex(ValueError, "x is an array"):
                problem.evaluate([1.0, 2.0])
            x = some_point(problem)
            x[3] = numpy.nan
            fault = self.fails("E_NUMERIC", problem.evaluate, x)
            self.assertIn("an unknown of elbow", str(fault))

    def test_a_workspace_for_each_thread(self):
        with ambulo.Problem.load(REACH) as problem:
            points = [some_point(problem) * (1 + 0.1 * i) for i in range(4)]
            alone = [problem.evaluate(x).objective for x in points]
            found = [[] for _ in points]

            def work(i):
                for _ in range(50):
                    found[i].append(problem.evaluate(points[i]).objective)

            threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(found, [[value] * 50 for value in alone])

    def test_transfer_and_solution_files(self):
        with ambulo.Problem.load(REACH) as coarse, \
                ambulo.Problem.load(REACH, {"trajectory.intervals": 20}) as fine:
            x = some_point(coarse)
            there = coarse.transfer(x, fine)
            self.close(coarse.motion(x).q, fine.motion(there).q, 1e-12)
            result = coarse.solve()
            result.write(self.folder / "out")
            self.close(coarse.load_solution(self.folder / "out" / "solution.yaml"), result.x, 1e-15)
            self.close(fine.load_solution(self.folder / "out" / "solution.yaml", stretch=True),
                       coarse.transfer(result.x, fine), 1e-9)


class Extension(Case):
    def test_function_of_the_caller_is_the_built_in_term(self):
        with ambulo.Problem.load(REACH) as problem:
            own = problem.extend(terms=[ambulo.Term("user_term", function=effort, name="effort")])
            x = some_point(problem)
            found = own.evaluate(x)
            self.assertEqual(own.term_names, ["torque_squared", "acceleration", "effort"])
            self.assertAlmostEqual(found.terms[2] / found.terms[0], 1.0, 13)
            twice = ambulo.Problem.load(REACH, {"objective[0].weight": 2})
            self.close(own.gradient(x), twice.gradient(x), 1e-12)
            errors = {error.family: error.error for error in own.check_derivatives(x)}
            self.assertLess(errors["effort"], 1e-6)

    def test_wrong_gradients_are_named(self):
        def wrong(state, gradient):
            if gradient is not None:
                gradient.tau += 2.2 * state.tau
            return float(state.tau @ state.tau)

        def assigned(state, gradient):
            if gradient is not None:
                gradient.tau = 2 * state.tau  # sets the values, does not replace the array
            return float(state.tau @ state.tau)

        with ambulo.Problem.load(REACH) as problem:
            own = problem.extend(terms=[
                ambulo.Term("user_term", function=wrong, name="wrong"),
                ambulo.Term("user_term", function=assigned, name="assigned")])
            errors = {error.family: error.error
                      for error in own.check_derivatives(some_point(problem))}
            self.assertGreater(errors["wrong"], 1e-2)
            self.assertLess(errors["assigned"], 1e-6)
            self.assertLess(errors["torque_squared"], 1e-6)

    def test_state_is_that_of_the_motion(self):
        seen = {}

        def look(state, gradient):
            seen[state.node] = (state.time, state.q.copy(), state.qdd.copy(), state.tau.copy(),
                                state.wrench.copy(), state.points.copy())
            with self.assertRaises(ValueError):
                state.q[0] = 1.0
            return 0.0

        with ambulo.Problem.load(REACH) as problem:
            row = ambulo.UserRow("look", "m", "not_negative", 0, 0.8, look)
            own = problem.extend(user_rows=[row])
            x = some_point(problem)
            own.evaluate(x)
            motion = own.motion(x)
            self.assertEqual(sorted(seen), list(range(33)))
            for node, state in seen.items():
                for got, array in zip(state, (motion.time, motion.q, motion.qdd, motion.tau,
                                              motion.wrench, motion.points)):
                    self.close(got, array[node], 1e-11)

    def test_row_holds_at_the_solution(self):
        with ambulo.Problem.load(REACH) as problem:
            own = problem.extend(user_rows=[
                ambulo.UserRow("slow elbow", "rad/s", "not_negative", 0, 0.8, slower_elbow)])
            result = own.solve()
            self.assertEqual(result.verdict, ambulo.Verdict.OPTIMAL)
            self.assertAlmostEqual(result.motion().qd[:, 1].max(), 2.0, 5)
            self.assertGreater(problem.solve().motion().qd[:, 1].max(), 2.1)

    def test_compiled_functions_are_called_as_they_are(self):
        source = ambulo.callbacks.node_function(effort, 2, 2)
        address = int(ambulo.ffi.cast("uintptr_t", source))
        with ambulo.Problem.load(REACH) as problem:
            x = some_point(problem)
            for function in (source, address):
                own = problem.extend(terms=[ambulo.Term("user_term", function=function)])
                self.assertAlmostEqual(own.evaluate(x).terms[2], problem.evaluate(x).terms[0], 9)
            with self.assertRaisesRegex(TypeError, "expected a function"):
                problem.extend(terms=[ambulo.Term("user_term", function="effort")])

    def test_term_and_row_of_the_velocity_of_a_point(self):
        class HandSpeed:
            """m/s squared; an object carries what the function needs."""

            def __init__(self, model, local, limit=0.0):
                self.model, self.local, self.limit = model, local, limit

            def __call__(self, state, gradient, sign=1.0):
                found = self.model.point_motion("lower", self.local, state.q, state.qd)
                if gradient is not None:
                    slope = 2 * sign * found.velocity
                    gradient.q += slope @ found.velocity_q
                    gradient.qd += slope @ found.position_q
                return sign * float(found.velocity @ found.velocity)

            def below(self, state, gradient):
                return self.limit ** 2 + self(state, gradient, -1.0)

        with ambulo.Problem.load(REACH) as problem:
            hand = HandSpeed(problem.model, [0, 0, 0], limit=1.5)
            bare = problem.solve()

            def fastest(result):
                motion = result.motion()
                return max(float(numpy.linalg.norm(
                    hand.model.point_motion("lower", [0, 0, 0], q, qd).velocity))
                    for q, qd in zip(motion.q, motion.qd))

            own = problem.extend(
                terms=[ambulo.Term("user_term", function=hand, name="hand", weight=0.1)],
                user_rows=[ambulo.UserRow("slow hand", "m^2/s^2", "not_negative", 0, 0.8,
                                          hand.below)])
            errors = {error.family: error.error
                      for error in own.check_derivatives(some_point(problem))}
            self.assertLess(errors["hand"], 1e-6)
            self.assertLess(errors["slow hand"], 1e-6)
            slow = own.solve()
            self.assertEqual(slow.verdict, ambulo.Verdict.OPTIMAL)
            self.assertGreater(fastest(bare), 1.8)
            self.assertLess(fastest(slow), 1.5001)

    def test_exceptions_come_through(self):
        def fails(state, gradient):
            raise RuntimeError("not today")

        with ambulo.Problem.load(REACH) as problem:
            own = problem.extend(terms=[ambulo.Term("user_term", function=fails)])
            for call in (own.evaluate, own.gradient, own.check_derivatives, own.audit):
                with self.assertRaisesRegex(RuntimeError, "not today"):
                    call(some_point(problem))
            problem.evaluate(some_point(problem))  # nothing is left over
