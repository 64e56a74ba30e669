"""Fits: a run, its report, stops."""

import ambulo
from support import TOP, Case, optional

pandas = optional("pandas")
ARM = TOP / "tests" / "study" / "arm" / "fit.yaml"


class Fits(Case):
    def test_two_prices_of_a_reach(self):
        """Those that its references were made with are found (tests/study)."""
        seen = []
        with ambulo.Fit.load(ARM) as fit:
            self.assertIn("elbow", fit.describe())
            report = fit.run(self.folder / "fitted", workers=2, progress=seen.append)
        self.assertGreater(len(seen), 1)
        self.assertEqual(seen[-1].solves, report.document["solves"])
        self.assertEqual((report.name, report.ended_by), ("arm", "converged"))
        self.close(report.parameters["elbow"], 2.5, 1e-4)
        self.close(report.parameters["smooth"], 0.4, 1e-4)
        self.assertLess(report.distance["after"], 1e-4 * report.distance["before"])
        self.assertIn("converged", report.text)
        # the fitted problem, and as a condition sets it
        self.assertEqual(report.fitted, self.folder / "fitted" / "fitted.yaml")
        with report.problem() as problem:
            self.assertEqual(str(problem.solve().verdict), "optimal")
        self.assertEqual(report.problem("quick").duration, 0.7)
        with self.assertRaisesRegex(KeyError, "quick, slow"):
            report.problem("fast")
        self.tables(report)
        # opened later
        later = ambulo.FitReport(self.folder / "fitted")
        self.assertEqual((later.document, later.text), (report.document, None))
        self.assertEqual(repr(later), repr(report))

    def tables(self, report):
        if not pandas:
            return
        table = report.to_pandas().set_index("parameter")
        self.close(table.after["smooth"], 0.004, 1e-4)
        self.assertEqual(table.key["smooth"], "objective[acceleration].weight")
        curves = report.curves_to_pandas()
        self.assertEqual(len(curves), 3 * 3 * 2)
        elbow = curves[(curves.curve == "elbow") & (curves.condition == "middle")].set_index("when")
        self.assertTrue(elbow.held_out.all())
        self.assertLess(elbow.rmse["after"], 1e-3 * elbow.rmse["before"])
        self.assertEqual(len(report.history_to_pandas()), len(report.document["history"]))

    def test_faults(self):
        bad = self.folder / "fit.yaml"
        bad.write_text(ARM.read_text().replace("reach.yaml", str(ARM.with_name("reach.yaml")))
                       .replace("range: [0.1, 10]", "rnage: [0.1, 10]"))
        fault = self.fails("E_SCHEMA", ambulo.Fit.load, bad)
        self.assertIn("did you mean 'range'?", {message.hint for message in fault.messages})
        with self.assertRaises(FileNotFoundError):
            ambulo.FitReport(self.folder)

    def test_stopping_and_going_on(self):
        with ambulo.Fit.load(ARM) as fit:
            with self.assertRaises(FileNotFoundError):
                fit.run(self.folder / "fitted", workers=1, progress=lambda now: 2)
            stopped = fit.run(self.folder / "fitted", workers=1,
                              progress=lambda now: now.iteration >= 1)
            self.assertEqual(stopped.ended_by, "interrupted")

            def fault(now):
                raise LookupError("mine")

            with self.assertRaisesRegex(LookupError, "mine"):
                fit.run(self.folder / "fitted", progress=fault)
            first = []
            report = fit.run(self.folder / "fitted", progress=first.append)
        self.assertGreater(first[-1].resumed, 0)
        self.assertEqual(report.ended_by, "converged")
