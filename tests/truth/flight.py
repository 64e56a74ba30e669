"""Times at which the ground does nothing. Then m c'' = m g, the angular momentum about the centre of mass is constant, and
nothing but the person's own joints does work:

    force     |m (c'' - g)| / m g
    momentum  |L(t) - L(take-off)|
    energy    |int tau_root . v_root dt|, what forces and moments from nowhere bring in
"""

import numpy as np

import loads
from sole import at, larger, runs


def check(motion):
    if not motion.reaction or not motion.flies().any():
        return {}
    if any(load.kind == "hand" for load in loads.of_all(motion)):
        raise ValueError("flights with held loads are not covered")
    force = np.linalg.norm(motion.required()[0], axis=1) / motion.body.weight
    root = [i for i, n in enumerate(motion.body.names) if not motion.body.coordinates[n]["actuated"]]
    brought = motion.integral((motion.residual * motion.v[:, root]).sum(1))
    cells = {"flight force": None, "flight momentum": None, "flight energy": None}
    for first, last in runs(motion.flies()):
        k = slice(first, last + 1)
        gain = np.linalg.norm(motion.momentum[k, 3:] - motion.momentum[first, 3:], axis=1)
        work = np.abs(brought[k] - brought[first])
        for name, x in (("flight force", force[k]), ("flight momentum", gain), ("flight energy", work)):
            cells[name] = larger(cells[name], (x.max(), at(motion, first + x.argmax())))
    return cells
