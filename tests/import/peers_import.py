"""Imported models against Pinocchio, MuJoCo and OpenSim: mass matrix and torques over random poses.

Arguments: the program and a scratch folder. Prints a line for each model and, last, "N passed, N failed"; "skipped: ..." where a package is
missing. Our numbers are those of `ambulo inverse`: tau(q, qd, qdd), and columns of the mass matrix
as tau(q, 0, e_i) - tau(q, 0, 0).
"""

import csv
import glob
import importlib.util
import math
import os
import random
import re
import subprocess
import sys
import xml.etree.ElementTree as ET

BOUND = 1e-10  # of the largest number of what is compared
MASS_BOUND = 1e-12  # of the largest entry of a mass matrix, that of MuJoCo with armature
POSES = 5
ROOT = ["base_tx", "base_ty", "base_tz", "base_tilt", "base_list", "base_rotation"]


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(" ".join(words) + "\n" + done.stderr)
    return done.stdout


def convert(ambulo, source, target, *options):
    run(ambulo, "import", source, "-o", target, "--force", *options)
    return target


def coordinates(model):
    """Names and whether they are angles, in the order of the file."""
    found = []
    for line in open(model, encoding="utf-8"):
        if "- {name: " in line and "joint: " in line:
            angle = "joint: revolute" in line
        if "coordinate: {name: " in line:
            found.append((line.split("coordinate: {name: ")[1].split(",")[0].split("}")[0], angle))
    return found


def root_axes(model):
    """Axes of the six joints that an import gives a free URDF, in its order: those of a robot that
    looks along another axis than x are turned."""
    text = open(model, encoding="utf-8").read()
    axes = {}
    for axis, name in re.findall(r"axis: \[([^]]*)\],\s+coordinate: \{name: (base_\w+)", text):
        axes[name] = [float(x) for x in axis.split(",")]
    return axes


def our_torques(ambulo, model, names, states, scratch):
    """tau of states [(q, qd, qdd)], each a list in the order of names."""
    table = os.path.join(scratch, "states.csv")
    with open(table, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["time"] + [k + n for k in ("q.", "qd.", "qdd.") for n in names])
        for i, state in enumerate(states):
            rows.writerow([i] + [repr(x) for part in state for x in part])
    text = run(ambulo, "inverse", model, table, "--angles", "radians", "--grf", "none")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return [[float(row["tau." + n]) for n in names] for row in csv.DictReader(lines)]


def random_states(names, seed):
    draw = random.Random(seed)
    d = len(names)
    states = []
    for _ in range(POSES):
        q = [draw.uniform(-1, 1) for _ in range(d)]
        states.append((q, [draw.uniform(-2, 2) for _ in range(d)],
                       [draw.uniform(-5, 5) for _ in range(d)]))
    zero = [0.0] * d
    for q, _, _ in list(states):
        states.append((q, zero, zero))
        for i in range(d):
            states.append((q, zero, [float(i == k) for k in range(d)]))
    return states


def judge(label, ours, theirs, bound=BOUND):
    size = max(1.0, max(abs(x) for row in theirs for x in row))
    worst = max(abs(a - b) for r, s in zip(ours, theirs) for a, b in zip(r, s)) / size
    good = worst <= bound and len(ours) == len(theirs)
    print(f"{'ok' if good else 'FAILED':8} {label}: {len(ours[0])} coordinates, "
          f"{len(ours)} states, worst difference {worst:.1e} of the largest torque")
    return good


# ----------------------------------------------------------------- Pinocchio


def mimics(source):
    """(leader, multiplier, offset) of joints that follow another, which itself follows none."""
    found = {}
    for joint in ET.parse(source).getroot().findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            found[joint.get("name")] = (mimic.get("joint"), float(mimic.get("multiplier", 1)),
                                        float(mimic.get("offset", 0)))
    for name in found:
        while found[name][0] in found:
            (leader, times, plus), (above, more, start) = found[name], found[found[name][0]]
            found[name] = (above, times * more, times * start + plus)
    return found


