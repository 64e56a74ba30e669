"""What acts on the body from outside, as the table of the motion says it.

    ground  force and moment about the world's origin, on the link of the foot's heel, or of the patch
    hands   the opposite of the force and the moment that a hand exerts, at its point
    cords   a tension E pulls both ends of a device towards each other
    joints  an effort E of a device at a joint adds to the person's torque
"""

import numpy as np

from body import listed


class Load:
    """On a link: force and moment about the world's origin at every time."""

    def __init__(self, kind, name, motion, link, force, moment):
        self.kind, self.name, self.link, self.force, self.moment = kind, name, link, force, moment
        self.joint = motion.body.links[link][0]

    def power(self, motion):
        v, w, p = (x[:, self.joint] for x in (motion.velocity, motion.spin, motion.p))
        about = self.moment - np.cross(p, self.force)  # about the joint's origin
        return (self.force * v).sum(1) + (about * w).sum(1)


def center(load, n, origin):
    """Of pressure, on the plane through origin across n; wrong where nothing presses."""
    up = load.force @ n
    moment = load.moment - np.cross(origin, load.force)
    with np.errstate(all="ignore"):
        return origin + np.cross(n, moment) / up[:, None]


def of_ground(motion):
    loads = []
    if not motion.reaction:
        return loads
    for name in [*motion.body.feet, *motion.body.patches]:
        if f"grf.{name}.x" in motion.table:
            loads.append(Load("ground", name, motion, link_of(motion.body, name), motion.vectors(f"grf.{name}"),
                              motion.vectors(f"moment.{name}")))
    return loads


def link_of(body, name):
    if name in body.patches:
        return body.points[body.patches[name]["point"]][0]
    heel, toe = (listed(body.feet[name][end]) for end in ("heel", "toe"))
    links = {body.points[p][0] for p in heel + toe}
    if len(links) > 1:
        raise ValueError(f"the foot {name} is two links, whose loads the table does not tell apart")
    return links.pop()


def of_hands(motion):
    loads = []
    for name, hand in hands(motion):
        force, moment = (-motion.vectors(f"held.{name}.{hand}.{kind}") for kind in ("force", "moment"))
        place = motion.point(hand)[0]
        loads.append(Load("hand", hand, motion, motion.body.points[hand][0], force,
                          moment + np.cross(place, force)))
    return loads


def hands(motion):
    for load in listed(motion.problem.get("load")):
        for hand in load.get("hands", []):
            yield load.get("name", "load"), hand


def devices(motion):
    """Each device of the problem, with the images that `mirror` adds."""
    for device in listed(motion.problem.get("devices")):
        yield device
        if device.get("mirror"):
            yield image_of(motion.body, device)


def image_of(body, device):
    c = body.coordinates[device["coordinate"]]  # images of cords do not occur
    if c["sign"] != 1:
        raise ValueError("images of devices at joints that change their sign are not covered")
    foot = body.feet[device["foot"]]["mirror"] if "foot" in device else None
    name = device["name"]
    name = name[:-2] + "_l" if name.endswith("_r") else name[:-2] + "_r" if name.endswith("_l") else name + "_mirror"
    return {**device, "name": name, "coordinate": c["mirror"], "foot": foot}


def end_of(motion, end):
    return motion.body.points[end["point"]] if "point" in end else (end["link"], np.array(end["position"], float))


def of_cords(motion):
    loads = []
    for device in devices(motion):
        if "between" not in device:
            continue
        ends = [end_of(motion, end) for end in device["between"]]
        places = [motion.at(*end)[0] for end in ends]
        line = places[1] - places[0]
        pull = motion.table[f"device.{device['name']}.force"][:, None] * line / np.linalg.norm(line, axis=1)[:, None]
        for (link, _), place, force in zip(ends, places, (pull, -pull)):
            loads.append(Load("cord", device["name"], motion, link, force, np.cross(place, force)))
    return loads


def joint_efforts(motion):
    """[times][coordinates], what devices at joints do."""
    efforts = np.zeros_like(motion.tau)
    for device in devices(motion):
        if "coordinate" in device:
            column = motion.body.names.index(device["coordinate"])
            kind = "torque" if motion.body.coordinates[device["coordinate"]]["turns"] else "force"
            efforts[:, column] += motion.table[f"device.{device['name']}.{kind}"]
    return efforts


def of_all(motion):
    return of_ground(motion) + of_hands(motion) + of_cords(motion)
