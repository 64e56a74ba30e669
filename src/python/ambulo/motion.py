"""A motion as arrays, as a table, as a picture."""

from typing import List, Tuple

import numpy

from ._native import lib
from .mechanics import doubles
from .records import usual_struct


class Motion:
    """A motion at n times, of d coordinates, p points, f feet, s patches, v devices and h holds.

    ========================  =========  ======================================================
    attribute                 shape      meaning
    ========================  =========  ======================================================
    time                      [n]        s
    q, qd, qdd                [n][d]     rad or m, and per second
    tau                       [n][d]     N m or N: of the person, without what devices do
    wrench                    [n][6]     moment about the world's origin, then force: what the
                                         surroundings apply
    points                    [n][p][3]  m, world axes
    zmp                       [n][3]     zero-moment point, m; NaN where nothing presses down
    grf, cop                  [n][f][3]  force on each foot, N; its centre of pressure, m
    free_moment               [n][f]     N m, about the normal
    grf_moment                [n][f][3]  N m, all of it, about the world's origin
    patch_force, patch_cop    [n][s][3]  the same of patches
    patch_free_moment         [n][s]
    patch_moment              [n][s][3]
    device_effort             [n][v]     N m or N
    device_along              [n][v]     coordinate or length, rad or m
    device_power              [n][v]     W, on the body
    hold_force, hold_moment   [n][h]     of what hands hold: N that each hand exerts, and N m about
                              [2][3]     its point; zeros of a hand that is not there
    hold_power                [n][h]     W, of the forces of both hands
    ========================  =========  ======================================================

    Without ground reaction forces on feet are NaN; centres of pressure are NaN in the air. Columns
    are ``coordinates``, ``point_names``, ``feet``, ``patches``, ``devices``, ``holds``; the hands of a
    hold are named in ``hold_hands``.
    """

    time: numpy.ndarray
    q: numpy.ndarray
    qd: numpy.ndarray
    qdd: numpy.ndarray
    tau: numpy.ndarray
    wrench: numpy.ndarray
    points: numpy.ndarray
    zmp: numpy.ndarray
    grf: numpy.ndarray
    cop: numpy.ndarray
    free_moment: numpy.ndarray
    grf_moment: numpy.ndarray
    patch_force: numpy.ndarray
    patch_cop: numpy.ndarray
    patch_free_moment: numpy.ndarray
    patch_moment: numpy.ndarray
    device_effort: numpy.ndarray
    device_along: numpy.ndarray
    device_power: numpy.ndarray
    hold_force: numpy.ndarray
    hold_moment: numpy.ndarray
    hold_power: numpy.ndarray
    coordinates: List[str]
    point_names: List[str]
    feet: List[str]
    patches: List[str]
    devices: List[str]
    holds: List[str]
    hold_hands: List[List[str]]
    _device_columns: List[Tuple[str, str, str]]

    def __getitem__(self, name: str) -> numpy.ndarray:
        """A column [n] as motion.csv calls it: ``motion["q.knee_angle_r"]``."""
        table = self.to_dict()
        if name not in table:
            raise KeyError(f"{name}; known are {', '.join(table)}")
        return table[name]

    def to_dict(self) -> dict:
        """Columns by name, as motion.csv has them (docs/results.md)."""
        table = {"time": self.time}
        for kind in ("q", "qd", "qdd", "tau"):
            array = getattr(self, kind)
            table.update((f"{kind}.{name}", array[:, i]) for i, name in enumerate(self.coordinates))
        table.update((f"zmp.{axis}", self.zmp[:, i]) for i, axis in enumerate("xyz"))
        if numpy.isfinite(self.free_moment).any():
            self._add_ground(table, self.feet, self.grf, self.cop, self.free_moment,
                             self.grf_moment)
        used = [i for i in range(len(self.patches)) if numpy.any(self.patch_force[:, i] != 0)
                and numpy.isfinite(self.patch_force[:, i]).all()]
        self._add_ground(table, [self.patches[i] for i in used], self.patch_force[:, used],
                         self.patch_cop[:, used], self.patch_free_moment[:, used],
                         self.patch_moment[:, used])
        for i, (name, effort, along) in enumerate(self._device_columns):
            table[f"device.{name}.{effort}"] = self.device_effort[:, i]
            table[f"device.{name}.{along}"] = self.device_along[:, i]
            table[f"device.{name}.power"] = self.device_power[:, i]
        for i, name in enumerate(self.holds):
            for k, hand in enumerate(self.hold_hands[i]):
                for what, array in (("force", self.hold_force), ("moment", self.hold_moment)):
                    table.update((f"held.{name}.{hand}.{what}.{axis}", array[:, i, k, j])
                                 for j, axis in enumerate("xyz"))
            table[f"held.{name}.power"] = self.hold_power[:, i]
        return table

    @staticmethod
    def _add_ground(table, names, force, center, twist, moment):
        for i, name in enumerate(names):
            table.update((f"grf.{name}.{axis}", force[:, i, k]) for k, axis in enumerate("xyz"))
            table.update((f"cop.{name}.{axis}", center[:, i, k]) for k, axis in enumerate("xyz"))
            table[f"free_moment.{name}"] = twist[:, i]
            table.update((f"moment.{name}.{axis}", moment[:, i, k]) for k, axis in enumerate("xyz"))

    def to_pandas(self):
        """``to_dict`` as a pandas.DataFrame with the time (s) as its index."""
        import pandas

        table = self.to_dict()
        index = pandas.Index(table.pop("time"), name="time")
        return pandas.DataFrame(table, index=index)

    def plot(self, coordinates=None, **options):
        """Angles and torques over time: ``ambulo.plots.motion``."""
        from . import plots

        return plots.motion(self, coordinates, **options)

    def __repr__(self):
        return (f"<Motion: {len(self.time)} times from {self.time[0]:.4g} to {self.time[-1]:.4g} s, "
                f"{len(self.coordinates)} coordinates>")


