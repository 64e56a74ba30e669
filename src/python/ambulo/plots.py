"""Pictures with matplotlib, which is only needed here. Every function returns the figure."""

from typing import Optional, Sequence

import numpy


def _axes(rows, columns, figsize, title):
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(rows, columns, figsize=figsize, squeeze=False, sharex=True,
                                   layout="constrained")
    if title:
        figure.suptitle(title)
    return figure, axes


def motion(of, coordinates: Optional[Sequence[str]] = None, *, title: Optional[str] = None):
    """Each coordinate (rad or m) and its torque (N m or N) over time; ``of``: a Motion."""
    names = list(of.coordinates if coordinates is None else coordinates)
    figure, axes = _axes(len(names), 2, (8, 1.2 + 1.4 * len(names)), title)
    for line, name in enumerate(names):
        column = of.coordinates.index(name)
        for side, values in enumerate((of.q, of.tau)):
            axes[line, side].plot(of.time, values[:, column])
            axes[line, side].grid(alpha=0.3)
        axes[line, 0].set_ylabel(name)
    axes[0, 0].set_title("coordinate, rad or m")
    axes[0, 1].set_title("torque, N m or N")
    for axis in axes[-1]:
        axis.set_xlabel("time, s")
    return figure


def convergence(of, *, title: Optional[str] = None):
    """Objective and worst violation over the iterations of a solve; ``of``: a Result. Dotted where
    another grid begins."""
    way = of.history
    figure, axes = _axes(2, 1, (6, 5), title)
    for axis, name in zip(axes[:, 0], ("objective", "violation")):
        axis.plot(way["iteration"], way[name])
        axis.set_ylabel(name)
        axis.grid(alpha=0.3)
        for k in numpy.flatnonzero(numpy.diff(way["intervals"])):
            axis.axvline(0.5 * (way["iteration"][k] + way["iteration"][k + 1]), color="0.5",
                         linestyle=":")
    if (way["violation"] > 0).any():
        axes[1, 0].set_yscale("log")
    axes[1, 0].set_xlabel("iteration")
    return figure


def ground_force(of, up: int = 1, forward: int = 0, *, title: Optional[str] = None):
    """Force on each foot along up and forward, given as numbers of the world's axes."""
    figure, axes = _axes(2, 1, (6, 5), title)
    for line, (axis, word) in enumerate(((up, "upward"), (forward, "forward"))):
        for foot, name in enumerate(of.feet):
            axes[line, 0].plot(of.time, of.grf[:, foot, axis], label=name)
        axes[line, 0].set_ylabel(f"{word} force, N")
        axes[line, 0].grid(alpha=0.3)
    axes[0, 0].legend()
    axes[1, 0].set_xlabel("time, s")
    return figure


def points(of, names: Optional[Sequence[str]] = None, up: int = 1, forward: int = 0, *,
           title: Optional[str] = None):
    """Paths of points of the model, seen from the side."""
    figure, axes = _axes(1, 1, (8, 5), title)
    names = list(of.point_names if names is None else names)
    for name in names:
        path = of.points[:, of.point_names.index(name)]
        axes[0, 0].plot(path[:, forward], path[:, up], label=name)
    axes[0, 0].set_aspect("equal")
    axes[0, 0].set_xlabel("forward, m")
    axes[0, 0].set_ylabel("up, m")
    axes[0, 0].grid(alpha=0.3)
    if len(names) <= 12:
        axes[0, 0].legend(fontsize="small")
    return figure


def sensitivities(of, most: int = 15, *, title: Optional[str] = None):
    """The dearest numbers of a problem as bars: percent of the objective for a change that one can
    picture; ``of``: what ``Result.sensitivities`` returns."""
    items = [item for item in of if numpy.isfinite(item.share)][:most][::-1]
    figure, axes = _axes(1, 1, (7, 1 + 0.3 * len(items)), title)
    axes[0, 0].barh([item.words or item.name for item in items],
                    [100 * item.share for item in items])
    axes[0, 0].set_xlabel("% of the objective")
    axes[0, 0].grid(axis="x", alpha=0.3)
    return figure
