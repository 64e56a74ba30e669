"""Solves: the point of the program, progress, interruption, exceptions, threads."""

import gc
import os
import shutil
import signal
import subprocess
import threading
import time
import unittest
import warnings

import ambulo
import numpy
from support import COARSE_REACH, REACH, TOP, WALK, YARDSTICK, Case, arm, effort, some_point, swing

PROGRAM = os.environ.get("AMBULO") or shutil.which("ambulo") or str(TOP / "build" / "ambulo")


class Results(Case):
    def test_facts_of_a_result(self):
        with ambulo.Problem.load(REACH) as problem:
            result = problem.solve()
            self.assertIs(result.verdict, ambulo.Verdict.OPTIMAL)
            self.assertTrue(result.is_solution)
            self.assertEqual(result.x.shape, (problem.control_point_count, 2))
            found = problem.evaluate(result.x)
            self.assertAlmostEqual(found.objective, result.objective, 12)
            self.close(found.rows, result.rows, 1e-12)
            self.assertAlmostEqual(sum(result.terms.values()), result.objective, 12)
            self.assertEqual(list(result.terms), ["torque_squared", "acceleration"])
            self.assertLess(result.audit.kkt, 1e-3)
            self.assertEqual(result.audit.fault.kind, ambulo.FaultKind.NONE)
            # stationary: the gradient of the Lagrangian is small
            slope = problem.gradient(result.x, 1.0, -result.multipliers)
            self.assertLess(numpy.abs(slope).max(), 1e-3 * numpy.abs(problem.gradient(result.x)).max())
            self.assertGreater(result.evaluations, 0)
            self.assertGreater(result.timing.total, 0)
            self.assertIn("NLopt", result.ending)
            self.assertIsNone(result.explanation)
            self.assertIsNone(result.parameters)
            self.assertIn("optimal, objective", repr(result))

    def test_the_way_of_a_solve(self):
        with ambulo.Problem.load(YARDSTICK) as problem:
            result, again = problem.solve(), problem.solve()
            way, other, told = result.history, again.history, result.summary()["convergence"]
            given = problem.audit(result.x)
        self.assertEqual(way["iteration"][-1], result.iterations)
        self.assertEqual(way["evaluations"][-1], result.evaluations)
        self.assertEqual(way["objective"][-1], result.objective)
        worst = result.audit.violation
        self.assertEqual(way["violation"][-1], worst.worst / worst.size)
        self.assertTrue((numpy.diff(way["seconds"]) >= 0).all())
        self.assertTrue((numpy.diff(way["iteration"]) >= 0).all())
        for name, column in way.items():
            self.assertEqual(len(column), len(told[name]))
            if name != "seconds":
                numpy.testing.assert_array_equal(column, other[name])
                numpy.testing.assert_array_equal(column, [numpy.nan if v is None else v
                                                          for v in told[name]])
        self.assertEqual(len(given.history["iteration"]), 0)

    def test_between_the_nodes(self):
        with ambulo.Problem.load(COARSE_REACH) as problem:
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                result = problem.solve()
            dense = result.dense_audit
            self.assertEqual(dense.failing, 1)
            self.assertEqual(dense.families[0].violation.family, "joint_limit")
            self.assertIn("joint_limit", str(told[0].message))
            self.assertEqual(told[0].filename, __file__)
            self.assertEqual(result.messages[0].severity, "warning")
            refined = problem.solve_refined(result.x)
            self.assertEqual(refined.dense_audit.failing, 0)
            self.assertGreater(refined.problem.node_count, problem.node_count)

    def test_without_a_solution_it_says_why(self):
        with ambulo.Problem.load(REACH, {"time.duration": 0.05}) as problem:
            result = problem.solve()
            self.assertIs(result.verdict, ambulo.Verdict.INFEASIBLE)
            self.assertFalse(result.is_solution)
            self.assertTrue(result.explanation.lines)
            self.assertIn("torque_limit",
                          {limit.family for limit in result.explanation.on_limits})

    def test_sensitivities_are_derivatives(self):
        key = "ends.final.elbow"
        with ambulo.Problem.load(COARSE_REACH) as problem:
            result = problem.solve(optimality_tolerance=1e-7)
            known = {item.name: item for item in result.sensitivities()}
            step = 1e-4  # rad
            value = known[key].value
            around = []
            for sign in (-1, 1):
                degrees = numpy.degrees(value + sign * step)
                with ambulo.Problem.load(COARSE_REACH, {key: float(degrees)}) as other:
                    around.append(other.solve(result.x, optimality_tolerance=1e-7).objective)
            self.assertAlmostEqual(known[key].derivative, (around[1] - around[0]) / (2 * step), 3)

    def test_output(self):
        with ambulo.Problem.load(REACH) as problem:
            result = problem.solve()
        result.write(self.folder / "out", samples=9)
        names = {path.name for path in (self.folder / "out").iterdir()}
        self.assertEqual(names, {"summary.json", "motion.csv", "motion.sto", "solution.yaml",
                                 "gait.svg", "scene.json"})
        self.assertEqual(result.summary()["objective"]["total"], result.objective)
        self.fails("E_IO", result.write, self.folder / "out")
        result.write(self.folder / "out", overwrite=True)

    @unittest.skipUnless(os.access(PROGRAM, os.X_OK), "no program ambulo")
    def test_the_program_finds_the_same_bits(self):
        out = self.folder / "out"
        subprocess.run([PROGRAM, "solve", str(YARDSTICK), "-o", str(out)], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with ambulo.Problem.load(YARDSTICK) as problem:
            self.close(problem.solve().x, problem.load_solution(out / "solution.yaml"), 0)

    def test_audit_of_a_given_point(self):
        with arm() as model, swing(model) as problem:
            result = problem.audit(some_point(problem))
            self.assertIs(result.verdict, ambulo.Verdict.INFEASIBLE)
            again = problem.audit(problem.solve().x)
            self.assertIs(again.verdict, ambulo.Verdict.OPTIMAL)

    def test_options(self):
        with ambulo.Problem.load(YARDSTICK) as problem:
            result = problem.solve(maximum_iterations=1, continuation=0)
            self.assertIs(result.ending_code, ambulo.Ending.ITERATIONS)
            options = problem.options()
            options.algorithm = "auglag"
            self.assertIs(problem.solve(options=options).verdict, ambulo.Verdict.OPTIMAL_AT_NODES)
            with self.assertRaisesRegex(AttributeError, "time_limit"):
                problem.solve(time_limt=3)
            self.fails("E_ARGUMENT", problem.solve, feasibility_tolerance=-1)

    def test_results_outlive_their_problem(self):
        with ambulo.Problem.load(REACH) as problem:
            result = problem.solve()
        with self.assertRaisesRegex(ValueError, "closed"):
            problem.solve()
        del problem
        gc.collect()
        self.assertIn(result.audit.violation.family,
                      {row.family for row in result.problem.rows()})
        self.assertEqual(result.motion(5).q.shape, (5, 2))
        self.assertTrue(result.sensitivities())
        result.close()
        self.assertEqual(repr(result), "<Result, closed>")


class Progress(Case):
    def test_it_is_told_and_can_stop(self):
        told = []

        def progress(now):
            told.append(now)
            return now.iteration >= 2

        with ambulo.Problem.load(YARDSTICK, {"solver.continuation": False}) as problem:
            result = problem.solve(progress=progress)
            self.assertIs(result.verdict, ambulo.Verdict.INTERRUPTED)
            self.assertEqual(told[-1].iteration, 2)
            self.assertIn("solve", {now.stage for now in told})
            self.assertIs(problem.solve(result.x).verdict, ambulo.Verdict.OPTIMAL_AT_NODES)

    def test_an_exception_ends_the_solve(self):
        def progress(now):
            if now.iteration == 2:
                raise LookupError("enough")

        with ambulo.Problem.load(YARDSTICK) as problem:
            with self.assertRaisesRegex(LookupError, "enough") as caught:
                problem.solve(progress=progress)
            self.assertEqual(caught.exception.result.x.shape, (problem.control_point_count, 18))
            self.assertIs(problem.solve().verdict, ambulo.Verdict.OPTIMAL_AT_NODES)

    def test_an_exception_of_a_term_ends_the_solve(self):
        calls = []

        def term(state, gradient):
            calls.append(1)
            if len(calls) == 3000:  # once: the solve would get over it
                raise LookupError("enough")
            return effort(state, gradient)

        with ambulo.Problem.load(YARDSTICK) as problem:
            own = problem.extend(terms=[ambulo.Term("user_term", function=term, weight=1e-9)])
            with self.assertRaisesRegex(LookupError, "enough") as caught:
                own.solve()
            self.assertIs(caught.exception.result.verdict, ambulo.Verdict.INTERRUPTED)

    def test_ctrl_c_keeps_the_best_point(self):
        """SIGINT while the solver computes, with no function of the caller in sight."""
        for interrupt in ("keep", "raise"):
            with ambulo.Problem.load(WALK) as problem:
                # as often as it takes: the first may fall before the first iteration
                timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
                timer.start()
                if interrupt == "keep":
                    result = problem.solve(optimality_tolerance=1e-13, maximum_iterations=100000,
                                           maximum_evaluations=10 ** 9)
                else:
                    with self.assertRaises(KeyboardInterrupt) as caught:
                        problem.solve(interrupt="raise", optimality_tolerance=1e-13,
                                      maximum_iterations=100000, maximum_evaluations=10 ** 9)
                    result = caught.exception.result
                timer.join()
                self.assertIs(result.ending_code, ambulo.Ending.CALLER)
                self.assertIs(result.verdict, ambulo.Verdict.INTERRUPTED)
                self.assertEqual(result.x.shape, (problem.control_point_count, 18))
        with self.assertRaisesRegex(ValueError, "interrupt"):
            problem.solve(interrupt="never")


class Threads(Case):
    def test_solves_meet_neither_each_other_nor_the_interpreter(self):
        with ambulo.Problem.load(YARDSTICK) as problem:
            alone = problem.solve().x
            found, counted, stop = {}, [0], threading.Event()

            def count():
                while not stop.is_set():
                    counted[0] += 1
                    time.sleep(0)

            def work(i):
                found[i] = problem.solve().x

            counter = threading.Thread(target=count)
            counter.start()
            threads = [threading.Thread(target=work, args=(i,)) for i in range(3)]
            before = counted[0]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            meanwhile = counted[0] - before
            stop.set()
            counter.join()
            for i in range(3):
                self.close(found[i], alone, 0)
            self.assertGreater(meanwhile, 10)


class Memory(Case):
    def test_everything_is_freed_once(self):
        """Every object that is made is given back, by `with`, by `close` or by being forgotten."""
        from ambulo import _native

        freed, made = [], []
        init = _native.Handle.__init__

        def counting(handle, pointer, free, *needs):
            made.append(pointer)
            init(handle, pointer, lambda p: (freed.append(p), free(p))[1], *needs)

        _native.Handle.__init__ = counting
        try:
            for _ in range(3):
                with arm() as model, swing(model) as problem:
                    own = problem.extend(terms=[ambulo.Term("user_term", function=effort)])
                    result = own.solve()
                    result.motion().to_dict()
                    own.close()
                problem = ambulo.Problem.load(REACH, {"free": {"ends.initial_speed.shoulder":
                                                               [-300, 600]}})
                best = problem.solve_parameters(maximum_iterations=20)
                best.problem.model.coordinates
                del problem, best, own, result, model
            gc.collect()
        finally:
            _native.Handle.__init__ = init
        self.assertGreater(len(made), 20)
        self.assertEqual(len(freed), len(made))

    def test_order_of_closing_does_not_matter(self):
        model = arm()
        problem = swing(model)
        result = problem.solve()
        model.close()
        problem.close()
        self.assertGreater(result.objective, 0)
        self.assertEqual(result.motion().coordinates, ["shoulder", "elbow"])
