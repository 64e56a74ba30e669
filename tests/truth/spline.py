"""The motion that solution.yaml holds: a B-spline of degree p on clamped knots u,

    q(t) = sum_j N_j,p(t) P_j,     q'(t) = sum_j N_j,p-1(t) p (P_j+1 - P_j) / (u_j+p+1 - u_j+1),

by de Boor's recursion. With mirrored ends the second half of the stride is the mirror image of the
first: q(t + T) = sign * q_partner(t) + shift, the shift along forward and up alone.
"""

import numpy as np


def clamped(breakpoints, degree):
    b = np.asarray(breakpoints, float)
    return np.concatenate([np.repeat(b[0], degree), b, np.repeat(b[-1], degree)])


def value(points, knots, degree, times):
    """[times][coordinates]"""
    last = len(points) - 1
    k = np.clip(np.searchsorted(knots, times, side="right") - 1, degree, last)
    d = [points[k - degree + j] for j in range(degree + 1)]
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            low, high = knots[k - degree + j], knots[k + 1 + j - r]
            a = ((times - low) / (high - low))[:, None]
            d[j] = (1 - a) * d[j - 1] + a * d[j]
    return d[degree]


def derivative(points, knots, degree):
    n = len(points)
    width = knots[degree + 1:degree + n] - knots[1:n]
    return degree * np.diff(points, axis=0) / width[:, None], knots[1:-1], degree - 1


class Spline:
    """q, qd, qdd of the coordinates `names`, over the stride if it is mirrored."""

    def __init__(self, solution, names, mirror=None):
        if solution["trajectory"]["basis"] != "bspline":
            raise ValueError(f"no basis {solution['trajectory']['basis']} here")
        degree = solution["trajectory"]["degree"]
        order = [solution["coordinates"].index(name) for name in names]
        points = np.array(solution["control_points"], float)[:, order]
        first = (points, clamped(solution["trajectory"]["breakpoints"], degree), degree)
        second = derivative(*first)
        self.parts = first, second, derivative(*second)
        self.duration = float(solution["duration"])
        self.mirror = mirror  # (partner, sign, shift) of each coordinate, or None

    def at(self, times):
        times = np.asarray(times, float)
        if self.mirror is None:
            return [value(*part, times) for part in self.parts]
        later = times > self.duration
        out = [value(*part, np.where(later, times - self.duration, times)) for part in self.parts]
        partner, sign, shift = self.mirror
        for order, q in enumerate(out):
            q[later] = q[later][:, partner] * sign + (shift if order == 0 else 0.0)
        return out