def pin_states(pin, model, names, followers, states):
    """(q, v, a) of Pinocchio. The root is a composite of the six joints of the import."""
    for state in states:
        values = [dict(zip(names, part)) for part in state]
        for name, (leader, times, plus) in followers.items():
            for k in range(3):
                values[k][name] = times * values[k][leader] + (plus if k == 0 else 0.0)
        q = pin.neutral(model)
        v, a = [0.0] * model.nv, [0.0] * model.nv
        for j in range(1, model.njoints):
            joint, name = model.joints[j], model.names[j]
            if joint.nv == 6:
                for i, n in enumerate(ROOT):
                    q[joint.idx_q + i] = values[0][n]
                    v[joint.idx_v + i], a[joint.idx_v + i] = values[1][n], values[2][n]
                continue
            angle = values[0].get(name, 0.0)
            if joint.nq == 2:
                q[joint.idx_q], q[joint.idx_q + 1] = math.cos(angle), math.sin(angle)
            else:
                q[joint.idx_q] = angle
            v[joint.idx_v], a[joint.idx_v] = values[1].get(name, 0.0), values[2].get(name, 0.0)
        yield q, v, a


def pin_columns(model, names):
    at = {}
    for j in range(1, model.njoints):
        joint, name = model.joints[j], model.names[j]
        for i in range(joint.nv):
            at[ROOT[i] if joint.nv == 6 else name] = joint.idx_v + i
    return [at[n] for n in names]


def compare_urdf(ambulo, source, scratch, seed):
    import numpy as np
    import pinocchio as pin

    target = convert(ambulo, source, os.path.join(scratch, "model.yaml"), "--repair-inertia")
    names = [n for n, _ in coordinates(target)]
    root, axes = pin.JointModelComposite(), root_axes(target)
    free = "base_tx" in names
    for name in ROOT if free else []:
        kind = pin.JointModelPrismaticUnaligned if name in ROOT[:3] else pin.JointModelRevoluteUnaligned
        root.addJoint(kind(np.array(axes[name])), pin.SE3.Identity())
    model = pin.buildModelFromUrdf(source, root) if free else pin.buildModelFromUrdf(source)
    model.gravity.linear[:] = [0, 0, -9.81]
    followers = mimics(source)
    data = model.createData()
    states = random_states(names, seed)
    columns = pin_columns(model, names + list(followers))
    # the speed by which dry friction is smoothed
    smooth = np.full(model.nv, 0.1)
    for j in range(1, model.njoints):
        if model.joints[j].nv == 1 and model.joints[j].shortname().startswith("JointModelP"):
            smooth[model.joints[j].idx_v] = 0.01
    theirs = []
    for q, v, a in pin_states(pin, model, names, followers, states):
        v = np.array(v)
        tau = pin.rnea(model, data, q, v, np.array(a))
        tau += model.damping * v + model.friction * v / np.hypot(v, smooth)
        tau = dict(zip(names + list(followers), tau[columns].tolist()))
        for name, (leader, times, _) in followers.items():
            tau[leader] += times * tau[name]
        theirs.append([tau[n] for n in names])
    return judge(os.path.basename(source), our_torques(ambulo, target, names, states, scratch), theirs)


# ------------------------------------------------------------------- MuJoCo


def mujoco_replace(mujoco, body, joint, new, drive):
    """A joint of several coordinates by joints of one: (name, slides, axis in the body's frame)."""
    pos = list(joint.pos)
    for name, slides, axis in new:
        kind = mujoco.mjtJoint.mjJNT_SLIDE if slides else mujoco.mjtJoint.mjJNT_HINGE
        body.add_joint(name=name, type=kind, axis=axis, pos=pos, limited=0, **drive)


def mujoco_model(mujoco, np, source):
    compiled = mujoco.MjModel.from_xml_path(source)
    spec = mujoco.MjSpec.from_file(source)
    for part in (spec.actuators, spec.tendons, spec.equalities, spec.sensors, spec.keys, spec.excludes):
        for item in list(part):
            spec.delete(item)
    unit, none = np.eye(3), {"armature": 0, "damping": [0, 0, 0], "frictionloss": 0}
    for body in spec.bodies:
        for joint in list(body.joints):
            name = joint.name
            if joint.type == mujoco.mjtJoint.mjJNT_FREE:
                name, turn = name or "base", np.zeros(9)
                mujoco.mju_quat2Mat(turn, compiled.body(body.name).quat)
                world = turn.reshape(3, 3)  # rows: the world's axes in the body's
                parts = [("_tx", 1, 0), ("_ty", 1, 1), ("_tz", 1, 2), ("_tilt", 0, 1), ("_list", 0, 0),
                         ("_rotation", 0, 2)]
                mujoco_replace(mujoco, body, joint, [(name + n, s, world[k]) for n, s, k in parts], none)
                spec.delete(joint)
            elif joint.type == mujoco.mjtJoint.mjJNT_BALL:
                parts = zip("xyz", unit)
                drive = {key: getattr(joint, key) for key in none}
                mujoco_replace(mujoco, body, joint, [(f"{name}_{n}", 0, axis) for n, axis in parts], drive)
                spec.delete(joint)
    return spec.compile()


