"""The judge is judged: distances against brute force, splines against differences, and a walk, a jump and a lift
whose files are changed, each of which must move the cell that it concerns beyond its bound.

    python tests/truth/test_truth.py FOLDER    a scratch folder; results of `walk`, `jump`, `lift` are in it,
                                              and the file of `walk_padded`, which has a heel pad
"""

import csv
import json
import os
import shutil
import sys

import numpy as np

import ground
import solids
import spline
import strict_yaml
import truth

MODELS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "models")
RANDOM = np.random.default_rng(5)


def main():
    checks = [segments, segment_and_box, boxes, hulls, splines, texts, *faults_of(sys.argv[1])]
    passed = 0
    for check in checks:
        wrong = check()
        passed += not wrong
        if wrong:
            print(f"FAILED: {check.__name__}: {wrong}")
    print(f"{passed} passed, {len(checks) - passed} failed")
    return passed < len(checks)


# -------------------------------------------------------------------- geometry

def segments():
    p, q, a, b = RANDOM.normal(size=(4, 200, 3))
    q[:20], b[20:40] = p[:20], a[20:40]  # spheres
    s = np.linspace(0, 1, 201)[None, :, None]
    one, other = p[:, None] + s * (q - p)[:, None], a[:, None] + s * (b - a)[:, None]
    least = [np.linalg.norm(x[:, None] - y[None], axis=2).min() for x, y in zip(one, other)]
    off = np.array(least) - solids.segment_to_segment(p, q, a, b)
    return "" if (off > -1e-12).all() and (off < 0.03).all() else f"{off.min()} {off.max()}"


def segment_and_box():
    a, b = RANDOM.normal(size=(2, 200, 3))
    half = np.array([0.3, 0.5, 0.2])
    s = np.linspace(0, 1, 20001)[None, :, None]
    points = a[:, None] + s * (b - a)[:, None]
    least = np.linalg.norm(np.maximum(0, np.abs(points) - half), axis=2).min(1)
    off = least - solids.segment_to_box(a, b, half)
    if not ((off > -1e-9).all() and (off < 1e-3).all()):
        return f"distance {off.min()} {off.max()}"
    inside = least < 1e-9
    out = solids.segment_in_box(a, b, half)[inside]
    # moved by less than the way out in any direction it still touches, in one it does not
    for k, way in zip(np.flatnonzero(inside), out):
        d = RANDOM.normal(size=(2000, 3))
        d *= 0.99 * way / np.linalg.norm(d, axis=1)[:, None]
        if solids.segment_to_box(a[k] + d, b[k] + d, half).max() > 1e-6:
            return f"{way} is further than needed"
    return "" if inside.sum() > 10 and (out > 0).all() else "no case"


def boxes():
    cube = solids.Box("a", np.zeros((3, 3)), np.broadcast_to(np.eye(3), (3, 3, 3)), [0.5, 0.5, 0.5])
    turn = np.array([[1, 1, 0], [-1, 1, 0], [0, 0, np.sqrt(2)]]) / np.sqrt(2)
    middle = np.array([[0.8, 0, 0], [1.0, 0, 0], [1.3, 0, 0]])
    other = solids.Box("b", middle, np.broadcast_to(turn, (3, 3, 3)), [0.5, 0.5, 0.5])
    expected = 0.5 + np.sqrt(0.5) - middle[:, 0]  # an edge against a face
    off = np.abs(cube.box(other) - expected).max()
    return "" if off < 1e-12 else str(off)


def hulls():
    square = [np.array(p, float) for p in ((0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.5))]
    found = [ground.outside_hull(square, np.array(p)) for p in ((0.2, 0.9), (2, 0.5), (2, 2), (0.5, -0.25))]
    return "" if np.allclose(found, [0, 1, np.sqrt(2), 0.25]) else str(found)


def splines():
    knots, points = spline.clamped([0, 0.3, 0.5, 1.2], 4), RANDOM.normal(size=(7, 2))
    t, h = np.linspace(0.01, 1.19, 50), 1e-5
    slope = spline.value(*spline.derivative(points, knots, 4), t)
    off = np.abs(slope - (spline.value(points, knots, 4, t + h) - spline.value(points, knots, 4, t - h)) / (2 * h))
    ones = spline.value(np.ones((7, 1)), knots, 4, t)
    return "" if off.max() < 1e-7 and np.abs(ones - 1).max() < 1e-14 else f"{off.max()}"


