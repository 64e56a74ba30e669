"""A problem of Ambulo stated anew for CasADi, from its files alone: no line of the engine is shared.

    J = sum_terms w int sum_i (scale_i (u_i - offset_i))^2 dt,   u = tau (torque_squared), qdd (acceleration)

by the trapezoidal rule; tau by Newton and Euler in world axes: of the joint i with the axis s through p,
tau_i = s . sum over the bodies behind it of (M + (c - p) x F), or s . sum F where it slides, with
F = m (a - g) and M = I alpha + omega x I omega. Rows have the names of Ambulo's: (family, subject, detail,
node) = an expression, ">=" or "=" zero. What is stated here is what the problems of judge.py ask for; an
entry of a file that is not known ends it.
"""

import os

import casadi as ca
import numpy as np

import strict_yaml
from spline import derivative, value

TURNS, SLIDES = "revolute", "prismatic"


def about(axis, angle):
    """Rotation about a fixed unit vector, by Rodrigues' formula."""
    x, y, z = (float(v) for v in axis)
    k = ca.SX(np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]))
    return ca.SX.eye(3) + ca.sin(angle) * k + (1 - ca.cos(angle)) * ca.mtimes(k, k)


def turned(axis, degrees):
    """The same of a number; quarters are exact."""
    sine, cosine = {0: (0, 1), 1: (1, 0), 2: (0, -1), 3: (-1, 0)}.get(
        (degrees / 90) % 4, (np.sin(np.radians(degrees)), np.cos(np.radians(degrees))))
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], float)
    return ca.SX(np.eye(3) + sine * k + (1 - cosine) * (k @ k))


class Frame:
    """Where a link is, how it turns, and how that changes."""

    def __init__(self, rotation, place, turn, spin, acceleration):
        self.rotation, self.place, self.turn, self.spin, self.acceleration = rotation, place, turn, spin, acceleration

    def moved(self, vector):
        d = ca.mtimes(self.rotation, ca.SX(vector))
        return Frame(self.rotation, self.place + d, self.turn, self.spin,
                     self.acceleration + ca.cross(self.spin, d) + ca.cross(self.turn, ca.cross(self.turn, d)))

    def rotated(self, rotation):
        return Frame(ca.mtimes(self.rotation, rotation), self.place, self.turn, self.spin, self.acceleration)

    def jointed(self, kind, axis, q, qd, qdd):
        s = ca.mtimes(self.rotation, ca.SX(axis))
        if kind == TURNS:
            return s, Frame(ca.mtimes(self.rotation, about(axis, q)), self.place, self.turn + s * qd,
                            self.spin + s * qdd + ca.cross(self.turn, s * qd), self.acceleration)
        return s, Frame(self.rotation, self.place + s * q, self.turn, self.spin,
                        self.acceleration + s * qdd + 2 * ca.cross(self.turn, s * qd) + ca.cross(self.spin, s * q)
                        + ca.cross(self.turn, ca.cross(self.turn, s * q)))