def mujoco_friction(mujoco, np, model):
    """Dry friction by the speed of each dof, smoothed as model.h says."""
    slides = np.array([model.jnt_type[j] == mujoco.mjtJoint.mjJNT_SLIDE for j in model.dof_jntid])
    return lambda v: model.dof_frictionloss * v / np.hypot(v, np.where(slides, 0.01, 0.1))


def mass_error(states, ours, theirs):
    """Largest difference of the entries of mass matrices, of the largest entry."""
    d, worst = len(ours[0]), 0.0
    for first in range(POSES, len(states), d + 1):
        m = [[[row[k] - rows[first][k] for k in range(d)] for row in rows[first + 1:first + 1 + d]]
             for rows in (ours, theirs)]
        size = max(abs(x) for row in m[1] for x in row)
        worst = max(worst, max(abs(a - b) for r, s in zip(*m) for a, b in zip(r, s)) / size)
    return worst


def mujoco_couplings(mujoco, source):
    """(follower, leader, coefficients) of active equalities of two joints."""
    model, found = mujoco.MjModel.from_xml_path(source), []
    for i in range(model.neq):
        if model.eq_type[i] == mujoco.mjtEq.mjEQ_JOINT and model.eq_active0[i] and model.eq_obj2id[i] >= 0:
            found.append((model.joint(model.eq_obj1id[i]).name, model.joint(model.eq_obj2id[i]).name,
                          list(model.eq_data[i][:5])))
    return found


def compare_mjcf(ambulo, source, scratch, seed):
    import mujoco
    import numpy as np

    target = convert(ambulo, source, os.path.join(scratch, "model.yaml"))
    names = [n for n, _ in coordinates(target)]
    couplings = mujoco_couplings(mujoco, source)
    model = mujoco_model(mujoco, np, source)
    model.jnt_stiffness[:] = 0
    friction = mujoco_friction(mujoco, np, model)
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    if not model.opt.gravity.any():
        model.opt.gravity[:] = [0, 0, -9.81]  # as the import says
    data = mujoco.MjData(model)
    joints = names + [follower for follower, _, _ in couplings]
    at = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, n) for n in joints]
    assert min(at) >= 0 and model.nv == len(joints), (joints, model.nv)
    states = random_states(names, seed)
    theirs = []
    for q, v, a in states:
        q, v, a, slopes = list(q), list(v), list(a), []
        for follower, leader, c in couplings:
            k, y0 = names.index(leader), model.joint(follower).qpos0[0]
            x = q[k] - model.joint(leader).qpos0[0]
            slope = sum(i * c[i] * x ** (i - 1) for i in range(1, 5))
            bend = sum(i * (i - 1) * c[i] * x ** (i - 2) for i in range(2, 5))
            q.append(y0 + sum(c[i] * x ** i for i in range(5)))
            v.append(slope * v[k])
            a.append(slope * a[k] + bend * v[k] ** 2)
            slopes.append((k, slope))
        for k, j in enumerate(at):
            data.qpos[model.jnt_qposadr[j]] = q[k]
            data.qvel[model.jnt_dofadr[j]], data.qacc[model.jnt_dofadr[j]] = v[k], a[k]
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)  # with armature
        tau = mass @ data.qacc + data.qfrc_bias - data.qfrc_damper + friction(data.qvel)
        all_of_them = [float(tau[model.jnt_dofadr[j]]) for j in at]
        for (k, slope), more in zip(slopes, all_of_them[len(names):]):
            all_of_them[k] += slope * more
        theirs.append(all_of_them[:len(names)])
    ours = our_torques(ambulo, target, names, states, scratch)
    good = judge(os.path.basename(source), ours, theirs)
    error = mass_error(states, ours, theirs)
    if error > MASS_BOUND:
        print(f"FAILED   {os.path.basename(source)}: mass matrix, {error:.1e} of its largest entry")
    return good and error <= MASS_BOUND


def package_files(package, *paths):
    spec = importlib.util.find_spec(package)
    folder = os.path.dirname(spec.origin) if spec and spec.origin else ""
    return [os.path.join(folder, p) for p in paths if os.path.exists(os.path.join(folder, p))]


