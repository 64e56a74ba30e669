"""Motions: the numbers of motion.csv, tables and pictures; motions in files."""

import unittest

import ambulo
import numpy
from support import REACH, WALK, Case, optional

pandas, matplotlib = optional("pandas"), optional("matplotlib")
if matplotlib:
    matplotlib.use("Agg")

solved = {}


def solution(path, overrides=None):
    """Solved once for all tests."""
    if path not in solved:
        with ambulo.Problem.load(path, overrides) as problem:
            solved[path] = problem.solve()
    return solved[path]


def table_of(path):
    from ambulo.files import read_table

    return read_table(path.read_text())


class Motions(Case):
    def columns_are_those_of_the_file(self, result):
        result.write(self.folder / "out")
        table = table_of(self.folder / "out" / "motion.csv")
        found = result.motion().to_dict()
        self.assertEqual(list(table), list(found))
        for name, values in table.items():
            nan = numpy.isnan(values)
            self.assertEqual(nan.tolist()[:len(found[name])], numpy.isnan(found[name]).tolist(), name)
            part = values[:len(found[name])]  # of a mirrored step the file has the stride
            self.close(numpy.nan_to_num(part), numpy.nan_to_num(found[name]), 1e-9)

    def test_of_an_arm(self):
        self.columns_are_those_of_the_file(solution(REACH))

    def test_of_a_walk_with_forces(self):
        self.columns_are_those_of_the_file(solution(WALK))

    def test_of_a_body_with_devices(self):
        self.columns_are_those_of_the_file(solution(ambulo.MODELS / "walk_knee_brace.yaml"))

    def test_of_a_body_on_patches(self):
        self.columns_are_those_of_the_file(solution(ambulo.MODELS / "sit_to_stand.yaml"))

    def test_of_a_body_that_lifts_a_box(self):
        result = solution(ambulo.MODELS / "lift.yaml")
        self.columns_are_those_of_the_file(result)
        motion, (box,) = result.motion(60), result.problem.holds
        self.assertEqual((motion.holds, motion.hold_hands), (["box"], [["hand_r", "hand_l"]]))
        self.assertEqual(motion.hold_force.shape, (60, 1, 2, 3))
        # before and after it is held nothing, in between what carries it
        apart = (motion.time < box.from_) | (motion.time > box.to)
        self.assertTrue(apart.any())
        self.close(motion.hold_force[apart], numpy.zeros((apart.sum(), 1, 2, 3)))
        whole = (motion.time > box.from_ + box.ramp) & (motion.time < box.to - box.ramp)
        upward = motion.hold_force[whole, 0].sum(axis=1)[:, 1]
        self.close(upward.mean() / (box.mass * 9.81), 1.0, 0.1)
        hand = result.summary()["held"]["box"]["hands"]["hand_r"]
        size = numpy.linalg.norm(result.motion(2001).hold_force[:, 0, 0], axis=1)
        self.close(size.max() / hand["peak_force"], 1.0, 0.02)

    def test_times_of_ones_own(self):
        result = solution(REACH)
        motion = result.motion([0.0, 0.1, 0.8])
        self.assertEqual(motion.tau.shape, (3, 2))
        self.close(result.motion(17).time, numpy.linspace(0, 0.8, 17))
        self.close(motion["q.elbow"], motion.q[:, 1])
        self.assertTrue(numpy.isnan(motion.grf).all())
        with self.assertRaises(KeyError):
            motion["q.knee"]
        self.fails("E_ARGUMENT", result.motion, [0.9])
        # rates are the derivatives of the values
        fine = result.motion(8001)
        dt = fine.time[1]
        self.close((fine.q[2:] - fine.q[:-2]) / (2 * dt), fine.qd[1:-1], 1e-5)

    def test_torques_are_inverse_dynamics(self):
        result = solution(REACH)
        motion = result.motion()
        found = result.problem.model.inverse_dynamics(motion.q, motion.qd, motion.qdd)
        self.close(found.tau, motion.tau, 1e-12)
        self.close(found.points, motion.points, 1e-13)

    @unittest.skipUnless(pandas, "no pandas")
    def test_tables(self):
        result = solution(REACH)
        frame = result.motion().to_pandas()
        self.assertEqual(frame.index.name, "time")
        self.assertEqual(frame["q.elbow"].iloc[-1], result.motion().q[-1, 1])
        costs = ambulo.to_pandas(result.sensitivities())
        self.assertEqual(costs["name"][0], result.sensitivities()[0].name)
        rows = result.rows_to_pandas()
        self.assertEqual(len(rows), result.problem.row_count)
        self.assertEqual(rows["value"].tolist(), result.rows.tolist())
        self.assertEqual(set(rows["relation"]), {"equal", "not_negative"})

    @unittest.skipUnless(matplotlib, "no matplotlib")
    def test_pictures(self):
        from matplotlib import pyplot

        result = solution(WALK)
        motion = result.motion()
        figure = motion.plot(["knee_angle_r", "ankle_angle_r"], title="walk")
        lines = [axis.get_lines()[0] for axis in figure.axes]
        self.close(lines[0].get_ydata(), motion["q.knee_angle_r"])
        self.close(lines[3].get_ydata(), motion["tau.ankle_angle_r"])
        figure = ambulo.plots.ground_force(motion)
        self.close(figure.axes[0].get_lines()[1].get_ydata(), motion["grf.left.y"])
        figure = ambulo.plots.points(motion, ["head_top"])
        self.close(figure.axes[0].get_lines()[0].get_ydata(),
                   motion.points[:, motion.point_names.index("head_top"), 1])
        items = result.sensitivities()
        figure = ambulo.plots.sensitivities(items, most=3)
        widths = [bar.get_width() for bar in figure.axes[0].patches]
        self.close(widths[::-1], [100 * item.share for item in items[:3]])
        figure = ambulo.plots.convergence(result)
        self.close(figure.axes[0].get_lines()[0].get_ydata(), result.history["objective"])
        self.assertEqual(figure.axes[1].get_yscale(), "log")
        figure.savefig(self.folder / "x.svg")
        pyplot.close("all")


class Files(Case):
    def test_inverse_dynamics_of_a_file(self):
        result = solution(REACH)
        result.write(self.folder / "out")
        motion, model = result.motion(), result.problem.model
        found = ambulo.inverse_of_file(model, self.folder / "out" / "motion.csv")
        self.close(found.columns["tau.elbow"], motion["tau.elbow"], 1e-9)
        self.assertIsNone(found.residual)
        again = ambulo.inverse_of_file(model, self.folder / "out" / "motion.csv", recompute_rates=1)
        self.assertGreater(numpy.abs(again.columns["tau.elbow"] - motion["tau.elbow"]).max(), 1e-7)
        if pandas:
            self.assertEqual(found.to_pandas().index.name, "time")

    def test_forces_leave_nothing_over(self):
        result = solution(WALK)
        result.write(self.folder / "out")
        found = ambulo.inverse_of_file(result.problem.model, self.folder / "out" / "motion.csv")
        self.assertLess(max(found.residual.force_rms), 1e-9)

    def test_comparison_with_people(self):
        result = solution(WALK)
        result.write(self.folder / "out")
        scores = {score.name: score for score in ambulo.compare(self.folder / "out")}
        self.assertGreater(scores["knee_flexion"].r, 0.9)
        self.assertIn("deg", scores["knee_flexion"].unit)
        self.assertEqual(len(ambulo.compare(self.folder / "out", curves="knee_flexion")), 1)
        self.fails("E_IO", ambulo.compare, self.folder / "none")
