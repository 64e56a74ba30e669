#!/usr/bin/env python3
"""Muscles of the leg for Ambulo, from a model of OpenSim.

usage: leg_muscles.py SUBJECT.osim OUT.yaml [--sample SAMPLE.json] [--poses 3000]

SUBJECT.osim is OpenSim/Examples/Moco/example3DWalking/subject_walk_scaled.osim of opensim-core
(Apache-2.0): the muscles of Rajagopal et al. (2016), Lai et al. (2017) and Uhlrich et al. (2022) on
one subject. Needs the packages opensim and numpy; takes a minute.

The right ankle of the model gets the axes of Ambulo's bodies: the ankle turns about the tibia's Z, and
the welded subtalar joint becomes a pin about the foot's X through the same centre. All lengths at the
neutral pose stay what they were. Then three things are fitted, by few terms chosen one at a time, each
the one that lessens what remains the most:

  length l(q), together with the moment arms -dl/dq, over random poses in the box RANGES;
  pull dl/dt at hip, knee and ankle: t moves the child of the joint along the axes of its parent, so
    a force F of the muscle pushes the child by -F pull;
  and the numbers of the muscles are copied. Shares of fast fibres: FAST_FIBERS.

Some paths of OpenSim slip off their wrapping surface and are up to 2 cm shorter from there on: psoas and
iliacus at hips extended by more than 22 degrees, the upper gluteus maximus in outward rotation. Such poses,
and those beside a jump, are left out: the polynomials go on as if the muscle kept its place.

SAMPLE.json gets 200 other poses with lengths and moment arms straight from OpenSim, for a test; "kept"
says where the path is in its place.
"""
import argparse
import itertools
import json
import math
import pathlib
import re
import tempfile
import textwrap
import xml.etree.ElementTree as ElementTree

import numpy as np
import opensim

COORDINATES = ["hip_flexion_r", "hip_adduction_r", "hip_rotation_r", "knee_angle_r", "ankle_angle_r",
               "subtalar_angle_r"]
RANGES = np.array([[-35, 65], [-20, 18], [-25, 25], [0, 120], [-35, 30], [-18, 18]])  # degrees
# Ambulo's joint: joint of OpenSim, Ambulo's link below, its link above with the parent's axes
JOINTS = {"hip_r": ("hip_r", "thigh_r", "pelvis"), "knee_r": ("walker_knee_r", "shank_r", "thigh_r"),
          "ankle_r": ("ankle_r", "talus_r", "shank_r")}
# The Achilles tendon stretches by a tenth under the largest force (own value); other tendons are rigid.
ELASTIC = {"soleus", "gaslat", "gasmed"}
# Forces are not scaled with the subject: they are those of the generic man of Rajagopal et al. (2016).
MASS_OF_FORCES = 75.3  # kg
# 1 - share of slow fibres in the table of Uchida et al. (2016), which gathers Johnson et al. (1973),
# Garrett et al. (1983) and others and says 0.5 where nobody measured
FAST_FIBERS = {"addbrev": .5, "addlong": .5, "addmagDist": .448, "addmagIsch": .448, "addmagMid": .448,
               "addmagProx": .448, "bflh": .4575, "bfsh": .471, "edl": .25, "ehl": .25, "fdl": .4, "fhl": .4,
               "gaslat": .493, "gasmed": .434, "glmax1": .45, "glmax2": .45, "glmax3": .45, "glmed1": .45,
               "glmed2": .45, "glmed3": .45, "glmin1": .45, "glmin2": .45, "glmin3": .45, "grac": .5,
               "iliacus": .5, "perbrev": .4, "perlong": .4, "piri": .5, "psoas": .5, "recfem": .6135,
               "sart": .5, "semimem": .5075, "semiten": .575, "soleus": .197, "tfl": .5, "tibant": .3,
               "tibpost": .4, "vasint": .457, "vaslat": .545, "vasmed": .497}