def mjcfs():
    wanted = os.environ.get("AMBULO_MJCF")
    if wanted:
        return wanted.split(":")
    here = os.path.dirname(os.path.abspath(__file__))
    return (sorted(glob.glob(os.path.join(here, "*.xml")))
            + package_files("gymnasium", "envs/mujoco/assets/humanoid.xml",
                            "envs/mujoco/assets/walker2d_v5.xml", "envs/mujoco/assets/ant.xml")
            + package_files("dm_control", "suite/humanoid.xml", "suite/humanoid_CMU.xml",
                            "suite/walker.xml"))


# ------------------------------------------------------------------ OpenSim


def osim_follows(osim, function):
    """Whether a joint of ours can follow such a function; the others an import freezes."""
    inner = osim.MultiplierFunction.safeDownCast(function)
    while inner is not None:
        function = inner.getFunction()
        inner = osim.MultiplierFunction.safeDownCast(function)
    kind = function.getConcreteClassName()
    if kind == "PolynomialFunction":
        return osim.PolynomialFunction.safeDownCast(function).getCoefficients().size() <= 5
    return kind in ("Constant", "LinearFunction", "SimmSpline", "NaturalCubicSpline")


def osim_freeze(osim, model):
    """Axes that cannot follow a coordinate become constants where it stands by default."""
    for k in range(model.getJointSet().getSize()):
        joint = osim.CustomJoint.safeDownCast(model.updJointSet().get(k))
        if joint is None:
            continue
        spatial = joint.upd_SpatialTransform()
        for i in range(6):
            axis = spatial.updTransformAxis(i)
            names = axis.getCoordinateNames()
            if names.size() == 0 or not axis.hasFunction() or osim_follows(osim, axis.getFunction()):
                continue
            default = model.getCoordinateSet().get(names.getValue(0)).getDefaultValue()
            axis.set_function(osim.Constant(axis.getFunction().calcValue(osim.Vector(1, default))))
            axis.setCoordinateNames(osim.ArrayStr())


class Coupler:
    """f of a coordinate that another one follows; value and derivatives by its coordinate."""

    def __init__(self, osim, constraint):
        self.osim = osim
        self.leader = constraint.getIndependentCoordinateNames().get(0)
        self.follower = constraint.getDependentCoordinateName()
        self.function = constraint.getFunction().clone()
        self.scale = osim.PropertyHelper.getValueDouble(constraint.getPropertyByName("scale_factor"))

    def at(self, x):
        place = self.osim.Vector(1, x)
        order = [self.osim.StdVectorInt([0] * n) for n in (1, 2)]
        return [self.scale * self.function.calcValue(place)] + [
            self.scale * self.function.calcDerivative(part, place) for part in order]


def osim_couplers(osim, model):
    found = []
    for k in range(model.getConstraintSet().getSize()):
        coupler = osim.CoordinateCouplerConstraint.safeDownCast(model.getConstraintSet().get(k))
        if coupler is not None:
            found.append(Coupler(osim, coupler))
    return found


def osim_turns(q, v, a):
    """Angular velocity and acceleration of turns about x, then y, then z of the body, as OpenSim's
    free and ball joints have for speeds: E(q), its product with the rates, and its derivative."""
    c1, s1, c2, s2 = math.cos(q[0]), math.sin(q[0]), math.cos(q[1]), math.sin(q[1])
    e = [[1, 0, s2], [0, c1, -s1 * c2], [0, s1, c1 * c2]]
    de = [[0, 0, c2 * v[1]],
          [0, -s1 * v[0], -c1 * c2 * v[0] + s1 * s2 * v[1]],
          [0, c1 * v[0], -s1 * c2 * v[0] - c1 * s2 * v[1]]]
    speed = [sum(e[i][k] * v[k] for k in range(3)) for i in range(3)]
    push = [sum(e[i][k] * a[k] + de[i][k] * v[k] for k in range(3)) for i in range(3)]
    return e, speed, push


def osim_balls(model):
    """Names of the three turns of every free or ball joint."""
    found = []
    for k in range(model.getJointSet().getSize()):
        joint = model.getJointSet().get(k)
        if joint.getConcreteClassName() in ("FreeJoint", "BallJoint"):
            found.append([joint.get_coordinates(i).getName() for i in range(3)])
    return found