class Body:
    """Torques, points and the wrench on the ground of one state, as expressions."""

    def __init__(self, path):
        self.file = strict_yaml.load(path)
        units = self.file["units"]
        known = {"length": "metres", "mass": "kilograms", "torque": "newton_metres"}
        if any(units.get(key, word) != word for key, word in known.items()):
            raise ValueError(f"{path}: units {units}")
        self.unit = {TURNS: np.pi / 180 if units["angle"] == "degrees" else 1.0, SLIDES: 1.0}
        self.links = self.file["links"]
        self.joints = [link for link in self.links if link["joint"] != "fixed"]
        self.names = [(link.get("coordinate") or {}).get("name", link["name"]) for link in self.joints]
        n = len(self.joints)
        self.state = ca.SX.sym("q", n), ca.SX.sym("qd", n), ca.SX.sym("qdd", n)
        self.gravity = np.array(self.file["gravity"], float)
        self.bodies, self.frames, self.axes, self.above = [], {}, [], {}
        for link in self.links:
            self.add(link)
        self.mass = sum(link["body"]["mass"] for link in self.links if "body" in link)
        self.weight = self.mass * np.linalg.norm(self.gravity)

    def add(self, link):
        parent = link["parent"]
        zero = ca.SX.zeros(3)
        frame = Frame(ca.SX.eye(3), zero, zero, zero, zero) if parent == "none" or parent is None else self.frames[parent]
        above = list(self.above.get(parent, []))
        theta, d, a, alpha = link.get("dh", [0, 0, 0, 0])
        axis = [0, 0, 1]
        if "origin" in link:
            if set(link["origin"]) != {"xyz"}:
                raise ValueError(f"origin of {link['name']}")
            frame, axis = frame.moved(link["origin"]["xyz"]), link.get("axis", axis)
        if link["joint"] != "fixed":
            i = len(self.axes)
            s, behind = frame.jointed(link["joint"], axis, *(part[i] for part in self.state))
            self.axes.append((link["joint"], s, frame.place))
            frame, above = behind, above + [i]
        # the joint turns about z, and so does theta: these two are in either order
        frame = frame.rotated(turned([0, 0, 1], theta)).moved([a, 0, d]).rotated(turned([1, 0, 0], alpha))
        self.frames[link["name"]], self.above[link["name"]] = frame, above
        if "body" in link:
            self.bodies.append((above, *self.effort(frame, link["body"])))

    def effort(self, frame, body):
        """Force, moment about the centre of mass, and that centre."""
        center = frame.moved(body["com"])
        xx, yy, zz, xy, xz, yz = body["inertia"]
        inertia = ca.SX(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], float))
        world = ca.mtimes(ca.mtimes(frame.rotation, inertia), frame.rotation.T)
        moment = ca.mtimes(world, frame.spin) + ca.cross(frame.turn, ca.mtimes(world, frame.turn))
        return body["mass"] * (center.acceleration - ca.SX(self.gravity)), moment, center.place

    def torques(self):
        out = []
        for i, (kind, s, place) in enumerate(self.axes):
            total = ca.SX.zeros(3)
            for above, force, moment, center in self.bodies:
                if i in above:
                    total += moment + ca.cross(center - place, force) if kind == TURNS else force
            out.append(ca.dot(s, total))
        return ca.vertcat(*out)

    def wrench(self):
        """(F, M) about the origin of the world: what the ground has to give."""
        force = sum((f for _, f, _, _ in self.bodies), ca.SX.zeros(3))
        return force, sum((m + ca.cross(c, f) for _, f, m, c in self.bodies), ca.SX.zeros(3))

    def points(self):
        listed = self.file.get("points") or []
        return {p["name"]: self.frames[p["link"]].moved(p["position"]).place for p in listed}

    def limits(self, key, link):
        c = link.get("coordinate") or {}
        unit = self.unit[link["joint"]] if key == "range" else 1.0
        return [bound * unit for bound in c[key]] if key in c else None


def only(given, *known):
    strange = set(given) - set(known)
    if strange:
        raise ValueError(f"not stated here: {', '.join(sorted(strange))}")