GROUPS = {"hip_flexors": "iliacus psoas sart",
          "hip_extensors": "glmax1 glmax2 glmax3",
          "hip_abductors": "glmed1 glmed2 glmed3 glmin1 glmin2 glmin3 tfl",
          "hip_adductors": "addbrev addlong addmagDist addmagIsch addmagMid addmagProx grac",
          "hip_rotators": "piri",
          "hamstrings": "bflh semimem semiten",
          "quadriceps": "recfem vasint vaslat vasmed",
          "knee_flexors": "bfsh",
          "plantarflexors": "gaslat gasmed soleus",
          "dorsiflexors": "edl ehl tibant",
          "invertors": "fdl fhl tibpost",
          "evertors": "perbrev perlong"}
SOURCE = [
    "opensim-core (Apache-2.0), OpenSim/Examples/Moco/example3DWalking/subject_walk_scaled.osim",
    "Rajagopal A et al (2016) Full-body musculoskeletal model for muscle-driven simulation of human gait. "
    "IEEE Trans Biomed Eng 63:2068-2079",
    "Lai AKM, Arnold AS, Wakeling JM (2017) Why are antagonist muscles co-activated in my simulation? "
    "Ann Biomed Eng 45:2762-2774",
    "Uhlrich SD et al (2022) Muscle coordination retraining inspired by musculoskeletal simulations reduces "
    "knee contact force. Sci Rep 12:9842",
    "De Groote F et al (2016) Evaluation of direct collocation optimal control problem formulations for solving "
    "the muscle redundancy problem. Ann Biomed Eng 44:2922-2936 (curves of force)",
    "Uchida TK et al (2016) Stretching your energetic budget. PLoS ONE 11:e0150378 (shares of fast fibers)"]
STEP = 1e-3          # rad and m, of central differences
LENGTH_WEIGHT = 2    # of a length's error, in m, beside an arm's, in m/rad


def align_ankle(source, target):
    """Write the model with the right ankle about the tibia's Z and a subtalar joint about the foot's X."""
    tree = ElementTree.parse(source)
    for frame in tree.find(".//PinJoint[@name='ankle_r']").iter("PhysicalOffsetFrame"):
        frame.find("orientation").text = "0 0 0"
    joint = tree.find(".//WeldJoint[@name='subtalar_r']")
    joint.tag = "PinJoint"
    coordinate = ElementTree.SubElement(ElementTree.SubElement(joint, "coordinates"), "Coordinate",
                                        name="subtalar_angle_r")
    ElementTree.SubElement(coordinate, "range").text = "-1 1"
    frames = {frame.get("name"): frame for frame in joint.iter("PhysicalOffsetFrame")}
    heel = [float(x) for x in frames["talus_r_offset"].find("translation").text.split()]
    # the talus has its origin at the ankle's centre: so has the joint, seen from either side
    frames["talus_r_offset"].find("translation").text = "0 0 0"
    frames["calcn_r_offset"].find("translation").text = " ".join(repr(-x) for x in heel)
    for frame in frames.values():
        frame.find("orientation").text = f"0 {math.pi / 2!r} 0"
    tree.write(target)


class Leg:
    """The right leg of a model at poses; shift moves the child of a joint along an axis of the parent."""

    def __init__(self, path, joint=None, axis=0, shift=0.0):
        self.model = opensim.Model(str(path))
        if joint:
            frame = opensim.PhysicalOffsetFrame.safeDownCast(self.model.getJointSet().get(joint).upd_frames(0))
            place = frame.get_translation()
            moved = opensim.Vec3(place.get(0), place.get(1), place.get(2))
            moved.set(axis, place.get(axis) + shift)
            frame.set_translation(moved)
        self.state = self.model.initSystem()
        every = self.model.getCoordinateSet()
        known = [every.get(i).getName() for i in range(every.getSize())]
        self.coordinates = [every.get(name) if name in known else None for name in COORDINATES]
        self.patella = every.get("knee_angle_r_beta")  # equals the angle of the knee
        muscles = self.model.getMuscles()
        self.muscles = [muscles.get(i) for i in range(muscles.getSize())
                        if muscles.get(i).getName().endswith("_r")]

    def put(self, pose):
        for coordinate, value in zip(self.coordinates, pose):
            if coordinate:
                coordinate.setValue(self.state, float(value), False)
        self.patella.setValue(self.state, float(pose[3]), False)
        self.model.realizePosition(self.state)

    def lengths(self, pose):
        self.put(pose)
        return np.array([muscle.getLength(self.state) for muscle in self.muscles])

    def place(self, body):
        return self.model.getBodySet().get(body).getTransformInGround(self.state).p().to_numpy()


