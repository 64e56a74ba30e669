"""The true sole of a foot, as the model has it: two corners at the heel, two at the ball, a tip.

A foot with arcs is a rolling one. Its sole is round about two axes across the foot, through the arcs'
centres C, with radii r, the heights of the centres above the sole at q = 0; between them it is flat. At a
pitch above FLAT it touches the ground in the line under C of the heel, below -FLAT in that of the ball,
otherwise with all of it, from the heel's corners to the tip. Without arcs the lines are those of the corners, and
below -FLAT toes bend and lie on the ground from the ball to the tip. The pitch, less that by which the heel's pad
gives, is

    theta = asin(n . (t - h) / L),   h, t the centres of heel and ball, L their distance.
"""

import numpy as np
import pinocchio as pin

import pads
from body import listed

FLAT = 0.006  # rad beyond what the problem allows a flat foot


class Sole:
    def __init__(self, motion, name):
        self.motion, self.name = motion, name
        foot, body = motion.body.feet[name], motion.body
        self.heel_corners, self.toe_corners = listed(foot["heel"]), listed(foot["toe"])
        self.heel, self.toe = (foot.get(k, c[0]) for k, c in
                               (("heel_center", self.heel_corners), ("toe_center", self.toe_corners)))
        self.arcs = foot.get("arcs")
        self.link = body.points[self.heel][0]
        tip = foot.get("tip")
        self.tip = tip if tip and body.points[tip][0] == self.link else None
        self.set_axes()

    def set_axes(self):
        """Along the foot, across it, in the link's axes; half width."""
        at = lambda name: self.motion.body.points[name][1]  # noqa: E731
        along = at(self.toe) - at(self.heel)
        self.length = np.linalg.norm(along)
        self.along = along / self.length
        self.half_width = 0.0
        if len(self.heel_corners) == 2:
            across = at(self.heel_corners[0]) - at(self.heel_corners[1])
            self.half_width = np.linalg.norm(across) / 2
            self.across = across / np.linalg.norm(across)
        else:
            self.across = np.cross(self.link_up(), self.along)
        self.radius = {}
        for end, point in (self.arcs or {}).items():
            centre = at(point) - at(self.heel)
            self.radius[end] = np.linalg.norm(centre - (centre @ self.along) * self.along
                                              - (centre @ self.across) * self.across)

    def link_up(self):
        """The ground's normal in the link's axes at q = 0."""
        joint, behind = self.motion.body.links[self.link]
        data = self.motion.body.model.createData()
        pin.forwardKinematics(self.motion.body.model, data, self.motion.body.neutral() * 0)
        return (data.oMi[joint] * behind).rotation.T @ self.motion.body.up

    def pitch(self):
        line = self.motion.point(self.toe)[0] - self.motion.point(self.heel)[0]
        return np.arcsin(np.clip(line @ self.motion.body.up / self.length, -1, 1))

    def flat(self):
        allowed = (self.motion.problem.get("constraints") or {}).get("orientation_tolerance", 0.01)
        return allowed + FLAT

    # ---------------------------------------------------------------- outline

    def reach(self):
        """Ahead of the heel along the level foot: the line of the heel, that of the ball, the tip."""
        f = self.level()
        origin = self.motion.point(self.heel)[0]
        ahead = lambda p: ((self.motion.point(p)[0] - origin) * f).sum(1)  # noqa: E731, of what is level
        lines = [ahead(self.arcs[end]) if self.arcs else ahead(p)
                 for end, p in (("heel", self.heel), ("toe", self.toe))]
        tip = ahead(self.tip) if self.tip else lines[1]
        return origin, f, *lines, tip

    def level(self):
        n = self.motion.body.up
        along = self.motion.direction(self.link, self.along)
        along = along - (along @ n)[:, None] * n
        return along / np.linalg.norm(along, axis=1)[:, None]

    def outside(self, place):
        """How far a point of the ground is outside of what of the sole touches it, m."""
        origin, f, heel, ball, tip = self.reach()
        theta, flat = self.pitch() - pads.depth(self.motion, self) / (ball - heel), self.flat()
        ahead_end = np.maximum(ball, tip)
        back = np.minimum(heel, 0.0)  # the corners of the heel
        low = np.where(theta < -flat, ball, np.where(theta > flat, heel, back))
        bent = ball if self.arcs else ahead_end
        high = np.where(theta > flat, heel, np.where(theta < -flat, bent, ahead_end))
        x = ((place - origin) * f).sum(1)
        y = ((place - origin) * np.cross(self.motion.body.up, f)).sum(1)
        dx = np.maximum(0, np.maximum(low - x, x - high))
        return np.hypot(dx, np.maximum(0, np.abs(y) - self.half_width))

    # ----------------------------------------------------------- lowest points

    def lowest(self, end):
        """Places and velocities of the sole's lowest points at heel or toe: at a corner, or of an arc at
        both of its sides."""
        n = self.motion.body.up
        if not self.arcs:
            names = self.heel_corners if end == "heel" else self.toe_corners
            return [self.motion.point(name)[:2] for name in names]
        link, centre = self.motion.body.points[self.arcs[end]]
        axis = self.motion.direction(link, self.across)
        down = -(n - (axis @ n)[:, None] * axis)
        down *= self.radius[end] / np.linalg.norm(down, axis=1)[:, None]
        spin = self.motion.spin[:, self.motion.body.links[link][0]]
        found = []
        for side in (-1, 1) if self.half_width else (0,):
            place, velocity, _ = self.motion.at(link, centre + side * self.half_width * self.across)
            found.append((place + down, velocity + np.cross(spin, down)))
        return found

    def middle(self, end):
        """The same in the middle between both sides."""
        both = self.lowest(end)
        return tuple(sum(x) / len(both) for x in zip(*both))


