"""Many problems at once: sweep files, their runs, and the folders that these leave."""

import json
import os
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Union

import numpy

from . import _records as records
from ._native import Call, Handle, Owner, ffi, lib, path_of, text_of
from .files import read_table
from .problem import Problem
from .processes import Watch, left_of, print_line
from .records import Carrier, from_c

NULL = ffi.NULL


def _show(now):
    print_line(f"{now.done - now.no_result} of {now.cases} done, {now.failed} without a solution{left_of(now.seconds_left)}")


class Batch(Owner):
    """A sweep: a base problem and values for some of its keys; its list of cases never changes.

    >>> batch = ambulo.Batch.load(ambulo.MODELS / "sweep_walk.yaml")
    >>> study = batch.run("study", progress=True)
    >>> study.to_pandas().groupby("gait.speed").objective.mean()

    The format of sweep files is that of docs/batch-format.md.
    """

    def __init__(self, handle: Handle):
        self._handle = handle

    @classmethod
    def load(cls, path) -> "Batch":
        """Reads a sweep file and its base problem."""
        out = ffi.new("ambulo_sweep **")
        with Call() as call:
            call(lib.ambulo_sweep_load(path_of(path), NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_sweep_free))

    @classmethod
    def create(cls, path, base, *, name: str = "batch", **keys) -> "Batch":
        """Writes a sweep file at ``path`` and reads it.

        ``base`` is the problem file, seen from where Python runs; ``keys`` are those of a sweep
        file: lists and dictionaries, numbers and words.

        >>> batch = ambulo.Batch.create(
        ...     "masses.yaml", ambulo.MODELS / "walk.yaml",
        ...     axes=[{"key": "subject.mass", "name": "mass", "values": [60, 75, 90]}],
        ...     outputs=["objective"])
        """
        document = {"ambulo": 1, "kind": "sweep", "name": name, "base": os.path.abspath(base), **keys}
        text = json.dumps(document, indent=2, default=_plain)  # JSON is YAML
        Path(path).write_text(text + "\n")
        return cls.load(path)

    # ------------------------------------------------------------------ queries

    @property
    def name(self) -> str:
        return self._read(text_of, lib.ambulo_sweep_name)

    @property
    def base(self) -> Path:
        """The base problem's file."""
        return Path(self._read(text_of, lib.ambulo_sweep_base))

    @property
    def axes(self) -> List[str]:
        pointer = self._pointer
        return [text_of(lib.ambulo_sweep_axis_name(pointer, i))
                for i in range(lib.ambulo_sweep_axis_count(pointer))]

    @property
    def front_points(self) -> int:
        """Points that a Pareto front is asked for; 0: the sweep is none. The list of a front has its
        ends only; a run finds the others."""
        return lib.ambulo_sweep_front_points(self._pointer)

    def __len__(self):
        return lib.ambulo_sweep_case_count(self._pointer)

    @property
    def cases(self) -> List[records.Case]:
        struct, found, pointer = ffi.new("ambulo_case *"), [], self._pointer
        with Call() as call:
            for i in range(lib.ambulo_sweep_case_count(pointer)):
                call(lib.ambulo_sweep_case(pointer, i, struct))
                found.append(from_c(records.Case, struct))
        return found

    def problem(self, case: Union[int, str]) -> Problem:
        """The problem of a case, by its place in the list, its name or its id."""
        cases = self.cases
        return Problem.load(self.base, cases[_place(cases, case)].overrides)

    def to_pandas(self):
        """The list of cases: id, name and the texts of the axes."""
        import pandas

        pointer, axes = self._pointer, self.axes
        return pandas.DataFrame([
            [case.id, case.name] + [text_of(lib.ambulo_sweep_value(pointer, i, k))
                                    for k in range(len(axes))]
            for i, case in enumerate(self.cases)], columns=["id", "name", *axes])

    # ---------------------------------------------------------------------- run

    def run(self, folder, *, workers: int = 0, progress: Union[bool, Callable, None] = None,
            interrupt: str = "keep", **options) -> "Study":
        """Solves every case that is not finished in ``folder`` yet, and writes the table.

        ``workers``    processes at once; 0: the usable processors, as memory allows
        ``progress``   a function that is called with a BatchProgress a few times a second; it
                       returns 0 (None) to go on, 1 to start no new case, 2 to stop now; True prints
                       a line
        ``interrupt``  Ctrl-C lets running cases finish, a second one stops: "keep" then returns
                       the study so far, "raise" raises KeyboardInterrupt
        ``options``    those of BatchOptions: ``case_seconds``, ``case_megabytes``, ``force``, ...

        Cases are run by the program ``ambulo`` of the package, each in a process of its own, so
        that terms in Python have no place here. The same call goes on where a run was stopped.
        """
        carrier, batch = Carrier(), Batch(self._held)
        watch = Watch(carrier, records.BatchOptions(workers=workers, **options), progress, _show,
                      records.BatchProgress, interrupt)
        with Call() as call:
            status = lib.ambulo_batch_run(batch._pointer, path_of(folder), watch.options, NULL,
                                          call.messages, NULL)
            watch.finish(call, status, "the same call goes on")
        study = Study(folder, batch)
        study.collect()
        return study

    def __repr__(self):
        if self._handle is None:
            return "<Batch, closed>"
        return f"<Batch {self.name}: {len(self)} cases of {self.base.name}, axes {', '.join(self.axes)}>"