def random_poses(count, seed):
    rng = np.random.default_rng(seed)
    low, high = np.radians(RANGES).T
    return low + (high - low) * np.stack([(rng.permutation(count) + rng.random(count)) / count
                                          for _ in COORDINATES], 1)


def measure(leg, poses):
    """Lengths [pose, muscle], moment arms [pose, muscle, coordinate], and where a path does not jump."""
    shape = len(poses), len(leg.muscles), len(COORDINATES)
    length, arms, bend = np.zeros(shape[:2]), np.zeros(shape), np.zeros(shape)
    for n, pose in enumerate(poses):
        length[n] = leg.lengths(pose)
        for j in range(len(COORDINATES)):
            step = STEP * (np.arange(len(COORDINATES)) == j)
            up, down = leg.lengths(pose + step), leg.lengths(pose - step)
            arms[n, :, j] = (down - up) / (2 * STEP)
            bend[n, :, j] = np.abs(up - 2 * length[n] + down) / STEP
    return length, arms, bend.max(2) < 2e-3


def measure_pull(path, joint, poses, length):
    """dl/dt [pose, muscle, axis], t of the joint's child along the axes of its parent, and where it is smooth."""
    def at(axis, shift):
        leg = Leg(path, joint, axis, shift)
        return np.array([leg.lengths(pose) for pose in poses])
    ends = np.array([[at(axis, -STEP), at(axis, STEP)] for axis in range(3)])
    bend = np.abs(ends.sum(1) - 2 * length) / STEP
    return np.moveaxis(ends[:, 1] - ends[:, 0], 0, 2) / (2 * STEP), bend.max(0) < .2


def powers(count, degree):
    """Exponents of all terms, by their total degree."""
    return sorted((e for e in itertools.product(range(degree + 1), repeat=count) if sum(e) <= degree),
                  key=lambda e: (sum(e), [-x for x in e]))


def term(exponents, q):
    return np.prod(q ** np.array(exponents), 1)


def slope(exponents, k, q):
    if exponents[k] == 0:
        return np.zeros(len(q))
    lower = np.array(exponents) - (np.arange(len(exponents)) == k)
    return exponents[k] * np.prod(q ** lower, 1)


def choose(columns, target, enough, most):
    """Columns that lessen the residual of target [row, any] the most, the first (constant) always, until
    enough(rms of the residual, count) or so many as most; their order of choice."""
    left, rest = columns.copy(), target.copy()
    scale = np.linalg.norm(columns, axis=0)
    chosen = [0]
    while True:
        unit = left[:, chosen[-1]] / np.linalg.norm(left[:, chosen[-1]])
        rest -= np.outer(unit, unit @ rest)
        if len(chosen) >= min(most, columns.shape[1]) or enough(rest, len(chosen)):
            return chosen
        left -= np.outer(unit, unit @ left)
        size = np.linalg.norm(left, axis=0)
        gain = np.where(size > 1e-6 * scale, ((left.T @ rest) ** 2).sum(1) / np.maximum(size, 1e-30) ** 2, 0)
        gain[chosen] = -1
        chosen.append(int(gain.argmax()))


def rms(x):
    return math.sqrt(np.mean(np.square(x)))