def soles(motion):
    return {name: Sole(motion, name) for name in motion.body.feet}


def check(motion):
    return {"slip": slip(motion), "sinks": sinks(motion)}


def held(motion, name, end):
    """When the schedule holds an end of a foot."""
    modes = ("heel", "flat") if end == "heel" else ("flat", "toe")
    return np.any([c.holds for c in motion.contacts if c.name == name and c.mode in modes]
                  or [np.zeros(len(motion.t), bool)], axis=0)


def runs(mask):
    """First and last of each run of true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return list(zip(edges[::2], edges[1::2] - 1))


def slip(motion):
    """mm along the ground from where a held point came down: of arcs the integral of the velocity where
    the sole touches."""
    worst = None
    tracks = [(f"{name} {end}", sole.middle(end)[1], held(motion, name, end), motion.body.up)
              for name, sole in soles(motion).items() for end in ("heel", "toe")]
    tracks += [(c.name, motion.point(motion.body.patches[c.name]["point"])[1], c.holds, c.normal)
               for c in motion.contacts if c.name in motion.body.patches]
    for name, velocity, mask, normal in tracks:
        moved = motion.integral(velocity - (velocity @ normal)[:, None] * normal)
        for first, last in runs(mask):
            far = np.linalg.norm(moved[first:last + 1] - moved[first], axis=1)
            worst = larger(worst, (1e3 * far.max(), f"{name} {at(motion, first + far.argmax())}"))
    return worst


def sinks(motion):
    """mm, at all times, in contact or not, less what the pad of a heel gives. Tips do not count: toes bend."""
    worst = None
    for name, sole in soles(motion).items() if motion.contacts else ():
        for end in ("heel", "toe"):
            give = pads.depth(motion, sole) if end == "heel" else 0.0
            for place, _ in sole.lowest(end):
                depth = motion.ground(place) - place @ motion.body.up - give
                worst = larger(worst, (1e3 * depth.max(), f"{name} {end} {at(motion, depth.argmax())}"))
    return worst if worst is None else (max(0.0, worst[0]), worst[1])


def larger(a, b):
    return b if a is None or not a[0] >= b[0] else a


def unit_of(x):
    return x / np.maximum(np.linalg.norm(x, axis=-1, keepdims=True), 1e-300)


def at(motion, k):
    return f"at {motion.t[k]:.3f} s"
