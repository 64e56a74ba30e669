"""Pads of heels: springs between heel and ground, which give by b = heel_pad under the body weight W.

    d = b F / W,   held: b F^2 / 2 W

F is the normal force of a foot on its heel; of a flat one the part that presses at the heel if the rest presses
at the ball: F_n (ball - x) / (ball - heel), x ahead to the centre of pressure, by the true sole's lines.
"""

import numpy as np

import loads


def give(motion):
    return motion.problem.get("ground_reaction", {}).get("heel_pad", 0.0)


def pressing(motion, sole):
    """N at the heel, at every time."""
    found = np.zeros(len(motion.t))
    load = next((x for x in loads.of_ground(motion) if x.name == sole.name), None)
    if load is None or not give(motion):
        return found
    n = motion.body.up
    heel = motion.point(sole.heel)[0]
    origin, f, back, ball, _ = sole.reach()
    place = loads.center(load, n, heel + (motion.ground(heel) - heel @ n)[:, None] * n)
    up, x = load.force @ n, ((place - origin) * f).sum(1)
    share = {"heel": 1.0, "flat": (ball - x) / (ball - back)}
    for c in motion.contacts:
        if c.name == sole.name and c.mode in share:
            found = np.where(c.holds & (up > 0), up * share[c.mode], found)
    return found


def depth(motion, sole):
    """m"""
    return give(motion) * pressing(motion, sole) / motion.body.weight


def energy(motion, sole):
    """J"""
    return depth(motion, sole) * pressing(motion, sole) / 2