def fit_length(q, length, arms):
    """Terms of the length over the coordinates q: exponents, coefficients."""
    candidates = powers(q.shape[1], {1: 6, 2: 6, 3: 6, 4: 5}[q.shape[1]])
    columns = np.concatenate([[LENGTH_WEIGHT * term(e, q) for e in candidates]]
                             + [[-slope(e, k, q) for e in candidates] for k in range(q.shape[1])], 1).T
    target = np.concatenate([LENGTH_WEIGHT * length, arms.T.ravel()])[:, None]

    history = []

    def enough(rest, count):
        history.append(rms(rest))
        worst = max(rms(part) for part in np.split(rest, q.shape[1] + 1))
        if worst < 1.2e-3:
            return history[-1] < 6e-4 or count >= 26
        return count >= 26 and history[-1] > .95 * history[-5]  # more terms do not help

    chosen = sorted(choose(columns, target, enough, 40))
    return [candidates[i] for i in chosen], np.linalg.lstsq(columns[:, chosen], target[:, 0], rcond=None)[0]


def fit_pull(q, pull):
    """Common terms of the three components of a pull: exponents, coefficients [axis]."""
    candidates = powers(q.shape[1], 3)
    columns = np.array([term(e, q) for e in candidates]).T
    chosen = sorted(choose(columns, pull, lambda rest, count: rms(rest) < 5e-3, 30))
    return [candidates[i] for i in chosen], np.linalg.lstsq(columns[:, chosen], pull, rcond=None)[0].T


class Place:
    """Smooth length of a path that is in its place: from a parabola over all poses to a polynomial of the
    sixth degree, leaving out what is off, so that the shorter paths beyond a jump do not bend it."""

    def __init__(self, q, length):
        keep = np.ones(len(q), bool)
        for degree in range(2, 7 if q.shape[1] < 4 else 6):
            self.terms = powers(q.shape[1], degree)
            columns = self.columns(q)
            for _ in range(8):
                self.coefficients = np.linalg.lstsq(columns[keep], length[keep], rcond=None)[0]
                error = np.abs(columns @ self.coefficients - length)
                self.limit = max(3e-3, 5 * np.median(error))
                keep = error < self.limit

    def columns(self, q):
        return np.array([term(e, q) for e in self.terms]).T

    def holds(self, q, length):
        return np.abs(self.columns(q) @ self.coefficients - length) < self.limit


def number(x):
    return f"{x:.6g}"


def numbers(values):
    return "[" + ", ".join(number(x) for x in values) + "]"


def rows(exponents):
    return "[" + ", ".join("[" + ", ".join(map(str, e)) + "]" for e in exponents) + "]"


def wrapped(key, text, indent):
    """key: text in lines of at most 118 characters, which do not break within [1, 0, 2]."""
    whole = re.sub(r"\[[\d, ]+\]", lambda found: found[0].replace(" ", "~"), text)
    return textwrap.fill(f"{key}: {whole}", 118, initial_indent=" " * indent, subsequent_indent=" " * (indent + 2),
                         break_long_words=False, break_on_hyphens=False).replace("~", " ")


def describe(fit):
    """The YAML of a muscle."""
    lines = [f"  - name: {fit['name']}", f"    group: {fit['group']}"]
    for key, digits in (("force", "N"), ("fiber", "m, optimal length"), ("tendon", "m, slack length"),
                        ("pennation", "rad at optimal length"), ("passive_strain", ""),
                        ("fast_fibers", "")):
        text = f"    {key}: {number(fit[key])}"
        lines.append(f"{text:27s}# {digits}" if digits and fit["first"] else text)
    if fit["name"][:-2] in ELASTIC:
        lines += ["    elastic: ankle_angle_r", "    tendon_strain: 0.1"]
    lines.append(f"    coordinates: [{', '.join(fit['coordinates'])}]")
    lines.append(wrapped("exponents", rows(fit["exponents"]), 4))
    lines.append(wrapped("length", numbers(fit["length"]), 4))
    lines.append("    pull:")
    for joint, (exponents, parts) in fit["pull"].items():
        lines.append(f"      {joint}:")
        lines.append(wrapped("exponents", rows(exponents), 8))
        lines += [wrapped(axis, numbers(part), 8) for axis, part in zip("xyz", parts)]
    return "\n".join(lines)


