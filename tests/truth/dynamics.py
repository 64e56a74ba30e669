"""The equations of motion, by Pinocchio's recursion:

    tau = M(q) a + b(q, v) - sum over loads of J^T W - efforts of devices at joints,

whose rows of the root vanish where the ground carries the body. And its energy,

    dE/dt = tau . v + power of all loads and devices,

dE/dt = (8 (E+ - E-) - (E++ - E--)) / 12 h of the kinetic and potential energy at q + v h + a h^2 / 2, v + a h.
"""

import numpy as np
import pinocchio as pin

import loads

STEP = 2e-4  # s


def check(motion):
    outside = loads.of_all(motion)
    tau = inverse(motion, outside) - loads.joint_efforts(motion)
    root = np.array([not motion.body.coordinates[n]["actuated"] for n in motion.body.names])
    motion.residual = tau[:, root]
    largest = np.abs(motion.tau).max()
    cells = {"spline": spline_against_table(motion)}
    compared = ~root if motion.reaction else np.ones_like(root)
    cells["torque"] = np.abs(tau - motion.tau)[:, compared].max() / largest
    cells["root"] = root_force(motion, root) if motion.reaction else None
    cells["energy"] = energy(motion, outside, np.where(compared, motion.tau, tau))
    return cells


def spline_against_table(motion):
    return max(np.abs(mine - motion.columns(name)).max() / max(1.0, np.abs(mine).max())
               for mine, name in ((motion.q, "q."), (motion.v, "qd."), (motion.a, "qdd.")))


def inverse(motion, outside):
    model, data = motion.body.model, motion.body.model.createData()
    tau = np.empty_like(motion.tau)
    for k in range(len(motion.t)):
        forces = pin.StdVec_Force()
        forces.extend([pin.Force.Zero()] * model.njoints)
        for load in outside:
            place = pin.SE3(motion.R[k, load.joint], motion.p[k, load.joint])
            forces[load.joint] += place.actInv(pin.Force(load.force[k], load.moment[k]))
        tau[k] = pin.rnea(model, data, motion.q[k], motion.v[k], motion.a[k], forces)
    return tau


def root_force(motion, root):
    """In body weights, moments times 1 m; flight has columns of its own."""
    rest = motion.residual[~motion.flies()] / motion.body.weight
    return np.abs(rest).max() if rest.size else None


def energy(motion, outside, tau):
    """Of the written torques and loads, relative to the largest sum of powers."""
    power = (tau * motion.v).sum(1) + sum(load.power(motion) for load in outside)
    power += (loads.joint_efforts(motion) * motion.v).sum(1)
    return np.abs(energy_rate(motion) - power).max() / np.abs((tau * motion.v)).sum(1).max()


def energy_rate(motion):
    model, data = motion.body.model, motion.body.model.createData()
    rate = np.zeros(len(motion.t))
    for shift, factor in ((-2, 1), (-1, -8), (1, 8), (2, -1)):
        h = shift * STEP
        q, v = motion.q + h * motion.v + h * h / 2 * motion.a, motion.v + h * motion.a
        rate += factor * np.array([pin.computeKineticEnergy(model, data, x, y)
                                   + pin.computePotentialEnergy(model, data, x) for x, y in zip(q, v)])
    return rate / (12 * STEP)
