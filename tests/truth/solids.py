"""Exact distances between solids: capsules of the body, boxes and bars that stand in the way, the box that
hands hold, the ground. The overlap of two is how far one must move to be clear of the other:

    capsules      r1 + r2 - |segment - segment|
    capsule, box  r - |segment - box|, or r + the shortest way out where the segment is inside (separating
                  axes: the box's three, and their products with the segment)
    boxes         the shortest way out along the fifteen separating axes

Of capsules those of one link, of neighbours in the chain of links that have some, and those that overlap at
q = 0 do not count. Feet and patches in contact are exempt from what they stand on; hands from what they hold.
"""

import itertools

import numpy as np
import pinocchio as pin

from body import listed
from sole import unit_of

NAMED = 5  # pairs that a row names


def check(motion):
    s = Solids(motion)
    return {"overlap": largest(motion, [*s.body_pairs(), *s.obstacle_pairs(), *s.held_pairs(), *s.ground_pairs()])}


def largest(motion, pairs):
    """The largest overlap, and the pairs with the largest ones."""
    found = [(1e3 * overlap.max(), f"{name} at {motion.t[overlap.argmax()]:.3f} s") for name, overlap in pairs]
    if not found:
        return None
    found.sort(reverse=True)
    deep = [f"{mm:.0f} mm {where}" for mm, where in found[:NAMED] if mm > 1.0]
    more = sum(mm > 1.0 for mm, _ in found) - len(deep)
    return max(0.0, found[0][0]), ", ".join(deep) + (f", {more} more pairs" if more else "")


class Solids:
    def __init__(self, motion):
        self.motion, self.body = motion, motion.body
        self.capsules = {name: (motion.at(link, a)[0], motion.at(link, b)[0], r)
                         for name, (link, a, b, r) in motion.body.capsules.items()}
        self.boxes = [Box.fixed(motion, o) for o in listed(motion.problem.get("obstacles")) if "center" in o]
        self.bars = [o for o in listed(motion.problem.get("obstacles")) if "center" not in o]
        self.held = [Box.held(motion, load) for load in listed(motion.problem.get("load")) if "size" in load]

    # ---------------------------------------------------------- which there are

    def body_pairs(self):
        at_rest = rest_capsules(self.body)
        for a, b in itertools.combinations(self.capsules, 2):
            if not self.joined(a, b) and capsules_overlap(at_rest[a], at_rest[b])[0] <= 0:
                yield f"{a} {b}", capsules_overlap(self.capsules[a], self.capsules[b])

    def joined(self, a, b):
        one, other = self.link(a), self.link(b)
        return one == other or self.bearer(one) == other or self.bearer(other) == one

    def link(self, capsule):
        return self.body.capsules[capsule][0]

    def bearer(self, link):
        """The next link towards the root that has capsules."""
        link = self.body.parents[link]
        while link and link not in {c[0] for c in self.body.capsules.values()}:
            link = self.body.parents[link]
        return link

    def obstacle_pairs(self):
        for name, capsule in self.capsules.items():
            free = ~self.touching(self.link(name))
            for box in self.boxes:
                yield f"{name} {box.name}", np.where(free, box.capsule(*capsule), -1.0)
            for bar in self.bars:
                ends = [np.broadcast_to(self.place(bar[end]), capsule[0].shape) for end in ("from", "to")]
                yield f"{name} {bar['name']}", capsules_overlap(capsule, (*ends, bar["radius"]))

    def held_pairs(self):
        for box in self.held:
            hands = {self.body.points[h][0] for h in box.hands}
            for name, capsule in self.capsules.items():
                if self.link(name) not in hands:
                    yield f"{name} {box.name}", np.where(box.now, box.capsule(*capsule), -1.0)
            for other in self.boxes:
                yield f"{box.name} {other.name}", np.where(box.now, box.box(other), -1.0)
            yield f"{box.name} ground", np.where(box.now, box.below(self.motion), -1.0)

    def ground_pairs(self):
        if not self.motion.contacts:
            return
        for name, (a, b, r) in self.capsules.items():
            free = ~self.touching(self.link(name))
            if self.link(name) in {self.body.points[listed(f["heel"])[0]][0] for f in self.body.feet.values()}:
                continue  # soles have a column of their own
            depth = [r + self.motion.ground(p) - p @ self.body.up for p in (a, b)]
            yield f"{name} ground", np.where(free, np.maximum(*depth), -1.0)

    def touching(self, link):
        """When a patch of a link is in contact, or its hand pushes something that is fixed."""
        mask = np.zeros(len(self.motion.t), bool)
        for c in self.motion.contacts:
            if c.name in self.body.patches and self.body.points[self.body.patches[c.name]["point"]][0] == link:
                mask |= c.holds
        for load in listed(self.motion.problem.get("load")):
            if load.get("mass", 0) == 0 and any(self.body.points[h][0] == link for h in load.get("hands", [])):
                mask[:] = True
        return mask

    def place(self, flu):
        return np.array(flu, float) @ self.body.axes


def rest_capsules(body):
    """At q = 0, as arrays of one time."""
    data, found = body.model.createData(), {}
    pin.forwardKinematics(body.model, data, np.zeros(body.model.nq))
    for name, (link, a, b, r) in body.capsules.items():
        joint, behind = body.links[link]
        frame = data.oMi[joint] * behind
        found[name] = (frame.act(a)[None], frame.act(b)[None], r)
    return found


