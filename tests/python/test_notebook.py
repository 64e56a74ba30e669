"""The notebooks of docs/examples run from the first cell to the last."""

import json
import os
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import ambulo
from support import TOP, Case, optional

NOTEBOOKS = sorted((TOP / "docs" / "examples").glob("*.ipynb"))
# one folder: the second run of a study finds it solved
STUDY = tempfile.TemporaryDirectory(prefix="ambulo-study-")
WANTED = optional("pandas") and optional("matplotlib")


@unittest.skipUnless(WANTED, "no pandas or no matplotlib")
class Notebooks(Case):
    @classmethod
    def setUpClass(cls):
        os.environ["AMBULO_STUDY"] = STUDY.name

    @classmethod
    def tearDownClass(cls):
        del os.environ["AMBULO_STUDY"]
        STUDY.cleanup()

    def test_as_plain_scripts(self):
        import matplotlib

        matplotlib.use("Agg")
        self.assertTrue(NOTEBOOKS)
        for path in NOTEBOOKS:
            names = {"__name__": "__main__"}
            for cell in json.loads(path.read_text())["cells"]:
                if cell["cell_type"] == "code":
                    exec(compile("".join(cell["source"]), path.name, "exec"), names)
            matplotlib.pyplot.close("all")

    def test_they_are_kept_without_outputs(self):
        for path in NOTEBOOKS:
            for cell in json.loads(path.read_text())["cells"]:
                self.assertFalse(cell.get("outputs"))

    @unittest.skipUnless(optional("nbclient") and optional("ipykernel"), "no nbclient or no ipykernel")
    def test_in_a_kernel(self):
        import nbclient
        import nbformat
        from jupyter_client.kernelspec import NoSuchKernel

        # whichever interpreter the kernel is of, it finds this package
        found = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
        found["PYTHONPATH"] = str(Path(ambulo.__file__).resolve().parents[1])
        with mock.patch.dict(os.environ, found, clear=True), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for path in NOTEBOOKS:
                notebook = nbformat.read(path, as_version=4)
                client = nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3",
                                                 resources={"metadata": {"path": str(self.folder)}})
                try:
                    client.execute()
                except NoSuchKernel as fault:
                    self.skipTest(str(fault))
                cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
                self.assertTrue(all(cell.execution_count for cell in cells))
                kinds = {kind for cell in cells for output in cell.outputs
                         for kind in output.get("data", {})}
                self.assertIn("image/png", kinds)
