"""Batches: their lists, runs in processes, tables, cases; stops of every kind."""

import base64
import json
import os
import re
import signal
import subprocess
import sys
import threading
import unittest
import zlib
from pathlib import Path
from unittest import mock

import ambulo
import numpy
from support import REACH, Case, optional

pandas, matplotlib = optional("pandas"), optional("matplotlib")
if matplotlib:
    matplotlib.use("Agg")


def table_of(page):
    """The table of a study's page, which is deflated where there is zlib, as text."""
    packed = re.search('"table":"([^"]*)"', page)
    return zlib.decompress(base64.b64decode(packed[1]), -15).decode() if packed else page


class Batches(Case):
    def batch(self, times=(0.8, 1.0, 1.2), **keys):
        axes = [{"key": "time.duration", "name": "time", "values": list(times)}]
        keys = {"case_name": "t{time}", "outputs": [
            "objective", {"output": "max(tau.elbow)", "label": "elbow, N m"}], **keys}
        return ambulo.Batch.create(self.folder / "sweep.yaml", REACH, axes=axes, **keys)

    def test_a_list_of_cases(self):
        batch = self.batch(numpy.array([0.8, 1.0]))
        self.assertEqual((batch.name, len(batch), batch.axes), ("batch", 2, ["time"]))
        self.assertEqual(batch.base, REACH)
        self.assertEqual([case.name for case in batch.cases], ["t0.8", "t1.0"])
        self.assertEqual(batch.cases[1].overrides, ["time.duration=1.0"])
        self.assertEqual(batch.cases[1].previous, -1)
        for which in (1, -1, "t1.0", batch.cases[1].id):
            self.assertEqual(batch.problem(which).duration, 1.0)
        self.assertEqual(len(ambulo.Batch.load(ambulo.MODELS / "sweep_walk.yaml")), 200)
        fault = self.fails("E_SCHEMA", self.batch, name="b", filters=["tine < 1"])
        self.assertIn("did you mean 'time'?", fault.messages[0].hint)
        batch.close()
        with self.assertRaises(ValueError):
            batch.name

    def test_from_the_sweep_to_the_motion_of_a_case(self):
        seen = []
        study = self.batch().run(self.folder / "study", workers=2, progress=seen.append)
        self.assertEqual((seen[-1].done, seen[-1].cases, seen[-1].resumed), (3, 3, 0))
        census = study.status()
        self.assertEqual((census.done, census.failed, census.missing, census.holder), (3, 0, 0, ""))
        self.assertEqual((len(study), [case.name for case in study]), (3, ["t0.8", "t1.0", "t1.2"]))
        # a case is what a solve gives
        case = study["t1.0"]
        self.assertIs(study[1], case)
        solved = ambulo.Problem.load(REACH, {"time.duration": 1.0}).solve()
        self.assertEqual((case.state, case.values["time"]), ("optimal", 1.0))
        self.close(case.values["objective"], solved.objective, 1e-9)
        self.close(case.values["elbow, N m"], solved.motion()["tau.elbow"].max(), 1e-6)
        self.close(case.motion()["tau.elbow"], solved.motion()["tau.elbow"], 1e-6)
        self.assertEqual(case.summary()["verdict"], "optimal")
        self.assertEqual(case.record()["exit_code"], 0)
        self.assertEqual(case.problem().duration, 1.0)
        again = case.result()
        self.close(again.objective, solved.objective, 1e-9)
        self.assertEqual(again.motion(11).q.shape, (11, 2))
        with self.assertRaises(IndexError):
            study[3]
        with self.assertRaisesRegex(KeyError, "t2"):
            study["t2"]
        # the same folder, opened later, knows its sweep
        later = ambulo.Study(self.folder / "study")
        self.assertEqual([case.id for case in later], [case.id for case in study])
        self.assertEqual(later[2].problem().duration, 1.2)

    @unittest.skipUnless(pandas, "no pandas")
    def test_tables(self):
        batch = self.batch((0.8, 0.01))
        self.assertEqual(list(batch.to_pandas().columns), ["id", "name", "time"])
        study = batch.run(self.folder / "study")
        table = study.to_pandas()
        self.assertEqual(list(table.columns), ["id", "name", "state", "time", "objective", "elbow, N m"])
        self.assertEqual(list(table.state), ["optimal", "infeasible"])
        self.assertEqual(table.time.dtype.kind, "f")
        self.assertEqual(study.status().failed, 1)
        self.assertEqual(study[0].motion_to_pandas().index.name, "time")
        self.close(table.objective[0], study[0].values["objective"])

    @unittest.skipUnless(matplotlib, "no matplotlib")
    def test_pictures(self):
        from matplotlib import pyplot

        study = self.batch((0.8, 0.01, 1.0)).run(self.folder / "study")
        axis, = study.plot("time", "elbow, N m").axes
        points, failed = (line.get_xdata() for line in axis.lines)
        self.assertEqual([list(points), list(failed)], [[0.01, 0.8, 1.0], [0.01]])
        self.assertEqual(axis.get_ylabel(), "elbow, N m")
        axis, = study.plot("objective", "elbow, N m", by="time").axes
        self.assertEqual([text.get_text() for text in axis.get_legend().get_texts()],
                         ["time 0.01", "time 0.8", "time 1"])
        with self.assertRaisesRegex(KeyError, "no column 'knee'"):
            study.plot("time", "knee")
        with self.assertRaisesRegex(ValueError, "no front"):
            study.plot_front()
        pyplot.close("all")

    def test_page(self):
        study = self.batch((0.8, 1.0)).run(self.folder / "study")
        page = study.report()
        self.assertEqual(page, self.folder / "study" / "report.html")
        self.assertIn(study[0].id, table_of(page.read_text()))
        self.fails("E_IO", study.report, self.folder / "no" / "page.html")

    def test_damage_is_found(self):
        study = self.batch((0.8, 1.0)).run(self.folder / "study")
        self.assertEqual((study.verify().census.corrupt, study.verify().damaged), (0, []))
        (study[1].folder / "motion.csv").write_text("nothing\n")
        census, damaged = study.verify()
        self.assertEqual(census.corrupt, 1)
        self.assertEqual([(one.name, Path(one.file).name) for one in damaged], [("t1.0", "motion.csv")])
        self.assertEqual(study.collect().corrupt, 1)
        self.assertEqual(study[1].state, "corrupt")
        # computed again, and nothing else is
        seen = []
        study = self.batch((0.8, 1.0)).run(self.folder / "study", progress=seen.append)
        self.assertEqual((study.status().corrupt, seen[0].resumed, study[1].state), (0, 1, "optimal"))
        # other cases in the same folder are refused
        fault = self.fails("E_PROBLEM", self.batch((0.8, 1.1)).run, self.folder / "study")
        self.assertTrue(fault.messages)
        self.assertEqual(len(self.batch((0.8, 1.1)).run(self.folder / "study", force=1)), 2)

    def test_folders_that_are_none(self):
        self.fails("E_IO", ambulo.Study, self.folder)
        self.fails("E_IO", ambulo.Study, self.folder / "not there")

    def test_stopping_and_going_on(self):
        batch = self.batch([0.5 + 0.01 * k for k in range(30)])
        study = batch.run(self.folder / "study", workers=1, progress=lambda now: now.done >= 3)
        done = study.status().done
        self.assertTrue(3 <= done < 30, done)
        self.assertEqual((study[0].state, study[29].state), ("optimal", "missing"))
        seen = []
        study = batch.run(self.folder / "study", progress=seen.append)
        self.assertEqual((study.status().done, seen[0].resumed), (30, done))

    def test_an_exception_of_progress(self):
        def fault(now):
            if now.running:
                raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            self.batch([0.5 + 0.01 * k for k in range(30)]).run(
                self.folder / "study", workers=1, progress=fault)
        self.assertTrue(ambulo.Study(self.folder / "study").status().missing > 0)

    def test_interruption(self):
        batch = self.batch([0.5 + 0.005 * k for k in range(60)])
        for interrupt in ("keep", "raise"):
            folder = self.folder / interrupt
            timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            if interrupt == "keep":
                with self.assertWarnsRegex(ambulo.AmbuloWarning, "interrupted: the same call goes on"):
                    study = batch.run(folder, workers=1)
            else:
                with self.assertRaises(KeyboardInterrupt):
                    batch.run(folder, workers=1, interrupt="raise")
                study = ambulo.Study(folder)
            timer.join()
            self.assertTrue(study.status().missing > 0)
            self.assertEqual(study.status().failed, 0)  # running cases were not cut off
        with self.assertRaisesRegex(ValueError, "interrupt"):
            batch.run(self.folder / "third", interrupt="never")

    def test_a_front(self):
        batch = ambulo.Batch.create(
            self.folder / "front.yaml", REACH, name="front",
            front={"terms": ["torque_squared", "acceleration"], "points": 4})
        self.assertEqual(batch.front_points, 4)
        study = batch.run(self.folder / "study")
        census = study.collect()
        self.assertEqual((census.front.terms, census.front.wanted), (2, 4))
        self.assertGreaterEqual(len(study), 4)
        self.assertIn("front", study[0].values)