def _plain(value):
    """What json does not know: numbers of numpy, paths."""
    return value.tolist() if hasattr(value, "tolist") else os.fspath(value)


def _place(items, which: Union[int, str]) -> int:
    if not isinstance(which, str):
        return range(len(items))[which]
    for place, item in enumerate(items):
        if which in (item.id, item.name):
            return place
    raise KeyError(f"there is no case '{which}'")


# ----------------------------------------------------------------------- folders


class Verified(NamedTuple):
    """What reading every file of a batch folder gave."""

    census: records.BatchCensus
    damaged: List[records.BatchDamage]
    """The first damaged file of each corrupt case."""


class Study:
    """A batch folder: the table, drawings, and every case.

    >>> study = ambulo.Study("study")
    >>> table = study.to_pandas()
    >>> worst = study[int(table.effort.idxmax())]
    >>> worst.motion().keys()

    ``batch`` (a Batch, or a sweep file) is only needed for problems of cases where the sweep file is
    no longer where it was.
    """

    def __init__(self, folder, batch: Union[Batch, str, os.PathLike, None] = None):
        self.folder = Path(folder)
        self.status()  # refuses what is no batch folder
        self._batch = batch
        self._cases: Optional[List["StudyCase"]] = None

    # ------------------------------------------------------------------- census

    def _census(self, function, *arguments) -> records.BatchCensus:
        census = ffi.new("ambulo_batch_census *")
        with Call() as call:
            call(function(path_of(self.folder), *arguments, NULL, call.messages, census))
        return from_c(records.BatchCensus, census)

    def status(self) -> records.BatchCensus:
        """What stands in the folder, from the records alone: ``done``, ``failed``, ``missing``, ..."""
        return self._census(lib.ambulo_batch_status)

    def verify(self) -> Verified:
        """The same by comparing every file with its checksum."""
        damaged: List[records.BatchDamage] = []

        def tell(_, damage):
            damaged.append(from_c(records.BatchDamage, damage))

        told = ffi.callback("void(void *, const ambulo_batch_damage *)", tell)
        return Verified(self._census(lib.ambulo_batch_verify, told, NULL), damaged)

    def collect(self) -> records.BatchCensus:
        """Writes ``results.csv`` and ``results.jsonl`` anew from the cases."""
        self._cases = None
        return self._census(lib.ambulo_batch_collect)

    # -------------------------------------------------------------------- table

    def _table(self, name) -> Path:
        path = self.folder / name
        if not path.exists():
            self.collect()
        return path

    def to_pandas(self):
        """``results.csv``: a line for each case with ``id``, ``name``, ``state``, the axes and the
        outputs; line i is ``study[i]``. Written where it is missing; ``collect`` writes it anew."""
        import pandas

        return pandas.read_csv(self._table("results.csv"),
                               dtype={"id": str, "name": str, "state": str})

    # -------------------------------------------------------------------- cases

    @property
    def cases(self) -> List["StudyCase"]:
        """As the table has them."""
        if self._cases is None:
            lines = self._table("results.jsonl").read_text().splitlines()
            self._cases = [StudyCase(self, json.loads(line)) for line in lines]
        return self._cases

    def __len__(self):
        return len(self.cases)

    def __iter__(self) -> Iterator["StudyCase"]:
        return iter(self.cases)

    def __getitem__(self, which: Union[int, str]) -> "StudyCase":
        """A case by its line in the table, its name or its id."""
        return self.cases[_place(self.cases, which)]

    @property
    def batch(self) -> Batch:
        """The sweep that the folder was filled from."""
        if not isinstance(self._batch, Batch):
            known = json.loads((self.folder / "batch.json").read_text())
            self._batch = Batch.load(self._batch or known["sweep"])
        return self._batch

    # ----------------------------------------------------------------- pictures

    def plot(self, x: str, y: str, by: Optional[str] = None, **options):
        """A column of the table over another: ``ambulo.plots.study``."""
        from . import plots

        return plots.study(self, x, y, by, **options)

    def plot_front(self, **options):
        """The points of a Pareto front: ``ambulo.plots.front``."""
        from . import plots

        return plots.front(self, **options)

    def report(self, path=None, **options) -> Path:
        """Writes the page to watch: table, plots and motions in one HTML file, by default
        ``report.html`` in the folder. ``options`` are those of PageOptions."""
        path = self.folder / "report.html" if path is None else Path(path)
        carrier = Carrier()
        with Call() as call:
            call(lib.ambulo_batch_page(path_of(self.folder), path_of(path),
                                       carrier.new(records.PageOptions(**options)), NULL,
                                       call.messages, NULL))
        return path

    def __repr__(self):
        census = self.status()
        return (f"<Study {self.folder}: {census.done - census.no_result} of {census.cases} cases done, "
                f"{census.failed} without a solution>")


