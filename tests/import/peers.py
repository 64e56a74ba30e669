"""Imported models against Pinocchio and MuJoCo: mass matrix and torques over random poses.

Arguments: the program, a scratch folder, then Python files' words of what is compared (urdf, mjcf).
Prints a line for each model and, last, "N passed, N failed"; "skipped: ..." where a package is
missing. Our numbers are those of `ambulo inverse`: tau(q, qd, qdd), and columns of the mass matrix
as tau(q, 0, e_i) - tau(q, 0, 0).
"""

import csv
import glob
import importlib.util
import math
import os
import random
import subprocess
import sys
import xml.etree.ElementTree as ET

BOUND = 1e-9  # of the largest number of what is compared
POSES = 5


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


def judge(label, ours, theirs):
    size = max(1.0, max(abs(x) for row in theirs for x in row))
    worst = max(abs(a - b) for r, s in zip(ours, theirs) for a, b in zip(r, s)) / size
    good = worst <= BOUND and len(ours) == len(theirs)
    print(f"{'ok' if good else 'FAILED':8} {label}: {len(ours[0])} coordinates, "
          f"{len(ours)} states, worst difference {worst:.1e} of the largest torque")
    return good


# ----------------------------------------------------------------- Pinocchio


def pin_states(pin, model, names, held, states):
    """(q, v, a) of Pinocchio. The root is a composite of the six joints of the import."""
    root = ["base_tx", "base_ty", "base_tz", "base_tilt", "base_list", "base_rotation"]
    for state in states:
        values = [dict(zip(names, part)) for part in state]
        q = pin.neutral(model)
        v, a = [0.0] * model.nv, [0.0] * model.nv
        for j in range(1, model.njoints):
            joint, name = model.joints[j], model.names[j]
            if joint.nv == 6:
                for i, n in enumerate(root):
                    q[joint.idx_q + i] = values[0][n]
                    v[joint.idx_v + i], a[joint.idx_v + i] = values[1][n], values[2][n]
                continue
            angle = values[0].get(name, held.get(name, 0.0))
            if joint.nq == 2:
                q[joint.idx_q], q[joint.idx_q + 1] = math.cos(angle), math.sin(angle)
            else:
                q[joint.idx_q] = angle
            v[joint.idx_v], a[joint.idx_v] = values[1].get(name, 0.0), values[2].get(name, 0.0)
        yield q, v, a


def pin_columns(model, names):
    root = ["base_tx", "base_ty", "base_tz", "base_tilt", "base_list", "base_rotation"]
    at = {}
    for j in range(1, model.njoints):
        joint, name = model.joints[j], model.names[j]
        for i in range(joint.nv):
            at[root[i] if joint.nv == 6 else name] = joint.idx_v + i
    return [at[n] for n in names]


def compare_urdf(ambulo, source, scratch, seed):
    import numpy as np
    import pinocchio as pin

    target = convert(ambulo, source, os.path.join(scratch, "model.yaml"), "--repair-inertia")
    names = [n for n, _ in coordinates(target)]
    root = pin.JointModelComposite()
    for joint in (pin.JointModelPX(), pin.JointModelPY(), pin.JointModelPZ(), pin.JointModelRY(),
                  pin.JointModelRX(), pin.JointModelRZ()):
        root.addJoint(joint, pin.SE3.Identity())
    free = "base_tx" in names
    model = pin.buildModelFromUrdf(source, root) if free else pin.buildModelFromUrdf(source)
    model.gravity.linear[:] = [0, 0, -9.81]
    held = {}
    for joint in ET.parse(source).getroot().findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            held[joint.get("name")] = float(mimic.get("offset", 0))
    data = model.createData()
    states = random_states(names, seed)
    columns = pin_columns(model, names)
    theirs = []
    for q, v, a in pin_states(pin, model, names, held, states):
        theirs.append(pin.rnea(model, data, q, np.array(v), np.array(a))[columns].tolist())
    return judge(os.path.basename(source), our_torques(ambulo, target, names, states, scratch), theirs)


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
    names = ("talos_full_v2.urdf", "icub.urdf", "g1_29dof_rev_1_0.urdf", "romeo.urdf",
             "simple_humanoid.urdf", "human.urdf", "ur5_robot.urdf", "double_pendulum_continuous.urdf")
    return [found[n] for n in names if n in found]


def main():
    ambulo, scratch = sys.argv[1:3]
    passed = failed = 0
    sources = []
    if importlib.util.find_spec("pinocchio") is None:
        print("skipped: URDF against Pinocchio (no package `pin`)")
    else:
        sources = [(compare_urdf, path) for path in urdfs()]
        if not sources:
            print("skipped: URDF against Pinocchio (no package `example-robot-data`)")
    for i, (compare, path) in enumerate(sources):
        good = compare(ambulo, path, scratch, i)
        passed, failed = passed + good, failed + (not good)
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
