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
    """The most important numbers of a problem as bars: percent of the objective for a change that one can
    picture; ``of``: what ``Result.sensitivities`` returns."""
    items = [item for item in of if numpy.isfinite(item.share)][:most][::-1]
    figure, axes = _axes(1, 1, (7, 1 + 0.3 * len(items)), title)
    axes[0, 0].barh([item.words or item.name for item in items],
                    [100 * item.share for item in items])
    axes[0, 0].set_xlabel("% of the objective")
    axes[0, 0].grid(axis="x", alpha=0.3)
    return figure


def _is_valid(case):
    return case.state in ("optimal", "feasible")


def study(of, x: str, y: str, by: Optional[str] = None, *, title: Optional[str] = None):
    """A column of a study's table over another, a point for each case that has both numbers; with
    ``by``, a third column, a line for each of its values. Hollow: no valid solution. ``of``: a
    Study, or a list of its cases."""
    figure, axes = _axes(1, 1, (7, 4.5), title)
    groups = {}
    for case in of:
        for name in filter(None, (x, y, by)):
            if name not in case.values:
                raise KeyError(f"no column '{name}'; there are {', '.join(case.values)}")
        if all(isinstance(case.values[name], (int, float)) for name in (x, y)):
            groups.setdefault(case.values[by] if by else None, []).append(case)
    for value, cases in sorted(groups.items(), key=lambda item: (str(type(item[0])), item[0])):
        cases.sort(key=lambda case: case.values[x])
        _points(axes[0, 0], cases, x, y, "-" if by else "none", f"{by} {value}" if by else None)
    if by and len(groups) <= 12:
        axes[0, 0].legend(fontsize="small")
    return figure


def front(of, *, title: Optional[str] = None):
    """A Pareto front: each term without its weight over another, a panel for each two. Points of
    the front are filled (of two terms, a line joins them), others hollow. ``of``: a Study."""
    cases = [case for case in of if _is_valid(case)]
    terms = [name[7:-1] for name in (cases[0].values if cases else ()) if name.startswith("weight(")]
    if not terms or "front" not in cases[0].values:
        raise ValueError("the study has no front, or no point of one is solved")
    pairs = [(a, b) for k, a in enumerate(terms) for b in terms[k + 1:]]
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(pairs), figsize=(5 * len(pairs), 4.5), squeeze=False,
                                   layout="constrained")
    if title:
        figure.suptitle(title)
    on = sorted((case for case in cases if case.values["front"] == "yes"),
                key=lambda case: case.values["place"])
    for axis, (x, y) in zip(axes[0], pairs):
        _points(axis, on, x, y, "-" if len(terms) == 2 else "none")
        others = [case for case in cases if case.values["front"] != "yes"]
        axis.plot([case.values[x] for case in others], [case.values[y] for case in others], "o",
                  color="0.5", markerfacecolor="none", zorder=1)
    return figure


def _points(axis, cases, x, y, line, label=None):
    drawn, = axis.plot([case.values[x] for case in cases], [case.values[y] for case in cases],
                       linestyle=line, marker="o", label=label)
    failed = [case for case in cases if not _is_valid(case)]
    axis.plot([case.values[x] for case in failed], [case.values[y] for case in failed], "o",
              color=drawn.get_color(), markerfacecolor="white")
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    axis.grid(alpha=0.3)
