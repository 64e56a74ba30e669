"""The model's own limits, at all times: of joints in degrees beyond their range, of torques in % of the limit
of that direction. Coordinates of the root have none here."""

import numpy as np

from sole import at, larger


def check(motion):
    joint = torque = None
    for i, name in enumerate(motion.body.names):
        c = motion.body.coordinates[name]
        if not c["actuated"]:
            continue
        if c["turns"]:
            over = np.maximum(c["range"][0] - motion.q[:, i], motion.q[:, i] - c["range"][1])
            if np.isfinite(over.max()):
                joint = larger(joint, (max(0.0, np.degrees(over.max())), f"{name} {at(motion, over.argmax())}"))
        for limit, tau in ((c["torque"][1], motion.tau[:, i]), (-c["torque"][0], -motion.tau[:, i])):
            if np.isfinite(limit) and limit > 0:
                share = 100 * (tau / limit - 1)
                torque = larger(torque, (max(0.0, share.max()), f"{name} {at(motion, share.argmax())}"))
    return {"joint limits": joint, "torque limits": torque}