class Statement:
    """Of a problem file: outputs of a node as one function, and rows as numbers with which they are mixed."""

    def __init__(self, path):
        self.file = strict_yaml.load(path)
        only(self.file, "ambulo", "kind", "name", "model", "angles", "time", "trajectory", "gait", "constraints", "ends",
             "objective")
        self.body = Body(os.path.join(os.path.dirname(path), self.file["model"]))
        self.duration, self.intervals = self.file["time"]["duration"], self.file["time"]["intervals"]
        only(self.file["time"], "duration", "intervals")
        self.degree = self.file["trajectory"]["degree"]
        steps = np.arange(self.file["trajectory"]["intervals"] + 1, dtype=np.longdouble)
        breaks = steps * np.longdouble(self.duration) / steps[-1]
        self.knots = np.concatenate([np.repeat(breaks[0], self.degree), breaks, np.repeat(breaks[-1], self.degree)])
        self.times = np.arange(self.intervals + 1, dtype=np.longdouble) * np.longdouble(self.duration) / self.intervals
        self.basis = self.make_basis()
        self.make_outputs()
        self.rows = {}  # name: (relation, [(node, output, factor)], constant)
        self.make_rows()

    def make_basis(self):
        """[order][node][control point], in extended precision."""
        count = len(self.knots) - self.degree - 1
        parts = [(np.eye(count, dtype=np.longdouble), self.knots, self.degree)]
        parts += [derivative(*parts[0])]
        parts += [derivative(*parts[1])]
        return [value(*part, self.times) for part in parts]

    # ---------------------------------------------------------------- outputs

    def make_outputs(self):
        n, names = len(self.body.names), self.body.names
        tau, points = self.body.torques(), self.body.points()
        self.order, parts = {}, []
        for word, vector in (("q", self.body.state[0]), ("qd", self.body.state[1]), ("qdd", self.body.state[2]),
                             ("tau", tau)):
            for i in range(n):
                self.order[word, names[i]] = len(parts)
                parts.append(vector[i])
        for name, place in points.items():
            for i in range(3):
                self.order[name, i] = len(parts)
                parts.append(place[i])
        force, moment = self.body.wrench()
        for i in range(3):
            self.order["force", i], self.order["moment", i] = len(parts), len(parts) + 1
            parts += [force[i], moment[i]]
        self.order["density"] = len(parts)
        parts.append(sum((self.term(term, tau) for term in self.file["objective"]), ca.SX(0)))
        self.node = ca.Function("node", list(self.body.state), [ca.vertcat(*parts)], {"cse": True})

    def term(self, term, tau):
        only(term, "term", "weight", "scale", "offset")
        u = {"torque_squared": tau, "acceleration": self.body.state[2]}[term["term"]]
        total, scale, offset = 0, term.get("scale") or {}, term.get("offset") or {}
        only(offset.values(), "body_weight")
        for i, name in enumerate(self.body.names):
            less = self.body.weight if name in offset else 0.0
            total += (scale.get(name, scale.get("default", 1)) * (u[i] - less)) ** 2
        return term["weight"] * total

    def weights(self):
        """Of the trapezoidal rule."""
        step = np.longdouble(self.duration) / self.intervals
        w = np.full(self.intervals + 1, step)
        w[0], w[-1] = step / 2, step / 2
        return w

    # ------------------------------------------------------------------- rows

    def put(self, name, relation, terms, constant):
        self.rows[name] = relation, [(node, self.order[output], factor) for node, output, factor in terms], constant

    def make_rows(self):
        c = self.file["constraints"]
        only(c, "joint_limits", "torque_limits", "ground_penetration", "foot_strike", "zmp", "minimum_force")
        if c.get("joint_limits") != "nodes" or c.get("minimum_force", "off") not in ("off", False):
            raise ValueError("limits that are not stated here")
        for family, key, output in (("joint_limit", "range", "q"), ("torque_limit", "torque", "tau")):
            if key == "torque" and not c.get("torque_limits"):
                continue
            for name, link in zip(self.body.names, self.body.joints):
                self.put_limits(family, output, name, self.body.limits(key, link))
        if "gait" in self.file:
            for node in range(self.intervals + 1):
                self.put_support(node)
        self.put_ends(self.file["ends"])

    def put_limits(self, family, output, name, bounds):
        for node in range(self.intervals + 1) if bounds else ():
            self.put((family, name, "lower", node), ">=", [(node, (output, name), 1)], -bounds[0])
            self.put((family, name, "upper", node), ">=", [(node, (output, name), -1)], bounds[1])

    def put_ends(self, ends):
        only(ends, "kind", "order", "initial", "initial_speed", "final", "final_speed")
        degree = np.pi / 180 if self.file.get("angles") == "degrees" else 1.0
        for side, node in (("initial", 0), ("final", self.intervals)):
            for key, output, detail in ((side, "q", "value"), (side + "_speed", "qd", "rate")):
                for name, number in (ends.get(key) or {}).items():
                    self.put((side + "_state", name, detail, node), "=", [(node, (output, name), 1)], -number * degree)
        if ends.get("kind", "free") != "periodic":
            return
        rate = 1 / float(np.abs(self.basis[1][0]).max())
        for name in self.body.names:
            travel = self.gait_travel() if name == self.root_forward() else 0.0
            for output, detail, scale, shift in (("q", "value", 1.0, travel), ("qd", "rate", rate, 0.0))[:ends["order"] + 1]:
                terms = [(self.intervals, (output, name), scale), (0, (output, name), -scale)]
                self.put(("periodic", name, detail, -1), "=", terms, -shift)

    # ------------------------------------------------------- the yardstick's gait

    def gait_travel(self):
        return self.file["gait"]["step_length"] * self.file["gait"]["steps"]

    def root_forward(self):
        return self.body.names[0]

    def stands(self, node):
        """{foot: (mode, forward, left)}: strike s of step s, feet in turn, phases in parts of the stride."""
        gait = self.file["gait"]
        only(gait, "steps", "first_foot", "step_length", "step_width", "phases")
        step = self.duration / gait["steps"]
        feet = ["left", "right"] if gait["first_foot"] == "left" else ["right", "left"]
        out = {}
        for strike in range(-2, gait["steps"] + 2):
            part = (float(self.times[node]) - strike * step) / (2 * step)
            p, foot = gait["phases"], feet[strike % 2]
            if p["heel_strike"] < part < p["toe_off"]:
                mode = "heel" if part < p["foot_flat"] else "flat" if part < p["heel_off"] else "toe"
                left = gait["step_width"] / 2 * (1 if foot == "left" else -1)
                out[foot] = mode, gait["step_length"] * strike, left
        return out

    def put_support(self, node):
        """z up, x forward, y left; a foot is placed by its heel."""
        neutral = dict(zip(self.order, np.array(self.node(*[np.zeros(len(self.body.names))] * 3)).ravel()))
        stands, corners = self.stands(node), []
        for foot in self.body.file["feet"]:
            mode, forward, left = stands.get(foot["name"], ("air", 0, 0))
            down = {"heel": foot["heel"], "toe": foot["toe"], "flat": foot["heel"] + foot["toe"], "air": []}[mode]
            for point in foot["heel"] + foot["toe"]:
                self.put(("ground_penetration", point, "height", node), "=" if point in down else ">=",
                         [(node, (point, 2), 1)], 0.0)
            heel, toe = foot["heel_center"], foot["toe_center"]
            if mode == "air":
                continue
            place = [neutral[toe, 0] - neutral[heel, 0] + forward, left] if mode == "toe" else [forward, left]
            center = toe if mode == "toe" else heel
            for axis, detail in enumerate(("forward", "left")):
                self.put(("foot_strike", center, detail, node), "=", [(node, (center, axis), 1)], -place[axis])
            if mode == "flat":
                self.put(("foot_strike", toe, "heading", node), "=", [(node, (toe, 1), 1)], -left)
            corners += [(forward + neutral[point, 0] - neutral[heel, 0], left + neutral[point, 1] - neutral[heel, 1])
                        for point in foot["heel"] + foot["toe"]]
        self.put_zmp(node, np.array(corners))

    def put_zmp(self, node, corners):
        """The zero-moment point (-M_y, M_x) / F_z in the box of the corners, times F_z / mg."""
        low, high, w = corners.min(axis=0), corners.max(axis=0), self.body.weight
        for detail, axis, sign, bound in (("back", 0, 1, low[0]), ("front", 0, -1, high[0]),
                                          ("right", 1, 1, low[1]), ("left", 1, -1, high[1])):
            moment = [(node, ("moment", 1), -sign / w)] if axis == 0 else [(node, ("moment", 0), sign / w)]
            self.put(("zmp", "support", detail, node), ">=", moment + [(node, ("force", 2), -sign * bound / w)], 0.0)