def osim_values(names, held, couplers, motion):
    """(q, qd, qdd) of coordinates by name, with those that others make follow; slopes of these."""
    values, slopes = dict(zip(names, zip(*motion))), []
    for coupler in couplers:
        x, dx, ddx = values.get(coupler.leader, (held[coupler.leader], 0.0, 0.0))
        f, slope, bend = coupler.at(x)
        values[coupler.follower] = (f, slope * dx, slope * ddx + bend * dx * dx)
        slopes.append((coupler, slope))
    return values, slopes


def osim_turns_twice(osim, model):
    """Whether a coordinate turns a joint about several axes. There OpenSim 4.6 has torques of
    velocities that its own energies contradict (Rajagopal's knee: by 0.3 % of the largest)."""
    for k in range(model.getJointSet().getSize()):
        joint = osim.CustomJoint.safeDownCast(model.getJointSet().get(k))
        turns = []
        for i in range(3 if joint is not None else 0):
            names = joint.getSpatialTransform().getTransformAxis(i).getCoordinateNames()
            turns += [names.getValue(0)] if names.size() else []
        if len(turns) > len(set(turns)):
            return True
    return False


def osim_powers(model, names, held, couplers, states):
    """dE/dt on motions of constant acceleration, by differences of OpenSim's energies."""
    state, h = model.initSystem(), 1e-3
    coordinates = [model.getCoordinateSet().get(k) for k in range(model.getCoordinateSet().getSize())]
    for q, v, a in states:
        total = 0.0
        for k, share in ((-2, 1), (-1, -8), (1, 8), (2, -1)):
            t = k * h
            moved = ([x + t * (dx + t * ddx / 2) for x, dx, ddx in zip(q, v, a)],
                     [dx + t * ddx for dx, ddx in zip(v, a)], a)
            values, _ = osim_values(names, held, couplers, moved)
            for c in coordinates:
                x, dx, _ = values.get(c.getName(), (held[c.getName()], 0.0, 0.0))
                c.setValue(state, x, False)
                c.setSpeedValue(state, dx)
            model.realizeVelocity(state)
            center, gravity = model.calcMassCenterPosition(state), model.getGravity()
            height = sum(center.get(i) * gravity.get(i) for i in range(3))
            total += share * (model.calcKineticEnergy(state) - model.getTotalMass(state) * height)
        yield [total / (12 * h)]


def osim_torques(osim, model, names, scale, held, couplers, states):
    model.updConstraintSet().clearAndDestroy()
    model.updForceSet().clearAndDestroy()
    for k in range(model.getCoordinateSet().getSize()):
        model.updCoordinateSet().get(k).set_locked(False)
        model.updCoordinateSet().get(k).set_clamped(False)
    model.finalizeConnections()
    state = model.initSystem()
    coordinates = [model.getCoordinateSet().get(k) for k in range(model.getCoordinateSet().getSize())]
    # where the speed of a coordinate stands among the generalized speeds
    at = {}
    for c in coordinates:
        state.setU(osim.Vector(state.getNU(), 0.0))
        c.setSpeedValue(state, 1.0)
        at[c.getName()] = [state.getU().get(i) for i in range(state.getNU())].index(1.0)
    solver = osim.InverseDynamicsSolver(model)
    for q, v, a in states:
        values, slopes = osim_values(names, held, couplers, (q, v, a))
        acceleration = osim.Vector(state.getNU(), 0.0)
        for c in coordinates:
            n = c.getName()
            x, dx, ddx = values.get(n, (held[n] * scale.get(n, 1.0), 0.0, 0.0))
            c.setValue(state, x / scale.get(n, 1.0), False)
            c.setSpeedValue(state, dx / scale.get(n, 1.0))
            acceleration.set(at[n], ddx / scale.get(n, 1.0))
        turned = []
        for ball in osim_balls(model):
            e, speed, push = osim_turns(*zip(*[values[n] for n in ball]))
            for n, u, w in zip(ball, speed, push):
                model.getCoordinateSet().get(n).setSpeedValue(state, u)
                acceleration.set(at[n], w)
            turned.append((ball, e))
        tau = solver.solve(state, acceleration)
        ours = {n: tau.get(at[n]) / scale.get(n, 1.0) for n in names}
        for coupler, slope in slopes:
            if coupler.leader in ours:
                ours[coupler.leader] += slope * tau.get(at[coupler.follower])
        for ball, e in turned:
            for k, n in enumerate(ball):
                ours[n] = sum(e[i][k] * tau.get(at[ball[i]]) for i in range(3))
        yield [ours[n] for n in names]