def header(subject):
    quoted = "\n".join(textwrap.fill(f'- "{text}"', 116, initial_indent="  ", subsequent_indent="    ")
                       for text in SOURCE)
    box = "\n".join(f"  {name}: [{low}, {high}]" for name, (low, high) in zip(COORDINATES, RANGES))
    joints = "\n".join(f"  {name}: {{link: {link}, axes: {axes}}}" for name, (_, link, axes) in JOINTS.items())
    return f"""\
# Forty muscles of a leg and their mirror images. bench/leg_muscles.py writes this file; names are those of
# the model it comes from.
#
#   length: l(q) = sum of length[k] * product of q[j]^exponents[k][j]; the moment arm is -dl/dq.
#   pull: dl/dt, t a shift of the joint's child along X, Y, Z of the body above (pelvis, thigh, shank; ISB):
#     the force F of the muscle pushes the child by -F * pull. Its size is 1 where the muscle runs straight
#     across the joint. Of left legs, z has the other sign.
#
# The ankle turns about the shank's Z and the subtalar joint about the foot's X through one centre, as in
# lower_body_23; positive are flexion (of the ankle: toes up), adduction, inward rotation and inversion.
# The knee's lengths hold what OpenSim's knee slides and turns along as it bends. Toes are straight.
# Psoas, iliacus and the upper gluteus maximus keep their place where OpenSim's slip off a wrapping surface.
# Shares of fast fibers are those of Uchida et al. (2016), who gathered them; 0.5 where nobody measured.

ambulo: 1
kind: muscles
name: leg_muscles
source:
{quoted}
license: Apache-2.0
# whose forces these are, kg (the generic man of Rajagopal et al.), and whose lengths, m
subject: {{{', '.join(f'{key}: {number(value)}' for key, value in subject.items())}}}
mirror: {{_r: _l}}
# where the fit holds; degrees
coordinates:
{box}
# joints whose contact force is known: the link below; `axes`: the link above, along whose axes
joints:
{joints}
muscles:
"""


def subject_of(leg):
    """Mass; thigh and shank between joint centres, at the neutral pose."""
    leg.put(np.zeros(6))
    hip, ankle = leg.place("femur_r"), leg.place("talus_r")
    knee_joint = leg.model.getJointSet().get("walker_knee_r")
    knee = knee_joint.getParentFrame().getTransformInGround(leg.state).p().to_numpy()
    return {"mass": MASS_OF_FORCES,
            "thigh": round(float(np.linalg.norm(hip - knee)), 4),
            "shank": round(float(np.linalg.norm(knee - ankle)), 4)}


def numbers_of(muscle):
    hill = opensim.Millard2012EquilibriumMuscle.safeDownCast(muscle)
    return {"force": muscle.getMaxIsometricForce(), "fiber": muscle.getOptimalFiberLength(),
            "tendon": muscle.getTendonSlackLength(), "pennation": muscle.getPennationAngleAtOptimalFiberLength(),
            "passive_strain": hill.getFiberForceLengthCurve().getStrainAtOneNormForce()}


def rounded(values):
    return np.array([float(number(x)) for x in np.ravel(values)]).reshape(np.shape(values))


