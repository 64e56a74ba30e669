"""Objects live as long as the calls that use them: closing at the wrong moment is no crash.

Each of these tests ended the interpreter, or wrote to its error stream, before handles were held by
the calls that they are given to.
"""

import copy
import gc
import inspect
import pickle
import subprocess
import sys
import threading

import numpy

import ambulo
from support import REACH, TOP, YARDSTICK, Case, arm, effort, swing

FREE = {"free": {"ends.initial_speed.shoulder": [-300, 600]}}


class Silent(Case):
    """A case in which nothing is written about an exception that nobody can catch."""

    def setUp(self):
        super().setUp()
        said = []
        hook, sys.unraisablehook = sys.unraisablehook, said.append

        def check():
            gc.collect()
            sys.unraisablehook = hook
            self.assertEqual([str(one.exc_value) for one in said], [])

        self.addCleanup(check)


class Closing(Silent):
    def test_in_the_progress_of_every_solve(self):
        for solve, overrides in (("solve", None), ("solve_refined", None),
                                 ("solve_parameters", FREE), ("solve", {"solver.algorithm": "slsqp",
                                                                    "solver.maximum_iterations": 2})):
            problem, calls = ambulo.Problem.load(REACH, overrides), []

            def progress(now):
                calls.append(now.iteration)
                problem.close()
                gc.collect()

            with self.subTest(solve=solve):
                result = getattr(problem, solve)(progress=progress)
                self.assertTrue(calls)
                self.assertEqual(result.x.size, result.problem.variable_count)
                self.assertGreater(result.objective, 0)
                with self.assertRaisesRegex(ValueError, "closed"):
                    problem.solve()

    def test_in_a_function_of_the_caller(self):
        calls = ("evaluate", "gradient", "row_gradient", "check_derivatives", "audit", "solve")
        for name in calls:
            closed = []

            def term(state, gradient):
                if not closed:
                    closed.append(1)
                    problem.close()
                    gc.collect()
                return effort(state, gradient)

            model = arm()
            problem = swing(model).extend(terms=[ambulo.Term("user_term", function=term)])
            x = numpy.zeros(problem.variable_count)
            model.close()
            arguments = {"solve": (), "row_gradient": (x, 1)}.get(name, (x,))
            with self.subTest(call=name):
                self.assertIsNotNone(getattr(problem, name)(*arguments))
                self.assertTrue(closed)
            problem.close()

    def test_in_the_progress_of_batches_and_fits(self):
        batch = ambulo.Batch.create(self.folder / "sweep.yaml", REACH,
                                    axes=[{"key": "time.duration", "values": [0.9, 1.0]}])
        fit, calls = ambulo.Fit.load(TOP / "tests" / "study" / "arm" / "fit.yaml"), []

        def close(thing):
            def progress(now):
                calls.append(thing)
                thing.close()
                gc.collect()
            return progress

        study = batch.run(self.folder / "study", workers=1, progress=close(batch))
        self.assertEqual((study.status().done, len(study.batch)), (2, 2))
        fit.run(self.folder / "fitted", workers=2, progress=close(fit))
        self.assertEqual(set(calls), {batch, fit})

    def test_from_another_thread(self):
        for _ in range(5):
            problem, begun = ambulo.Problem.load(YARDSTICK), threading.Event()

            def close():
                begun.wait()
                problem.close()
                gc.collect()

            thread = threading.Thread(target=close)
            thread.start()
            result = problem.solve(progress=lambda now: begun.set(), maximum_iterations=4)
            thread.join()
            self.assertGreater(len(result.rows), 0)

    def test_while_others_read(self):
        """One thread reads whatever there is, another closes: values, or a word that it is closed."""
        for _ in range(20):
            with ambulo.Problem.load(REACH) as problem:
                result = problem.solve(maximum_iterations=2)
            faults = []

            def read():
                try:
                    while True:
                        for name in ("x", "rows", "audit", "history", "ending", "families"):
                            getattr(result, name)
                        result.motion(5)
                except ValueError as fault:
                    faults.append(str(fault))

            threads = [threading.Thread(target=read) for _ in range(3)]
            for thread in threads:
                thread.start()
            result.close()
            for thread in threads:
                thread.join()
            self.assertEqual(faults, ["this Result is closed"] * 3)

    def test_mechanics_of_several_threads(self):
        model = arm()
        mechanics, q = ambulo.Mechanics(model), numpy.random.default_rng(1).normal(size=(400, 2))
        expected, wrong = mechanics.inverse_dynamics(q).tau, []

        def work():
            for _ in range(20):
                if not numpy.array_equal(mechanics.inverse_dynamics(q).tau, expected):
                    wrong.append(1)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        model.close()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_every_call_of_a_closed_object(self):
        model = arm()
        problem = swing(model)
        result, mechanics = problem.solve(), ambulo.Mechanics(model)
        base = self.folder / "sweep.yaml"
        batch = ambulo.Batch.create(base, REACH, axes=[{"key": "time.intervals", "values": [10]}])
        fine = {"close", "load", "load_text", "create", "messages", "problem", "model"}
        x, q = numpy.zeros(problem.variable_count), numpy.zeros((3, 2))
        given = {"x": x, "q": q, "to": problem, "path": "p", "coordinate": 0, "row": 0, "what": "link",
                 "name": "upper", "values": [1.0], "folder": str(self.folder / "out"), "case": 0,
                 "gait": ambulo.Gait(), "load_link": 0, "terms": [], "link": 0, "local": numpy.zeros(3), "qd": q}
        for thing in (result, mechanics, problem, batch, model):
            thing.close()
            names = [name for name in dir(type(thing)) if not name.startswith("_")]
            for name in names:
                if name in fine:
                    continue
                with self.subTest(kind=type(thing).__name__, name=name):
                    with self.assertRaises((ValueError, TypeError)) as caught:
                        found = getattr(thing, name)
                        wanted = [p for p in inspect.signature(found).parameters.values()
                                  if p.default is p.empty and p.kind is p.POSITIONAL_OR_KEYWORD]
                        found(*[given[p.name] for p in wanted])
                    self.assertIn("is closed", str(caught.exception))
            self.assertTrue(repr(thing))


