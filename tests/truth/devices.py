"""What the body wears and carries, from the problem's own numbers.

Devices: E = -g w k h(s - s0 + P / k), -g w c s', w a f; g = 1 at a joint, -1 between points; h(x) = x, or on
one side b (u^3 - u^4 / 2) with u = x / b + 1/2 cut to [0, 1], and x beyond; w = S((v) / r) S((l - v) / r)
of a clutch, v the share of the stride since `from`.

Held loads: with c = (p1 + p2) / 2 + o, G = w (m (c'' - g)) + w P, hands exert

    f1 + f2 = G,    sum (p_k - c) x f_k + m_k = w I (d x d'') / (d . d),    d = p2 - p1.
"""

import numpy as np

import loads
from body import listed
from sole import larger


def check(motion):
    return {"devices": devices(motion), "held": held(motion)}


def smooth(u):
    u = np.clip(u, 0, 1)
    return u * u * (3 - 2 * u)


# ---------------------------------------------------------------- devices

def devices(motion):
    """Relative to each device's largest effort."""
    worst = None
    for device in loads.devices(motion):
        written = effort_column(motion, device)
        off = np.abs(written - law(motion, device)).max() / max(np.abs(written).max(), 1e-9)
        worst = larger(worst, (off, device["name"]))
    return worst


def effort_column(motion, device):
    name = f"device.{device['name']}."
    return motion.table[name + "torque"] if name + "torque" in motion.table else motion.table[name + "force"]


def law(motion, device):
    s, rate, g, unit = coordinate(motion, device)
    w = clutch(motion, device)
    if device["kind"] == "damper":
        return -g * w * device["damping"] * rate
    if device["kind"] == "actuator":
        if "points" in device:
            raise ValueError("profiles of actuators are not covered")
        return w * device.get("amount", 1.0)
    k = device["stiffness"]
    stretch = s - device["rest"] * unit + (device.get("pretension", 0.0) / k if k else 0.0)
    side = {"above": 1, "below": -1}.get(device.get("side"), 0)
    if side:
        stretch = side * one_sided(side * stretch, device.get("smoothing", 0.01 / unit) * unit)
    return -g * w * k * stretch


def one_sided(x, b):
    u = np.clip(x / b + 0.5, 0, 1)
    return np.where(x > b / 2, x, b * (u ** 3 - u ** 4 / 2))


def coordinate(motion, device):
    """s, its rate, g and the unit of its numbers."""
    if "coordinate" in device:
        i = motion.body.names.index(device["coordinate"])
        turns = motion.body.coordinates[device["coordinate"]]["turns"]
        return motion.q[:, i], motion.v[:, i], 1, motion.angle if turns else 1.0
    (p, u, _), (q, v, _) = (motion.at(*loads.end_of(motion, end)) for end in device["between"])
    s = np.linalg.norm(q - p, axis=1)
    return s, ((q - p) * (v - u)).sum(1) / s, -1, 1.0


def clutch(motion, device):
    if "engaged" not in device:
        return 1.0
    begin, end, r = (device["engaged"].get(k, d) for k, d in (("from", 0), ("to", 1), ("ramp", 0.05)))
    strike = next(s["time"] for s in motion.summary["strikes"] if s["foot"] == device["foot"])
    share = ((motion.t - strike) / motion.scene["duration"]) % 1.0
    v, length = (share - begin) % 1.0, (end - begin) % 1.0
    return np.where(v <= length, smooth(v / r) * smooth((length - v) / r), 0.0)


# -------------------------------------------------------------- held loads

def held(motion):
    """Force in body weights, moment in body weights times 1 m."""
    worst = None
    for load in listed(motion.problem.get("load")):
        if "hands" in load:
            name = load.get("name", "load")
            worst = larger(worst, (wrench_error(motion, load, name) / motion.body.weight, name))
    return worst


def wrench_error(motion, load, name):
    w = window(motion, load)[:, None]
    points = [motion.point(hand) for hand in load["hands"]]
    forces = [motion.vectors(f"held.{name}.{hand}.force") for hand in load["hands"]]
    moments = [motion.vectors(f"held.{name}.{hand}.moment") for hand in load["hands"]]
    offset = np.array(load.get("center", [0, 0, 0]), float) @ motion.body.axes
    center = sum(p for p, _, _ in points) / len(points) + offset
    acceleration = sum(a for _, _, a in points) / len(points)
    push = np.array(load.get("force", [0, 0, 0]), float) @ motion.body.axes
    need = w * (load.get("mass", 0.0) * (acceleration - motion.body.gravity) + push)
    spin = np.zeros_like(need)
    if len(points) == 2:
        d, rate = points[1][0] - points[0][0], points[1][2] - points[0][2]
        spin = w * load.get("inertia", 0.0) * np.cross(d, rate) / (d * d).sum(1)[:, None]
        spin -= np.cross(offset, w * push)  # a push acts in the middle between the hands
    turning = sum(np.cross(p - center, f) + m for (p, _, _), f, m in zip(points, forces, moments))
    return max(np.abs(sum(forces) - need).max(), np.abs(turning - spin).max())


def window(motion, load):
    """1 while it is held, with a smooth rise and fall inside of the motion."""
    w = np.ones(len(motion.t))
    r = load.get("ramp", 0.1)
    if load.get("from", 0) > 1e-9:
        w *= smooth((motion.t - load["from"]) / r)
    if load.get("to", np.inf) < motion.t[-1] - 1e-9:
        w *= smooth((load["to"] - motion.t) / r)
    return w