def write_sample(leg, places, path):
    poses = rounded(random_poses(200, 3))
    length, arms, smooth = measure(leg, poses)
    path.write_text(json.dumps({
        "units": "rad, m; arms are -dl/dq in m/rad; kept: the path is in its place there",
        "coordinates": COORDINATES, "poses": poses.tolist(),
        "muscles": {muscle.getName(): {
            "length": rounded(length[:, i]).tolist(), "arms": rounded(arms[:, i] + 0.0).tolist(),
            "kept": (smooth[:, i] & place.holds(poses[:, span], length[:, i])).tolist()}
            for i, (muscle, (span, place)) in enumerate(zip(leg.muscles, places))}}))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--sample", type=pathlib.Path)
    parser.add_argument("--poses", type=int, default=3000)
    arguments = parser.parse_args()
    opensim.Logger.setLevelString("error")
    with tempfile.TemporaryDirectory() as folder:
        aligned = pathlib.Path(folder) / "aligned.osim"
        align_ankle(arguments.model, aligned)
        leg = Leg(aligned)
        neutral = np.zeros(6)
        change = np.abs(leg.lengths(neutral) - Leg(arguments.model).lengths(neutral)).max()
        assert change < 1e-9, f"the neutral lengths changed by {change} m"
        poses, others = random_poses(arguments.poses, 1), random_poses(1000, 2)
        length, arms, smooth = measure(leg, poses)
        pulls = {name: measure_pull(aligned, joint, poses[:1500], length[:1500])
                 for name, (joint, _, _) in JOINTS.items()}
        test_length, test_arms, test_smooth = measure(leg, others)

    group_of = {name: group for group, names in GROUPS.items() for name in names.split()}
    text, terms, places = header(subject_of(leg)), 0, []
    print("muscle       terms   length  arms: rms  worst (of the range) mm   left out   pull: terms rms worst size")
    for i, muscle in enumerate(leg.muscles):
        name = muscle.getName()
        span = [j for j in range(6) if np.median(np.abs(arms[:, i, j])) > 1e-4]
        q = poses[:, span]
        place = Place(q, length[:, i])
        keep = smooth[:, i] & place.holds(q, length[:, i])
        exponents, coefficients = fit_length(q[keep], length[keep, i], arms[keep, i][:, span])
        fit = {"name": name, "group": group_of[name[:-2]], **numbers_of(muscle), "first": i == 0,
               "fast_fibers": FAST_FIBERS[name[:-2]], "coordinates": [COORDINATES[j] for j in span],
               "exponents": exponents, "length": coefficients, "pull": {}}
        notes = []
        for joint, (pull, steady) in pulls.items():
            pull = pull[:, i]
            if np.median(np.abs(pull).max(1)) < 1e-3:
                continue
            good = keep[:len(pull)] & steady[:, i]
            pull, at = pull[good], q[:len(good)][good]
            shared, parts = fit_pull(at, pull)
            fit["pull"][joint] = shared, parts
            error = pull - (rounded(parts) @ np.array([term(e, at) for e in shared])).T
            size = np.linalg.norm(pull, axis=1)
            notes.append(f"{joint[:-2]} {len(shared):2d} {rms(error):.4f} {np.abs(error).max():.3f}"
                         f" {size.min():.2f} to {size.max():.2f}")
        text += describe(fit) + "\n"
        places.append((span, place))
        terms += len(exponents)
        # errors at other poses, with the numbers that the file has
        good = test_smooth[:, i] & place.holds(others[:, span], test_length[:, i])
        q, c = others[good][:, span], rounded(coefficients)
        error = c @ np.array([term(e, q) for e in exponents]) - test_length[good, i]
        wrong = np.stack([-(c @ np.array([slope(e, k, q) for e in exponents])) - test_arms[good, i, j]
                          for k, j in enumerate(span)], 1)
        worst = np.unravel_index(np.abs(wrong).argmax(), wrong.shape)
        reach = np.abs(test_arms[good, i, span[worst[1]]]).max()
        print(f"{name:12s} {len(exponents):4d} {1e3 * rms(error):8.2f} {1e3 * rms(wrong):10.2f}"
              f" {1e3 * abs(wrong[worst]):6.1f} ({COORDINATES[span[worst[1]]][:-2]}, {1e3 * reach:.0f})"
              f" {np.sum(~keep):6d}   {'; '.join(notes)}")
    arguments.out.write_text(text)
    print(f"{len(leg.muscles)} muscles, {terms} terms of lengths: {arguments.out}")
    if arguments.sample:
        write_sample(leg, places, arguments.sample)


if __name__ == "__main__":
    main()