def _shapes(d, p, f, s, v, h):
    state = {name: (d,) for name in ("q", "qd", "qdd", "tau")}
    return dict(state, wrench=(6,), points=(p, 3), zmp=(3,), grf=(f, 3), cop=(f, 3),
                free_moment=(f,), grf_moment=(f, 3), patch_force=(s, 3), patch_cop=(s, 3),
                patch_free_moment=(s,), patch_moment=(s, 3),
                device_effort=(v,), device_along=(v,), device_power=(v,),
                hold_force=(h, 2, 3), hold_moment=(h, 2, 3), hold_power=(h,))


def motion_of(problem, x, times) -> Motion:
    """Of the flat unknowns x."""
    times = numpy.ascontiguousarray(numpy.atleast_1d(times), dtype=float)
    if times.ndim != 1 or len(times) < 1:
        raise ValueError(f"times are an array {list(times.shape)}; expected [n]")
    model, devices, holds = problem.model, problem.devices, problem.holds
    made = Motion()
    made.time, made.coordinates = times, model.coordinate_names
    made.point_names, made.devices = model.point_names, [device.name for device in devices]
    made.feet = [foot.name for foot in model.feet]
    made.holds = [hold.name for hold in holds]
    made.hold_hands = [[made.point_names[hand] for hand in hold.hand if hand >= 0] for hold in holds]
    made.patches = [patch.name for patch in model.patches]
    made._device_columns = [
        (device.name, "torque", "angle") if device.coordinate >= 0 and
        model.coordinates[device.coordinate].type.name == "REVOLUTE" else
        (device.name, "force", "length") for device in devices]
    struct, memory = usual_struct("ambulo_motion"), []
    shapes = _shapes(len(made.coordinates), len(made.point_names), len(made.feet),
                     len(made.patches), len(devices), len(holds))
    for name, shape in shapes.items():
        array = numpy.empty((len(times),) + shape)
        setattr(made, name, array)
        if array.size:
            memory.append(doubles(array))
            setattr(struct, name, memory[-1])
    problem._asked(lib.ambulo_problem_motion, doubles(x), len(times), doubles(times), struct)
    return made