class StudyCase:
    """One case of a study: ``id``, ``name``, ``state``, and ``values`` of axes and outputs."""

    def __init__(self, study: Study, line: Dict[str, Any]):
        self._study = study
        self.id: str = line.pop("id")
        self.name: str = line.pop("name")
        self.state: str = line.pop("state")
        self.values = line

    @property
    def folder(self) -> Path:
        """Its result folder (docs/results.md): ``gait.svg``, ``summary.json``, ``motion.csv``, ..."""
        return self._study.folder / "cases" / self.id[-2:] / self.id

    def record(self) -> Dict[str, Any]:
        """How it ended: state, exit code, seconds, checksums."""
        return json.loads(self.folder.with_name(self.id + ".json").read_text())

    def summary(self) -> Dict[str, Any]:
        """What its summary.json says."""
        return json.loads((self.folder / "summary.json").read_text())

    def motion(self) -> Dict[str, numpy.ndarray]:
        """Columns of its motion.csv by name."""
        return read_table((self.folder / "motion.csv").read_text())

    def motion_to_pandas(self):
        """The same as a pandas.DataFrame with the time (s) as its index."""
        import pandas

        table = self.motion()
        return pandas.DataFrame(table, index=pandas.Index(table.pop("time"), name="time"))

    def problem(self) -> Problem:
        """Its problem: the base with the values of this case."""
        return self._study.batch.problem(self.id)

    def result(self):
        """Its solution in its problem, judged anew: a Result, with motions at any times. It has
        neither multipliers nor sensitivities; ``problem().solve(start)`` from its ``x`` finds them."""
        problem = self.problem()
        return problem.audit(problem.load_solution(self.folder / "solution.yaml"))

    def __repr__(self):
        return f"<StudyCase {self.name}: {self.state}>"
