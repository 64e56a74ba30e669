"""A model file of Ambulo, with the problem's subject, load and slope, as a model of Pinocchio.

A link's transform is T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha); its joint turns about, or slides
along, the z axis of its parent. So the joint stands at the parent's frame, and the link's frame at a
constant T behind it (turns about z commute). With `origin` and `axis` the joint stands at the origin.
"""

import os

import numpy as np
import pinocchio as pin

import strict_yaml


def turn(axis, angle):
    return pin.AngleAxis(angle, np.array(axis, float)).toRotationMatrix()


def move(rotation=None, place=(0.0, 0.0, 0.0)):
    return pin.SE3(np.eye(3) if rotation is None else rotation, np.array(place, float))


class Body:
    def __init__(self, problem, folder):
        self.file = strict_yaml.load(os.path.join(folder, problem["model"]))
        self.subject = {**(self.file.get("subject") or {}), **(problem.get("subject") or {})}
        self.set_units(self.file["units"])
        self.set_directions(problem)
        self.links, self.parents, self.coordinates = {}, {}, {}  # link: (joint, placement behind it)
        self.model = pin.Model()
        waiting = list(self.file["links"])
        while waiting:
            link = next(x for x in waiting if x["parent"] in (None, "world") or x["parent"] in self.links)
            waiting.remove(link)
            self.add_link(link)
        for load in listed(problem.get("load")):
            if "hands" not in load:
                self.add_mass(load)
        self.model.gravity.linear[:] = self.gravity
        self.names = [n for n in self.model.names if n in self.coordinates]
        self.mass = pin.computeTotalMass(self.model)
        self.weight = self.mass * np.linalg.norm(self.gravity)
        self.set_places()

    # ---------------------------------------------------------------- numbers

    def set_units(self, units):
        stature, mass = self.subject.get("stature"), self.subject.get("mass")
        self.angle = np.pi / 180 if units["angle"] == "degrees" else 1.0
        self.dh_angle = np.pi / 180 if units.get("dh_angle", units["angle"]) == "degrees" else 1.0
        self.length = stature if units.get("length") == "stature" else 1.0
        self.kilograms = mass if units.get("mass") == "body_mass" else 1.0
        self.relative_torque = units.get("torque") == "weight_stature"

    def sexed(self, x):
        """Numbers that are given for both sexes."""
        if isinstance(x, dict) and set(x) == {"male", "female"}:
            return self.sexed(x[self.subject["sex"]])
        if isinstance(x, dict):
            return {key: self.sexed(y) for key, y in x.items()}
        return [self.sexed(y) for y in x] if isinstance(x, list) else x

    def place(self, x):
        return np.array(self.sexed(x), float) * self.length

    def set_directions(self, problem):
        g = np.array(self.file.get("gravity", [0, -9.81, 0]), float)
        self.up = -g / np.linalg.norm(g)
        f = np.array(self.file.get("forward", [1, 0, 0]), float)
        f = f - self.up * (f @ self.up)
        self.forward = f / np.linalg.norm(f)
        self.left = np.cross(self.up, self.forward)
        self.axes = np.array([self.forward, self.left, self.up])  # world = (f, l, u) @ axes
        angle = np.pi / 180 if problem.get("angles") == "degrees" else 1.0
        slope = (problem.get("ground") or {}).get("slope", 0.0) * angle
        size = np.linalg.norm(g)
        self.gravity = -size * (np.cos(slope) * self.up + np.sin(slope) * self.forward)

    # ------------------------------------------------------------------ links

    def add_link(self, link):
        parent = link["parent"] if link["parent"] in self.links else None
        joint, behind = self.links[parent] if parent else (0, pin.SE3.Identity())
        if link["joint"] != "fixed":
            name = (link.get("coordinate") or {}).get("name", link["name"])
            kind, before = self.joint_of(link)
            joint, behind = self.model.addJoint(joint, kind, behind * before, name), pin.SE3.Identity()
            self.add_coordinate(name, link, joint)
            after = pin.SE3.Identity() if "origin" in link else self.dh(link)
        else:
            after = self.origin(link) if "origin" in link else self.dh(link)
        self.links[link["name"]], self.parents[link["name"]] = (joint, behind * after), parent
        for body in [link["body"]] if "body" in link else link.get("bodies") or []:
            self.add_body(link["name"], self.sexed(body))

    def dh(self, link):
        theta, d, a, alpha = self.sexed(link["dh"])
        first = move(turn([0, 0, 1], theta * self.dh_angle), [0, 0, d * self.length])
        return first * move(turn([1, 0, 0], alpha * self.dh_angle), [a * self.length, 0, 0])

    def origin(self, link):
        roll, pitch, yaw = np.array(self.sexed(link["origin"].get("rpy", [0, 0, 0])), float) * self.dh_angle
        rotation = turn([0, 0, 1], yaw) @ turn([0, 1, 0], pitch) @ turn([1, 0, 0], roll)
        return move(rotation, self.place(link["origin"].get("xyz", [0, 0, 0])))

    def joint_of(self, link):
        turns = link["joint"] == "revolute"
        if "origin" not in link:
            return (pin.JointModelRZ() if turns else pin.JointModelPZ()), pin.SE3.Identity()
        axis = np.array(link["axis"], float) / np.linalg.norm(link["axis"])
        kind = pin.JointModelRevoluteUnaligned if turns else pin.JointModelPrismaticUnaligned
        return kind(axis), self.origin(link)

    def add_coordinate(self, name, link, joint):
        c = self.sexed(link.get("coordinate") or {})
        turns = link["joint"] == "revolute"
        torque = 1.0
        if self.relative_torque:
            torque = self.subject["mass"] * np.linalg.norm(self.gravity) * (self.subject["stature"] if turns else 1.0)
        self.coordinates[name] = {
            "joint": joint, "turns": turns, "actuated": c.get("actuated", True),
            "mirror": c.get("mirror", name), "sign": c.get("mirror_sign", 1),
            "default": c.get("default", 0.0) * (self.angle if turns else self.length),
            "range": bounds(c.get("range"), self.angle if turns else self.length),
            "torque": bounds(c.get("torque"), torque)}

    def add_body(self, link, body):
        mass, com = body["mass"] * self.kilograms, self.place(body["com"])
        if "gyration" in body:
            inertia = mass * np.diag((np.array(body["gyration"]) * self.length) ** 2)
        else:
            xx, yy, zz, xy, xz, yz = np.array(body["inertia"], float) * self.kilograms * self.length ** 2
            inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        joint, behind = self.links[link]
        self.model.appendBodyToJoint(joint, pin.Inertia(mass, com, inertia), behind)

    def add_mass(self, load):
        joint, behind = self.links[load["link"]]
        point = pin.Inertia(load["mass"], np.array(load["position"], float), np.zeros((3, 3)))
        self.model.appendBodyToJoint(joint, point, behind)

    # ----------------------------------------------------------------- places

    def set_places(self):
        self.points = {p["name"]: (p["link"], self.place(p["position"])) for p in listed(self.file.get("points"))}
        self.feet = {f["name"]: f for f in listed(self.file.get("feet"))}
        self.patches = {p["name"]: p for p in listed(self.file.get("patches"))}
        self.capsules = {c["name"]: (c["link"], self.place(c["from"]), self.place(c["to"]),
                                     float(self.place(c["radius"]))) for c in listed(self.file.get("capsules"))}

    def index(self, name):
        """The column of a coordinate in Pinocchio's vectors."""
        return self.model.joints[self.coordinates[name]["joint"]].idx_v

    def neutral(self):
        q = np.zeros(self.model.nq)
        for name, c in self.coordinates.items():
            q[self.index(name)] = c["default"]
        return q


def listed(x):
    return [] if x is None else x if isinstance(x, list) else [x]


def bounds(pair, unit):
    low, high = pair if pair else (None, None)
    return (-np.inf if low is None else low * unit, np.inf if high is None else high * unit)