class Copying(Silent):
    def test_objects_refuse_to_be_pickled_or_copied(self):
        model = arm()
        problem = swing(model)
        for thing in (problem.solve(), ambulo.Mechanics(model), problem, model):
            for take in (pickle.dumps, copy.copy, copy.deepcopy):
                with self.subTest(kind=type(thing).__name__, take=take.__name__):
                    with self.assertRaisesRegex(TypeError, "neither pickled nor copied"):
                        take(thing)

    def test_what_they_say_is_pickled(self):
        with swing(arm()) as problem:
            result = problem.solve()
            motion, audit = result.motion(), result.audit
        self.assertEqual(pickle.loads(pickle.dumps(audit)), audit)
        again = pickle.loads(pickle.dumps(motion))
        self.close(again.q, motion.q, 0)
        self.assertEqual(pickle.loads(pickle.dumps(result.verdict)), result.verdict)
        self.assertEqual(pickle.loads(pickle.dumps(result.summary())), result.summary())

    def test_errors_are_pickled(self):
        """As a pool of processes does with what a worker raises."""
        fault = self.fails("E_SCHEMA", ambulo.Problem.load_text, "nonsense: 1")
        again = pickle.loads(pickle.dumps(fault))
        self.assertEqual((again.status, str(again), again.messages),
                         (fault.status, str(fault), fault.messages))


class HandedOver(Silent):
    """Problems that a function makes for solve_parameters are the library's from then on."""

    key = "ends.initial_speed.shoulder"

    def solve(self, problem, at):
        return problem.solve_parameters({self.key: (-5, 5)}, at=at)

    def test_the_one_that_is_solved_is_refused(self):
        with ambulo.Problem.load(REACH) as problem:
            with self.assertRaisesRegex(ValueError, "the problem that is solved"):
                self.solve(problem, lambda values: problem)
            self.assertGreater(problem.solve().objective, 0)

    def test_none_is_taken_twice(self):
        with ambulo.Problem.load(REACH) as problem:
            other = ambulo.Problem.load(REACH)
            with self.assertRaisesRegex(ValueError, "closed"):
                self.solve(problem, lambda values: other)

    def test_what_was_made_of_one_says_so(self):
        results = []

        def at(values):
            made = ambulo.Problem.load(REACH)
            results.append(made.solve(maximum_iterations=1))
            return made

        with ambulo.Problem.load(REACH) as problem:
            self.solve(problem, at)
        with self.assertRaisesRegex(ValueError, "handed over"):
            results[0].objective


class Collected(Silent):
    def test_a_function_that_knows_its_problem(self):
        """A circle through the library: the problem holds its term, which holds the problem."""
        from ambulo import _native

        freed, made = [], []
        init = _native.Handle.__init__

        def counting(handle, pointer, free, *needs):
            made.append(pointer)
            init(handle, pointer, lambda p: (freed.append(p), free(p))[1], *needs)

        def make():
            def term(state, gradient):
                return effort(state, gradient) + 0 * len(holder)

            holder = [swing(arm()).extend(terms=[ambulo.Term("user_term", function=term)])]
            holder[0].evaluate(numpy.zeros(holder[0].variable_count))

        _native.Handle.__init__ = counting
        try:
            make()
            gc.collect()
        finally:
            _native.Handle.__init__ = init
        self.assertEqual(len(freed), len(made))
        self.assertGreaterEqual(len(made), 4)  # model, problem, extension, workspace

    def test_the_interpreter_may_end_at_any_time(self):
        """With objects of every kind alive, in circles and in threads: not a word."""
        script = f"""
import sys, threading, numpy, ambulo
problem = ambulo.Problem.load({str(REACH)!r})
result = problem.solve()
model, mechanics = problem.model, ambulo.Mechanics(problem.model)
x = numpy.zeros(problem.variable_count)
problem.evaluate(x)
own = problem.extend(terms=[ambulo.Term("user_term", function=lambda s, g: 0 * len(kept))])
kept = [own, result, mechanics, model]
kept.append(kept)
own.evaluate(x)
sys.kept = kept
threading.Thread(target=lambda: [problem.solve() for _ in range(50)], daemon=True).start()
"""
        for end in ("", "sys.exit(0)", "del problem, result, own"):
            done = subprocess.run([sys.executable, "-W", "ignore", "-c", script + end], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