def compare_osim(ambulo, source, scratch, seed):
    import opensim as osim

    osim.Logger.setLevelString("error")
    target = convert(ambulo, source, os.path.join(scratch, "model.yaml"))
    names = [n for n, _ in coordinates(target)]
    model = osim.Model(source)
    model.initSystem()
    couplers = osim_couplers(osim, model)
    all_of_it = [model.getCoordinateSet().get(k) for k in range(model.getCoordinateSet().getSize())]
    held = {c.getName(): c.getDefaultValue() for c in all_of_it}
    osim_freeze(osim, model)
    scale = {}
    for line in open(target, encoding="utf-8"):
        if "times the source's coordinate" in line:
            words = line.split("#   - ")[1].split()
            scale[words[0]] = float(words[2])
    states, label, good = random_states(names, seed), os.path.basename(source), True
    ours = our_torques(ambulo, target, names, states, scratch)
    theirs = list(osim_torques(osim, model, names, scale, held, couplers, states))
    if osim_turns_twice(osim, model):
        moving = states[:POSES]
        powers = [[sum(t * v for t, v in zip(tau, s[1]))] for tau, s in zip(ours, moving)]
        good = judge(label + ", power", powers, list(osim_powers(model, names, held, couplers, moving)), 1e-7)
        ours, theirs, label = ours[POSES:], theirs[POSES:], label + ", at rest"
    return judge(label, ours, theirs) and good


def osims():
    wanted = os.environ.get("AMBULO_OSIM")
    if wanted:
        return wanted.split(":")
    here = os.path.dirname(os.path.abspath(__file__))
    fetched = os.environ.get("AMBULO_OPENSIM", os.path.join(here, "..", "..", "build", "opensim"))
    return [path for folder in (here, fetched) for path in sorted(glob.glob(os.path.join(folder, "*.osim")))]


def urdfs():
    wanted = os.environ.get("AMBULO_URDF")
    if wanted:
        return wanted.split(":")
    import pinocchio

    prefix = os.path.dirname(pinocchio.__file__)
    found = {}
    for folder in ("../../../../share/example-robot-data", "../../cmeel.prefix/share/example-robot-data"):
        for path in glob.glob(os.path.join(prefix, folder, "robots", "**", "*.urdf"), recursive=True):
            found.setdefault(os.path.basename(path), os.path.realpath(path))
    # humanoids, an arm on a table, joints that follow others, continuous joints
    here = os.path.dirname(os.path.abspath(__file__))
    names = ("talos_full_v2.urdf", "icub.urdf", "g1_29dof_rev_1_0.urdf", "romeo.urdf",
             "simple_humanoid.urdf", "human.urdf", "ur5_robot.urdf", "double_pendulum_continuous.urdf")
    return sorted(glob.glob(os.path.join(here, "*.urdf"))) + [found[n] for n in names if n in found]


def main():
    ambulo, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
    for name in ("AMBULO_URDF", "AMBULO_OSIM", "AMBULO_MJCF", "AMBULO_OPENSIM"):
        if name in os.environ:
            paths = os.environ[name].split(":")
            os.environ[name] = ":".join(os.path.abspath(path) for path in paths)
    os.chdir(scratch)  # packages leave logs where they run
    passed = failed = 0
    sources = []
    if importlib.util.find_spec("pinocchio") is None:
        print("skipped: URDF against Pinocchio (no package `pin`)")
    else:
        sources = [(compare_urdf, path) for path in urdfs()]
        if len(sources) < 2:
            print("skipped: humanoids against Pinocchio (no package `example-robot-data`)")
    if importlib.util.find_spec("opensim") is None:
        print("skipped: OpenSim models against OpenSim (no package `opensim`)")
    else:
        sources += [(compare_osim, path) for path in osims()]
        if "AMBULO_OSIM" not in os.environ and all("Rajagopal" not in path for _, path in sources):
            print("skipped: published models against OpenSim (tests/users/fetch_opensim.sh build/opensim brings them)")
    if importlib.util.find_spec("mujoco") is None:
        print("skipped: MuJoCo models against MuJoCo (no package `mujoco`)")
    else:
        sources += [(compare_mjcf, path) for path in mjcfs()]
    for i, (compare, path) in enumerate(sources):
        good = compare(ambulo, path, scratch, i)
        passed, failed = passed + good, failed + (not good)
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