class Box:
    """Middle [times][3], axes [times][3][3] (rows), half sizes."""

    def __init__(self, name, middle, axes, half):
        self.name, self.middle, self.axes, self.half = name, middle, axes, np.array(half, float)

    @classmethod
    def fixed(cls, motion, o):
        n = len(motion.t)
        turn = o.get("heading", 0.0) * motion.angle
        f, left, up = motion.body.axes
        axes = np.array([np.cos(turn) * f + np.sin(turn) * left, np.cos(turn) * left - np.sin(turn) * f, up])
        middle = np.array(o["center"], float) @ motion.body.axes
        return cls(o["name"], np.broadcast_to(middle, (n, 3)), np.broadcast_to(axes, (n, 3, 3)), o["half_size"])

    @classmethod
    def held(cls, motion, load):
        """Upright but for the line from hand to hand, which its left side is along."""
        places = [motion.point(hand)[0] for hand in load["hands"]]
        line = places[0] - places[-1]
        line = line * np.sign(line @ motion.body.left)[:, None]
        left = unit_of(line)
        ahead = unit_of(np.cross(left, motion.body.up))
        axes = np.stack([ahead, left, np.cross(ahead, left)], axis=1)
        offset = np.array(load.get("center", [0, 0, 0]), float) @ motion.body.axes
        box = cls(load.get("name", "load"), sum(places) / len(places) + offset, axes, np.array(load["size"]) / 2)
        box.hands = load["hands"]
        box.now = (motion.t >= load.get("from", -np.inf)) & (motion.t <= load.get("to", np.inf))
        return box

    def inside(self, p):
        return np.einsum("kab,kb->ka", self.axes, p - self.middle)

    def capsule(self, a, b, r):
        a, b = self.inside(a), self.inside(b)
        distance = segment_to_box(a, b, self.half)
        return np.where(distance > 1e-9, r - distance, r + segment_in_box(a, b, self.half))

    def box(self, other):
        """The shortest way out; negative where they are apart."""
        mine, theirs = self.axes, other.axes
        products = np.cross(mine[:, :, None], theirs[:, None]).reshape(len(mine), 9, 3)
        axes = np.concatenate([mine, theirs, products], axis=1)
        size = np.linalg.norm(axes, axis=2)
        axes = axes / np.maximum(size, 1e-12)[:, :, None]
        reach = sum(np.abs(np.einsum("kab,kcb->kac", axes, box.axes)) @ box.half for box in (self, other))
        apart = np.abs(np.einsum("kab,kb->ka", axes, other.middle - self.middle))
        return np.where(size > 1e-6, reach - apart, np.inf).min(1)

    def below(self, motion):
        corners = [self.middle + np.einsum("b,kba->ka", self.half * s, self.axes)
                   for s in itertools.product((-1, 1), repeat=3)]
        return np.max([motion.ground(c) - c @ motion.body.up for c in corners], axis=0)


# -------------------------------------------------------------------- distances

def capsules_overlap(one, other):
    return one[2] + other[2] - segment_to_segment(one[0], one[1], other[0], other[1])


def segment_to_segment(p, q, a, b):
    """Least distance: inside both where that is a minimum, or at an end of one of them."""
    d, e, r = q - p, b - a, p - a
    dot = lambda x, y: (x * y).sum(1)  # noqa: E731
    dd, ee, de, dr, er = dot(d, d), dot(e, e), dot(d, e), dot(d, r), dot(e, r)
    det = dd * ee - de * de
    with np.errstate(all="ignore"):
        s, t = (de * er - ee * dr) / det, (dd * er - de * dr) / det
        crossing = (det > 1e-12 * dd * ee) & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    s, t = np.where(crossing, s, 0.0), np.where(crossing, t, 0.0)
    inner = np.linalg.norm(r + s[:, None] * d - t[:, None] * e, axis=1)
    ends = np.min([to_segment(p, a, b), to_segment(q, a, b), to_segment(a, p, q), to_segment(b, p, q)], axis=0)
    return np.where(crossing, np.minimum(inner, ends), ends)


def to_segment(p, a, b):
    line = b - a
    s = np.clip(((p - a) * line).sum(1) / np.maximum((line * line).sum(1), 1e-300), 0, 1)
    return np.linalg.norm(p - a - s[:, None] * line, axis=1)


def segment_to_box(a, b, half):
    """In the box's axes; the distance is convex along the segment: ternary search."""
    low, high = np.zeros(len(a)), np.ones(len(a))

    def distance(s):
        return np.linalg.norm(np.maximum(0, np.abs(a + s[:, None] * (b - a)) - half), axis=1)

    for _ in range(80):
        first, second = low + (high - low) / 3, high - (high - low) / 3
        right = distance(first) > distance(second)
        low, high = np.where(right, first, low), np.where(right, high, second)
    return np.min([distance((low + high) / 2), distance(np.zeros(len(a))), distance(np.ones(len(a)))], axis=0)


def segment_in_box(a, b, half):
    middle, reach = (a + b) / 2, (b - a) / 2
    edges = np.broadcast_to(np.eye(3), (len(a), 3, 3))
    axes = np.concatenate([edges, np.cross(edges, unit_of(reach)[:, None])], axis=1)
    size = np.linalg.norm(axes, axis=2)
    axes = axes / np.maximum(size, 1e-12)[:, :, None]
    overlap = (np.abs(axes) @ half + np.abs(np.einsum("kab,kb->ka", axes, reach))
               - np.abs(np.einsum("kab,kb->ka", axes, middle)))
    return np.where(size > 1e-6, overlap, np.inf).min(1)
