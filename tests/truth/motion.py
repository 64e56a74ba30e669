"""A result folder beside its problem: the motion of the spline, what the table says of forces, when
contacts hold.

Rates and accelerations are those of the spline, by formulas of this folder; poses, twists and accelerations
of links are Pinocchio's. The table is written at ten times as many times as there are nodes.
"""

import csv
import json
import os

import numpy as np
import pinocchio as pin

import strict_yaml
from body import Body, listed
from spline import Spline


class Motion:
    def __init__(self, problem_file, folder):
        self.problem = strict_yaml.load(problem_file)
        self.body = Body(self.problem, os.path.dirname(problem_file))
        self.scene = read_json(folder, "scene.json")
        self.summary = read_json(folder, "summary.json")
        self.table = read_table(os.path.join(folder, "motion.csv"))
        self.t = self.table["time"]
        self.angle = np.pi / 180 if self.problem.get("angles") == "degrees" else 1.0
        self.reaction = any(name.startswith("grf.") for name in self.table)
        solution = strict_yaml.load(os.path.join(folder, "solution.yaml"))
        self.spline = Spline(solution, self.body.names, self.mirror())
        self.q, self.v, self.a = self.spline.at(self.t)
        self.tau, self.places = self.columns("tau."), {}
        self.move()
        self.contacts = [Contact(self, c) for c in self.scene["contacts"]]

    def columns(self, prefix):
        return np.stack([self.table[prefix + name] for name in self.body.names], axis=1)

    def vectors(self, prefix):
        return np.stack([self.table[f"{prefix}.{axis}"] for axis in "xyz"], axis=1)

    def mirror(self):
        """Partner, sign and shift of each coordinate, if a step stands for a stride."""
        if not self.scene["mirrored"]:
            return None
        names, c = self.body.names, self.body.coordinates
        partner = [names.index(c[n]["mirror"]) for n in names]
        sign = np.array([c[n]["sign"] for n in names], float)
        data = self.body.model.createData()
        pin.computeJointJacobians(self.body.model, data, self.body.neutral())
        travel = self.scene["travel"] / 2 * self.body.forward + self.scene["rise"] / 2 * self.body.up
        shift = np.zeros(len(names))
        for i, n in enumerate(names):
            if not c[n]["turns"] and not c[n]["actuated"]:
                axis = pin.getJointJacobian(self.body.model, data, c[n]["joint"], pin.WORLD)[:3, i]
                shift[i] = axis @ travel
        return partner, sign, shift

    # -------------------------------------------------------------- kinematics

    def move(self):
        """Rotation and place of every joint, velocity and acceleration of its origin, spin and its rate,
        all in the world's axes; energy, momentum and its rate about the centre of mass."""
        model, data = self.body.model, self.body.model.createData()
        n, m = len(self.t), model.njoints
        self.R, self.p = np.empty((n, m, 3, 3)), np.empty((n, m, 3))
        local = np.empty((4, n, m, 3))
        self.momentum, self.momentum_rate, self.center = np.empty((n, 6)), np.empty((n, 6)), np.empty((n, 3))
        for k in range(n):
            pin.computeCentroidalMomentumTimeVariation(model, data, self.q[k], self.v[k], self.a[k])
            self.momentum[k], self.momentum_rate[k], self.center[k] = data.hg.vector, data.dhg.vector, data.com[0]
            pin.forwardKinematics(model, data, self.q[k], self.v[k], self.a[k])
            for j in range(m):
                self.R[k, j], self.p[k, j] = data.oMi[j].rotation, data.oMi[j].translation
                local[0, k, j], local[1, k, j] = data.v[j].linear, data.v[j].angular
                local[2, k, j], local[3, k, j] = data.a[j].linear, data.a[j].angular
        self.velocity, self.spin, spatial, self.spin_rate = np.einsum("kjab,xkjb->xkja", self.R, local)
        self.acceleration = spatial + np.cross(self.spin, self.velocity)

    def at(self, link, place):
        """Place, velocity and acceleration of a point of a link."""
        joint, behind = self.body.links[link]
        arm = self.R[:, joint] @ (behind.rotation @ np.asarray(place, float) + behind.translation)
        w = self.spin[:, joint]
        around = np.cross(w, arm)
        return (self.p[:, joint] + arm, self.velocity[:, joint] + around,
                self.acceleration[:, joint] + np.cross(self.spin_rate[:, joint], arm) + np.cross(w, around))

    def point(self, name):
        return self.at(*self.body.points[name])

    def point_at(self, name, k):
        """Place of a point at one time."""
        if name not in self.places:
            self.places[name] = self.point(name)[0]
        return self.places[name][k]

    def direction(self, link, axis):
        joint, behind = self.body.links[link]
        return self.R[:, joint] @ (behind.rotation @ np.asarray(axis, float))

    def required(self):
        """Force, and moment about the world's origin, that the surroundings must exert."""
        force = self.momentum_rate[:, :3] - self.body.mass * self.body.gravity
        return force, self.momentum_rate[:, 3:] + np.cross(self.center, force)

    # ---------------------------------------------------------------- the rest

    def ground(self, place):
        """Height of the ground under places; of stairs that of the step."""
        base = (self.problem.get("constraints") or {}).get("ground_height", 0.0)
        along = place @ self.body.forward
        height = np.full(along.shape, base)
        for s in self.scene["ground"]["surfaces"]:
            low, high = ends_of(s)
            here = (along >= low) & (along < high)
            height[here] = base + s["height"] + s["slope"] * (along[here] - s["at"])
        return height

    def flies(self):
        """When nothing that the ground does is written."""
        forces = [np.abs(x) for name, x in self.table.items() if name.startswith(("grf.", "moment."))]
        return np.all([x == 0 for x in forces], axis=0)

    def integral(self, y):
        """From the beginning to each time, by trapezoids."""
        step = np.diff(self.t) if y.ndim == 1 else np.diff(self.t)[:, None]
        return np.concatenate([np.zeros_like(y[:1]), np.cumsum(step * (y[1:] + y[:-1]) / 2, axis=0)])


class Contact:
    """One contact of the schedule: the foot or patch, how it stands, when."""

    def __init__(self, motion, c):
        self.name, self.mode, self.begin, self.end = c["name"], c["mode"], c["from"], c["to"]
        self.holds = (motion.t >= self.begin - 1e-9) & (motion.t <= self.end + 1e-9)
        self.normal, self.corners = motion.body.up, None
        if c.get("surface"):
            self.corners = np.array(c["surface"]) @ motion.body.axes
            self.normal = unit(np.cross(self.corners[0] - self.corners[1], self.corners[0] - self.corners[3]))
        for given in listed(motion.problem.get("contacts")):
            if given.get("foot") == self.name and "normal" in given:
                raise ValueError("feet on slopes of their own are not covered")


def unit(x):
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


def ends_of(surface):
    low, high = surface["from"], surface["to"]
    return -np.inf if low is None else low, np.inf if high is None else high


def read_json(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return json.load(file)


def read_table(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    numbers = np.array(rows[1:], float)
    return {name: numbers[:, i] for i, name in enumerate(rows[0])}
