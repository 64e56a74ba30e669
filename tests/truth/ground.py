"""Forces of the ground. On a contact with the force F and the moment M about a point o of its surface with
the normal n, F_n = n . F:

    cone       |F - F_n n| - mu F_n <= 0, in body weights
    pressure   c = o + n x M / F_n inside of the sole, where F_n is above a twentieth
    pull       F_n >= 0
    work       int (F . v_c + (M - (c - o) x F) . w) dt = int (twist . wrench) dt = 0: a ground that stands
               still does none; less what heels' pads hold at the end more than at the beginning; beside the
               work of joints that is positive, sum of int max(0, tau v) dt

Without forces of the ground the zero-moment point of the whole body takes the place of c, inside of the hull
of the soles that are down.
"""

import numpy as np

import loads
import pads
from loads import center
from sole import at, larger, soles


def check(motion):
    if not motion.reaction:
        return {"pressure": zero_moment_point(motion)}
    ground = loads.of_ground(motion)
    return {"cone": cone(motion, ground), "pull": pull(motion, ground), "pressure": pressure(motion, ground),
            "ground work": work(motion, ground)}


def normal_of(motion, load):
    """Of a patch that of its surface."""
    return next((c.normal for c in motion.contacts if c.name == load.name), motion.body.up)


def cone(motion, ground):
    mu = motion.problem["ground_reaction"].get("friction", 0.5)
    worst = None
    for load in ground:
        n = normal_of(motion, load)
        up = load.force @ n
        if isinstance(mu, (int, float)):
            beyond = (np.linalg.norm(load.force - up[:, None] * n, axis=1) - mu * up) / motion.body.weight
            worst = larger(worst, (max(0.0, beyond.max()), f"{load.name} {at(motion, beyond.argmax())}"))
    return worst


def pull(motion, ground):
    worst = None
    for load in ground:
        down = -(load.force @ normal_of(motion, load)) / motion.body.weight
        worst = larger(worst, (max(0.0, down.max()), f"{load.name} {at(motion, down.argmax())}"))
    return worst


def pressure(motion, ground):
    worst, shapes = None, soles(motion)
    for load in ground:
        loaded = load.force @ normal_of(motion, load) > 0.05 * motion.body.weight
        if not loaded.any():
            continue
        if load.name in shapes:
            out = outside_sole(motion, load, shapes[load.name])
        else:
            out = outside_patch(motion, load)
        out = np.where(loaded, out, 0.0)
        worst = larger(worst, (1e3 * out.max(), f"{load.name} {at(motion, out.argmax())}"))
    return worst


def outside_sole(motion, load, sole):
    n = motion.body.up
    heel = motion.point(sole.heel)[0]
    ground = heel + (motion.ground(heel) - heel @ n)[:, None] * n
    return sole.outside(center(load, n, ground))


def outside_patch(motion, load):
    out = np.zeros(len(motion.t))
    for c in (c for c in motion.contacts if c.name == load.name):
        middle = c.corners.mean(0)
        sides = [c.corners[0] - c.corners[1], c.corners[0] - c.corners[3]]
        arm = center(load, c.normal, np.broadcast_to(middle, load.force.shape)) - middle
        over = [np.abs(arm @ (s / np.linalg.norm(s))) - np.linalg.norm(s) / 2 for s in sides]
        out = np.where(c.holds, np.hypot(*(np.maximum(0, x) for x in over)), out)
    return out


def work(motion, ground):
    """J, and as a share of the joints' positive work in %."""
    names = motion.body.names
    joints = np.array([motion.body.coordinates[n]["actuated"] for n in names])
    positive = motion.integral(np.maximum(0, (motion.tau * motion.v)[:, joints]).sum(1))[-1]
    done = sum(motion.integral(load.power(motion))[-1] for load in ground)
    for sole in soles(motion).values():
        held = pads.energy(motion, sole)
        done += held[-1] - held[0]
    return 100 * abs(done) / positive, f"{done:+.2f} J of {positive:.1f} J"


# ----------------------------------------------------------- the zero-moment point

def zero_moment_point(motion):
    if not motion.contacts:
        return None
    n, (force, moment) = motion.body.up, motion.required()
    height = motion.ground(np.zeros((len(motion.t), 3)))
    origin = height[:, None] * n
    up = force @ n
    point = origin + np.cross(n, moment - np.cross(origin, force)) / up[:, None]
    worst = None
    for k in range(len(motion.t)):
        corners = [motion.point_at(name, k) for foot in down(motion, k) for name in corners_of(motion, foot)]
        if up[k] > 0.05 * motion.body.weight and corners:
            flat = np.array(corners) @ motion.body.axes[:2].T
            out = outside_hull(flat, motion.body.axes[:2] @ point[k])
            worst = larger(worst, (1e3 * out, at(motion, k)))
    return worst


def down(motion, k):
    return {c.name for c in motion.contacts if c.holds[k]}


def corners_of(motion, foot):
    f = motion.body.feet[foot]
    return [p for end in ("heel", "toe") for p in (f[end] if isinstance(f[end], list) else [f[end]])]


def outside_hull(points, p):
    """Distance of p from the convex hull of points of the plane; 0 inside."""
    hull = convex_hull(points)
    sides = list(zip(hull, hull[1:] + hull[:1]))
    if len(hull) > 2 and all((b - a)[0] * (p - a)[1] - (b - a)[1] * (p - a)[0] >= 0 for a, b in sides):
        return 0.0
    return min(to_segment(p, a, b) for a, b in sides)


def to_segment(p, a, b):
    s = np.clip((p - a) @ (b - a) / max((b - a) @ (b - a), 1e-300), 0, 1)
    return np.linalg.norm(p - a - s * (b - a))


def convex_hull(points):
    """Anticlockwise (Andrew's chain)."""
    order = sorted(map(tuple, points))

    def chain(ps):
        out = []
        for p in ps:
            while len(out) > 1 and cross(out[-2], out[-1], p) <= 0:
                out.pop()
            out.append(p)
        return out[:-1]

    return [np.array(p) for p in (chain(order) + chain(order[::-1]) or order)]


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