def texts():
    lines = ["a:", "  {b: [1, 2e-3], 'c d': none}", "list: # of two", "  - {x: -1}", "  - y: 'it: is'", "    z: [[1],", "      [2]]",
             "text: a, b: c"]
    found = strict_yaml.Blocks(strict_yaml.lines_of(lines)).block(0)
    expected = {"a": {"b": [1, 0.002], "c d": None}, "list": [{"x": -1}, {"y": "it: is", "z": [[1], [2]]}],
                "text": "a, b: c"}
    return "" if found == expected else str(found)


# ---------------------------------------------------------------- wrong results

def column(name, change):
    """A change of the table."""
    def apply(folder):
        path = os.path.join(folder, "motion.csv")
        rows = list(csv.reader(open(path, encoding="utf-8")))
        at = rows[1].index(name)
        for row in rows[2:]:
            row[at] = repr(change(float(row[at])))
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
    return apply


def control_point(coordinate, by):
    def apply(folder):
        path = os.path.join(folder, "solution.yaml")
        lines = open(path, encoding="utf-8").read().split("\n")
        at = strict_yaml.load(path)["coordinates"].index(coordinate)
        first = lines.index("control_points:") + 1
        for k in range(first, len(lines)):
            if not lines[k].startswith("  - ["):
                break  # what follows are multipliers
            numbers = lines[k].strip()[3:-1].split(", ")
            numbers[at] = repr(float(numbers[at]) + by * (k - first))
            lines[k] = "  - [" + ", ".join(numbers) + "]"
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    return apply


def scene(change):
    def apply(folder):
        path = os.path.join(folder, "scene.json")
        content = json.load(open(path, encoding="utf-8"))
        change(content)
        json.dump(content, open(path, "w", encoding="utf-8"))
    return apply


def shorter(content):
    """Nothing is where the ground is."""
    content["ground"]["surfaces"] = [{"from": None, "to": None, "at": 0, "height": 0.05, "slope": 0}]


# problem, what is changed, cells that must be larger than before and beyond their bound
FAULTS = [
    ("walk", column("q.knee_angle_r", lambda x: x + 1e-8), ["spline"]),
    ("walk", column("tau.knee_angle_r", lambda x: x * (1 + 1e-5)), ["torque"]),
    ("walk", column("grf.right.y", lambda x: x * 1.001), ["torque", "root", "energy"]),
    ("walk", column("grf.right.z", lambda x: x + 0.6 * 75 * 9.81), ["root", "cone"]),
    ("walk", column("grf.left.y", lambda x: -x), ["pull"]),
    ("walk", column("moment.left.z", lambda x: x * 1.05), ["root", "pressure"]),
    ("walk", control_point("pelvis_tx", 0.004), ["spline", "ground work", "slip"]),
    ("walk", control_point("hip_adduction_r", 0.03), ["overlap"]),
    ("walk", scene(shorter), ["sinks"]),
    ("walk", column("grf.left.y", lambda x: 0.5 * x), ["sinks"]),
    ("lift", column("held.box.hand_r.force.y", lambda x: x + 0.1), ["held", "root"]),
    ("lift", control_point("elbow_flex_r", -0.02), ["joint limits", "held"]),
    ("lift", column("tau.knee_angle_r", lambda x: 20 * x), ["torque limits"]),
    ("jump", control_point("pelvis_ty", -0.02), ["flight energy", "sinks", "spline"]),
    ("jump", control_point("lumbar_extension", 0.5), ["flight momentum", "flight force"]),
    ("walk_exotendon", column("device.tendon.force", lambda x: 1.001 * x), ["devices", "torque"]),
]


def faults_of(scratch):
    before = {}
    for k, (problem, change, cells) in enumerate(FAULTS):
        def check(problem=problem, change=change, cells=cells):
            file, folder = os.path.join(MODELS, problem + ".yaml"), os.path.join(scratch, problem)
            if not os.path.exists(file):
                file = folder + ".yaml"
            if problem not in before:
                before[problem] = cells_of(file, folder)
            wrong = os.path.join(scratch, "wrong")
            shutil.rmtree(wrong, ignore_errors=True)
            shutil.copytree(folder, wrong)
            change(wrong)
            return missed(before[problem], cells_of(file, wrong), cells)
        check.__name__ = f"{problem}, fault {k + 1}"
        yield check


def cells_of(file, folder):
    row = {"cells": {}}
    truth.examine(file, folder, row)
    return row["cells"]


def missed(before, after, cells):
    bound = {c[0]: c[3] for c in truth.COLUMNS}
    value = lambda x, name: -1.0 if x[name] is None else x[name][0]  # noqa: E731
    return ", ".join(f"{c}: {value(before, c):g} to {value(after, c):g}" for c in cells
                     if not (value(after, c) > bound[c] and value(after, c) > 1.2 * value(before, c)))


if __name__ == "__main__":
    sys.exit(main())