class Programs(Case):
    def said(self, *command):
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout

    def test_the_package_has_its_program(self):
        self.assertIn(ambulo.__version__, self.said(ambulo.program(), "--version"))
        # and the program finds the package's models
        self.assertEqual(Path(self.said(ambulo.program(), "--models").strip()), ambulo.MODELS.resolve())

    def test_another_one(self):
        with mock.patch.dict(os.environ, {"AMBULO_PROGRAM": str(self.folder / "none")}):
            with self.assertRaisesRegex(FileNotFoundError, "AMBULO_PROGRAM"):
                ambulo.program()

    def test_a_program_that_is_none(self):
        batch = ambulo.Batch.create(self.folder / "s.yaml", REACH, cases=[{"name": "one", "set": {"time.duration": 1}}])
        fault = self.fails("E_IO", batch.run, self.folder / "study", program=str(self.folder / "none"))
        self.assertIn("start a worker", fault.messages[0].message)

    def test_the_command_of_the_environment(self):
        command = Path(sys.executable).with_name("ambulo")
        if not command.exists():
            self.skipTest("not installed by a wheel")
        self.assertIn(ambulo.__version__, self.said(command, "--version"))


class Written(Case):
    def test_a_sweep_file_is_one_for_the_program(self):
        ambulo.Batch.create(self.folder / "s.yaml", REACH, name="mine", combine="zip",
                            axes=[{"key": "time.duration", "values": numpy.linspace(1, 2, 3)}])
        text = json.loads((self.folder / "s.yaml").read_text())
        self.assertEqual(text["axes"][0]["values"], [1.0, 1.5, 2.0])
        said = subprocess.run([ambulo.program(), "batch", "s.yaml", "--dry-run"], cwd=self.folder,
                              check=True, stdout=subprocess.PIPE, text=True).stdout
        self.assertEqual(said.count("time.duration="), 3)
