"""A predicted motion of a robot, replayed in Pinocchio on its own URDF.

Arguments: the URDF, the imported model, motion.csv. Of every line of the motion the pose, velocity and
acceleration of the root are those of the six joints of the import, in its order; as a free flyer of
Pinocchio it then has spatial ones in its own axes. With the forces of the ground on the feet,

    tau = M(q) a + b(q, v) - sum over feet of J^T f,

whose first six, what the root would need besides, should vanish, and whose others should be the
torques of the motion. Prints "N passed, N failed"; bounds are shares of the weight m g, for moments
and torques times 1 m.
"""

import csv
import math
import os
import re
import sys

import numpy as np
import pinocchio as pin

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "import"))
import peers_import

BOUND = 1e-8
ROOT = peers_import.ROOT


def rows_of(motion):
    with open(motion, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            yield {name: float(value) for name, value in row.items()}


def root_model(imported, lift):
    """The root alone, on the joints that `ambulo import` gives it."""
    model, parent = pin.Model(), 0
    place, axes = pin.SE3(np.eye(3), np.array(lift)), peers_import.root_axes(imported)
    for name in ROOT:
        kind = pin.JointModelPrismaticUnaligned if name in ROOT[:3] else pin.JointModelRevoluteUnaligned
        parent = model.addJoint(parent, kind(np.array(axes[name])), place, name)
        place = pin.SE3.Identity()
    return model


def state_of(model, root, row):
    """q, v, a of the free flyer and the joints behind it."""
    q, v, a = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    data = root.createData()
    pin.forwardKinematics(root, data, *(np.array([row[kind + n] for n in ROOT]) for kind in ("q.", "qd.", "qdd.")))
    q[:7] = pin.SE3ToXYZQUAT(data.oMi[6])
    v[:6], a[:6] = data.v[6].vector, data.a[6].vector
    for j in range(2, model.njoints):
        joint, name = model.joints[j], model.names[j]
        if "q." + name not in row:
            continue  # one that the import holds
        angle = row["q." + name]
        q[joint.idx_q:joint.idx_q + joint.nq] = angle if joint.nq == 1 else (math.cos(angle), math.sin(angle))
        v[joint.idx_v], a[joint.idx_v] = row["qd." + name], row["qdd." + name]
    return q, v, a


def forces_of(model, data, feet, row):
    """What the ground does to each joint, in its axes; data holds the poses."""
    forces = [pin.Force.Zero() for _ in range(model.njoints)]
    for foot, link in feet.items():
        force = np.array([row[f"grf.{foot}.{axis}"] for axis in "xyz"])
        if not force.any():
            continue  # in the air: no centre of pressure
        at = np.array([row[f"cop.{foot}.{axis}"] for axis in "xyz"])
        moment = np.cross(at, force) + [0, 0, row[f"free_moment.{foot}"]]
        joint = model.frames[model.getFrameId(link)].parentJoint
        forces[joint] += data.oMi[joint].actInv(pin.Force(force, moment))
    return forces


def main():
    urdf, imported, motion = sys.argv[1:4]
    text = open(imported, encoding="utf-8").read()
    lift = [float(x) for x in re.search(r"xyz: \[([^]]*)\]", text).group(1).split(",")]
    feet = dict(re.findall(r"- \{name: (left|right)_heel, link: (\w+),", text))
    assert len(feet) == 2, feet
    model = pin.buildModelFromUrdf(urdf, pin.JointModelFreeFlyer())
    model.gravity.linear[:] = [0, 0, -9.81]
    data, root = model.createData(), root_model(imported, lift)
    weight = 9.81 * pin.computeTotalMass(model)
    worst_root = worst_joint = 0.0
    count = 0
    for row in rows_of(motion):
        q, v, a = state_of(model, root, row)
        pin.forwardKinematics(model, data, q)
        tau = pin.rnea(model, data, q, v, a, forces_of(model, data, feet, row))
        tau += model.damping * v + model.friction * v / np.hypot(v, 0.1)
        ours = np.zeros(model.nv)
        for j in range(2, model.njoints):
            name = "tau." + model.names[j]
            ours[model.joints[j].idx_v] = row.get(name, tau[model.joints[j].idx_v])
        worst_root = max(worst_root, np.abs(tau[:6]).max() / weight)
        worst_joint = max(worst_joint, np.abs((tau - ours)[6:]).max() / weight)
        count += 1
    print(f"Pinocchio {pin.__version__}: {count} times, root {worst_root:.1e}, joints {worst_joint:.1e} of the weight")
    good = [count > 10 and worst_root <= BOUND, count > 10 and worst_joint <= BOUND]
    if not all(good):
        print(f"FAILED: more than {BOUND:.0e} of the weight")
    print(f"{sum(good)} passed, {len(good) - sum(good)} failed")
    return not all(good)


if __name__ == "__main__":
    sys.exit(main())
